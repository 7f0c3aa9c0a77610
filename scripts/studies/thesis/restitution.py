"""P Fig. 4.5: tangential restitution e_t against |u_t / u_n| for several stiffness ratios."""

import time
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.tables import Table
from jostle_lab.verdicts import every, exact, true
from studies.examples import example
from studies.thesis.impact.equations import Contact, integrate

LINES: dict[float, dict[str, Any]] = {
    0.01: {"linestyle": "-", "lw": 2.2, "color": "#1f5fa8"},
    0.1: {"linestyle": "--", "lw": 1.2, "color": "#7a4fa0"},
    1.0: {"linestyle": ":", "lw": 1.6, "color": "#c0272d"},
    10.0: {"linestyle": "-.", "lw": 1.0, "color": "#2e7d4f"},
}
"""kappa and the lines of the thesis' caption."""
BEYOND = 100.0
"""One stiffness ratio more, for the limit."""
FRICTION = 0.1
THINNED = 3
CHECKED = np.geomspace(0.0101, 20.0, 24)
"""Ratios at which the equations of motion are integrated."""

Curves = dict[float, tuple[Numbers, Numbers]]
"""kappa: |u_t / u_n| and e_t."""


def make(laboratory: Laboratory, _quick: bool, _seeds: int | None = None) -> Product:
    """Everything is exact and takes no time: there is one effort only, and no error bar."""
    table = thinned(laboratory)
    checked = {value: integrated(laboratory, value) for value in LINES}
    kappa = table["stiffness_ratio"]
    found: Curves = {
        value: (table["velocity_ratio"][kappa == value], table["restitution"][kappa == value])
        for value in (*LINES, BEYOND)
    }
    one = kappa == 1.0
    sliding = (table["velocity_ratio"][one], table["full_sliding"][one])
    normal = float(table["normal_restitution"][0])
    slides_from = {value: float(table["slides_from"][kappa == value][0]) for value in found}
    names = list(table)
    rows = [dict(zip(names, map(float, row), strict=True)) for row in zip(*table.values(), strict=True)]
    notes = [
        f"k_n = 4.5e6 N/m, R = 0.02 m, gamma_n = 9.84 kg/s, mu = 0.1, m = 4.5 g, against a wall; e_n = {normal:.5f}",
        "phases of sticking and sliding stitched exactly (collision::Dashpot)",
        "no chance, hence no seeds and no error bars",
    ]
    title = "Figure 4.5: tangential restitution"
    stated = [*statements(found, sliding, normal, slides_from), stitched(found, checked)]
    return Product(title, rows, draw(found, sliding, checked), stated, notes)


def thinned(laboratory: Laboratory) -> Table:
    """The curves by the collision law of the program, every third of their points."""

    def compute() -> tuple[Table, float]:
        begun = time.perf_counter()
        whole = example(replace(laboratory, records=None), "tangential_restitution")
        kappa = whole["stiffness_ratio"]
        chosen = np.concatenate([np.flatnonzero(kappa == value)[::THINNED] for value in (*LINES, BEYOND)])
        return {name: column[chosen] for name, column in whole.items()}, time.perf_counter() - begun

    return laboratory.computed(f"example tangential_restitution, {THINNED}rd points of each curve", compute)


def integrated(laboratory: Laboratory, kappa: float) -> tuple[Numbers, Numbers]:
    """Ratios |u_t / u_n| and e_t from the equations of motion, without the formulas of P 4.5."""

    def compute() -> tuple[Table, float]:
        begun = time.process_time()
        found = [integrate(Contact(ratio=kappa), 1.0, float(r)).restitutions[1] for r in CHECKED]
        return {"ratio": CHECKED, "restitution": np.array(found)}, time.process_time() - begun

    table = laboratory.computed(f"equations of motion, kappa = {kappa:g}", compute)
    return table["ratio"], table["restitution"]


def stitched(found: Curves, checked: Curves) -> Statement:
    """Exact stitching beside the equations of motion."""
    worst = {k: float(np.max(np.abs(np.interp(x, *found[k]) - e))) for k, (x, e) in checked.items()}
    return Statement.judged(
        "4.5.2, Fig. 4.5",
        "e_t by stitching the phases of sticking and sliding",
        f"largest difference from the equations of motion at {len(CHECKED)} ratios from {CHECKED[0]:g} to "
        f"{CHECKED[-1]:g}: " + ", ".join(f"kappa = {k:g}: {w:.0e}" for k, w in worst.items()),
        exact(max(worst.values()), 1e-3, "difference, the curves interpolated between their points,"),
    )


def draw(found: Curves, sliding: tuple[Numbers, Numbers], checked: Curves) -> Figure:
    """Linear as in the thesis, and with a logarithmic abscissa for the small ratios."""
    figure = Figure(figsize=(WIDTH, 3.3), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    for panel in (left, right):
        for kappa, line in LINES.items():
            panel.plot(*found[kappa], label=rf"$\kappa$ = {kappa:g}", **line)
            panel.plot(*checked[kappa], "o", color=line["color"], mfc="white", ms=3.5, mew=0.8)
        panel.plot([], [], "o", color="0.3", mfc="white", ms=3.5, label="equations of motion")
        panel.plot(*sliding, color="0.1", lw=0.8, label="full sliding, (4.75)")
        panel.axhline(0.0, color="0.5", lw=0.6, zorder=0)
        panel.set(xlabel=r"$|u_t/u_n|$", ylim=(-1.05, 1.05))
    left.set(xlim=(0.0, 2.0), ylabel="$e_t$")
    right.set(xscale="log", xlim=(1e-2, 1e2))
    right.set_title("kinks: another slide begins or ends", fontsize=8)
    right.legend(loc="lower right")
    return figure


def statements(
    found: Curves, sliding: tuple[Numbers, Numbers], normal: float, slides_from: dict[float, float]
) -> list[Statement]:
    """What P 4.5.2 and 6.3.4 say of this figure."""
    soft_ratio, soft = found[0.01]
    lowest = float(soft[soft_ratio <= 2.0].min())
    far = {k: float(np.max(np.abs(e - sliding[1])[x >= 2.0])) for k, (x, e) in found.items()}
    reached = {
        k: float(x[np.flatnonzero(np.abs(e - sliding[1]) > 0.01)[-1]]) if np.any(np.abs(e - sliding[1]) > 0.01) else 0.0
        for k, (x, e) in found.items()
    }
    signs = {k: int(np.count_nonzero(np.diff(np.sign(e[x >= 1e-3])))) for k, (x, e) in found.items()}
    least = {k: float(e.min()) for k, (_, e) in found.items()}
    inner = {k: _log_mean(*found[k]) for k in found}
    damping_ratio = 9.84 / (2.0 * np.sqrt(4.5e6 * 4.5e-3))
    duration = -np.log(normal) / damping_ratio  # omega_n t_c, since e_n = exp(-c omega_n t_c)
    spring = {k: abs(found[k][1][0] - np.cos(np.sqrt(3.0 * k) * duration)) for k in LINES}
    counts = list(signs.values())
    recipe = {k: 1 - 3 * k * (1 + normal) for k in LINES}
    return [
        Statement.judged(
            "2, 6.2", "e_n is about 0.9", f"{normal:.5f}", exact(normal - 0.9, 0.005, "difference from one digit")
        ),
        Statement.judged(
            "6.3.4",
            "kappa = 0.01: e_t is close to one for all incoming velocities",
            f"lowest e_t at ratios of 0 to 2: {lowest:.3f}",
            exact(1.0 - lowest, 0.1, "1 less the lowest e_t"),
            "e_t = cos(omega_t t_c) at small ratios, and omega_t t_c = 0.54 is not small: 0.1 is lost where "
            "the thick line "
            "of the printed figure starts",
        ),
        _far(far, reached),
        Statement.judged(
            "6.3.4, Fig. 4.5",
            "at small |u_t/u_n| e_t oscillates about zero, faster as kappa grows",
            "changes of sign: " + ", ".join(f"kappa = {k:g}: {n}" for k, n in signs.items()),
            true(counts == sorted(counts) and counts[-1] > counts[0], "their number never falls, and grows in all"),
        ),
        Statement.judged(
            "6.3.4",
            "kappa -> inf: the oscillation averages to zero, e_t = max(0, (4.75))",
            "mean e_t over ln of the ratio from 0.01 to 0.5: "
            + ", ".join(f"kappa = {k:g}: {m:+.3f}" for k, m in inner.items())
            + f"; lowest e_t at kappa = {BEYOND:g}: {least[BEYOND]:.2f}",
            exact(inner[BEYOND], 0.1, f"mean at kappa = {BEYOND:g}"),
        ),
        Statement.judged(
            "4.79",
            "at small |u_t/u_n|, e_t = cos(omega_t t_c): the last slip can be neglected",
            "; ".join(
                f"kappa = {k:g}: {found[k][1][0]:+.3f}, formula {np.cos(np.sqrt(3.0 * k) * duration):+.3f}"
                for k in LINES
            ),
            every([exact(float(rest), 0.05) for rest in spring.values()], "at each kappa within 0.05; no chance"),
        ),
        Statement.judged(
            "4.76-4.79",
            "recipe: full sliding (4.75) wherever |u_t/u_n| > mu/kappa",
            "(4.75) at that ratio would be "
            + ", ".join(f"{e:.1f} for kappa = {k:g}" for k, e in recipe.items())
            + ", where e_t is never below -1; sliding to the end is certain only from the ratios "
            + ", ".join(f"{r:.2f}" for r in list(slides_from.values())[: len(LINES)]),
            true(min(recipe.values()) >= -1.0, "no e_t below -1, which would create energy; no chance"),
            "4.76 only says that the impact starts sliding, and for gamma_n = 0 only: for kappa > 1/3 it sticks later",
        ),
    ]


def _far(far: dict[float, float], reached: dict[float, float]) -> Statement:
    return Statement.judged(
        "4.5.2, Fig. 4.5",
        "for large |u_t/u_n| all curves are well approximated by full sliding (4.75)",
        "largest difference from 2 on: "
        + ", ".join(f"kappa = {k:g}: {d:.1e}" for k, d in far.items())
        + "; within 0.01 from the ratios "
        + ", ".join(f"{k:g}: {r:.2f}" for k, r in reached.items()),
        every([exact(far[k], 0.01) for k in LINES], "each kappa of the figure within 0.01 from a ratio of 2 on"),
        "the softest spring slides only from mu / kappa = 10 on, beyond the range that is printed",
    )


def _log_mean(ratio: Numbers, restitution: Numbers) -> float:
    """Mean over the logarithm of the ratio where full sliding would give less than zero."""
    inside = (ratio >= 0.01) & (ratio <= 0.5)
    x = np.log(ratio[inside])
    return float(np.trapezoid(restitution[inside], x) / (x[-1] - x[0]))
