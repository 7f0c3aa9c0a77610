"""P Fig. 4.3: the region that Coulomb friction (Amontons' in P) admits, quasi-static or at constant normal forces."""

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.tables import Table
from studies.thesis.two_supports.region_statements import constant_normal_forces, statements
from studies.thesis.two_supports.runs import (
    ENGINE,
    NORMAL_STIFFNESS,
    SCENE,
    TANGENTIAL_STIFFNESS,
    TIME_STEP,
    Torque,
)
from studies.thesis.two_supports.spring_region import Region, region

TILT = 0.1 * math.pi
SECONDS, QUICK_SECONDS = 2.0, 1.0
SAMPLE = 1e-3
"""Time between points [s]."""
SLOW_SAMPLES = 300
"""Points of the path under a slow torque."""
AMPLITUDE = 1e-5
"""Of the supports [m]: the centre of the disk is accelerated by a per cent of gravity."""
STIFFER = 100.0
"""Normal stiffness of the trial over that of P 5.1; the supports move a tenth as much, so that no contact opens."""
NORMAL_DAMPING = 10.0
"""gamma_n of P 5.1 [kg/s]."""
SHOWN = 1e8
"""Scale of the axes."""


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Regions from the theory; points of a disk on weakly vibrating supports, which come to all four corners."""
    run, trial = (shaken(QUICK_SECONDS if quick else SECONDS, factor) for factor in (1.0, STIFFER))
    slow = Torque(TILT, 0.113)
    tables = laboratory.run([run, trial, slow.run(SLOW_SAMPLES)], "figure 4.3")
    table, turned = tables[run], tables[slow.run(SLOW_SAMPLES)]
    slow_path = np.column_stack([turned["skin.departure"], turned["skin.stretch"]])[-SLOW_SAMPLES:]
    quasi_static, upright = region(laboratory, TILT), region(laboratory, 0.0)
    constant = constant_normal_forces(TILT)
    points, stiffer = springs(table), springs(tables[trial])
    rows: list[dict[str, Any]] = [
        {"what": name, "departure": float(p[0]), "stretch": float(p[1])}
        for name, p in [
            *quasi_static.corners.items(),
            *((f"constant {i}", p) for i, p in enumerate(constant)),
            *(("random supports", p) for p in points),
            *(("slow torque", p) for p in slow_path),
        ]
    ]
    notes = [
        f"tilt 0.1 pi, mu = 0.1, k_t = 1e6 N/m, m g = 1 N, R = 1 m; points: random supports of {AMPLITUDE:g} m rms, "
        f"{run.seconds:g} s, one each {SAMPLE:g} s, seed 1, after 10 ms",
    ]
    return Product(
        "Figure 4.3: admissible region",
        rows,
        _draw(quasi_static, constant, points, slow_path),
        statements(laboratory, quasi_static, upright, points, stiffer, table["amonton_margin"]),
        notes,
    )


def shaken(seconds: float, stiffer: float) -> Run:
    """A disk on weakly vibrating supports, its normal contacts so many times stiffer at the same damping ratio."""
    settings: tuple[tuple[str, float], ...] = (
        ("tilt", TILT),
        ("support.amplitude", AMPLITUDE / math.sqrt(stiffer)),
        ("time_step", TIME_STEP),
    )
    if stiffer != 1.0:
        settings += (
            ("contact.normal_stiffness", NORMAL_STIFFNESS * stiffer),
            ("contact.stiffness_ratio", TANGENTIAL_STIFFNESS / (NORMAL_STIFFNESS * stiffer)),
            ("contact.normal_damping", NORMAL_DAMPING * math.sqrt(stiffer)),
        )
    return Run(SCENE, ENGINE, seconds, SAMPLE, settings, drive="random-supports")


def springs(table: Table) -> Numbers:
    """Departure and stretch [rad] after 10 ms, shape (n, 2)."""
    return np.column_stack([table["skin.departure"], table["skin.stretch"]])[10:]


def _draw(quasi_static: Region, constant: Numbers, points: Numbers, slow: Numbers) -> Figure:
    figure = Figure(figsize=(0.85 * WIDTH, 4.6), layout="constrained")
    panel = figure.subplots()
    panel.plot(
        *(SHOWN * points.T),
        ".",
        color="#7fa8d1",
        ms=1.5,
        label="simulation, supports vibrate weakly",
        zorder=1,
        rasterized=True,
    )
    panel.plot(*(SHOWN * slow.T), color="#c0272d", lw=1.8, alpha=0.6, label="simulation, slow torque")
    panel.plot(*(SHOWN * np.vstack([constant, constant[:1]]).T), "k:", lw=1.3, label="constant normal forces")
    panel.plot(*(SHOWN * quasi_static.outline.T), "k--", lw=1.3, label="quasi-static")
    for name in ("S1", "S2", "T1", "T2"):
        corner = quasi_static.corners[name]
        panel.plot(*(SHOWN * corner), "ko", ms=3.5)
        left = corner[0] < 0.0
        panel.annotate(
            f"${name[0]}_{name[1]}$",
            tuple(SHOWN * corner),
            xytext=(-16 if left else 7, -9 if name == "T2" else 5),
            textcoords="offset points",
        )
    panel.set(xlabel=r"$\delta\theta$ [$10^{-8}$ rad]", ylabel=r"$\Theta$ [$10^{-8}$ rad]", aspect="equal")
    panel.margins(0.08)
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, 1.2), ncols=2)
    return figure
