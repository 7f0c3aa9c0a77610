"""P Figs 3.5 and 3.10: angular paths of the disks of one packing, by molecular and by event-driven dynamics."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import CLOCKWISE, COUNTER_CLOCKWISE, WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.statistics.rotation import RPM
from jostle_lab.tables import Table
from studies.thesis.packing.path_statements import event_driven_statements, molecular_statements
from studies.thesis.packing.paths_found import Paths
from studies.thesis.packing.runs import DISKS, MOLECULAR, RANDOM_PHASE, Method, shaken

STIFFNESS = 1e4
SEED = 1
SOFT_GAMMAS = (0.3, 0.6, 0.9, 2.0, 5.0, 20.0)
HARD_GAMMAS = (2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 20.0, 25.0)


@dataclass(frozen=True)
class Shaking:
    """One packing: how, how strongly, how long."""

    method: Method
    gamma: float
    settling: int
    """Unobserved [s], a whole number of frames."""
    frame: int
    """Time from point to point of the picture [s]; the rotation is measured once a second."""
    frames: int

    def run(self) -> Run:
        """Its run."""
        settings = shaken(self.method, STIFFNESS, self.gamma, SEED, self.settling)
        whole = float(self.settling + self.frame * self.frames)
        return Run("packing", self.method.engine, whole, float(self.frame), settings)

    def paths(self, table: Table) -> Paths:
        """What the run shows."""
        first = self.settling // self.frame
        turned = np.column_stack([table[f"disk.angle[{disk}]"][first:] for disk in range(1, DISKS + 1)])

        def last(name: str) -> float:
            return float(table[f"rotation.{name}"][-1])

        return Paths(
            np.arange(len(turned), dtype=np.float64) * self.frame,
            turned - turned[0],
            last("correlation"),
            last("adjusted_deviation"),
            last("share_rotating"),
            last("mean_square") / RPM**2,
        )


def _found(laboratory: Laboratory, shakings: list[Shaking], title: str) -> dict[float, Paths]:
    tables = laboratory.run([s.run() for s in shakings], title)
    return {s.gamma: s.paths(tables[s.run()]) for s in shakings}


def molecular_dynamics(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 3.5; it is one packing whatever the number of seeds."""
    frames, frame = (10, 1) if quick else (30, 10)
    shakings = [Shaking(MOLECULAR, g, 2 * frame, frame, frames) for g in SOFT_GAMMAS]
    found = _found(laboratory, shakings, "figure 3.5")
    notes = _notes("molecular dynamics", shakings[0])
    return _product("Figure 3.5: angular paths by molecular dynamics", found, 2, molecular_statements(found), notes)


def event_driven(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 3.10; it is one packing whatever the number of seeds."""
    frames, frame = (12, 5) if quick else (30, 20)
    shakings = [Shaking(RANDOM_PHASE, g, 2 * frame, frame, frames) for g in HARD_GAMMAS]
    found = _found(laboratory, shakings, "figure 3.10")
    notes = _notes("event-driven dynamics, fixed bottom with a random phase", shakings[0])
    title = "Figure 3.10: angular paths by event-driven dynamics"
    return _product(title, found, 3, event_driven_statements(found), notes)


def _product(
    title: str, found: dict[float, Paths], lines: int, statements: list[Statement], notes: list[str]
) -> Product:
    rows = [row for g, paths in found.items() for row in _rows(g, paths)]
    return Product(title, rows, draw(found, (lines, 3)), statements, notes)


def _notes(method: str, shaking: Shaking) -> list[str]:
    return [
        f"{method}, seed {SEED}, 60 disks, 80 Hz, k_n = 1e4 N/m, kappa = 0.77, gamma_n = 0.1 kg/s, mu = 0.1",
        f"{shaking.settling} s unobserved, then {shaking.frame * shaking.frames} s; points of the picture every "
        f"{shaking.frame} s; rho^2 and sigma_a from angles once a second, as P defines them",
        "one packing, as in P; errors are those of shares of 60 disks",
    ]


def _rows(gamma: float, paths: Paths) -> list[dict[str, Any]]:
    return [
        {"gamma": gamma, "time": float(time), **{f"angle_{i + 1}": float(a) for i, a in enumerate(turned)}}
        for time, turned in zip(paths.time, paths.angles, strict=True)
    ]


def draw(found: dict[float, Paths], shape: tuple[int, int]) -> Figure:
    """One panel for each Gamma, all on one scale; where growth would hide the paths, an inset at their own scale."""
    figure = Figure(figsize=(WIDTH, 2.2 * shape[0]), layout="constrained")
    axes = figure.subplots(*shape, sharex=True, sharey=True)
    limit = 1.05 * max(float(np.max(np.abs(paths.angles))) for paths in found.values()) / math.tau
    for panel, (gamma, paths) in zip(axes.flat, found.items(), strict=True):
        turns = paths.angles / math.tau
        _lines(panel, paths.time, turns)
        panel.axhline(0.0, color="0.5", lw=0.4, zorder=0)
        panel.set(xlim=(0.0, paths.time[-1]), ylim=(-limit, limit))
        panel.set_title(rf"$\Gamma$ = {gamma:g}", pad=3.0)
        panel.locator_params(axis="both", nbins=5)
        own = 1.05 * float(np.max(np.abs(turns)))
        if own < 0.35 * limit:
            inset = panel.inset_axes((0.16, 0.62, 0.5, 0.36))
            _lines(inset, paths.time, turns)
            inset.set(xlim=(0.0, paths.time[-1]), ylim=(-own, own), xticks=[])
            inset.tick_params(labelsize=6.0)
    for panel in axes[:, 0]:
        panel.set_ylabel("angle [revolutions]")
    for panel in axes[-1]:
        panel.set_xlabel("time [s]")
    figure.suptitle("solid blue: counter-clockwise in the end; dashed red: clockwise", fontsize=8.0)
    return figure


def _lines(panel: Any, time: Numbers, turns: Numbers) -> None:
    for path in turns.T:
        up = path[-1] > 0.0
        panel.plot(time, path, "-" if up else "--", lw=0.6, color=COUNTER_CLOCKWISE if up else CLOCKWISE, alpha=0.8)
