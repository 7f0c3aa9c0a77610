"""P Fig. 6.8: scaled angular velocity against tilt for four normal restitutions."""

from itertools import pairwise

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Estimate, places, zero_crossings
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Wedge, curves, effort, tilt_axes

RESTITUTIONS = {0.5: "+", 0.7: "x", 0.9: (8, 2, 0), 1.0: "s"}
"""e_n and the symbols of the thesis' caption."""

Curves = dict[float, Curve]


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run all restitutions."""
    chosen = effort(quick, seeds)
    wedges = {e: Wedge(restitution=e) for e in RESTITUTIONS}
    tilts = QUICK_TILTS if quick else TILTS
    by_wedge = curves(laboratory, "figure 6.8", dict.fromkeys(wedges.values(), tilts), chosen)
    found = {e: by_wedge[wedge] for e, wedge in wedges.items()}
    rows = [row for curve in found.values() for row in curve.rows()]
    notes = ["map; theta_W = 120 degrees, mu = 0.1, kappa = 0.773", *chosen.notes()]
    return Product("Figure 6.8: influence of viscous dissipation", rows, draw(found), statements(found), notes)


def draw(found: Curves) -> Figure:
    """All curves in one panel."""
    figure = Figure(figsize=(0.75 * WIDTH, 3.8), layout="constrained")
    panel = figure.subplots()
    for (e, marker), colour in zip(RESTITUTIONS.items(), shades(len(RESTITUTIONS)), strict=True):
        draw_curve(panel, found[e].tilts, found[e].points, f"$e_n$ = {e:g}", marker=marker, color=colour, mfc="white")
    tilt_axes(panel)
    panel.legend()
    return figure


def statements(found: Curves) -> list[Statement]:
    """What P 6.3.4 says of this figure."""
    text = "; ".join(
        f"e_n = {e:g}: {max(c.points, key=lambda p: p.mean)} to {min(c.points, key=lambda p: p.mean)}"
        for e, c in found.items()
    )
    extremes = [(max(p.mean for p in c.points), min(p.mean for p in c.points)) for c in found.values()]
    high = all(a[0] < b[0] for a, b in pairwise(extremes))
    low = all(a[1] > b[1] for a, b in pairwise(extremes))
    exponents = _exponents(found)
    values = [e.mean for _, e in exponents]
    exponent_text = ", ".join(f"{e} at {tilt:g}" for tilt, e in exponents[:: max(1, len(exponents) // 6)])
    crossings = {e: zero_crossings(c.tilts, c.points) for e, c in found.items()}
    return [
        Statement(
            "6.3.4",
            "smaller e_n gives lower rotation",
            f"extremes: {text}",
            Verdict.AGREES if high and low else (Verdict.PARTLY if high or low else Verdict.DISAGREES),
        ),
        Statement(
            "6.3.4",
            "no power of e_n brings the curves together",
            f"exponent from e_n 0.7 to 0.9, by tilt [degrees]: {exponent_text}; range {min(values):.1f} to "
            f"{max(values):.1f}",
            verdict(max(values) - min(values) > 1.0),
        ),
        Statement(
            "6.2, 6.8",
            "the sense of rotation changes with tilt",
            "; ".join(f"e_n = {e:g}: {places(c, 'degrees')}" for e, c in crossings.items()),
            verdict(any(crossings.values())),
        ),
        Statement(
            "6.1",
            "a symmetric wedge does not turn the disk",
            "; ".join(f"e_n = {e:g}: {c.at(0.0).mean:.1e} +- {c.at(0.0).error:.1e}" for e, c in found.items()),
            verdict(all(abs(c.at(0.0).mean) < 3.5 * c.at(0.0).error for c in found.values())),
        ),
    ]


def _exponents(found: Curves) -> list[tuple[float, Estimate]]:
    """Exponents b of omega ~ e_n^b by tilt, where both velocities are clear and of one sign."""
    span = float(np.log(0.9 / 0.7))
    exponents = []
    for tilt, a, b in zip(found[0.7].tilts, found[0.7].points, found[0.9].points, strict=True):
        if a.mean * b.mean > 0.0 and min(abs(a.mean) / a.error, abs(b.mean) / b.error) > 5.0:
            error = float(np.hypot(a.error / a.mean, b.error / b.mean)) / span
            exponents.append((tilt, Estimate(float(np.log(b.mean / a.mean)) / span, error)))
    return exponents
