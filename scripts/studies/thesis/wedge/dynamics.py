"""P Fig. 6.3: mean angular velocity against tilt by molecular dynamics, six Gamma."""

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.statistics.power_law import weighted_power_law
from jostle_lab.verdicts import below, every, near
from studies.thesis.wedge.curves import RADIUS, UNOBSERVED, Curve, Wedge, tilt_axes
from studies.thesis.wedge.rules import SMALL, changes_sense, symmetric

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
    figure = Figure(figsize=(0.85 * WIDTH, 3.8), layout="constrained")
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
    strong = {g: curve for g, curve in found.items() if g > 1.0}
    fastest = max(abs(p.mean) / scale(g) for g, curve in strong.items() for p in curve.points)
    return [
        *_in_contact(found, fastest),
        _proportional(strong),
        changes_sense({f"Gamma = {g:g}": curve for g, curve in strong.items()}),
        symmetric(
            {f"Gamma = {g:g}": curve for g, curve in found.items()},
            "6.1, 6.2",
            "the error at Gamma = 3 is too large by a fifth: runs twice as long, an hour of one processor",
        ),
    ]


def _in_contact(found: dict[float, Curve], fastest: float) -> list[Statement]:
    """Gamma <= 1, where the disk stays in contact most of the time."""
    weak = {g: curve for g, curve in found.items() if g <= 1.0}
    largest = {}
    for g, curve in weak.items():
        point = max(curve.points, key=lambda p: abs(p.mean))
        largest[g] = Estimate(abs(point.mean) / scale(g), point.error / scale(g))
    text = "; ".join(f"Gamma = {g:g}: at most {e} rad/s" for g, e in largest.items())
    certain = {g: sum(abs(p.mean) > 3.0 * p.error for p in curve.points if p.error > 0.0) for g, curve in weak.items()}
    return [
        Statement.judged(
            "6.2",
            "Gamma <= 1: the rotation is too small to be measurable in 300 s",
            f"{text}, against {fastest:.3g} rad/s at Gamma > 1; beyond zero by 3 errors: "
            + ", ".join(f"{n} of {len(weak[g].points)} points at Gamma = {g:g}" for g, n in certain.items()),
            every(
                [below(e, SMALL * fastest) for e in largest.values()], f"below {SMALL:.0%} of the fastest at each Gamma"
            ),
            "in a deterministic run the disk settles on a periodic motion, whose small rotation has hardly an error",
        )
    ]


def _proportional(strong: dict[float, Curve]) -> Statement:
    """Exponent of omega in v_b, at each tilt where all Gamma turn the same way for certain."""
    exponents = {}
    speeds = np.array([curve.wedge.base_velocity for curve in strong.values()])
    for i, tilt in enumerate(next(iter(strong.values())).tilts):
        points = [curve.points[i] for curve in strong.values()]
        signs = {np.sign(p.mean) for p in points}
        if len(signs) == 1 and all(abs(p.mean) > 5.0 * p.error for p in points):
            scaled = [Estimate(abs(p.mean) / scale(g), p.error / scale(g)) for g, p in zip(strong, points, strict=True)]
            exponents[tilt] = weighted_power_law(speeds, scaled)
    weights = np.array([e.error**-2 for e in exponents.values()])
    means = np.array([e.mean for e in exponents.values()])
    # The scatter from tilt to tilt is the error: it is larger than that of the runs if the law does not hold exactly.
    mean = float(np.sum(weights * means) / weights.sum())
    error = max(float(means.std(ddof=1)) / np.sqrt(len(means)), float(weights.sum()) ** -0.5)
    return Statement.judged(
        "6.2",
        "Gamma > 1: the angular velocity scales linearly with v_b",
        f"exponent {Estimate(mean, float(error))} over {len(exponents)} tilts, Gamma from {min(strong):g} to "
        f"{max(strong):g}: " + ", ".join(f"{e} at {t:g}" for t, e in exponents.items()),
        near(Estimate(mean, float(error)), 1.0, 0.1),
        "see figure 6.5: at small Gamma the phase of the wedge at impact is not random",
    )
