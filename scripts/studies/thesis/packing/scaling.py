"""Power laws, breaks and extrema of ensembles against Gamma, with errors by drawing packings.

The packings are the same at every Gamma, so a resample draws the same packings everywhere.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from jostle_lab.statistics.estimates import Estimate, Numbers, bootstrap
from jostle_lab.statistics.power_law import log_slope

RESAMPLES = 1000
TWO_POINTS = "A line through two points has no error of its slope; give three or more."


@dataclass(frozen=True)
class Fitted:
    """A parameter, its standard error and its 95 % interval."""

    value: float
    error: float
    low: float
    high: float

    @property
    def estimate(self) -> Estimate:
        """Value and standard error."""
        return Estimate(self.value, self.error)

    def __str__(self) -> str:
        """Value and interval."""
        return f"{self.value:.2f} (95 %: {self.low:.2f} to {self.high:.2f})"


def fitted(samples: Sequence[Numbers], parameter: Callable[[Numbers], Numbers]) -> Fitted:
    """`parameter` of the means over packings, with what drawing packings makes of it.

    Args:
        samples: values of the packings, one array of shape (packings,) for each Gamma.
        parameter: of means of shape (..., gammas), for each of the leading shape.

    """

    def statistic(*drawn: Numbers, axis: int) -> Numbers:
        return parameter(np.stack([np.mean(values, axis=axis) for values in drawn], axis=-1))

    value = float(statistic(*samples, axis=0))
    resamples = bootstrap(samples, statistic, paired=True, resamples=RESAMPLES)
    resamples = resamples[np.isfinite(resamples)]
    if len(resamples) < 0.9 * RESAMPLES or len(samples[0]) < 2:
        return Fitted(value, np.nan, np.nan, np.nan)
    low, high = np.quantile(resamples, [0.025, 0.975])
    return Fitted(value, float(resamples.std(ddof=1)), float(low), float(high))


def exponent(gammas: Sequence[float], samples: Sequence[Numbers]) -> Fitted:
    """Exponent of a power of Gamma; raises ValueError with fewer than three points, which have no scatter."""
    if len(gammas) < 3:
        raise ValueError(TWO_POINTS)
    return fitted(samples, lambda means: log_slope(gammas, means))


def geometric_exponent(gammas: Sequence[float], samples: Sequence[Numbers]) -> Fitted:
    """Exponent of the geometric mean over packings, in which the fastest few do not prevail."""
    return fitted([np.log(values) for values in samples], lambda means: log_slope(gammas, np.exp(means)))


def critical_exponent(gammas: Sequence[float], samples: Sequence[Numbers], at: Numbers, critical: float) -> Fitted:
    """Exponent of (y - y_c) against (Gamma - Gamma_c), `at` the packings' values at Gamma_c (P 3.2); as `exponent`."""
    if len(gammas) < 3:
        raise ValueError(TWO_POINTS)
    beyond = np.array(gammas) - critical

    def parameter(means: Numbers) -> Numbers:
        return log_slope(beyond, means[..., :-1] - means[..., -1:])

    return fitted([*samples, at], parameter)


def two_slopes(gammas: Sequence[float], y: Numbers, breaks: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Break [Gamma] and both slopes of the best pair of lines in ln y against ln Gamma that meet, along the last axis.

    Args:
        gammas: shape (n,).
        y: shape (..., n), positive.
        breaks: candidates.

    """
    x, logs = np.log(gammas), np.log(y)
    best = np.full(logs.shape[:-1], np.inf)
    found = [np.full(logs.shape[:-1], np.nan) for _ in range(3)]
    for candidate in breaks:
        over = np.maximum(x - np.log(candidate), 0.0)
        design = np.column_stack([np.ones_like(x), x, over])
        inverse = np.linalg.pinv(design)
        coefficients = logs @ inverse.T
        rest = np.sum((logs - coefficients @ design.T) ** 2, axis=-1)
        better = rest < best
        best = np.where(better, rest, best)
        below = coefficients[..., 1]
        values = (np.full_like(best, candidate), below, below + coefficients[..., 2])
        found = [np.where(better, new, old) for new, old in zip(values, found, strict=True)]
    return found[0], found[1], found[2]


def break_point(gammas: Sequence[float], samples: Sequence[Numbers]) -> tuple[Fitted, Fitted, Fitted]:
    """Gamma at which one power law becomes another, and both exponents."""
    breaks = np.geomspace(gammas[1], gammas[-2], 60)

    def part(number: int) -> Fitted:
        return fitted(samples, lambda means: two_slopes(gammas, means, breaks)[number])

    return part(0), part(1), part(2)


def extremum(gammas: Sequence[float], samples: Sequence[Numbers], largest: bool) -> Fitted:
    """Gamma of the largest or smallest mean: vertex of the parabola in ln Gamma through it and its neighbours.

    An extremum at an end of the range is none: NaN, and so is the error if a tenth of the resamples have theirs there.
    """
    x = np.log(gammas)
    sign = 1.0 if largest else -1.0

    def parameter(means: Numbers) -> Numbers:
        flat = sign * means.reshape(-1, len(x))
        return np.array([_vertex(x, row) for row in flat]).reshape(means.shape[:-1])

    return fitted(samples, parameter)


def _vertex(x: Numbers, y: Numbers) -> float:
    top = int(np.argmax(y))
    if top in (0, len(x) - 1):
        return float("nan")
    square, linear, _ = np.polyfit(x[top - 1 : top + 2], y[top - 1 : top + 2], 2)
    return float(np.exp(-0.5 * linear / square)) if square < 0.0 else float(np.exp(x[top]))
