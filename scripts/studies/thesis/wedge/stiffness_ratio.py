"""P Fig. 6.9: scaled angular velocity against tilt, five stiffness ratios and the limit of rigid springs."""

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Estimate, chi_square, places, pooled, zero_crossings
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Effort, Wedge, curves, effort, other_law, tilt_axes

RATIOS = {0.01: "^", 0.1: "D", 1.0: "s", 10.0: "s", 100.0: "o"}
"""kappa and the symbols of the thesis' caption."""
FILLED = (0.01, 10.0)
BEYOND = 1000.0
"""One stiffness ratio more, to see where the limit goes."""

Curves = dict[float, Curve]


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run all stiffness ratios and the limit."""
    chosen = effort(quick, seeds)
    tilts = QUICK_TILTS if quick else TILTS
    wedges = {kappa: Wedge(stiffness_ratio=kappa) for kappa in (*RATIOS, BEYOND)}
    by_wedge = curves(laboratory, "figure 6.9", dict.fromkeys(wedges.values(), tilts), chosen)
    found = {kappa: by_wedge[wedge] for kappa, wedge in wedges.items()}
    limit = rigid_skin(laboratory, tilts, chosen)
    rows = [row for curve in (*found.values(), limit) for row in curve.rows()]
    notes = [
        "map; theta_W = 120 degrees, mu = 0.1, e_n = 0.9",
        "stiffness ratio inf: e_t = max(0, 1 - 3 mu (1 + e_n) |u_n/u_t|)",
        *chosen.notes(),
    ]
    return Product(
        "Figure 6.9: influence of the stiffness ratio", rows, draw(found, limit), statements(found, limit), notes
    )


def rigid_skin(laboratory: Laboratory, tilts: tuple[float, ...], effort: Effort) -> Curve:
    """The map with the limit of infinite kappa, by a Rust example."""
    wedge = Wedge(stiffness_ratio=float("inf"))
    tables = [
        other_law(laboratory, "rigid", wedge, effort.duration, seed, tilts) for seed in range(1, effort.seeds + 1)
    ]
    points = [
        pooled([t["scaled"][i] for t in tables], [t["standard_error"][i] for t in tables]) for i in range(len(tilts))
    ]
    return Curve(wedge, tuple(tilts), tuple(points), 1.0)


def draw(found: Curves, limit: Curve) -> Figure:
    """All curves in one panel."""
    figure = Figure(figsize=(0.9 * WIDTH, 4.2), layout="constrained")
    panel = figure.subplots()
    for (kappa, marker), colour in zip(RATIOS.items(), shades(len(RATIOS)), strict=True):
        fill = colour if kappa in FILLED else "white"
        draw_curve(
            panel, limit.tilts, found[kappa].points, rf"$\kappa$ = {kappa:g}", marker=marker, color=colour, mfc=fill
        )
    draw_curve(
        panel,
        limit.tilts,
        limit.points,
        r"$\kappa \to \infty$",
        marker="^",
        color="0.1",
        mfc="white",
        linestyle="--",
    )
    tilt_axes(panel)
    figure.legend(loc="outside right center")
    return figure


def statements(found: Curves, limit: Curve) -> list[Statement]:
    """What P 6.3.4 says of this figure."""
    strongest = max(abs(p.mean) for p in limit.points)
    text, close = [], {}
    for kappa in (10.0, 100.0, BEYOND):
        rest = [
            Estimate(a.mean - b.mean, float(np.hypot(a.error, b.error)))
            for a, b in zip(found[kappa].points, limit.points, strict=True)
        ]
        ratio, p_value = chi_square([r.mean for r in rest], [r.error for r in rest])
        rms = float(np.sqrt(np.mean([r.mean**2 for r in rest])))
        close[kappa] = rms / strongest
        text.append(f"kappa = {kappa:g}: rms {rms:.4f} ({100 * rms / strongest:.1f} % of the largest), {ratio:.1f}")
        text[-1] += f" chi^2 per point, p = {p_value:.2g}"
    largest = {kappa: max(abs(p.mean) for p in found[kappa].points) for kappa in RATIOS}
    values = list(largest.values())
    monotonic = values in (sorted(values), sorted(values, reverse=True))
    pointwise = [[found[kappa].points[i].mean for kappa in RATIOS] for i in range(len(limit.tilts))]
    ordered = sum(row in (sorted(row), sorted(row, reverse=True)) for row in pointwise)
    crossings = {kappa: zero_crossings(found[kappa].tilts, found[kappa].points) for kappa in RATIOS}
    return [
        Statement(
            "6.3.4, Fig. 6.9",
            "the limit kappa -> inf is almost indistinguishable from kappa = 100",
            "less the limit: " + "; ".join(text),
            Verdict.AGREES if close[100.0] < 0.05 else Verdict.DISAGREES,
        ),
        Statement(
            "6.3.4",
            "no simple tendency with kappa",
            "largest |R omega / (A omega_b)|: "
            + ", ".join(f"{kappa:g}: {value:.3f}" for kappa, value in largest.items())
            + f"; monotonic in kappa at {ordered} of {len(pointwise)} tilts",
            verdict(not monotonic or ordered < len(pointwise) // 2),
        ),
        Statement(
            "6.2",
            "the sense of rotation changes with tilt",
            "; ".join(f"kappa = {k:g}: {places(c, 'degrees')}" for k, c in crossings.items()),
            verdict(any(crossings.values())),
        ),
        Statement(
            "6.1",
            "a symmetric wedge does not turn the disk",
            "; ".join(f"kappa = {k:g}: {c.at(0.0).mean:.1e} +- {c.at(0.0).error:.1e}" for k, c in found.items()),
            verdict(all(abs(c.at(0.0).mean) < 3.5 * c.at(0.0).error for c in found.values())),
        ),
    ]
