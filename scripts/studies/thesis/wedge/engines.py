"""P Fig. 6.5: molecular dynamics beside the map, and beside the exactly moving wedge."""

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Estimate, chi_square, places, zero_crossings
from studies.thesis.wedge.collapse import average
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Effort, Wedge, curves, effort, tilt_axes
from studies.thesis.wedge.dynamics import molecular_curves

GAMMAS = {1.2: ("+", "#7a4fa0"), 1.5: ("x", "#1f5fa8"), 2.0: ("s", "#2e7d4f"), 3.0: ("s", "#c0272d")}
"""Gamma, the symbols of the thesis' caption, and colours."""
RESTITUTION = 0.89916
"""e_n of the molecular dynamics."""


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run the three engines at the same places."""
    soft, note = molecular_curves(laboratory, "figure 6.5, MD", tuple(GAMMAS), quick, seeds)
    chosen = effort(quick, None)
    tilts = tuple(sorted({*(QUICK_TILTS if quick else TILTS), *soft[1.2].tilts}))
    wedge = Wedge(restitution=RESTITUTION)
    the_map = curves(laboratory, "figure 6.5, map", {wedge: tilts}, chosen)[wedge]
    moving = _moving(laboratory, tilts, Effort(0.2 * chosen.duration, chosen.seeds))
    rows = [row for curve in (the_map, *moving.values(), *soft.values()) for row in curve.rows()]
    notes = [note, f"map and moving wedge with e_n = {RESTITUTION}; the moving wedge for a fifth of the map's time"]
    title = "Figure 6.5: molecular dynamics and event-driven, scaled"
    return Product(
        title, rows, draw(the_map, moving, soft), statements(the_map, moving, soft), [*notes, *chosen.notes()]
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
        draw_curve(lower, soft[gamma].tilts, _less(soft[gamma], the_map), "", **style)
        draw_curve(lower, moving[gamma].tilts, _less(moving[gamma], the_map), "", **line)
    tilt_axes(upper)
    tilt_axes(lower)
    upper.set_xlabel("")
    lower.set_ylabel("less the map")
    handles, labels = upper.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    return figure


def _less(curve: Curve, other: Curve) -> list[Estimate]:
    """Differences, with both errors."""
    pairs = [(point, other.at(tilt)) for tilt, point in zip(curve.tilts, curve.points, strict=True)]
    return [Estimate(a.mean - b.mean, float(np.hypot(a.error, b.error))) for a, b in pairs]


def statements(the_map: Curve, moving: dict[float, Curve], soft: dict[float, Curve]) -> list[Statement]:
    """MD against both event-driven ways, and MD against itself."""
    peak = max(abs(p.mean) for p in the_map.points)
    found = [
        Statement(
            "Fig. 6.5",
            "MD at all Gamma > 1 scales with A omega_b: one curve",
            (own := _own_collapse(soft))[0],
            own[1],
        )
    ]
    for gamma, curve in soft.items():
        to_map, to_moving = _less(curve, the_map), _less(curve, moving[gamma])
        approximation = _less(moving[gamma], the_map)
        ratio, p_value = _chi(to_map)
        ratio_moving, p_moving = _chi(to_moving)
        ratio_phase, p_phase = _chi(approximation)
        found.append(
            Statement(
                "Fig. 6.5, 6.3.3",
                f"MD and event-driven are indistinguishable within numerical error (Gamma = {gamma:g})",
                f"MD less map: rms {_rms(to_map, peak)}, chi^2 per point {ratio:.2f}, p = {p_value:.2g}; MD less exact "
                f"moving wedge: rms {_rms(to_moving, peak)}, {ratio_moving:.2f}, p = {p_moving:.2g}; moving wedge less "
                f"map: rms {_rms(approximation, peak)}, {ratio_phase:.2f}, p = {p_phase:.2g}",
                Verdict.AGREES if p_value > 0.01 else (Verdict.PARTLY if p_moving > 0.01 else Verdict.DISAGREES),
            )
        )
    crossings = {f"MD, Gamma = {g:g}": zero_crossings(c.tilts, c.points) for g, c in soft.items()}
    crossings["map"] = zero_crossings(the_map.tilts, the_map.points)
    found.append(
        Statement(
            "6.2",
            "the sense of rotation changes with tilt",
            "; ".join(f"{name}: {places(c, 'degrees')}" for name, c in crossings.items()),
            verdict(all(crossings.values())),
        )
    )
    return found


def _own_collapse(soft: dict[float, Curve]) -> tuple[str, Verdict]:
    tilts = next(iter(soft.values())).tilts
    common = [average([curve.points[i] for curve in soft.values()]) for i in range(len(tilts))]
    differences = [p.mean - c.mean for curve in soft.values() for p, c in zip(curve.points, common, strict=True)]
    errors = [p.error for curve in soft.values() for p in curve.points]
    ratio, p_value = chi_square(differences, errors, lost=len(tilts))
    return f"chi^2 per degree of freedom {ratio:.2f}, p = {p_value:.2g}", verdict(p_value > 0.01)


def _chi(points: list[Estimate]) -> tuple[float, float]:
    return chi_square([p.mean for p in points], [p.error for p in points])


def _rms(points: list[Estimate], peak: float) -> str:
    rms = float(np.sqrt(np.mean([p.mean**2 for p in points])))
    return f"{rms:.3f} ({100 * rms / peak:.0f} % of the largest value)"
