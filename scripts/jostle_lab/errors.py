"""Errors that a reader can act on: name, value, range, remedy."""

import math


class LabError(Exception):
    """Something that the user can put right; the message says how."""


def require(name: str, value: float, low: float, high: float, remedy: str) -> float:
    """Return `value` if it is finite and in [low, high], else raise LabError with name, value, range and remedy."""
    if math.isfinite(value) and low <= value <= high:
        return value
    raise LabError(f"{name} = {value:g} is outside [{low:g}, {high:g}]. {remedy}")
