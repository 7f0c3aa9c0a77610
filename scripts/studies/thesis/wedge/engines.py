"""P Fig. 6.5: molecular dynamics beside the map, and beside the exactly moving wedge."""

import math

from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import above, below, every
from studies.thesis.wedge.collapse import average
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Effort, Wedge, curves, effort, tilt_axes
from studies.thesis.wedge.dynamics import QUICK_SECONDS, SECONDS, molecular_curves
from studies.thesis.wedge.rules import alike, changes_sense, less, peak, rms

GAMMAS = {1.2: ("+", "#7a4fa0"), 1.5: ("x", "#1f5fa8"), 2.0: ("s", "#2e7d4f"), 3.0: ("s", "#c0272d")}
"""Gamma, the symbols of the thesis' caption, and colours."""
RESTITUTION = 0.89916
"""e_n of the molecular dynamics."""
CLOSE = 0.1
"""Part of the largest value that curves in print hide behind their symbols."""
LOAD_ERROR = 0.3
"""Error of the decade of a processor time, which the load of a machine changes by a factor of two."""


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run the three engines at the same places."""
    begun = laboratory.spent
    soft, note = molecular_curves(laboratory, "figure 6.5, MD", tuple(GAMMAS), quick, seeds)
    after_soft = laboratory.spent
    chosen = effort(quick, None)
    tilts = tuple(sorted({*(QUICK_TILTS if quick else TILTS), *soft[1.2].tilts}))
    wedge = Wedge(restitution=RESTITUTION)
    the_map = curves(laboratory, "figure 6.5, map", {wedge: tilts}, chosen)[wedge]
    after_map = laboratory.spent
    fifth = Effort(0.2 * chosen.duration, chosen.seeds)
    moving = _moving(laboratory, tilts, fifth)
    simulated = sum(
        (seeds or 1) * (QUICK_SECONDS if quick else SECONDS) / curve.wedge.time * len(curve.tilts)
        for curve in soft.values()
    )
    cost = {
        "molecular": (after_soft - begun) / simulated,
        "map": (after_map - after_soft) / (chosen.duration * chosen.seeds * len(tilts)),
        "moving": (laboratory.spent - after_map) / (fifth.duration * fifth.seeds * len(tilts) * len(GAMMAS)),
    }
    rows = [row for curve in (the_map, *moving.values(), *soft.values()) for row in curve.rows()]
    notes = [note, f"map and moving wedge with e_n = {RESTITUTION}; the moving wedge for a fifth of the map's time"]
    title = "Figure 6.5: molecular dynamics and event-driven, scaled"
    return Product(
        title, rows, draw(the_map, moving, soft), statements(the_map, moving, soft, cost), [*notes, *chosen.notes()]
    )


def _moving(laboratory: Laboratory, tilts: tuple[float, ...], effort: Effort) -> dict[float, Curve]:
    """The exact wedge on the same sine, event-driven, for each Gamma."""
    wedges = {gamma: Wedge("event-driven", gamma, restitution=RESTITUTION) for gamma in GAMMAS}
    found = curves(laboratory, "figure 6.5, moving wedge", dict.fromkeys(wedges.values(), tilts), effort)
    return {gamma: found[wedge] for gamma, wedge in wedges.items()}


def draw(the_map: Curve, moving: dict[float, Curve], soft: dict[float, Curve]) -> Figure:
    """All engines; below, differences from the map."""
    figure = Figure(figsize=(0.85 * WIDTH, 5.6), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[2.0, 1.0])
    draw_curve(upper, the_map.tilts, the_map.points, "map", marker="o", color="0.1", mfc="white", lw=2.0, zorder=1)
    for gamma, (marker, colour) in GAMMAS.items():
        fill = colour if gamma == 2.0 else "white"
        style = {
            "marker": marker,
            "color": colour,
            "mfc": fill,
            "linestyle": "none",
            "ms": 5.5,
            "mew": 1.1,
            "capsize": 0,
        }
        upper_label = rf"MD, $\Gamma$ = {gamma:g}"
        draw_curve(upper, soft[gamma].tilts, soft[gamma].points, upper_label, **style, zorder=3)
        line = {"marker": None, "color": colour, "linestyle": "-", "lw": 0.9, "capsize": 0}
        draw_curve(upper, moving[gamma].tilts, moving[gamma].points, rf"moving ED, $\Gamma$ = {gamma:g}", **line)
        draw_curve(lower, soft[gamma].tilts, less(soft[gamma], the_map), "", **style)
        draw_curve(lower, moving[gamma].tilts, less(moving[gamma], the_map), "", **line)
    tilt_axes(upper)
    tilt_axes(lower)
    upper.set_xlabel("")
    lower.set_ylabel("less the map")
    handles, labels = upper.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    return figure


def statements(
    the_map: Curve, moving: dict[float, Curve], soft: dict[float, Curve], cost: dict[str, float]
) -> list[Statement]:
    """MD against both event-driven ways and itself; `cost`: processor time per A omega_b / g [s]."""
    strongest = peak([the_map])
    tilts = next(iter(soft.values())).tilts
    common = [average([curve.points[i] for curve in soft.values()]) for i in range(len(tilts))]
    own = [
        Estimate(p.mean - c.mean, p.error) for curve in soft.values() for p, c in zip(curve.points, common, strict=True)
    ]
    text, judgement = alike(own, strongest, lost=len(tilts))
    apart = {g: alike(less(moving[g], the_map), strongest)[0] for g in moving}
    cause = (
        "the map's random phase: the exactly moving wedge, which has the phase of the sine, is off as much: "
        + "; ".join(f"Gamma = {g:g}: {a}" for g, a in apart.items())
    )
    found = [
        Statement.judged(
            "Fig. 6.5, 6.3.3", "MD at all Gamma > 1 scales with A omega_b: one curve", text, judgement, cause
        )
    ]
    for gamma, curve in soft.items():
        to_map, to_moving = alike(less(curve, the_map), strongest), alike(less(curve, moving[gamma]), strongest)
        rest = below(rms(less(curve, the_map)), CLOSE * strongest)
        found.append(
            Statement.judged(
                "Fig. 6.5, 6.3.3",
                f"MD and event-driven are indistinguishable within numerical error (Gamma = {gamma:g})",
                f"MD less map: {to_map[0]}; MD less the exactly moving wedge: {to_moving[0]}",
                every(
                    [to_map[1], rest], f"{to_map[1].rule}; in part if the rms is below {CLOSE:.0%} of it by two errors"
                ),
                f"moving wedge less map: {apart[gamma]}: the random phase is what differs, not the duration "
                "of contacts",
            )
        )
    curves = {f"MD, Gamma = {g:g}": c for g, c in soft.items()}
    ratio = cost["molecular"] / cost["map"]
    return [
        *found,
        changes_sense({**curves, "map": the_map}, every_one=True),
        Statement.judged(
            "6.3.3",
            "event-driven simulation is faster by orders of magnitude",
            f"processor time for the same time in units of A omega_b / g: {ratio:.0f} times that of the map, "
            "moving wedge "
            f"{cost['molecular'] / cost['moving']:.0f}",
            above(Estimate(math.log10(ratio), LOAD_ERROR), 2.0),
        ),
    ]
