"""BSDFs on the grids that readers of measured materials fix: one module a parametrisation."""
