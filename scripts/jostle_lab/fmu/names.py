"""Names of parameters of a packing that more than the FMU itself must know."""

EXTRAPOLATION_DEGREE = "base.extrapolation_degree"
"""Degree of the polynomial through the inputs of the base."""
