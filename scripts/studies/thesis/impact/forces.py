"""P Fig. 4.4: forces during an impact for several stiffness ratios, and the formulas of P 4.5 beside the equations."""

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.tables import Table
from jostle_lab.verdicts import exact
from studies.thesis.impact.equations import Contact, Impact, integrate
from studies.thesis.impact.statements import statements

RATIOS = {0.1: "--", 1.0: ":", 10.0: "-."}
"""kappa, and lines as in P Fig. 4.5."""
APPROACH, SLIP = 1.0, 0.2
"""|u_n| and u_t [m/s]."""
FLIGHT = 1e-2
"""Time of the fall in the simulation [s], a hundred times that of the contact."""
SAMPLE, SECONDS = 1e-6, 1.012e-2
"""Between rows, and of the run [s]."""
LOAD = APPROACH / FLIGHT
"""Gravity of the simulation [m/s^2]."""
RADIUS = 0.02


def dropped(kappa: float) -> Run:
    """A spinning disk that falls on the left wall, which is horizontal, and leaves the right one, which is upright."""
    half = math.pi / 4.0
    contact = Contact()
    settings = (
        ("gravity", LOAD),
        ("support.shape", 2),
        ("support.angle", half),
        ("tilt", half - 1e-9),
        ("disk.radius", RADIUS),
        ("disk.mass", contact.mass),
        # Heights count from the disk at rest, which has sunk in by m g / k_n.
        ("disk.drop_height", 0.5 * LOAD * FLIGHT**2 + contact.mass * LOAD / contact.stiffness),
        ("disk.initial_angular_velocity", SLIP / RADIUS),
        ("contact.normal_stiffness", contact.stiffness),
        ("contact.stiffness_ratio", kappa),
        ("contact.normal_damping", contact.damping),
        ("contact.friction", contact.friction),
        ("drive.amplitude", 0.0),
    )
    return Run("three_disk", "molecular-dynamics", SECONDS, SAMPLE, settings)


def make(laboratory: Laboratory, _quick: bool, _seeds: int | None = None) -> Product:
    """No chance: one effort only."""
    runs = {kappa: dropped(kappa) for kappa in RATIOS}
    tables = laboratory.run(list(runs.values()), "figure 4.4")
    found = {kappa: integrate(Contact(ratio=kappa), APPROACH, SLIP) for kappa in RATIOS}
    loaded = {kappa: integrate(Contact(ratio=kappa, load=LOAD), APPROACH, SLIP) for kappa in RATIOS}
    stated = [*statements(found), simulated({k: (loaded[k], tables[runs[k]]) for k in RATIOS})]
    times = np.linspace(0.0, min(i.duration for i in found.values()), 300)
    forces = {kappa: impact.forces(times) for kappa, impact in found.items()}
    rows: list[dict[str, Any]] = [
        {"kappa": k, "time": float(t), "normal_force": float(n), "tangential_force": float(f)}
        for k, (normal, tangential) in forces.items()
        for t, n, f in zip(times, normal, tangential, strict=True)
    ]
    notes = [
        f"k_n = 4.5e6 N/m, gamma_n = 9.84 kg/s, m = 4.5 g, mu = 0.1 (P Fig. 4.5); u_n = -{APPROACH:g} m/s, "
        f"u_t = {SLIP:g} m/s: not given for Fig. 4.4",
        "equations of motion by DOP853 with relative tolerance 1e-12 and events where a phase ends; no "
        "printed solution "
        "is used",
        f"simulation: the scene three_disk with the left wall horizontal, gravity {LOAD:g} m/s^2, so that the "
        "fall takes "
        "10 ms; the equations beside it have this gravity too",
        "no chance, hence no seeds and no error bars",
    ]
    return Product("Figure 4.4: forces during an impact", rows, draw(times, forces, tables, runs), stated, notes)


def observed(table: Table) -> tuple[Numbers, Numbers, Numbers]:
    """Time since first touch [s], normal and tangential force [N] of a run, while in contact."""
    normal, tangential = table["contact[1].normal_force"], table["contact[1].tangential_force"]
    time = np.asarray(SAMPLE * np.arange(len(normal)) - FLIGHT, dtype=np.float64)
    inside = (normal > 0.0) & (time > 0.5 * SAMPLE)
    return time[inside], normal[inside], tangential[inside]


def simulated(pairs: dict[float, tuple[Impact, Table]]) -> Statement:
    """The soft disks of the program beside the equations."""
    worst = {}
    for kappa, (impact, table) in pairs.items():
        time, normal, tangential = observed(table)
        held = time < impact.duration
        ours = impact.forces(time[held])
        rest = [np.max(np.abs(a[held] - b)) for a, b in zip((normal, tangential), ours, strict=True)]
        worst[kappa] = float(max(rest) / np.max(ours[0]))
    return Statement.judged(
        "4.57, 4.64, 4.67",
        "force history of an impact in the molecular dynamics",
        "largest difference from the equations of motion over the largest normal force: "
        + ", ".join(f"kappa = {k:g}: {w:.0e}" for k, w in worst.items()),
        exact(max(worst.values()), 1e-4, "difference over the largest normal force"),
    )


def draw(
    times: Numbers, forces: dict[float, tuple[Numbers, Numbers]], tables: dict[Run, Table], runs: dict[float, Run]
) -> Figure:
    """Friction limit mu n and the tangential forces, with points of the simulation."""
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    panel = figure.subplots()
    limit = Contact().friction * forces[1.0][0]
    panel.plot(1e6 * times, limit, color="#7a4fa0", lw=2.2, label=r"limit $\pm\mu n$, (4.57)")
    panel.plot(1e6 * times, -limit, color="#7a4fa0", lw=2.2)
    colours = shades(len(RATIOS))
    for (kappa, line), colour, marker in zip(RATIOS.items(), colours, "osD", strict=True):
        panel.plot(1e6 * times, forces[kappa][1], line, color=colour, lw=1.3, label=rf"$\tau$, $\kappa$ = {kappa:g}")
        time, _, tangential = observed(tables[runs[kappa]])
        panel.plot(
            1e6 * time[::4],
            tangential[::4],
            marker,
            color=colour,
            mfc="white",
            ms=3.5,
            label=rf"soft disks, $\kappa$ = {kappa:g}",
        )
    panel.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    panel.set(xlabel=r"time since first touch [$\mu$s]", ylabel="force [N]")
    figure.legend(loc="outside right center", title="lines: equations of motion")
    return figure
