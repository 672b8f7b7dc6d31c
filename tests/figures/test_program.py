"""The program that makes the page of the paper's figures, as `make figures` runs it, with tiny pictures."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
