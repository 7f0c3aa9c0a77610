"""P Fig. 6.6: scaled angular velocity against tilt for nine friction coefficients."""

from itertools import pairwise

from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Estimate, places, zero_crossings
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Wedge, curves, effort, other_law, tilt_axes

FRICTIONS = {0.001: "+", 0.005: "x", 0.01: (8, 2, 0), 0.03: "s", 0.05: "s", 0.1: "o", 0.15: "o", 0.3: "^", 1.0: "^"}
"""mu and the symbols of the thesis' caption."""
FILLED = (0.05, 0.15, 1.0)
NEAR_CRITICAL = (29.25, 29.7, 29.85, 29.92)
"""Tilts [degrees] where the peak of small mu is."""

Curves = dict[float, Curve]


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run all friction coefficients."""
    chosen = effort(quick, seeds)
    wedges = {mu: Wedge(friction=mu) for mu in FRICTIONS}
    tilts = tuple(sorted((*(QUICK_TILTS if quick else TILTS), *NEAR_CRITICAL)))
    by_wedge = curves(laboratory, "figure 6.6", dict.fromkeys(wedges.values(), tilts), chosen)
    found = {mu: by_wedge[wedge] for mu, wedge in wedges.items()}
    rows = [row for curve in found.values() for row in curve.rows()]
    notes = ["map; theta_W = 120 degrees, e_n = 0.9, kappa = 0.773", *chosen.notes()]
    found_statements = [*statements(found), recipe(laboratory, wedges[0.15])]
    return Product("Figure 6.6: influence of the friction coefficient", rows, draw(found), found_statements, notes)


def recipe(laboratory: Laboratory, wedge: Wedge) -> Statement:
    """Whether the printed recipe for e_t, which creates energy, explains the sign at mu = 0.15."""
    tilts = (8.0, 12.0, 16.0, 20.0, 24.0, 28.0)
    table = other_law(laboratory, "recipe", wedge, 1e6, 1, tilts)
    values = zip(tilts, table["scaled"], table["standard_error"], strict=True)
    text = ", ".join(f"{Estimate(float(mean), float(error))} at {tilt:g}" for tilt, mean, error in values)
    negative = any(table["scaled"] < -3.0 * table["standard_error"])
    conclusion = "negative too, so that it is not the cause" if negative else "positive, so that it is the cause"
    return Statement(
        "4.76-4.79",
        "the printed recipe for e_t instead of exact stitching: positive at mu = 0.15?",
        f"{text} degrees: {conclusion}",
        Verdict.OPEN,
    )


def draw(found: Curves) -> Figure:
    """All curves in one panel."""
    figure = Figure(figsize=(0.9 * WIDTH, 4.4), layout="constrained")
    panel = figure.subplots()
    for (mu, marker), colour in zip(FRICTIONS.items(), shades(len(FRICTIONS)), strict=True):
        fill = colour if mu in FILLED else "white"
        draw_curve(panel, found[mu].tilts, found[mu].points, rf"$\mu$ = {mu:g}", marker=marker, color=colour, mfc=fill)
    tilt_axes(panel)
    figure.legend(loc="outside right center")
    return figure


def statements(found: Curves) -> list[Statement]:
    """What P 6.3.4 says of this figure."""
    crossings = {mu: zero_crossings(curve.tilts, curve.points) for mu, curve in found.items()}
    text = "; ".join(f"mu = {mu:g}: {places(c, '')}" for mu, c in crossings.items())
    slippery = [crossings[mu] for mu in found if mu <= 0.1]
    moves = all(slippery) and all(a[0].mean > b[0].mean for a, b in pairwise(slippery) if a and b)
    rough = {mu: min(found[mu].points, key=lambda p: p.mean / p.error) for mu in found if mu > 0.1}
    positive = {mu: all(p.mean > -3.0 * p.error for p in found[mu].points) for mu in rough}
    tops = {mu: _strongest(found[mu]) for mu in found if mu <= 0.1}
    places = [place for place, _ in tops.values()]
    top_text = "; ".join(f"mu = {mu:g}: {height} at {place:g} degrees" for mu, (place, height) in tops.items())
    low, lower, third = (abs(height.mean) for _, height in list(tops.values())[:3])
    saturates = max(low, lower, third) < 1.3 * min(low, lower, third)
    return [
        Statement(
            "6.3.4",
            "as mu grows, the zero crossing moves to the left, up to mu = 0.1",
            f"sign changes [degrees]: {text}",
            verdict(moves),
        ),
        Statement(
            "6.3.4",
            "above mu = 0.1 the angular velocity stays positive for all tilts",
            "; ".join(
                f"mu = {mu:g}: {'yes' if positive[mu] else 'no'}, lowest by significance {p}" for mu, p in rough.items()
            ),
            _share(list(positive.values())),
        ),
        Statement(
            "6.3.4",
            "a peak of fast rotation moves towards the critical tilt as mu goes to 0",
            top_text,
            verdict(all(a >= b for a, b in pairwise(places)) and places[0] > places[-1]),
        ),
        Statement(
            "6.3.4",
            "the height of this peak saturates as mu goes to 0",
            f"strongest |R omega / (A omega_b)|: mu = 0.01: {third:.3f}, 0.005: {lower:.3f}, 0.001: {low:.3f}",
            Verdict.AGREES if saturates else Verdict.PARTLY,
        ),
        Statement(
            "6.1",
            "a symmetric wedge does not turn the disk",
            "; ".join(f"mu = {mu:g}: {curve.at(0.0)}" for mu, curve in found.items()),
            verdict(all(abs(curve.at(0.0).mean) < 4.0 * curve.at(0.0).error for curve in found.values())),
        ),
    ]


def _strongest(curve: Curve) -> tuple[float, Estimate]:
    """Tilt [degrees] and value of the fastest rotation."""
    return max(zip(curve.tilts, curve.points, strict=True), key=lambda pair: abs(pair[1].mean))


def _share(holds: list[bool]) -> Verdict:
    if all(holds):
        return Verdict.AGREES
    return Verdict.PARTLY if any(holds) else Verdict.DISAGREES
