"""P 2.1 and 2.2: how packings begin, time steps, damping; arithmetic and short runs."""

import math
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.programs import output_of
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.statistics.rotation import RPM
from jostle_lab.tables import Table, parse_csv, read_text_rows
from jostle_lab.verdicts import above, below, every, exact, true
from studies.thesis.packing.runs import DISKS, MOLECULAR, shaken

DENSITY = 3.57
"""[kg/m^2]."""
RADII = (0.015, 0.02, 0.025)
"""[m]."""
KEPT_DIGITS = 1e-7
"""Records are kept in single precision: places to this [m]."""
BOX = 0.4
"""Inner width [m]."""
TIME_STEP = 1e-6
"""delta t of P 2.2 [s]."""
STIFFNESSES = (1e4, 1e6)
DAMPINGS = (0.1, 10.0)
"""gamma_n of P 3.2 and gamma_c of P 2.2 [kg/s]."""
GAMMAS = (0.5, 1.0, 2.0, 5.0)
SETTLING, OBSERVED, PACKINGS = 8, 12, 6


def mass(radius: float) -> float:
    """Mass of a disk [kg]."""
    return DENSITY * math.pi * radius**2


def restitution(stiffness: float, damping: float, effective_mass: float) -> float:
    """e_n of the linear dashpot whose force only pushes (P 4.56, in the form of one branch for each side of c = 1)."""
    c = damping / (2.0 * math.sqrt(stiffness * effective_mass))
    root = math.sqrt(abs(1.0 - c * c))
    if root < 1e-9:
        return math.exp(-2.0)
    return math.exp(-2.0 * c * (math.acos(c) if c < 1.0 else math.acosh(c)) / root)


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """First contacts, steps and dampings."""
    centres, radii = initial_packing(laboratory)
    squares = _squares(laboratory, 2 if quick else PACKINGS)
    rows: list[dict[str, Any]] = [
        {"normal_damping": d, "gamma": g, "mean_square_rpm": e.mean, "error": e.error} for (d, g), e in squares.items()
    ]
    return Product(
        "P 2.1 and 2.2: initial packing, time step, damping",
        rows,
        draw(squares),
        [*_packing(centres, radii), *_steps(), *_damping(squares)],
        [
            f"damping: MD, k_n = 1e4 N/m, {PACKINGS} packings, {SETTLING} s unobserved, then {OBSERVED} s",
            "initial packing: seed 1, before the first step",
        ],
    )


def initial_packing(laboratory: Laboratory) -> tuple[Numbers, Numbers]:
    """Centres, shape (disks, 2), and radii [m] before the first step; radii are parameters, which are no columns."""

    def compute() -> tuple[Table, float]:
        with tempfile.TemporaryDirectory(prefix="jostle-") as folder:
            output = Path(folder) / "run.csv"
            run = Run("packing", MOLECULAR.engine, 1e-6, 1e-6, (("seed", 1),))
            output_of([laboratory.program, *run.arguments(), "--output", output])
            columns = parse_csv(output.read_text())
            given = read_text_rows([output.with_suffix(".parameters.csv")])
        values = {row["name"]: row["value"] for row in given}
        each = range(1, DISKS + 1)
        table = {axis: np.array([columns[f"disk.{axis}[{i}]"][0] for i in each]) for axis in ("x", "y")}
        return {**table, "radius": np.array([float(values[f"disk.radius[{i}]"]) for i in each])}, 0.0

    found = laboratory.computed("initial packing, seed 1", compute)
    return np.column_stack([found["x"], found["y"]]), found["radius"]


def _squares(laboratory: Laboratory, packings: int) -> dict[tuple[float, float], Estimate]:
    def run(damping: float, gamma: float, seed: int) -> Run:
        settings = (*shaken(MOLECULAR, 1e4, gamma, seed, SETTLING), ("contact.normal_damping", damping))
        return Run("packing", MOLECULAR.engine, float(SETTLING + OBSERVED), float(SETTLING + OBSERVED), settings)

    seeds = range(1, packings + 1)
    runs = {(d, g, s): run(d, g, s) for d in DAMPINGS for g in GAMMAS for s in seeds}
    tables = laboratory.run(list(runs.values()), "2.2, damping")
    return {
        (d, g): Estimate.over_runs(
            np.array([tables[runs[d, g, s]]["rotation.mean_square"][-1] for s in seeds]) / RPM**2
        )
        for d in DAMPINGS
        for g in GAMMAS
    }


def draw(squares: dict[tuple[float, float], Estimate]) -> Figure:
    """<omega^2> with both dampings."""
    figure = Figure(figsize=(0.7 * WIDTH, 3.2), layout="constrained")
    panel = figure.subplots()
    for damping, style, colour in zip(DAMPINGS, ("o-", "s--"), ("black", "0.5"), strict=True):
        points = [squares[damping, g] for g in GAMMAS]
        draw_curve(panel, GAMMAS, points, rf"$\gamma_n$ = {damping:g} kg/s", fmt=style, color=colour)
    panel.set(xscale="log", yscale="log", xlabel=r"$\Gamma$", ylabel=r"$\langle\bar\omega^2\rangle$ [RPM$^2$]")
    panel.legend()
    return figure


def touching(centres: Numbers, radii: Numbers, tolerance: float = KEPT_DIGITS) -> tuple[Numbers, float]:
    """Contacts of each disk with disks, floor and side walls, and the largest overlap [m]."""
    gaps = np.linalg.norm(centres[:, None] - centres[None, :], axis=2) - radii[:, None] - radii[None, :]
    np.fill_diagonal(gaps, np.inf)
    walls = np.column_stack([centres[:, 1], 0.5 * BOX + centres[:, 0], 0.5 * BOX - centres[:, 0]]) - radii[:, None]
    every_gap = np.hstack([gaps, walls])
    return np.asarray(np.count_nonzero(np.abs(every_gap) < tolerance, axis=1)), float(-every_gap.min())


def _packing(centres: Numbers, radii: Numbers) -> list[Statement]:
    contacts, overlap = touching(centres, radii)
    counts = ", ".join(f"{np.count_nonzero(np.isclose(radii, r))} of {1e3 * r:g} mm" for r in RADII)
    return [
        Statement.judged(
            "1.3, 2.4.1, 3.1",
            "60 disks: 20 of radius 1.5 cm, 20 of 2 cm, 20 of 2.5 cm",
            counts,
            true(all(np.count_nonzero(np.isclose(radii, r)) == 20 for r in RADII), "counted; no chance"),
        ),
        Statement.judged(
            "2.1",
            "each disk is placed where it touches two elements of the front and overlaps nothing",
            f"contacts: {contacts.min()} to {contacts.max()}, mean {contacts.mean():.2f}; overlap {overlap:.0e} m",
            every(
                [true(int(contacts.min()) >= 2, ""), exact(max(overlap, 0.0), KEPT_DIGITS)],
                "two or more each, overlap 0 to the digits kept",
            ),
        ),
    ]


def _steps() -> list[Statement]:
    light = mass(RADII[0])
    # One disk on two others at 30 degrees to the vertical: 2 k cos^2(30 degrees) = 1.5 k.
    periods = {k: math.tau * math.sqrt(light / (1.5 * k)) for k in STIFFNESSES}
    collisions = {k: math.pi * math.sqrt(0.5 * light / k) for k in STIFFNESSES}
    return [
        Statement.judged(
            "2.2",
            "the time step of 1e-6 s is below a hundredth of the period of one disk on top of two others",
            ", ".join(f"k_n = {k:.0e}: {p / TIME_STEP:.0f} steps a period" for k, p in periods.items()),
            true(all(p > 100.0 * TIME_STEP for p in periods.values()), "a hundred steps and more; no chance"),
        ),
        Statement.judged(
            "1.2.1, 2.2",
            "a collision lasts about half a period of the normal oscillation",
            ", ".join(
                f"k_n = {k:.0e}: {1e6 * c:.0f} us, half a period of the pile {5e5 * periods[k]:.0f} us"
                for k, c in collisions.items()
            ),
            true(
                all(0.5 < c / (0.5 * periods[k]) < 2.0 for k, c in collisions.items()), "within a factor 2; no chance"
            ),
        ),
        Statement.judged(
            "2.2",
            "run times of 1e3 s are 1e9 integration steps",
            f"{1e3 / TIME_STEP:.0e}",
            exact(1e3 / TIME_STEP - 1e9, 1.0),
        ),
    ]


def _damping(squares: dict[tuple[float, float], Estimate]) -> list[Statement]:
    light, heavy = 0.5 * mass(RADII[0]), mass(RADII[2])
    span = {d: (restitution(1e4, d, light), restitution(1e4, d, heavy)) for d in DAMPINGS}
    text = "; ".join(f"gamma = {d:g}: e_n {a:.3f} to {b:.3f}" for d, (a, b) in span.items())
    weak = {g: squares[0.1, g] for g in GAMMAS}
    strong = {g: squares[10.0, g] for g in GAMMAS}
    ratio = Estimate(strong[1.0].mean / weak[1.0].mean, strong[1.0].error / weak[1.0].mean)
    growth = Estimate(
        math.log(weak[1.0].mean / weak[0.5].mean) / math.log(2.0),
        math.hypot(weak[1.0].error / weak[1.0].mean, weak[0.5].error / weak[0.5].mean) / math.log(2.0),
    )
    return [
        Statement.judged(
            "2.2",
            "the deformation viscosity is gamma_c = 10",
            f"{text}; <omega^2> at Gamma = 1 with 10 over that with 0.1: {ratio}",
            above(ratio, 0.5),
            "P 3.2 has 0.1 for the same runs. With 10 kg/s contacts are nearly dead, e_n 0.08 to 0.25, and nine tenths "
            "of the rotation of chapter 3 are gone; 10 suits the stiff disk of chapter 6",
        ),
        Statement.judged(
            "3.2",
            "the normal viscous coefficient is gamma_n = 0.1",
            f"{text}; with 0.1 <omega^2> grows from Gamma = 0.5 to 1 with the exponent {growth}",
            every([above(growth, 2.5), below(growth, 5.0)], "the steep growth of Fig. 3.6 is there: exponent 2.5 to 5"),
            "six packings; 25 of them, a quarter of a CPU hour, would tell",
        ),
    ]
