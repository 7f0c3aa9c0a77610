"""What the runs of P 1.3 show: ensembles of packings, small packings, three disks."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.tables import Table
from studies.thesis.packing.bottom_runs import Material, Shaken, Small, Tilted

AIR_VISCOSITY = 1.8e-5
"""[Pa s]."""
GAP = 5e-4
"""Between a disk of 3 mm and each of two panes that are 4 mm apart (P 2.4.1) [m]."""
SURFACE_DENSITY = 3.57
"""[kg/m^2]."""


@dataclass(frozen=True)
class Ensemble:
    """Packings that are shaken alike; arrays of shape (packings,), of the disks above the bottom row."""

    cases: tuple[Shaken, ...]
    tables: tuple[Table, ...]

    def each(self, name: str, index: int = 0) -> Numbers:
        """A kept number of every packing."""
        return np.array([table[name][index] for table in self.tables])

    def over(self, name: str, index: int = 0) -> Estimate:
        """Its mean over the packings."""
        return Estimate.over_runs(self.each(name, index))

    @property
    def square(self) -> Estimate:
        """<omega^2> [RPM^2]."""
        return self.over("square")

    @property
    def drift(self) -> Estimate:
        """Mean velocity of a packing over its root mean square, mean over the packings."""
        return Estimate.over_runs(self.each("mean") / np.sqrt(self.each("square")))

    @property
    def drag(self) -> Estimate:
        """Power that the air between disks and panes would take over the one that the contacts take.

        The film of air shears: force 2 eta area / gap, so that energy decays at 4 eta / (gap times surface density).
        """
        rate = 4.0 * AIR_VISCOSITY / (GAP * SURFACE_DENSITY)
        return Estimate.over_runs(rate * self.each("power", 0) / self.each("power", 1))


@dataclass(frozen=True)
class Found:
    """Everything."""

    random: Mapping[float, Ensemble]
    """By epsilon [m]."""
    again: Mapping[float, Ensemble]
    """The same packings by other noise."""
    sine: Mapping[float, Ensemble]
    """By the epsilon of the same rms velocity [m]."""
    single: Mapping[float, Numbers]
    """Velocity of the disk on two fixed ones, every seed, by Gamma [RPM]."""
    buttons: Mapping[float, Numbers]
    """Velocities of the left and the right disk on three fixed ones, shape (seeds, 2), by Gamma [RPM]."""
    held: float
    """Largest velocity of a disk of the fixed row [RPM]."""
    tilted: Mapping[tuple[Material, float], Estimate]
    """Velocity of the upper disk by material and tilt in degrees [RPM]."""

    def same_sense(self, epsilon: float) -> Estimate:
        """Correlation of the velocities of the disks of a packing under two noises, mean over the packings."""
        pairs = zip(self.random[epsilon].tables, self.again[epsilon].tables, strict=True)
        return Estimate.over_runs(np.array([np.corrcoef(a["velocity"], b["velocity"])[0, 1] for a, b in pairs]))

    def button(self, gamma: float) -> Estimate:
        """Half the right velocity less the left one [RPM]: what mirror symmetry allows."""
        both = self.buttons[gamma]
        return Estimate.over_runs(0.5 * (both[:, 1] - both[:, 0]))

    def odd(self, gamma: float) -> Estimate:
        """Half the sum of both [RPM]: what mirror symmetry forbids."""
        return Estimate.over_runs(0.5 * self.buttons[gamma].sum(axis=1))


def gather(packings: Mapping[Shaken, Table], small: Mapping[Small, Numbers], tilted: Mapping[Tilted, float]) -> Found:
    """Runs into what they show."""
    kinds: dict[str, dict[float, list[Shaken]]] = {"random": {}, "again": {}, "sine": {}}
    epsilon_of = {case.gamma: case.radius for case in packings if case.radius is not None}
    for case in packings:
        kind = "sine" if case.radius is None else "again" if case.noise else "random"
        kinds[kind].setdefault(epsilon_of[case.gamma] or math.nan, []).append(case)
    made = {
        kind: {e: Ensemble(tuple(cases), tuple(packings[c] for c in cases)) for e, cases in groups.items()}
        for kind, groups in kinds.items()
    }
    free = {n: _by_gamma([c for c in small if c.disks == n], small) for n in (3, 5)}
    return Found(
        **made,
        single={g: values[:, 0] for g, values in free[3].items()},
        buttons=free[5],
        held=max(float(np.abs(velocities[: case.row]).max()) for case, velocities in small.items()),
        tilted={
            (m, t): Estimate.over_runs(np.array([v for c, v in tilted.items() if (c.material, c.tilt) == (m, t)]))
            for m, t in dict.fromkeys((c.material, c.tilt) for c in tilted)
        },
    )


def _by_gamma(cases: Sequence[Small], small: Mapping[Small, Numbers]) -> dict[float, Numbers]:
    """Velocities of the free disks, shape (seeds, free disks)."""
    gammas = dict.fromkeys(case.gamma for case in cases)
    return {g: np.array([small[c][c.row :] for c in cases if c.gamma == g]) for g in gammas}
