"""Fit of the onset, v = c ((Gamma - Gamma_c) / Gamma_c)^gamma above Gamma_c and 0 below (F eq. 1, Figs 3 and 11).

The sum of squares has kinks wherever Gamma_c passes a point, so the best pair (Gamma_c, gamma) is looked for on a grid,
with the best c for each in closed form, and then polished by least squares. Intervals are percentiles of the bootstrap,
which draws the runs of every point anew and takes the grid's best.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from jostle_lab.errors import LabError
from jostle_lab.statistics.estimates import Estimate, Numbers, bootstrap

RESAMPLES = 1000
"""Of the bootstrap."""
CONFIDENCE = 0.68
"""Probability of the intervals: comparable with one standard error."""
EXPONENTS = np.arange(0.05, 1.5001, 0.01)
THRESHOLD_STEP = 0.004


@dataclass(frozen=True)
class Fitted:
    """A parameter and its interval."""

    value: float
    low: float
    high: float

    def __str__(self) -> str:
        """Value, then the interval."""
        return f"{self.value:.2f} ({self.low:.2f} to {self.high:.2f})"

    @property
    def estimate(self) -> Estimate:
        """Value, and half of the interval as its standard error."""
        return Estimate(self.value, 0.5 * (self.high - self.low))


def with_window(found: Fitted, others: Sequence[Fitted]) -> Estimate:
    """A parameter with the standard error of chance and of the choice of the window.

    The window is taken to be any of `others` by chance: its part is their standard deviation.
    """
    return Estimate(found.value, math.hypot(found.estimate.error, float(np.std([o.value for o in others], ddof=1))))


@dataclass(frozen=True)
class Onset:
    """What was fitted."""

    threshold: Fitted
    """Gamma_c."""
    exponent: Fitted
    """gamma."""
    scale: float
    """c, the velocity at Gamma = 2 Gamma_c."""
    residual: float
    """Root mean square of the differences, weighted as the fit."""

    def velocity(self, gammas: Numbers) -> Numbers:
        """The fitted curve."""
        return self.scale * _shape(gammas, self.threshold.value, self.exponent.value)


def _shape(gammas: Numbers, threshold: float, exponent: float) -> Numbers:
    return np.asarray(np.maximum(gammas / threshold - 1.0, 0.0) ** exponent)


def fit_onset(
    gammas: Sequence[float], runs: Sequence[Sequence[float]], weights: Sequence[float] | None = None
) -> Onset:
    """Fit the velocities of all `runs` of each Gamma; `weights` of the points, equal unless given."""
    x = np.asarray(gammas, dtype=np.float64)
    if len(x) < 6:
        raise LabError(f"An onset has three parameters; {len(x)} values of Gamma are too few. Give six or more.")
    means = np.array([np.mean(v) for v in runs])
    w = np.ones(len(x)) if weights is None else np.asarray(weights, dtype=np.float64)
    grid = _Grid(x, means, w / w.mean())
    start = grid.best(means[None, :])[0]
    threshold, exponent, scale = _polished(x, means, grid.weights, start)
    threshold, exponent = float(threshold), float(exponent)
    drawn = grid.best(bootstrap(runs, _means, resamples=RESAMPLES).T)
    thresholds, exponents = (_interval(value, drawn[:, i]) for i, value in enumerate((threshold, exponent)))
    rest = means - scale * _shape(x, threshold, exponent)
    return Onset(thresholds, exponents, float(scale), float(np.sqrt(np.mean(grid.weights * rest**2))))


def _interval(value: float, drawn: Numbers) -> Fitted:
    low, high = np.quantile(drawn, [0.5 - 0.5 * CONFIDENCE, 0.5 + 0.5 * CONFIDENCE])
    return Fitted(value, min(float(low), value), max(float(high), value))


def _means(*runs: Numbers, axis: int) -> Numbers:
    return np.stack([np.mean(velocities, axis=axis) for velocities in runs])


class _Grid:
    """Shapes of all pairs (Gamma_c, gamma), normalised, so that the best pair is the largest projection."""

    def __init__(self, gammas: Numbers, means: Numbers, weights: Numbers) -> None:
        self.weights = weights
        # The threshold is below the first point that is at half of the largest velocity, or it would explain nothing.
        moving = gammas[np.abs(means) >= 0.5 * np.abs(means).max()].min()
        thresholds = np.arange(gammas.min(), moving, THRESHOLD_STEP)
        if len(thresholds) == 0:
            raise LabError(f"All of Gamma from {gammas.min():g} on is above the onset. Add smaller values.")
        self.pairs = np.array([(t, e) for t in thresholds for e in EXPONENTS])
        rising = np.maximum(gammas[None, :] / self.pairs[:, :1] - 1.0, 0.0) ** self.pairs[:, 1:]
        self.shapes = rising / np.sqrt(np.sum(weights * rising**2, axis=1))[:, None]

    def best(self, velocities: Numbers) -> Numbers:
        """Best pair of each row of velocities, shape (rows, 2)."""
        chunks = np.array_split(velocities * self.weights, max(1, len(velocities) // 50))  # bounds the memory
        best = np.concatenate([np.argmax(np.abs(chunk @ self.shapes.T), axis=1) for chunk in chunks])
        return np.asarray(self.pairs[best])


def _polished(gammas: Numbers, means: Numbers, weights: Numbers, start: Numbers) -> tuple[float, float, float]:
    """The least squares nearest to the grid's best: within a cell of it."""
    root = np.sqrt(weights)
    shape = _shape(gammas, *start)
    scale = float(np.sum(weights * means * shape) / np.sum(weights * shape**2))

    def rest(parameters: Numbers) -> Numbers:
        return np.asarray(root * (parameters[2] * _shape(gammas, parameters[0], parameters[1]) - means))

    cell = np.array([THRESHOLD_STEP, EXPONENTS[1] - EXPONENTS[0], 0.5 * abs(scale) + 1e-12])
    centre = np.array([*start, scale])
    solution = least_squares(rest, centre, bounds=(centre - cell, centre + cell), x_scale=cell)
    threshold, exponent, best = solution.x
    return float(threshold), float(exponent), float(best)
