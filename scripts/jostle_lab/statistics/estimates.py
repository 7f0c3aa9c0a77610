"""Means, errors of means, and what can be read off a curve with error bars. Resampling is scipy's bootstrap."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

RESAMPLES = 4000
"""Resamples of a bootstrap unless said otherwise; its generator is seeded with the same number."""

Numbers = NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """A mean and its standard error."""

    mean: float
    error: float

    @classmethod
    def over_runs(cls, values: Numbers) -> "Estimate":
        """Mean of independent runs and its standard error from their scatter."""
        return cls(float(values.mean()), float(values.std(ddof=1)) / math.sqrt(len(values)))

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


def relative_error(found: Numbers, exact: Numbers) -> float:
    """Rms of the difference over the rms of `exact`."""
    return float(np.sqrt(np.mean((found - exact) ** 2) / np.mean(exact**2)))


def pooled(means: Sequence[float], errors: Sequence[float]) -> Estimate:
    """Mean of independent runs of equal length, each with its own standard error."""
    return Estimate(float(np.mean(means)), math.sqrt(float(np.sum(np.square(errors)))) / len(errors))


def chi_square(differences: Sequence[float], errors: Sequence[float], lost: int = 0) -> tuple[float, float]:
    """Chi square per degree of freedom of `differences` from zero, and its p-value; `lost` degrees were fitted."""
    total = float(np.sum(np.square(np.divide(differences, errors))))
    freedom = len(errors) - lost
    return total / freedom, float(stats.chi2.sf(total, freedom))


def bootstrap(
    samples: Sequence[Sequence[float] | Numbers],
    statistic: Callable[..., Any],
    paired: bool = False,
    resamples: int = RESAMPLES,
) -> Numbers:
    """`statistic` of resampled samples, shape (..., resamples).

    Args:
        samples: values of independent runs; `paired`: entry i of each belongs to the same run.
        statistic: of the samples and `axis`, over which it reduces.
        paired: draw the same runs from every sample.
        resamples: number of resamples, and seed of the generator.

    A single run has no scatter: its statistic is returned `resamples` times.

    """
    arrays = tuple(np.asarray(sample, dtype=np.float64) for sample in samples)
    if min(map(len, arrays)) < 2:
        return np.repeat(np.asarray(statistic(*arrays, axis=-1))[..., None], resamples, axis=-1)
    result = stats.bootstrap(
        arrays,
        statistic,
        paired=paired,
        n_resamples=resamples,
        method="percentile",
        vectorized=True,
        rng=np.random.default_rng(resamples),
    )
    return np.asarray(result.bootstrap_distribution)


def bootstrap_mean(values: Sequence[float] | Numbers) -> Estimate:
    """Mean over packings, its error by drawing packings with replacement."""
    return Estimate(float(np.mean(values)), float(bootstrap([values], np.mean).std(ddof=1)))


def bootstrap_ratio(above: Sequence[float] | Numbers, below: Sequence[float] | Numbers) -> Estimate:
    """Ratio of the means of `above` and `below`, packing by packing the same; error by drawing packings."""

    def ratio(x: Numbers, y: Numbers, axis: int) -> Any:
        return x.mean(axis=axis) / y.mean(axis=axis)

    drawn = bootstrap([above, below], ratio, paired=True)
    return Estimate(float(np.mean(above) / np.mean(below)), float(drawn.std(ddof=1)))


def zero_crossings(x: Sequence[float], estimates: Sequence[Estimate], significance: float = 3.0) -> list[Estimate]:
    """Where a curve changes sign for certain: between points that are `significance` errors from zero.

    Points too close to zero are passed over. The place is that of the straight line between the two points next to the
    crossing, its error that of the line. Where the means in between change sign more than once, it is the middle of
    these changes, and half of the way from the first to the last is added to the error.
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
    place, error = _line(x, estimates, first, last)
    pairs = ((i, i + 1) for i in range(first, last) if estimates[i].mean * estimates[i + 1].mean < 0.0)
    changes = [_line(x, estimates, *pair)[0] for pair in pairs]
    if len(changes) > 1:
        place, error = 0.5 * (changes[0] + changes[-1]), math.hypot(error, 0.5 * (changes[-1] - changes[0]))
    return Estimate(place, error)


def _line(x: Sequence[float], estimates: Sequence[Estimate], first: int, last: int) -> tuple[float, float]:
    """Where the straight line between two points crosses zero, and the error of that."""
    a, b = estimates[first], estimates[last]
    span, height = x[last] - x[first], a.mean - b.mean
    share = a.mean / height
    return x[first] + share * span, abs(span / height) * math.hypot((1.0 - share) * a.error, share * b.error)


def places(crossings: Sequence[Estimate], unit: str) -> str:
    """The crossings as words, such as `20.1 +- 0.3, 30.0 +- 0.2 Hz`, or `none`."""
    return f"{', '.join(map(str, crossings))} {unit}".rstrip() if crossings else "none"


def sign_changes(crossings: Sequence[Estimate], unit: str, name: str = "") -> str:
    """The crossings as words, such as `sign changes at h = 20.1 +- 0.3 mm`, or `no sign change`."""
    at = f"{name} = " if name else ""
    return f"sign changes at {at}{places(crossings, unit)}" if crossings else "no sign change"
