"""F Figs 13 and 14: where mass is and where it flows, by place and by phase of the base."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jostle_lab.runs.run import Run
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.tables import Table
from studies.ratchet.cases import AMPLITUDE, Case

TOOTH = 6.0
"""w [mm]."""
TIP = 0.4
"""Radius of the tip [mm]."""
PHASES = 6
BOX = TOOTH / 6.0
"""Side of a box [mm]."""


@dataclass(frozen=True)
class FieldRun(Run):
    """One `jostle fields`."""

    warm_up: float = 1.0

    def arguments(self) -> list[str]:
        """Arguments of `jostle`, without the output file."""
        words = ["fields", self.scene, "--seconds", repr(self.seconds), "--warm-up", repr(self.warm_up)]
        words += ["--disks", str(self.disks)]
        for name, value in self.settings:
            words += ["--set", f"{name}={value!r}"]
        return words


def field_run(case: Case, seed: int) -> FieldRun:
    """The fields of one seed."""
    run = case.run(seed)
    settings = tuple(pair for pair in run.settings if pair[0] != "measure.start")
    seconds = case.seconds
    return FieldRun(run.scene, run.engine, seconds, seconds, settings, disks=run.disks, warm_up=case.warm_up)


@dataclass(frozen=True)
class MeanFields:
    """Fields averaged over seeds: shape (phases, rows, columns)."""

    x: Numbers
    """Centres of the columns [mm], one tooth."""
    y: Numbers
    """Centres of the rows [mm]."""
    mass: Numbers
    """Share of the mass of all disks."""
    momentum: Numbers
    """Over the mass of all disks [cm/s]; one more axis at the end: x, y."""


@dataclass(frozen=True)
class Fields:
    """Fields of several seeds: shape (seeds, phases, rows, columns)."""

    x: Numbers
    """Centres of the columns [mm], one tooth."""
    y: Numbers
    """Centres of the rows [mm]."""
    mass: Numbers
    """Share of the mass of all disks."""
    momentum: Numbers
    """Over the mass of all disks [cm/s]; one more axis at the end: x, y."""

    def mean(self) -> MeanFields:
        """Over the seeds."""
        return MeanFields(self.x, self.y, self.mass.mean(axis=0), self.momentum.mean(axis=0))

    def total(self) -> list[Estimate]:
        """Mean horizontal velocity of all disks in each phase window [cm/s]."""
        return [Estimate.over_runs(self.momentum[:, j, :, :, 0].sum(axis=(1, 2))) for j in range(PHASES)]


def gather(tables: Sequence[Table]) -> Fields:
    """Tables of `jostle fields` as arrays, on the rows that all of them need."""
    x = np.unique(np.round(1e3 * tables[0]["x"], 6))
    low = min(round(1e3 * float(t["y"].min()), 6) for t in tables)
    high = max(round(1e3 * float(t["y"].max()), 6) for t in tables)
    y = np.arange(low, high + 0.5 * BOX, BOX)
    shape = (len(tables), PHASES, len(y), len(x))
    mass, momentum = np.zeros(shape), np.zeros((*shape, 2))
    for seed, table in enumerate(tables):
        whole = float(table["mass"].sum()) / PHASES
        j = table["phase"].astype(int)
        row = np.rint((1e3 * table["y"] - low) / BOX).astype(int)
        column = np.searchsorted(x, np.round(1e3 * table["x"], 6) - 1e-3)
        mass[seed, j, row, column] = table["mass"] / whole
        for axis, name in enumerate(("momentum_x", "momentum_y")):
            momentum[seed, j, row, column, axis] = 100.0 * table[name] / whole
    return Fields(x, y, mass, momentum)


def surface(case: Case, x: Numbers, lift: float = 0.0) -> Numbers:
    """Height of the teeth [mm] at `x` [mm]; the arc of the tip is tangent to both sides."""
    apex, h = case.asymmetry * TOOTH, case.height
    x = np.mod(x, TOOTH)
    left = h * x / apex if apex > 0.0 else np.full_like(x, np.inf)
    right = h * (TOOTH - x) / (TOOTH - apex)
    sharp = np.minimum(left, right)
    # Centre of the arc: a distance TIP below both sides, along the bisector of the apex.
    up_left, up_right = math.hypot(h, apex), math.hypot(h, TOOTH - apex)
    n_left, n_right = np.array([-h, apex]) / up_left, np.array([h, TOOTH - apex]) / up_right
    bisector = (n_left + n_right) / float(np.linalg.norm(n_left + n_right))
    depth = TIP / float(bisector @ n_left)
    centre = np.array([apex, h]) - depth * bisector
    first, last = centre[0] + TIP * n_left[0], centre[0] + TIP * n_right[0]
    on_arc = (x > first) & (x < last)
    arc = centre[1] + np.sqrt(np.maximum(TIP**2 - (x - centre[0]) ** 2, 0.0))
    return np.asarray(np.where(on_arc, arc, sharp) + lift)


def lift_of(j: float) -> float:
    """Displacement of the base [mm] in the middle of window j."""
    return 1e3 * AMPLITUDE * math.sin(math.tau * (j + 0.5) / PHASES)


@dataclass(frozen=True)
class Flow:
    """What F reads off its fields, in numbers."""

    sliding: tuple[Estimate, Estimate]
    """Mean velocity (x, y) [cm/s], the base's taken off, just above the flatter side in window 4."""
    impulse: Estimate
    """Gain of the mean horizontal velocity while the base rises [cm/s]: window 1 less window 4."""
    to_the_left: Estimate
    """Share of the mass thrown up near the teeth in windows 0 and 1 that is in boxes that move to the left."""


NEAR = 2.5
"""Centres this far above the surface [mm] are just above it: a radius and a box, and the slope."""
THROWN = 5.0
"""Centres this far above the tips [mm] are near the teeth."""


def flow_of(case: Case, fields: Fields) -> Flow:
    """The numbers, each with the standard error over seeds."""
    x, y = np.meshgrid(fields.x, fields.y)
    flatter = x > TOOTH * case.asymmetry + TIP
    above = y - surface(case, x, lift_of(4))
    slope = flatter & (above > 0.0) & (above < NEAR) & (x < TOOTH - BOX)
    base = 100.0 * AMPLITUDE * math.tau * case.frequency * math.cos(math.tau * 4.5 / PHASES)
    weight = fields.mass[:, 4][:, slope].sum(axis=1)
    along = [Estimate.over_runs(fields.momentum[:, 4, :, :, axis][:, slope].sum(axis=1) / weight) for axis in (0, 1)]
    means = fields.momentum[..., 0].sum(axis=(2, 3))
    left, whole = 0.0, 0.0
    for j in (0, 1):
        thrown = (fields.momentum[:, j, :, :, 1] > 0.0) & (y < case.height + lift_of(j) + THROWN)
        mass = np.where(thrown, fields.mass[:, j], 0.0)
        whole = whole + mass.sum(axis=(1, 2))
        left = left + np.where(fields.momentum[:, j, :, :, 0] < 0.0, mass, 0.0).sum(axis=(1, 2))
    return Flow(
        (along[0], Estimate(along[1].mean - base, along[1].error)),
        Estimate.over_runs(means[:, 1] - means[:, 4]),
        Estimate.over_runs(np.asarray(left / whole)),
    )
