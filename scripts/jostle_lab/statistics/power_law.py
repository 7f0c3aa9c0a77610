"""Exponents of power laws by straight lines through logarithms."""

import math
from collections.abc import Sequence

import numpy as np

from jostle_lab.statistics.estimates import Estimate, Numbers


def log_slope(x: Sequence[float] | Numbers, y: Numbers) -> Numbers:
    """Slope of ln y against ln x by least squares, along the last axis of y; NaN where a y is not positive."""
    u = np.log(x) - np.mean(np.log(x))
    with np.errstate(invalid="ignore", divide="ignore"):
        v = np.log(y)
    return np.asarray(np.sum(u * v, axis=-1) / np.sum(u * u))


def power_law(x: Numbers, y: Numbers) -> Estimate:
    """Exponent b of y = a x^b by least squares in the logarithms; its standard error is that of the scatter about it.

    A line goes through two points whatever they are: they leave no scatter, and the error is NaN, not zero.
    """
    if len(x) < 2:
        return Estimate(math.nan, math.nan)
    u, v = np.log(x) - np.log(x).mean(), np.log(y) - np.log(y).mean()
    exponent = float(log_slope(x, y))
    if len(x) == 2:
        return Estimate(exponent, math.nan)
    rest = v - exponent * u
    return Estimate(exponent, float(np.sqrt(rest @ rest / (len(u) - 2) / (u @ u))))


def weighted_power_law(x: Numbers, estimates: Sequence[Estimate]) -> Estimate:
    """Exponent of positive `estimates` at x, weighted by their errors, which also give the error of the exponent."""
    means = np.array([e.mean for e in estimates])
    weights = (means / np.array([e.error for e in estimates])) ** 2
    u = np.log(x) - np.average(np.log(x), weights=weights)
    size = float(np.sum(weights * u * u))
    return Estimate(float(np.sum(weights * u * np.log(means))) / size, size**-0.5)
