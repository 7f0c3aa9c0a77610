"""Means against Gamma as P 3.1 forms them, their power laws and breaks, with intervals from drawing packings."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from jostle_lab.statistics.estimates import Estimate
from jostle_lab.statistics.power_law import log_slope
from jostle_lab.statistics.rotation import nearest_neighbours_regression, nearest_neighbours_resampled

Numbers = NDArray[np.float64]
Range = tuple[float, float]

LOW, HIGH = (0.0, 1.0), (1.6, 4.5)
"""Ranges of Gamma in which P Fig. 3.2 has power laws."""
THESIS_SLOPES = {LOW: 3.94, HIGH: 1.00}
"""Exponents that P prints there."""
PLACES = 120
"""Tried for a break."""
BEFORE_A_BREAK = 4
"""Least number of points on each side of it, itself included."""


@dataclass(frozen=True)
class Regression:
    """K nearest neighbours: a quantity of each packing and amplitude against Gamma, K the number of packings.

    Args:
        gamma: of each packing and amplitude, shape (rows,).
        values: what is averaged.
        packing: its number.

    """

    gamma: Numbers
    values: Numbers
    packing: Numbers

    @cached_property
    def neighbours(self) -> int:
        """K."""
        return len(np.unique(self.packing))

    @cached_property
    def at(self) -> Numbers:
        """Where the regression is evaluated: every K-th of the Gamma: neighbours share few packings."""
        return np.sort(self.gamma)[self.neighbours // 2 :: self.neighbours]

    @cached_property
    def curve(self) -> Numbers:
        """The regression at `at`."""
        return self.curve_at(self.at)

    def curve_at(self, gamma: Numbers) -> Numbers:
        """The regression at any Gamma."""
        return nearest_neighbours_regression(self.gamma, self.values, self.neighbours, gamma)

    @cached_property
    def resampled(self) -> Numbers:
        """The regression for packings drawn with replacement, shape (resamples, len(at))."""
        return nearest_neighbours_resampled(self.gamma, self.values, self.packing, self.neighbours, self.at)

    @cached_property
    def error(self) -> Numbers:
        """Standard error of the curve; not a number for a single packing."""
        if self.neighbours < 2:
            return np.full_like(self.curve, math.nan)
        return np.asarray(self.resampled.std(axis=0, ddof=1))

    def estimate(self, statistic: Callable[[Numbers, Numbers], float]) -> Estimate:
        """A number of Gamma and curve; its error by drawing packings, not a number for a single one."""
        value = statistic(self.at, self.curve)
        if self.neighbours < 2:
            return Estimate(value, math.nan)
        drawn = [statistic(self.at, curve) for curve in self.resampled]
        return Estimate(value, float(np.std(drawn, ddof=1)))

    def slope(self, range_: Range) -> Estimate:
        """Exponent of the least-squares line on log-log axes within a range of Gamma."""
        return self.estimate(lambda x, y: slope(x, y, range_))

    def mean(self, range_: Range) -> Estimate:
        """Mean of the curve within a range of Gamma."""
        return self.estimate(lambda x, y: float(y[within(x, range_)].mean()))

    def power_break(self, range_: Range) -> Estimate:
        """Gamma at which two power laws meet that fit the curve best within a range of Gamma."""
        line = BrokenLine(self.at, range_)
        return self.estimate(lambda _, y: line.place(np.log(y)))

    def level_break(self, range_: Range) -> Estimate:
        """Gamma at which two straight lines of the quantity against ln Gamma meet that fit best within a range."""
        line = BrokenLine(self.at, range_)
        return self.estimate(lambda _, y: line.place(y))


def within(x: Numbers, range_: Range) -> NDArray[np.bool_]:
    """Which x lie in a range, ends included."""
    return np.asarray((x >= range_[0]) & (x <= range_[1]))


def slope(x: Numbers, y: Numbers, range_: Range) -> float:
    """Slope of ln y against ln x within a range of x, by least squares; not a number for less than two points."""
    inside = within(x, range_) & (y > 0.0)
    if np.count_nonzero(inside) < 2:
        return math.nan
    return float(log_slope(x[inside], y[inside]))


class BrokenLine:
    """Two joined straight lines against ln x, fitted by least squares, and where they meet.

    Args:
        x: of the points, positive and rising, shape (points,).
        range_: points outside are left out.

    """

    def __init__(self, x: Numbers, range_: Range) -> None:
        self._inside = within(x, range_)
        inside = np.log(x[self._inside])
        if len(inside) < 2 * BEFORE_A_BREAK:
            self._places, self._bases = np.array([math.nan]), np.zeros((1, len(inside), 1))
            return
        self._places = np.linspace(inside[BEFORE_A_BREAK - 1], inside[-BEFORE_A_BREAK], PLACES)
        away = inside - self._places[:, None]
        columns = np.stack((np.ones_like(away), np.minimum(away, 0.0), np.maximum(away, 0.0)), axis=-1)
        self._bases = np.linalg.qr(columns)[0]

    def place(self, y: Numbers) -> float:
        """Where the lines of the best fit meet; not a number for less than twice `BEFORE_A_BREAK` points."""
        explained = np.sum(np.einsum("pnc,n->pc", self._bases, y[self._inside]) ** 2, axis=1)
        return math.exp(float(self._places[np.argmax(explained)]))
