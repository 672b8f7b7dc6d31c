"""Optical values in plain NumPy: materials, stacks and colour. No OpenCL."""
