"""The quantity ``bsdf``: f_r and f_t of a rough surface with a film, the paper's equation 12 in full."""

from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver

__all__ = ["BsdfSolver", "bsdf_solver"]
