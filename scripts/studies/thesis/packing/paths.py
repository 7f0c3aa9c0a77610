"""P Fig. 3.10: angular paths of the disks of one packing by event-driven dynamics, nine Gamma."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import CLOCKWISE, COUNTER_CLOCKWISE, WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.statistics.rotation import RPM, Rotation, rotation
from studies.thesis.packing.runs import RANDOM_PHASE, Record, angles, mean_square, packing_run

GAMMAS = (2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 20.0, 25.0)
STIFFNESS = 1e4
QUICK, FULL = Record(5.0, 60.0, 1.0), Record(30.0, 600.0, 2.0)
STEADY = 0.95
"""rho^2 from which a path counts as a straight line."""


@dataclass(frozen=True)
class Paths:
    """Angles of all disks at one Gamma."""

    time: Numbers
    """[s], shape (frames,)."""
    angles: Numbers
    """From the end of settling on [rad], shape (frames, disks)."""
    sample: float
    """[s]."""

    def rotation(self) -> Rotation:
        """Mean velocities and steadiness."""
        return rotation(self.angles, self.sample)

    def changed(self) -> int:
        """Disks whose mean angular velocities in the two halves differ by more than half of the larger, and 1 RPM."""
        half = (len(self.angles) - 1) // 2
        first = (self.angles[half] - self.angles[0]) / (half * self.sample) / RPM
        second = (self.angles[2 * half] - self.angles[half]) / (half * self.sample) / RPM
        larger = np.maximum(np.abs(first), np.abs(second))
        return int(np.count_nonzero(np.abs(first - second) > np.maximum(0.5 * larger, 1.0)))


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Run one packing at nine Gamma; it is one packing whatever the number of seeds."""
    record, seed = QUICK if quick else FULL, 1
    runs = {g: packing_run(RANDOM_PHASE, g, STIFFNESS, seed, record) for g in GAMMAS}
    tables = laboratory.run(list(runs.values()), "figure 3.10")
    found = {}
    for g, run in runs.items():
        turned = angles(tables[run], record)
        found[g] = Paths(np.arange(len(turned), dtype=np.float64) * record.sample, turned - turned[0], record.sample)
    rows = [row for g, paths in found.items() for row in _rows(g, paths)]
    notes = [
        f"fixed bottom with a random phase, seed {seed}, 60 disks, 80 Hz, k_n = 1e4 N/m, kappa = 0.77",
        f"gamma_n = 0.1 kg/s, mu = 0.1; {record.settling:g} s unobserved, then {record.observed:g} s, one point in "
        f"{record.sample:g} s",
        f"steady: rho^2 of angle and time above {STEADY}; paths of single disks, hence no error bars",
    ]
    title = "Figure 3.10: angular paths by event-driven dynamics"
    return Product(title, rows, draw(found), statements(found), notes)


def _rows(gamma: float, paths: Paths) -> list[dict[str, Any]]:
    return [
        {"gamma": gamma, "time": float(time), **{f"angle_{i + 1}": float(a) for i, a in enumerate(turned)}}
        for time, turned in zip(paths.time, paths.angles, strict=True)
    ]


def draw(found: dict[float, Paths]) -> Figure:
    """One panel for each Gamma; blue counter-clockwise, red clockwise."""
    figure = Figure(figsize=(WIDTH, 6.0), layout="constrained")
    axes = figure.subplots(3, 3, sharex=True)
    for panel, (gamma, paths) in zip(axes.flat, found.items(), strict=True):
        turns = paths.angles / math.tau
        for path in turns.T:
            panel.plot(paths.time, path, lw=0.6, color=COUNTER_CLOCKWISE if path[-1] > 0.0 else CLOCKWISE, alpha=0.8)
        panel.axhline(0.0, color="0.5", lw=0.4, zorder=0)
        limit = 1.08 * float(np.max(np.abs(turns)))
        panel.set(xlim=(0.0, paths.time[-1]), ylim=(-limit, limit))
        panel.set_title(rf"$\Gamma$ = {gamma:g}", pad=3.0)
        panel.locator_params(axis="y", nbins=5)
        panel.locator_params(axis="x", nbins=4)
    for panel in axes[:, 0]:
        panel.set_ylabel("angle [revolutions]")
    for panel in axes[-1]:
        panel.set_xlabel("time [s]")
    figure.align_ylabels(axes[:, 0])
    return figure


def statements(found: dict[float, Paths]) -> list[Statement]:
    """What P 3.3 says of this figure."""
    turning = {g: p.rotation() for g, p in found.items()}
    steady = {g: float(np.mean(r.correlation > STEADY)) for g, r in turning.items()}
    noise = {g: float(np.mean(r.adjusted_deviation)) for g, r in turning.items()}
    square = {g: mean_square(p.angles, p.sample) for g, p in found.items()}
    changed = {g: p.changed() for g, p in found.items()}
    return [
        Statement(
            "3.3",
            "for all Gamma all paths look linear: all disks turn with nearly constant velocity",
            "share of steady disks: " + ", ".join(f"{g:g}: {s:.2f}" for g, s in steady.items()),
            _share([s > 0.9 for s in steady.values()]),
        ),
        Statement(
            "3.3",
            "velocity fluctuations are not appreciable on this scale",
            "<sigma_a>: " + ", ".join(f"{g:g}: {s:.2f}" for g, s in noise.items()),
            _share([s < 0.5 for s in noise.values()]),
        ),
        Statement(
            "3.3",
            "partial rearrangements change the velocity of some disks (at Gamma = 2 and 8 there)",
            "disks that change velocity: " + ", ".join(f"{g:g}: {n}" for g, n in changed.items()),
            verdict(any(changed.values())),
        ),
        Statement(
            "3.2, 3.3",
            "disks turn the same way for good, faster as Gamma grows (up to about 10)",
            "<omega^2> [RPM^2]: " + ", ".join(f"{g:g}: {s:.3g}" for g, s in square.items()),
            verdict(square[2.0] < square[4.0] < square[8.0]),
        ),
    ]


def _share(holds: list[bool]) -> Verdict:
    if all(holds):
        return Verdict.AGREES
    return Verdict.PARTLY if any(holds) else Verdict.DISAGREES
