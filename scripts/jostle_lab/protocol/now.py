"""What the disks of a packing do at this moment: what can be drawn before anything is finished."""

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from jostle_lab.fmu.grains import Grains

SHORTEST = 3
"""Simulated seconds from which on a mean angular velocity shows something."""
BETWEEN = 1.0
"""Shortest time from one to the next on the clock [s]."""


@dataclass(frozen=True)
class Now:
    """A packing in the middle of an interval."""

    seed: int
    amplitude: float
    """A, the fraction of the full drive."""
    doing: str
    """settling, relaxing or recording."""
    seconds: int
    """Simulated time over which the velocities are means [s]."""
    box_width: float
    """[m]."""
    radii: NDArray[np.float64]
    """[m], shape (disks,)."""
    positions: NDArray[np.float64]
    """Centres [m], shape (disks, 2)."""
    velocities: NDArray[np.float64]
    """Mean angular velocities [rad/s, counter-clockwise], shape (disks,)."""


class Observer:
    """Looks at grains now and then; each part of an interval begins anew."""

    def __init__(self, grains: Grains, seed: int) -> None:
        self._grains, self._seed = grains, seed
        self._last = perf_counter()
        self.begin(1.0, "settling")

    def begin(self, amplitude: float, doing: str) -> None:
        """The mean velocities count from here."""
        self._amplitude, self._doing, self._seconds = amplitude, doing, 0
        self._start = self._grains.angles().copy()

    def look(self, seconds: int) -> Now | None:
        """After further simulated seconds: what is seen, unless it is too soon."""
        self._seconds += seconds
        if self._seconds < SHORTEST or perf_counter() - self._last < BETWEEN:
            return None
        self._last = perf_counter()
        velocities = (self._grains.angles() - self._start) / self._seconds
        place = self._grains.box_width, self._grains.radii, self._grains.positions()
        return Now(self._seed, self._amplitude, self._doing, self._seconds, *place, velocities)
