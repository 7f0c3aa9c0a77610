"""Means, errors of means, and what can be read off a curve with error bars."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

RESAMPLES = 4000
"""Resamples of every bootstrap; its generator is seeded with the same number."""

Numbers = NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """A mean and its standard error."""

    mean: float
    error: float

    def __str__(self) -> str:
        """Mean and error, rounded to one digit of the error, to two if the first one is 1."""
        if not (self.error > 0.0 and math.isfinite(self.error)):
            return f"{self.mean:.3g} +- {self.error:g}"
        decimals = -math.floor(math.log10(0.5 * self.error))
        if decimals > 4:
            return f"{self.mean:.2e} +- {self.error:.0e}"
        unit = 10.0**-decimals
        shown = max(decimals, 0)
        return f"{round(self.mean / unit) * unit:.{shown}f} +- {round(self.error / unit) * unit:.{shown}f}"


def pooled(means: Sequence[float], errors: Sequence[float]) -> Estimate:
    """Mean of independent runs of equal length, each with its own standard error."""
    return Estimate(float(np.mean(means)), math.sqrt(float(np.sum(np.square(errors)))) / len(errors))


def chi_square(differences: Sequence[float], errors: Sequence[float], lost: int = 0) -> tuple[float, float]:
    """Chi square per degree of freedom of `differences` from zero, and its p-value; `lost` degrees were fitted."""
    total = float(np.sum(np.square(np.divide(differences, errors))))
    freedom = len(errors) - lost
    return total / freedom, float(stats.chi2.sf(total, freedom))


def bootstrap_mean(values: Sequence[float]) -> Estimate:
    """Mean over packings, its error by drawing packings with replacement."""
    numbers = np.asarray(values, dtype=np.float64)
    return Estimate(float(numbers.mean()), float(_resampled(numbers[:, None])[:, 0].std(ddof=1)))


def bootstrap_ratio(above: Sequence[float], below: Sequence[float]) -> Estimate:
    """Ratio of the means of `above` and `below`, packing by packing the same; error by drawing packings."""
    pairs = np.column_stack([above, below]).astype(np.float64)
    resampled = _resampled(pairs)
    ratio = float(pairs[:, 0].mean() / pairs[:, 1].mean())
    return Estimate(ratio, float((resampled[:, 0] / resampled[:, 1]).std(ddof=1)))


def draws(count: int) -> NDArray[np.int64]:
    """Indices of packings drawn with replacement, shape (RESAMPLES, count); the same at each call."""
    return np.random.default_rng(RESAMPLES).integers(0, count, size=(RESAMPLES, count))


def _resampled(rows: Numbers) -> Numbers:
    """Means of resampled rows, shape (RESAMPLES, columns)."""
    return np.asarray(rows[draws(len(rows))].mean(axis=1))


def zero_crossings(x: Sequence[float], estimates: Sequence[Estimate], significance: float = 3.0) -> list[Estimate]:
    """Where a curve changes sign for certain: between points that are `significance` errors from zero.

    Points too close to zero are passed over. The place is that of the straight line between the two points next to the
    crossing, its error that of the line.
    """
    crossings = []
    last: int | None = None
    for index, point in enumerate(estimates):
        if abs(point.mean) < significance * point.error:
            continue
        if last is not None and point.mean * estimates[last].mean < 0.0:
            crossings.append(_crossing(x, estimates, last, index))
        last = index
    return crossings


def _crossing(x: Sequence[float], estimates: Sequence[Estimate], first: int, last: int) -> Estimate:
    a, b = estimates[first], estimates[last]
    span, height = x[last] - x[first], a.mean - b.mean
    share = a.mean / height
    error = abs(span / height) * math.hypot((1.0 - share) * a.error, share * b.error)
    return Estimate(x[first] + share * span, error)
