"""The HTTP service, and what it is made of."""
