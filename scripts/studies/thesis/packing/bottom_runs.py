"""Runs of P 1.3: packings over a bottom row that vibrates randomly, small ones over a fixed row, three disks tilted.

Only disks that are free to turn are counted. Of each run a few numbers are kept, no path.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.statistics.rotation import RPM
from jostle_lab.tables import Table
from studies.thesis.packing.runs import DISKS, FREQUENCY, GRAVITY, MOLECULAR, shaken

RADII = (0.015, 0.02, 0.025)
"""Of the disks [m]."""
QUARTER = 240.25 / FREQUENCY
"""[s]: four of them meet the base at four phases that are evenly spread."""
UNOBSERVED, OBSERVED = 2, 4
"""Quarters."""
SECOND_NOISE = 1000
"""Added to the seed of the noise: the same packing, other noise."""


def equivalent_gamma(radius: float) -> float:
    """Gamma of the sine at 80 Hz whose rms displacement and velocity are those of the random row, epsilon / 2."""
    return radius / math.sqrt(2.0) * (math.tau * FREQUENCY) ** 2 / GRAVITY


@dataclass(frozen=True)
class Shaken:
    """A packing of 60 disks; `radius` is epsilon of the random row [m], or None: the whole bottom moves as a sine."""

    gamma: float
    """Equivalent, if the row is random."""
    seed: int
    radius: float | None = None
    noise: int = 0

    def run(self) -> Run:
        """Its run, a row of the table each quarter."""
        start, whole = UNOBSERVED * QUARTER, (UNOBSERVED + OBSERVED) * QUARTER
        if self.radius is None:
            settings = shaken(MOLECULAR, 1e4, self.gamma, self.seed, start)
            return Run("packing", MOLECULAR.engine, whole, QUARTER, settings)
        settings = (
            ("seed", self.seed),
            ("gravity", GRAVITY),
            ("contact.normal_stiffness", 1e4),
            ("measure.start", start),
            ("bottom.radius", self.radius),
            ("bottom.angular_frequency", math.tau * FREQUENCY),
            ("bottom.damping_ratio", 0.5),
            ("bottom.seed", self.seed + self.noise),
        )
        return Run("packing", MOLECULAR.engine, whole, QUARTER, settings, drive="random-bottom")


@dataclass(frozen=True)
class Small:
    """Equal disks over a row of them that is fixed to the base, without tilt."""

    gamma: float
    disks: int
    """3: one on two; 5: two on three."""
    seed: int
    seconds: float = 60.0

    @property
    def row(self) -> int:
        """Disks of the fixed row."""
        return (self.disks + 1) // 2

    def run(self) -> Run:
        """Its run: plastic disks of 2 cm, each put down with a thousandth of its radius of play."""
        radius = 0.01
        settings = (
            *shaken(MOLECULAR, 1e4, self.gamma, self.seed, 5),
            ("box.width", 2.0 * self.row * radius * 1.002),
            ("initial.perturbation", 1e-3),
            *((f"disk.radius_{size}", radius) for size in ("small", "medium", "large")),
        )
        whole = 5.0 + self.seconds
        return Run("packing", MOLECULAR.engine, whole, whole, settings, self.disks, drive="sine-fixed-bottom")


@dataclass(frozen=True)
class Material:
    """Disks of 2.5 cm (P 6.1)."""

    name: str
    density: float
    """[kg/m^3]."""
    thickness: float
    """[m]."""

    @property
    def mass(self) -> float:
        """[kg], less the hole of 8 mm."""
        return self.density * self.thickness * math.pi * (0.0125**2 - 0.004**2)


ALUMINIUM, STEEL = Material("thin aluminium", 2700.0, 0.003), Material("thick steel", 7900.0, 0.01)
"""P gives 1 cm for the steel and no thickness for the aluminium."""


@dataclass(frozen=True)
class Tilted:
    """A disk on two others, shaken up and down at 200 Hz as in P 6.1."""

    material: Material
    tilt: float
    """[degrees]."""
    phase: float
    """Of the drive [rad]: runs that chaos makes independent; the scene has no seed."""
    gamma: float = 1.2
    seconds: float = 10.0

    def run(self) -> Run:
        """Its run: contacts of the same duration and restitution, 0.9, in both materials."""
        ratio = self.material.mass / STEEL.mass
        frequency = 200.0
        settings = (
            ("gravity", GRAVITY),
            ("tilt", math.radians(self.tilt)),
            ("disk.radius", 0.0125),
            ("disk.mass", self.material.mass),
            ("disk.initial_angular_velocity", 0.1),
            ("contact.normal_stiffness", 1e6 * ratio),
            ("contact.stiffness_ratio", 0.773),
            ("contact.normal_damping", 2.0 * C_OF_RESTITUTION * math.sqrt(1e6 * STEEL.mass) * ratio),
            ("contact.friction", 0.1),
            ("drive.frequency", frequency),
            ("drive.amplitude", self.gamma * GRAVITY / (math.tau * frequency) ** 2),
            ("drive.phase", self.phase),
            ("measure.start", 0.1 * self.seconds),
        )
        return Run("three_disk", MOLECULAR.engine, self.seconds, self.seconds, settings)


C_OF_RESTITUTION = 0.0346
"""Damping over the critical one that gives e_n = 0.9 (P 4.56)."""


def bottom_row(heights: Numbers) -> NDArray[np.bool_]:
    """Which disks stand on the floor at the start: those whose centre is as high as one of the radii."""
    return np.asarray(np.any(np.abs(heights[:, None] - np.array(RADII)) < 1e-9, axis=1))


def summary(case: Shaken, table: Table) -> Table:
    """What is kept of a packing; velocities in RPM, of the disks above the bottom row."""

    def each(name: str) -> Numbers:
        return np.column_stack([table[f"disk.{name}[{disk}]"] for disk in range(1, DISKS + 1)])

    heights = each("y")
    row = bottom_row(heights[0])
    free = ~row
    quarters = np.diff(each("angle")[UNOBSERVED:, free], axis=0) / QUARTER / RPM
    velocity = quarters.mean(axis=0)
    correlation = each("rotation_correlation")[-1, free]
    epsilon = case.radius or math.nan
    away = np.hypot(each("x")[1:, row] - each("x")[0, row], heights[1:, row] - heights[0, row])
    lost = np.diff(table["energy.lost"][[UNOBSERVED, -1]]) / (OBSERVED * QUARTER)
    return {
        "velocity": velocity,
        "mean": np.array([velocity.mean(), np.mean(velocity > 0.0)]),
        "square": np.array([np.mean(velocity**2)]),
        "faithful": np.array([np.mean(np.abs(np.sign(quarters).sum(axis=0)) == OBSERVED)]),
        "steady": np.array([np.mean(correlation > 0.95), correlation.mean()]),
        "row": np.array([np.count_nonzero(row), np.abs(each("angle")[-1, row]).max()]),
        "circle": np.array([(away / epsilon).max(), np.mean((away / epsilon) ** 2)]),
        "power": np.array([table["energy.kinetic"][UNOBSERVED + 1 :].mean(), float(lost[0])]),
    }


def packings(laboratory: Laboratory, cases: Iterable[Shaken], title: str) -> dict[Shaken, Table]:
    """Summaries of packings."""

    def kept(case: Shaken) -> Table:
        def compute() -> tuple[Table, float]:
            plain = replace(laboratory, records=None)
            return summary(case, plain.run([case.run()], title)[case.run()]), plain.spent

        return laboratory.computed(case.run().key(), compute)

    return {case: kept(case) for case in cases}


def velocities(laboratory: Laboratory, cases: Iterable[Small], title: str) -> dict[Small, Numbers]:
    """Mean angular velocities of the disks of small packings [RPM], the fixed row first."""
    wanted = list(cases)
    tables = laboratory.run([case.run() for case in wanted], title)
    return {
        case: np.array([tables[case.run()][f"disk.mean_angular_velocity[{i}]"][-1] for i in range(1, case.disks + 1)])
        / RPM
        for case in wanted
    }


def tilted(laboratory: Laboratory, cases: Iterable[Tilted], title: str) -> dict[Tilted, float]:
    """Mean angular velocities of the upper disk [RPM]."""
    wanted = list(cases)
    tables = laboratory.run([case.run() for case in wanted], title)
    return {case: float(tables[case.run()]["time_averaged_angular_velocity"][-1]) / RPM for case in wanted}
