"""The quantity ``fresnel``: R and T of a smooth film, the term a shader multiplies with its own D and G."""
