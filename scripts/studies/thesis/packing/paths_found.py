"""Angular paths of the disks of one packing, and what can be told of them: shares of disks with their errors."""

import math
from dataclasses import dataclass

import numpy as np

from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.statistics.rotation import RPM

PARTS = 4
"""Parts of a path whose mean velocities are compared."""
CERTAIN = 4.0
"""Standard deviations from which a difference of two velocities is a change: one of 60 disks by chance in 260."""


@dataclass(frozen=True)
class Paths:
    """One Gamma."""

    time: Numbers
    """[s], shape (frames,)."""
    angles: Numbers
    """Since the first frame [rad], shape (frames, disks)."""
    correlation: float
    """<rho^2>, from angles once a second."""
    adjusted_deviation: float
    """<sigma_a>, from intervals of 1 s."""
    steady: float
    """Share of the disks with rho^2 above 0.95."""
    square: float
    """<omega^2> [RPM^2]."""

    @property
    def disks(self) -> int:
        """Number of disks."""
        return int(self.angles.shape[1])

    def increments(self) -> Numbers:
        """Mean velocity between frames [RPM], shape (frames - 1, disks)."""
        return np.asarray(np.diff(self.angles, axis=0) / (self.time[1] - self.time[0]) / RPM)

    def changed(self) -> Estimate:
        """Number of disks whose mean velocity in one half differs from that in the other for certain.

        What a random walk does by chance is no change: the difference is held against the scatter of the velocities
        between frames within each half. A partial rearrangement of the packing changes velocities for good.
        """
        first, second = np.array_split(self.increments(), 2)
        variance = first.var(axis=0, ddof=1) / len(first) + second.var(axis=0, ddof=1) / len(second)
        floor = (1e-3 * np.abs(first.mean(axis=0)) + 1e-9) ** 2
        changed = np.abs(first.mean(axis=0) - second.mean(axis=0)) > CERTAIN * np.sqrt(variance + floor)
        count = int(np.count_nonzero(changed))
        return Estimate(float(count), math.sqrt(max(count, 1)))

    def faithful(self) -> Estimate:
        """Share of the disks that turn the same way in each of four parts of the record."""
        means = np.stack([part.mean(axis=0) for part in np.array_split(self.increments(), PARTS)])
        return self.share(np.abs(np.sign(means).sum(axis=0)) == PARTS)

    def share(self, chosen: Numbers) -> Estimate:
        """Share of the disks and its binomial error, with that of half a disk at the ends."""
        return share_of(float(np.mean(chosen)), self.disks)


def share_of(part: float, count: int) -> Estimate:
    """A share of `count` and its binomial error, with that of half a member at the ends."""
    inside = min(max(part, 0.5 / count), 1.0 - 0.5 / count)
    return Estimate(part, math.sqrt(inside * (1.0 - inside) / count))
