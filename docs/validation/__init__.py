"""Nacreous against what others measured and computed: a picture and numbers for each comparison.

`PYTHONPATH=docs:tests python -m validation [name ...]` draws docs/images/validation and writes the numbers
into docs/validation.md, between the comments that name each comparison.
"""
