"""Simpler models fitted to a film: one target, and a module a model."""
