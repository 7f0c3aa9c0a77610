"""P Fig. 6.3: mean angular velocity against tilt by molecular dynamics, six Gamma."""

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Estimate, chi_square, places, zero_crossings
from studies.thesis.wedge.curves import RADIUS, UNOBSERVED, Curve, Wedge, tilt_axes

SYMBOLS = {0.9: "+", 1.0: "x", 1.2: (8, 2, 0), 1.5: "s", 2.0: "s", 3.0: "o"}
"""Gamma and the symbols of the thesis' caption."""
FILLED = (2.0,)
COLOURS = {0.9: "0.55", 1.0: "0.3", 1.2: "#7a4fa0", 1.5: "#1f5fa8", 2.0: "#2e7d4f", 3.0: "#c0272d"}
TILTS = (0.0, 4.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0, 25.0, 28.0)
QUICK_TILTS = (0.0, 6.0, 10.0, 14.0, 20.0, 26.0)
QUICK_SECONDS, SECONDS = 60.0, 300.0 / (1.0 - UNOBSERVED)
"""Of each run; the thesis observes 300 s."""


def molecular(gamma: float) -> Wedge:
    """The wedge of P Figs 6.3 and 6.5 by molecular dynamics."""
    return Wedge("molecular-dynamics", gamma)


def molecular_curves(
    laboratory: Laboratory, title: str, gammas: tuple[float, ...], quick: bool, seeds: int | None
) -> tuple[dict[float, Curve], str]:
    """A curve for each Gamma, and a note."""
    tilts = QUICK_TILTS if quick else TILTS
    seconds = QUICK_SECONDS if quick else SECONDS
    count = seeds or 1
    found = {}
    runs = {
        (g, tilt, seed): molecular(g).run(tilt, seed, seconds)
        for seed in range(1, count + 1)
        for g in gammas
        for tilt in tilts
    }
    tables = laboratory.run(list(runs.values()), title)
    for g in gammas:
        points = []
        for tilt in tilts:
            ends = [tables[runs[g, tilt, seed]] for seed in range(1, count + 1)]
            means = [float(end["scaled_angular_velocity"][-1]) for end in ends]
            errors = [float(end["scaled_angular_velocity.standard_error"][-1]) for end in ends]
            points.append(Estimate(float(np.mean(means)), float(np.sqrt(np.sum(np.square(errors)))) / count))
        found[g] = Curve(molecular(g), tilts, tuple(points), 1.0)
    note = (
        f"molecular dynamics: k_n = 4.5e6 N/m, gamma_n = 9.84 kg/s, m = 4.5 g (e_n = 0.89916), kappa = 0.773, "
        f"mu = 0.1, R = 0.02 m, 80 Hz, {count} run(s) a point, seeds from 1 on, of {seconds:.0f} s, the first "
        f"{100 * UNOBSERVED:g} % unobserved"
    )
    return found, note


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run and compare."""
    found, note = molecular_curves(laboratory, "figure 6.3", tuple(SYMBOLS), quick, seeds)
    rows = [
        {
            **row,
            "angular_velocity": row["scaled_angular_velocity"] / scale(g),
            "velocity_error": row["error"] / scale(g),
        }
        for g, curve in found.items()
        for row in curve.rows()
    ]
    title = "Figure 6.3: angular velocity of a disk in a wedge, molecular dynamics"
    return Product(title, rows, draw(found), statements(found), [note])


def scale(gamma: float) -> float:
    """R / (A omega_b) [s]."""
    return RADIUS / molecular(gamma).base_velocity


def draw(found: dict[float, Curve]) -> Figure:
    """Angular velocity [rad/s] against tilt."""
    figure = Figure(figsize=(0.75 * WIDTH, 3.8), layout="constrained")
    panel = figure.subplots()
    for gamma, curve in found.items():
        points = [Estimate(p.mean / scale(gamma), p.error / scale(gamma)) for p in curve.points]
        fill = COLOURS[gamma] if gamma in FILLED else "white"
        draw_curve(
            panel,
            curve.tilts,
            points,
            rf"$\Gamma$ = {gamma:g}",
            marker=SYMBOLS[gamma],
            color=COLOURS[gamma],
            mfc=fill,
        )
    tilt_axes(panel)
    panel.set_ylabel(r"$\bar\omega$ [rad/s], counter-clockwise")
    panel.legend()
    return figure


def statements(found: dict[float, Curve]) -> list[Statement]:
    """What P 6.2 says of this figure."""
    strong = [g for g in found if g > 1.0]
    peak = max(abs(p.mean / scale(g)) for g in strong for p in found[g].points)
    weak = {g: max(found[g].points, key=lambda p: abs(p.mean)) for g in found if g <= 1.0}
    weak_text = "; ".join(
        f"Gamma = {g:g}: at most {Estimate(p.mean / scale(g), p.error / scale(g))} rad/s" for g, p in weak.items()
    )
    largest_weak = max((abs(p.mean / scale(g)) for g, p in weak.items()), default=0.0)
    zero = [found[g].at(0.0) for g in found]
    zero_chi, zero_p = chi_square([p.mean for p in zero], [max(p.error, 1e-9) for p in zero])
    crossings = {g: zero_crossings(found[g].tilts, found[g].points) for g in strong}
    crossing_text = "; ".join(f"Gamma = {g:g}: {places(c, '')}" for g, c in crossings.items())
    fastest = {g: max(found[g].points, key=lambda p: abs(p.mean)) for g in strong}
    return [
        Statement(
            "6.2",
            "Gamma <= 1: the rotation is too small to be measurable in 300 s",
            f"{weak_text} (strongest of all: {peak:.3g} rad/s)",
            verdict(largest_weak < 0.05 * peak),
        ),
        Statement(
            "6.2",
            "Gamma > 1: the angular velocity is proportional to v_b",
            "largest |R omega / (A omega_b)|: "
            + "; ".join(f"Gamma = {g:g}: {Estimate(abs(p.mean), p.error)}" for g, p in fastest.items())
            + "; point by point see figure 6.5",
            Verdict.AGREES if _alike(fastest) else Verdict.PARTLY,
        ),
        Statement(
            "6.2",
            "not monotonic in tilt, and may change direction as the tilt grows",
            f"changes sign at the tilts [degrees] {crossing_text}",
            verdict(any(crossings.values())),
        ),
        Statement(
            "6.1, 6.2",
            "a symmetric wedge does not turn the disk",
            f"zero tilt: chi^2 per degree {zero_chi:.2f}, p = {zero_p:.2g}, six Gamma",
            verdict(zero_p > 0.01),
        ),
    ]


def _alike(fastest: dict[float, Estimate]) -> bool:
    """Whether all are within 15 % of their mean."""
    sizes = np.array([abs(p.mean) for p in fastest.values()])
    return bool(np.all(np.abs(sizes / sizes.mean() - 1.0) < 0.15))
