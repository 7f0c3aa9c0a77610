"""Angular paths in, numbers of P 3.1 out."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

RPM = math.tau / 60.0
"""One revolution per minute [rad/s]."""


@dataclass(frozen=True)
class Rotation:
    """Rotation of each disk over one record, arrays of shape (disks,)."""

    mean_velocity: NDArray[np.float64]
    """Total excursion over time [rad/s]."""
    correlation: NDArray[np.float64]
    """Squared correlation of angle and time, rho^2; 0 for a disk that never turned."""
    adjusted_deviation: NDArray[np.float64]
    """sigma_a of P 3.1: 0 steady, 1 all noise; 1 for a disk that never turned."""

    def mean_square(self) -> float:
        """<omega^2> over the packing [RPM^2]."""
        return float(np.mean((self.mean_velocity / RPM) ** 2))


def rotation(angles: NDArray[np.float64], interval: float) -> Rotation:
    """Rotation from unwrapped `angles` [rad], shape (frames, disks), frames `interval` [s] apart."""
    frames = angles.shape[0]
    velocities = np.diff(angles, axis=0) / interval
    mean_velocity = (angles[-1] - angles[0]) / ((frames - 1) * interval)
    deviation = np.std(velocities, axis=0)
    total = np.abs(mean_velocity) + deviation
    adjusted = np.divide(deviation, total, out=np.ones_like(total), where=total > 0.0)
    return Rotation(mean_velocity, squared_correlation(angles), adjusted)


def squared_correlation(paths: NDArray[np.float64]) -> NDArray[np.float64]:
    """rho^2 of each column of `paths`, shape (frames, disks), with time.

    A driftless random walk averages 0.43, not 0 as the thesis has it.
    """
    time = np.arange(paths.shape[0], dtype=np.float64)
    time -= time.mean()
    centred = paths - paths.mean(axis=0)
    spread = np.sum(centred**2, axis=0)
    product = time @ centred
    return np.asarray(np.divide(product**2, np.sum(time**2) * spread, out=np.zeros_like(spread), where=spread > 0.0))


def nearest_neighbours_regression(
    x: NDArray[np.float64], y: NDArray[np.float64], neighbours: int, at: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Mean of the `neighbours` values y whose x lies nearest to each of `at`; the thesis uses 25 (P 3.1)."""
    order = np.argsort(np.abs(at[:, None] - x[None, :]), axis=1, kind="stable")[:, :neighbours]
    return np.asarray(y[order].mean(axis=1))


def nearest_neighbours_resampled(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    packing: NDArray[np.float64],
    neighbours: int,
    at: NDArray[np.float64],
    resamples: int = 500,
) -> NDArray[np.float64]:
    """The regression for packings drawn with replacement, shape (resamples, len(at)): its scatter is the error.

    Args:
        x: of each point, shape (points,).
        y: of each point.
        packing: number of the packing to which a point belongs; all points of a packing are drawn together.
        neighbours: of the regression.
        at: where it is evaluated.
        resamples: number of resamples, and seed of the generator.

    """
    order = np.argsort(np.abs(at[:, None] - x[None, :]), axis=1, kind="stable")
    numbers, member = np.unique(packing, return_inverse=True)
    sorted_member, sorted_y = member[order], y[order]
    generator = np.random.default_rng(resamples)
    curves = np.empty((resamples, len(at)))
    for curve in curves:
        times = np.bincount(generator.integers(len(numbers), size=len(numbers)), minlength=len(numbers))
        weight = times[sorted_member]
        # A point counts as often as its packing was drawn, until there are `neighbours`.
        counted = np.clip(neighbours - (np.cumsum(weight, axis=1) - weight), 0, weight)
        curve[:] = np.sum(counted * sorted_y, axis=1) / neighbours
    return curves
