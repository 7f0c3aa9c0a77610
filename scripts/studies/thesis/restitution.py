"""P Fig. 4.5: tangential restitution e_t against |u_t / u_n| for several stiffness ratios."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Numbers
from studies.examples import example

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

Curves = dict[float, tuple[Numbers, Numbers]]
"""kappa: |u_t / u_n| and e_t."""


def make(laboratory: Laboratory, _quick: bool, _seeds: int | None = None) -> Product:
    """Everything is exact and takes no time: there is one effort only, and no error bar."""
    table = example(laboratory, "tangential_restitution")
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
    return Product(title, rows, draw(found, sliding), statements(found, sliding, normal, slides_from), notes)


def draw(found: Curves, sliding: tuple[Numbers, Numbers]) -> Figure:
    """Linear as in the thesis, and with a logarithmic abscissa for the small ratios."""
    figure = Figure(figsize=(WIDTH, 3.3), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    for panel in (left, right):
        for kappa, line in LINES.items():
            panel.plot(*found[kappa], label=rf"$\kappa$ = {kappa:g}", **line)
        panel.plot(*sliding, color="0.1", lw=0.8, label="full sliding, (4.75)")
        panel.axhline(0.0, color="0.5", lw=0.6, zorder=0)
        panel.set(xlabel=r"$|u_t/u_n|$", ylim=(-1.05, 1.05))
    left.set(xlim=(0.0, 2.0), ylabel="$e_t$")
    right.set(xscale="log", xlim=(1e-2, 1e2))
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
    return [
        Statement("2, 6.2", "e_n is about 0.9", f"{normal:.5f}", verdict(abs(normal - 0.9) < 0.005)),
        Statement(
            "6.3.4",
            "kappa = 0.01: e_t is close to one for all incoming velocities",
            f"lowest e_t at ratios of 0 to 2: {lowest:.3f}",
            Verdict.AGREES if lowest > 0.9 else Verdict.PARTLY,
        ),
        Statement(
            "Fig. 4.5",
            "for large |u_t/u_n| all curves follow full sliding (4.75)",
            "largest difference from 2 on: "
            + ", ".join(f"kappa = {k:g}: {d:.1e}" for k, d in far.items())
            + "; within 0.01 from the ratios "
            + ", ".join(f"{k:g}: {r:.2f}" for k, r in reached.items()),
            # The softest tangential spring slides from mu / kappa = 10 on only, beyond the range of the printed figure.
            Verdict.AGREES if max(far[k] for k in (0.1, 1.0, 10.0)) < 0.01 else Verdict.PARTLY,
        ),
        Statement(
            "6.3.4",
            "at small |u_t/u_n| e_t oscillates about zero, faster as kappa grows",
            "changes of sign: " + ", ".join(f"kappa = {k:g}: {n}" for k, n in signs.items()),
            verdict(signs[0.01] <= signs[0.1] <= signs[1.0] <= signs[10.0] < signs[BEYOND]),
        ),
        Statement(
            "6.3.4",
            "kappa -> inf: the oscillation averages to zero, e_t = max(0, (4.75))",
            "mean e_t over ln of the ratio from 0.01 to 0.5: "
            + ", ".join(f"kappa = {k:g}: {m:+.3f}" for k, m in inner.items())
            + f"; lowest e_t at kappa = {BEYOND:g}: {least[BEYOND]:.2f}",
            verdict(abs(inner[BEYOND]) < 0.1),
        ),
        Statement(
            "4.79",
            "at small |u_t/u_n|, e_t = cos(omega_t t_c): the last slip can be neglected",
            "; ".join(
                f"kappa = {k:g}: {found[k][1][0]:+.3f}, formula {np.cos(np.sqrt(3.0 * k) * duration):+.3f}"
                for k in LINES
            ),
            verdict(all(abs(found[k][1][0] - np.cos(np.sqrt(3.0 * k) * duration)) < 0.05 for k in LINES)),
        ),
        Statement(
            "4.76-4.78",
            "recipe: full sliding wherever |u_t/u_n| > mu/kappa",
            "(4.75) at that ratio would be "
            + ", ".join(f"{1 - 3 * k * (1 + normal):.1f} for kappa = {k:g}" for k in LINES)
            + ", where e_t is never below -1; sliding to the end is certain only from the ratios "
            + ", ".join(f"{r:.2f}" for r in list(slides_from.values())[: len(LINES)]),
            Verdict.DISAGREES,
        ),
    ]


def _log_mean(ratio: Numbers, restitution: Numbers) -> float:
    """Mean over the logarithm of the ratio where full sliding would give less than zero."""
    inside = (ratio >= 0.01) & (ratio <= 0.5)
    x = np.log(ratio[inside])
    return float(np.trapezoid(restitution[inside], x) / (x[-1] - x[0]))
