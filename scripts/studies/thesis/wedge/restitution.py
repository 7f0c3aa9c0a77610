"""P Fig. 6.8: scaled angular velocity against tilt for four normal restitutions."""

import numpy as np
from matplotlib.figure import Figure
from scipy import optimize

from jostle_lab.plots.curves import draw_curve, shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, chi_square
from jostle_lab.verdicts import LEAST_PROBABILITY, above, every, rises, true
from studies.thesis.wedge.collapse import average
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Effort, Wedge, curves, effort, tilt_axes
from studies.thesis.wedge.rules import SMALL, changes_sense, from_zero, peak, rms, symmetric

RESTITUTIONS = {0.5: "+", 0.7: "x", 0.9: (8, 2, 0), 1.0: "s"}
"""e_n and the symbols of the thesis' caption."""

FRESH_SEEDS, FIRST_FRESH = 24, 101
"""Of a trial without tilt: chance of the two seeds of the figure, or not."""

Curves = dict[float, Curve]


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run all restitutions."""
    chosen = effort(quick, seeds)
    wedges = {e: Wedge(restitution=e) for e in RESTITUTIONS}
    tilts = QUICK_TILTS if quick else TILTS
    by_wedge = curves(laboratory, "figure 6.8", dict.fromkeys(wedges.values(), tilts), chosen)
    found = {e: by_wedge[wedge] for e, wedge in wedges.items()}
    trial = Effort(chosen.duration, chosen.seeds if quick else FRESH_SEEDS)
    upright = dict.fromkeys(wedges.values(), (0.0,))
    again = curves(laboratory, "figure 6.8, without tilt", upright, trial, first_seed=FIRST_FRESH)
    fresh = {f"e_n = {e:g}": again[wedge].at(0.0) for e, wedge in wedges.items()}
    rows = [row for curve in found.values() for row in curve.rows()]
    notes = ["map; theta_W = 120 degrees, mu = 0.1, kappa = 0.773", *chosen.notes()]
    return Product("Figure 6.8: influence of viscous dissipation", rows, draw(found), statements(found, fresh), notes)


def draw(found: Curves) -> Figure:
    """All curves in one panel."""
    figure = Figure(figsize=(0.85 * WIDTH, 3.8), layout="constrained")
    panel = figure.subplots()
    for (e, marker), colour in zip(RESTITUTIONS.items(), shades(len(RESTITUTIONS)), strict=True):
        draw_curve(panel, found[e].tilts, found[e].points, f"$e_n$ = {e:g}", marker=marker, color=colour, mfc="white")
    tilt_axes(panel)
    panel.legend()
    return figure


def statements(found: Curves, fresh: dict[str, Estimate]) -> list[Statement]:
    """What P 6.3.4 says of this figure; `fresh` are runs without tilt of other seeds, by name of the curve."""
    tops = {e: max(c.points, key=lambda p: p.mean) for e, c in found.items()}
    bottoms = {e: min(c.points, key=lambda p: p.mean) for e, c in found.items()}
    text = "; ".join(f"e_n = {e:g}: {tops[e]} to {bottoms[e]}" for e in found)
    named = {f"e_n = {e:g}": curve for e, curve in found.items()}
    ordered, decided = _ordered(found)
    return [
        Statement.judged(
            "6.3.4, Fig. 6.8",
            "smaller e_n gives lower rotational velocities",
            f"largest and smallest R omega / (A omega_b): {text}; at {ordered} of {decided} tilts where e_n = "
            "0.5 and 1.0 "
            "differ by 3 errors the first turns slower",
            every(
                [
                    rises(list(tops.values())),
                    rises([Estimate(-p.mean, p.error) for p in bottoms.values()]),
                    true(ordered == decided, ""),
                ],
                "the fastest rotation rises with e_n in both senses (a rising curve fits with p > 0.01, its "
                "end above its "
                "start by three errors), and at no tilt is e_n = 0.5 faster than 1.0",
            ),
            "the zero crossing moves with e_n, and near the crossing of one curve the other one turns faster",
        ),
        _no_power(found),
        changes_sense(named),
        symmetric(
            named,
            cause="chance: both seeds of e_n = 1 are two of their errors above zero. Trial of as long runs of "
            f"{FRESH_SEEDS} other seeds, {FIRST_FRESH} and up: {from_zero(fresh)}",
        ),
    ]


def _ordered(found: Curves) -> tuple[int, int]:
    """Tilts at which the smallest e_n turns slower than the largest, of those where they differ for certain."""
    slow, fast = found[min(found)], found[max(found)]
    ordered = decided = 0
    for a, b in zip(slow.points, fast.points, strict=True):
        if abs(abs(a.mean) - abs(b.mean)) > 3.0 * float(np.hypot(a.error, b.error)):
            decided += 1
            ordered += abs(a.mean) < abs(b.mean)
    return ordered, decided


def scaled(found: Curves, power: float) -> tuple[list[Estimate], int]:
    """Differences of omega / e_n^power from their weighted mean at each tilt, and how many means were fitted."""
    rest = []
    for i in range(len(found[0.9].tilts)):
        points = [Estimate(c.points[i].mean / e**power, c.points[i].error / e**power) for e, c in found.items()]
        common = average(points)
        rest += [Estimate(p.mean - common.mean, p.error) for p in points]
    return rest, len(found[0.9].tilts)


def _no_power(found: Curves) -> Statement:
    """The best power of e_n, and what it leaves."""

    def total(power: float) -> float:
        return float(sum((d.mean / d.error) ** 2 for d in scaled(found, power)[0]))

    best = float(optimize.minimize_scalar(total, bounds=(-2.0, 10.0), method="bounded").x)
    rest, lost = scaled(found, best)
    ratio, p = chi_square([d.mean for d in rest], [d.error for d in rest], lost + 1)
    strongest = peak(list(found.values()))
    misfit = rms(rest)
    return Statement.judged(
        "6.3.4",
        "no simple power of e_n scales the curves on each other",
        f"best power {best:.2f}: chi^2 per degree {ratio:.3g}, p = {p:.1g}, rms misfit {misfit}, "
        f"{100.0 * misfit.mean / strongest:.0f} % of the strongest rotation",
        true(p <= LEAST_PROBABILITY, f"the best power is rejected with p <= {LEAST_PROBABILITY:g}")
        & above(misfit, SMALL * strongest),
    )
