"""P Fig. 3.11: <omega^2> against Gamma, molecular dynamics beside event-driven dynamics, three stiffnesses."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product
from studies.thesis.packing.compared import Comparison, Key, compare
from studies.thesis.packing.comparison_statements import statements
from studies.thesis.packing.ensemble import EVENT_LENGTH, EVENT_PACKINGS, STIFFNESSES, effort
from studies.thesis.packing.runs import MOLECULAR, MOVING, RANDOM_PHASE, Method

SYMBOLS = {1e4: ("o", "#1f5fa8"), 1e5: ("s", "#d07a1f"), 1e6: ("^", "#2e7d4f")}
LINES: dict[Method, dict[str, Any]] = {
    MOLECULAR: {"linestyle": "-"},
    RANDOM_PHASE: {"linestyle": "--", "mfc": "white"},
    MOVING: {"linestyle": ":", "mfc": "white", "alpha": 0.75},
}


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 3.11."""
    compared = compare(laboratory, quick)
    points = [e.point for e in compared.found.values()]
    return Product(
        "Figure 3.11: mean squared angular velocity, molecular dynamics and event-driven",
        [_row(key, compared) for key in compared.found],
        draw(compared),
        statements(compared),
        [
            "60 disks, 80 Hz, kappa = 0.77, gamma_n = 0.1 kg/s, mu = 0.1; the same packings by every method",
            effort(points),
            "errors by drawing packings, ratios packing by packing over records of the same length",
            *(
                [
                    f"event-driven at k_n = 1e4 N/m at length: {effort([e.point for e in compared.long.values()])} "
                    "(the short ones below Gamma = 5, where P's 1000 s take another 50 minutes of one processor)"
                ]
                if compared.long
                else []
            ),
            "P's ED is the fixed bottom with a random phase; the moving base needs no such assumption",
        ],
    )


def _row(key: Key, compared: Comparison) -> dict[str, Any]:
    method, stiffness, gamma = key
    e = compared.found[key]
    square, lasting, ratio = e.estimate("mean_square"), e.estimate("persistent"), compared.ratio(*key)
    return {
        "method": method.name,
        "normal_stiffness": stiffness,
        "gamma": gamma,
        "mean_square_rpm": square.mean,
        "error": square.error,
        "lasting_rpm": lasting.mean,
        "lasting_error": lasting.error,
        "ratio_to_md": ratio.mean,
        "ratio_error": ratio.error,
        "processor_s_per_s": compared.cost[key],
        "packings": e.point.packings,
    }


def draw(compared: Comparison) -> Figure:
    """Linear and logarithmic, as in the thesis, and the ratio below."""
    figure = Figure(figsize=(WIDTH, 6.4), layout="constrained")
    mosaic = figure.subplot_mosaic([["linear", "log"], ["ratio", "ratio"]], height_ratios=[1.5, 1.0])
    for method in LINES:
        for stiffness in STIFFNESSES:
            _draw_curves(mosaic, compared, method, stiffness)
    if compared.long:
        points = [e.estimate("mean_square") for e in compared.long.values()]
        label = rf"ED, {EVENT_PACKINGS} packings, up to {EVENT_LENGTH} s, $k_n = 10^4$ N/m"
        for name in ("linear", "log"):
            draw_curve(mosaic[name], list(compared.long), points, label, fmt="x-.", color="black")
    for name in ("log", "ratio"):
        ticks = sorted({g for _, _, g in compared.found})
        mosaic[name].set_xscale("log")
        mosaic[name].set_xticks(ticks, [f"{g:g}" for g in ticks])
        mosaic[name].set_yscale("log")
        mosaic[name].minorticks_off()
    low, high = mosaic["ratio"].get_ylim()
    ticks = [t for t in (0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0) if low <= t <= high]
    mosaic["ratio"].set_yticks(ticks, [f"{t:g}" for t in ticks])
    mosaic["ratio"].axhline(1.0, color="0.4", lw=0.8, zorder=0)
    mosaic["ratio"].set_ylabel("event-driven / MD")
    for panel in mosaic.values():
        panel.set_xlabel(r"$\Gamma$")
    for name in ("linear", "log"):
        mosaic[name].set_ylabel(r"$\langle\bar\omega^2\rangle$ [RPM$^2$]")
    mosaic["linear"].set_ylim(0.0, None)
    handles, labels = mosaic["linear"].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    return figure


def _draw_curves(mosaic: dict[str, Axes], compared: Comparison, method: Method, stiffness: float) -> None:
    marker, colour = SYMBOLS[stiffness]
    gammas = compared.gammas(stiffness)
    x = [g * (1.0 + 0.012 * (STIFFNESSES.index(stiffness) - 1)) for g in gammas]
    style = {"marker": marker, "color": colour, "lw": 1.0, **LINES[method]}
    label = rf"{method.name}, $k_n = 10^{{{round(np.log10(stiffness))}}}$ N/m"
    points = [compared.found[method, stiffness, g].estimate("mean_square") for g in gammas]
    for name in ("linear", "log"):
        draw_curve(mosaic[name], x, points, label, **style)
    if method is not MOLECULAR:
        ratios = [compared.ratio(method, stiffness, g) for g in gammas]
        draw_curve(mosaic["ratio"], x, ratios, label, **style)
