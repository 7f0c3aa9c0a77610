"""P Fig. 6.6: scaled angular velocity against tilt for nine friction coefficients."""

import math
from itertools import pairwise

from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, places, zero_crossings
from jostle_lab.verdicts import Judgement, Verdict, above, every, falls, near, true
from studies.thesis.wedge import friction_trials
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Wedge, curves, effort, other_law, tilt_axes
from studies.thesis.wedge.friction_trials import Trials, trials
from studies.thesis.wedge.rules import alike, less, peak, symmetric

FRICTIONS = {0.001: "+", 0.005: "x", 0.01: (8, 2, 0), 0.03: "s", 0.05: "s", 0.1: "o", 0.15: "o", 0.3: "^", 1.0: "^"}
"""mu and the symbols of the thesis' caption."""
FILLED = (0.05, 0.15, 1.0)
NEAR_CRITICAL = (29.25, 29.7, 29.85, 29.92, 29.96, 29.98, 29.99)
"""Tilts [degrees] where the peak of small mu is."""
SLIPPERY = 0.05
"""Up to here the curves have these tilts too."""
STIFFER = 10.0
"""Tangential stiffness of a trial, whether e_t depends on it at small mu, over that of the figure."""
TRIAL_MU, TRIAL_TILTS = 0.001, (8.0, 16.0, 24.0, 28.0, 29.7)
SATURATED = 0.1
"""Part by which a saturated height may still change for a factor 5 of mu."""

Curves = dict[float, Curve]


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run all friction coefficients."""
    chosen = effort(quick, seeds)
    wedges = {mu: Wedge(friction=mu) for mu in FRICTIONS}
    plain = QUICK_TILTS if quick else TILTS
    tilts = {w: tuple(sorted((*plain, *NEAR_CRITICAL))) if mu <= SLIPPERY else plain for mu, w in wedges.items()}
    by_wedge = curves(laboratory, "figure 6.6", tilts, chosen)
    stiff = Wedge(friction=TRIAL_MU, stiffness_ratio=STIFFER * wedges[TRIAL_MU].stiffness_ratio)
    trial = curves(laboratory, "figure 6.6, stiffness", {stiff: TRIAL_TILTS}, chosen, seed_stride=50)
    found = {mu: by_wedge[wedge] for mu, wedge in wedges.items()}
    rows = [row for curve in found.values() for row in curve.rows()]
    notes = ["map; theta_W = 120 degrees, e_n = 0.9, kappa = 0.773", *chosen.notes()]
    anew = trials(laboratory, quick)
    found_statements = [
        *statements(found, anew),
        sliding(found[TRIAL_MU], trial[stiff]),
        recipe(laboratory, wedges[0.15]),
        friction_trials.agreement(found, anew),
    ]
    return Product("Figure 6.6: influence of the friction coefficient", rows, draw(found), found_statements, notes)


def sliding(curve: Curve, stiffer: Curve) -> Statement:
    """At very small mu the disk slides throughout, so that the tangential stiffness does not matter."""
    text, judgement = alike(less(stiffer, curve), peak([curve]))
    return Statement.judged(
        "6.3.4",
        "for very small mu the disk slides during the entire contact and e_t does not depend on k_t",
        f"mu = {curve.wedge.friction:g}, kappa = {curve.wedge.stiffness_ratio:g} and "
        f"{stiffer.wedge.stiffness_ratio:g} at "
        f"{len(stiffer.tilts)} tilts: {text}",
        judgement,
        "near the critical tilt slow grazing impacts have small |u_t/u_n|, and longer runs would tell",
    )


def recipe(laboratory: Laboratory, wedge: Wedge) -> Statement:
    """The printed recipe for e_t, which creates energy, at mu = 0.15: a trial of what makes ours differ."""
    tilts = (8.0, 12.0, 16.0, 20.0, 24.0, 28.0)
    table = other_law(laboratory, "recipe", wedge, 1e6, 1, tilts)
    values = [Estimate(float(m), float(e)) for m, e in zip(table["scaled"], table["standard_error"], strict=True)]
    text = ", ".join(f"{v} at {tilt:g}" for v, tilt in zip(values, tilts, strict=True))
    judged = [above(v, 0.0) for v in values]
    return Statement.judged(
        "4.76 to 4.79, 6.3.4",
        "the printed recipe for e_t gives a positive velocity at mu = 0.15",
        f"by the recipe, [degrees]: {text}",
        every(judged, f"at each tilt: {judged[0].rule}"),
        "a trial: the recipe is not what makes the printed curve of mu = 0.15 positive",
    )


def draw(found: Curves) -> Figure:
    """All curves against the tilt; those of small mu against the distance from the critical tilt over mu."""
    figure = Figure(figsize=(WIDTH, 4.6), layout="constrained")
    panel, close = figure.subplots(1, 2, sharey=True, width_ratios=(3, 2))
    for (mu, marker), colour in zip(FRICTIONS.items(), shades(len(FRICTIONS)), strict=True):
        fill = colour if mu in FILLED else "white"
        style = {"marker": marker, "color": colour, "mfc": fill}
        curve = found[mu]
        draw_curve(panel, curve.tilts, curve.points, rf"$\mu$ = {mu:g}", **style)
        away = [math.radians(curve.wedge.critical_tilt - tilt) / mu for tilt in curve.tilts]
        if mu <= SLIPPERY:
            draw_curve(close, away, curve.points, "", **style)
    tilt_axes(panel)
    close.axhline(0.0, color="0.5", lw=0.6, zorder=0)
    close.set(xscale="log", xlim=(0.02, 300.0), xlabel=r"$(\theta_0 - \theta_T)/\mu$ [rad]")
    close.set_title(rf"$\mu \leq$ {SLIPPERY:g}: the last degree, spread", fontsize=8)
    figure.legend(loc="outside upper center", ncols=5, title="bars: standard error")
    return figure


def statements(found: Curves, trial: Trials) -> list[Statement]:
    """What P 6.3.4 says of this figure; `trial` by the map written anew."""
    named = {f"mu = {mu:g}": curve for mu, curve in found.items()}
    return [_crossings(found), *_rough(found, trial), *_peaks(found), symmetric(named)]


def _crossings(found: Curves) -> Statement:
    """Where the sense changes, up to mu = 0.1."""
    crossings = {mu: zero_crossings(found[mu].tilts, found[mu].points) for mu in found if mu <= 0.1}
    text = "; ".join(f"mu = {mu:g}: {places(c, '')}" for mu, c in crossings.items())
    firsts = [c[0] for c in crossings.values() if c]
    complete = len(firsts) == len(crossings)
    judgement = falls(firsts) if complete else Judgement(Verdict.OPEN, "a curve without a crossing")
    return Statement.judged(
        "6.3.4, Fig. 6.6",
        "as mu grows, the zero crossing moves to the left, up to mu = 0.1",
        f"changes of sign [degrees]: {text}",
        Judgement(judgement.verdict, f"first crossing against mu, each curve has one: {judgement.rule}"),
        "a curve has no crossing that is certain: longer runs would tell",
    )


def _rough(found: Curves, trial: Trials) -> list[Statement]:
    """Above mu = 0.1, one row for each coefficient."""
    rows = []
    for mu in (mu for mu in found if mu > 0.1):
        curve = found[mu]
        index = min(range(len(curve.tilts)), key=lambda i: curve.points[i].mean / curve.points[i].error)
        lowest, tilt = curve.points[index], curve.tilts[index]
        negative = [t for t, p in zip(curve.tilts, curve.points, strict=True) if p.mean < -3.0 * p.error]
        positive = sum(p.mean > 2.0 * p.error for p in curve.points)
        span = f", negative by 3 errors from {negative[0]:g} to {negative[-1]:g} degrees" if negative else ""
        verdict = (
            Verdict.DISAGREES if negative else Verdict.AGREES if 2 * positive > len(curve.points) else Verdict.OPEN
        )
        rows.append(
            Statement.judged(
                "6.3.4, Fig. 6.6",
                f"above mu = 0.1 the angular velocity stays positive for all tilts (mu = {mu:g})",
                f"lowest by significance {lowest} at {tilt:g} degrees{span}; {positive} of {len(curve.points)} points "
                "above zero by 2 errors",
                Judgement(verdict, "no point below zero by 3 errors, most above by 2"),
                friction_trials.cause(trial, mu),
            )
        )
    return rows


def _peaks(found: Curves) -> list[Statement]:
    """The peak of small mu near the critical tilt."""
    tops = {mu: _strongest(found[mu]) for mu in found if mu <= 0.1}
    text = "; ".join(
        f"mu = {mu:g}: {height} at {place:g} degrees, (theta_0 - theta_T) / mu = "
        f"{math.radians(found[mu].wedge.critical_tilt - place) / mu:.2f}"
        for mu, (place, height) in tops.items()
    )
    at = [place for place, _ in tops.values()]
    moves = all(a >= b for a, b in pairwise(at)) and at[0] > at[-1]
    heights = [abs(height.mean) for _, height in tops.values()]
    errors = [height.error for _, height in tops.values()]
    ratio = heights[0] / heights[1]
    saturation = Estimate(ratio, ratio * math.hypot(errors[0] / heights[0], errors[1] / heights[1]))
    mu_low, mu_next = list(tops)[:2]
    slow = Estimate(heights[-1], errors[-1])
    fast = Estimate(heights[0] - slow.mean, math.hypot(errors[0], slow.error))
    return [
        Statement.judged(
            "6.3.4, Fig. 6.6",
            "a peak of fast rotation moves towards the critical tilt as mu goes to 0",
            text,
            true(moves, "the tilt of the strongest rotation on the grid never falls as mu falls, and rises in all"),
        ),
        Statement.judged(
            "6.3.4",
            "the height of this peak saturates as mu goes to 0",
            f"height at mu = {mu_low:g} over that at {mu_next:g}: {saturation}",
            near(saturation, 1.0, SATURATED),
            "the peak of the smallest mu lies between points of the grid of tilts, or is not reached yet",
        ),
        Statement.judged(
            "6.3.4",
            "small friction and a wall that is almost flat make the disk rotate fast",
            f"strongest at mu = {mu_low:g}: {Estimate(heights[0], errors[0])}, at mu = 0.1: {slow}",
            above(fast, 0.0),
        ),
    ]


def _strongest(curve: Curve) -> tuple[float, Estimate]:
    """Tilt [degrees] and value of the fastest rotation."""
    return max(zip(curve.tilts, curve.points, strict=True), key=lambda pair: abs(pair[1].mean))
