"""What runs beside F's figures show, and how they are reduced to a few numbers."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from jostle_lab.statistics.estimates import Estimate, Numbers

FLYING = 0.1
"""A disk that moves by more than this part of the amplitude against the base flies."""
BOND = 1.15
"""Centres nearer than this many mean diameters are neighbours."""
CRYSTAL = 0.9
"""|psi_6| of a disk from which on its neighbours are a hexagon."""


def moved(heights: Numbers) -> Numbers:
    """Range of each disk's height above the base [m], of shape (times, disks)."""
    return np.asarray(heights.max(axis=0) - heights.min(axis=0))


def jumps(places: Numbers, width: float) -> Numbers:
    """Changes to the next valley on the right and on the left, per disk and interval; shape (times, disks)."""
    steps = np.diff(np.floor(places / width), axis=0)
    return np.array([np.mean(np.maximum(steps, 0.0)), np.mean(np.maximum(-steps, 0.0))])


def hexagonal(x: Numbers, y: Numbers, width: float, diameter: float = 2.15e-3) -> Numbers:
    """Mean |psi_6| of the disks with five or more neighbours, and the share of all that sit in a hexagon."""
    dx = x[:, None] - x[None, :]
    dx -= width * np.round(dx / width)
    dy = y[:, None] - y[None, :]
    near = np.hypot(dx, dy) < BOND * diameter
    np.fill_diagonal(near, val=False)
    count = near.sum(axis=1)
    order = np.abs(np.where(near, np.exp(6j * np.arctan2(dy, dx)), 0.0).sum(axis=1)) / np.maximum(count, 1)
    bulk = count >= 5
    mean = float(order[bulk].mean()) if bulk.any() else math.nan
    return np.array([mean, float(np.mean((count == 6) & (order > CRYSTAL)))])


@dataclass(frozen=True)
class Found:
    """Arrays with one entry a seed."""

    masses: Numbers
    """Transport velocity, and its change with 1024 times the mass, shape (seeds, 2) [m/s]."""
    beds: Mapping[float, Numbers]
    """Range of the height of each disk above the base over the amplitude, shape (seeds, disks), by Gamma."""
    landed: Numbers
    """The same at the lowest Gamma with a lower velocity floor, one seed."""
    mono: Mapping[float, Numbers]
    """What `hexagonal` finds among equal disks, shape (seeds, 2), by the time that they are shaken [s]."""
    poly: Mapping[float, Numbers]
    """Among unequal ones."""
    flat: tuple[Numbers, ...]
    """Share of the disks that sit in hexagons on a flat base, equal and unequal ones."""
    jumps: Numbers
    """To the right and to the left, shape (seeds, 2)."""
    whole: Numbers
    """Transport velocity of four layers [cm/s]."""
    spread: Numbers
    """Standard deviation over their disks of each one's own mean velocity [cm/s]."""
    onsets: Mapping[str, tuple[Estimate, ...]]
    """Velocity 5 % and 10 % above the critical frequency [cm/s]."""

    def flying(self) -> dict[float, Estimate]:
        """Share of the disks that fly, by Gamma."""
        return {g: Estimate.over_runs(np.mean(ranges > FLYING, axis=1)) for g, ranges in self.beds.items()}
