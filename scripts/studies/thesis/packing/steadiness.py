"""P Figs 3.7 and 3.8: how straight the angular paths are, against Gamma, and rho^2 disk by disk at four Gamma."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, Numbers, bootstrap_mean
from jostle_lab.verdicts import Judgement, above, below, every, falls, near, rises
from studies.thesis.packing.ensemble import correlations, effort, soft
from studies.thesis.packing.mean_square import STIFFNESS, Points, ensembles
from studies.thesis.packing.scaling import exponent, extremum

SHOWN = (0.3, 4.0, 20.0, 29.0)
"""Gamma of the four histograms."""
STILL, STEADY = 0.05, 0.95
"""rho^2 below which a disk counts with the group near zero, and above which with that near one."""
BINS = 20


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Figure 3.7."""
    found = ensembles(laboratory, quick, "figure 3.7", seeds)
    return Product(
        "Figure 3.7: correlation of angle and time, and adjusted deviation, against Gamma",
        [_row(g, found) for g in found],
        draw(found),
        statements(found),
        [
            "runs of figure 3.6; angles once a second, as P's camera took them",
            f"{effort([e.point for e in found.values()])} (P: 100 packings, 1000 s)",
            "rho^2 and sigma_a of a path depend on how long it is followed: rho^2 of a driftless walk averages 0.43",
        ],
    )


def _row(gamma: float, found: Points) -> dict[str, Any]:
    rho, sigma = found[gamma].estimate("correlation"), found[gamma].estimate("adjusted_deviation")
    return {
        "gamma": gamma,
        "correlation": rho.mean,
        "correlation_error": rho.error,
        "adjusted_deviation": sigma.mean,
        "adjusted_deviation_error": sigma.error,
    }


def draw(found: Points) -> Figure:
    """Both quantities, linear and logarithmic."""
    figure = Figure(figsize=(WIDTH, 3.4), layout="constrained")
    gammas = list(found)
    kinds = (
        ("correlation", "o-", "black", r"$\langle\rho^2\rangle$"),
        ("adjusted_deviation", "s--", "0.5", r"$\langle\sigma_a\rangle$"),
    )
    for panel, scale in zip(figure.subplots(1, 2), ("linear", "log"), strict=True):
        for quantity, style, colour, label in kinds:
            points = [e.estimate(quantity) for e in found.values()]
            draw_curve(panel, gammas, points, label, fmt=style, color=colour, ms=3.5)
        for place in (1.0, 10.0):
            panel.axvline(place, color="0.7", lw=0.7, ls=":")
        panel.set(xscale=scale, yscale=scale, xlabel=r"$\Gamma$")
    panel.set_yticks([0.2, 0.3, 0.5, 1.0], ["0.2", "0.3", "0.5", "1"])
    panel.minorticks_off()
    figure.axes[0].set_ylabel(r"$\langle\rho^2\rangle$, $\langle\sigma_a\rangle$ [1]")
    figure.axes[0].legend()
    return figure


def statements(found: Points) -> list[Statement]:
    """What P 3.2 says of this figure."""
    gammas = list(found)
    rho = {g: e.estimate("correlation") for g, e in found.items()}
    sigma = {g: e.estimate("adjusted_deviation") for g, e in found.items()}
    top = extremum(gammas, [e.correlation for e in found.values()], largest=True)
    bottom = extremum(gammas, [e.adjusted_deviation for e in found.values()], largest=False)
    highest, lowest = max(rho.values(), key=lambda e: e.mean), min(sigma.values(), key=lambda e: e.mean)
    below_one = [g for g in gammas if g <= 1.0]
    beyond = [g for g in gammas if g >= 1.0]
    return [
        Statement.judged(
            "3.2, Fig. 3.7",
            "at small Gamma rho^2 increases and sigma_a decreases",
            f"rho^2 {rho[below_one[0]]} to {rho[1.0]}, sigma_a {sigma[below_one[0]]} to {sigma[1.0]}, from "
            f"{below_one[0]:g} to 1",
            rises([rho[g] for g in below_one]) & falls([sigma[g] for g in below_one]),
            CAUSES["low"],
        ),
        Statement.judged(
            "3.2, Fig. 3.7",
            "rho^2 reaches a maximum of about 1 at Gamma of about 1",
            f"{highest} at {top}",
            every(
                [near(highest, 1.0, 0.05), near(top.estimate, 1.0, 0.3)], "maximum within 0.05 of 1, place within 0.3"
            ),
            CAUSES["top"],
        ),
        Statement.judged(
            "3.2, Fig. 3.7",
            "sigma_a reaches a minimum of about 0.2 at Gamma of about 1",
            f"{lowest} at {bottom}",
            every(
                [near(lowest, 0.2, 0.05), near(bottom.estimate, 1.0, 0.3)],
                "minimum within 0.05 of 0.2, place within 0.3",
            ),
            CAUSES["bottom"],
        ),
        Statement.judged(
            "3.2, Fig. 3.7",
            "for Gamma > 1 rho^2 decreases monotonically and sigma_a increases monotonically",
            f"to {rho[beyond[-1]]} and {sigma[beyond[-1]]} at {beyond[-1]:g}",
            falls([rho[g] for g in beyond]) & rises([sigma[g] for g in beyond]),
            CAUSES["beyond"],
        ),
        _abrupt(found),
    ]


def _abrupt(found: Points) -> Statement:
    middle = [g for g in found if 1.0 <= g <= 10.0]
    last = [g for g in found if g >= 10.0]
    before = exponent(middle, [found[g].correlation for g in middle])
    after = exponent(last, [found[g].correlation for g in last])
    gap = Estimate(before.value - after.value, float(np.hypot(before.error, after.error)))
    return Statement.judged(
        "3.2, Fig. 3.7",
        "rho^2 falls slowly, linearly in log-log, from 1 to 10, and abruptly beyond",
        f"exponents {before} and {after}",
        every([below(before.estimate, 0.0), above(gap, 0.1)], "falling before 10, steeper by 0.1 beyond, for certain"),
        CAUSES["abrupt"],
    )


def histograms(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Figure 3.8."""
    found = ensembles(laboratory, quick, "figure 3.8", seeds)
    points = {g: found[g].point if g in found else soft(STIFFNESS, g) for g in SHOWN if g in found or not quick}
    rho = {p.gamma: values for p, values in correlations(laboratory, points.values(), "figure 3.8").items()}
    rows = [
        {"gamma": g, "packing": i + 1, "disk": j + 1, "correlation": float(v)}
        for g, values in rho.items()
        for (i, j), v in np.ndenumerate(values)
    ]
    return Product(
        "Figure 3.8: rho^2 disk by disk",
        rows,
        draw_histograms(rho),
        histogram_statements(rho),
        [
            f"runs of figure 3.6: {effort(list(points.values()))} (P: 100 packings, 1000 s)",
            f"near zero: rho^2 below {STILL:g}; near one: above {STEADY:g}; errors by drawing packings",
        ],
    )


def draw_histograms(rho: dict[float, Numbers]) -> Figure:
    """Probability densities on one scale, with errors over packings, and that of random walks beside."""
    figure = Figure(figsize=(WIDTH, 4.6), layout="constrained")
    edges = np.linspace(0.0, 1.0, BINS + 1)
    axes = figure.subplots(2, 2, sharex=True, sharey=True)
    for panel, (gamma, values) in zip(axes.flat, rho.items(), strict=False):
        each = np.array([np.histogram(row, edges, density=True)[0] for row in values])
        middle, error = each.mean(axis=0), each.std(axis=0, ddof=1) / np.sqrt(len(each))
        panel.bar(edges[:-1], middle, 1.0 / BINS, align="edge", color="0.75", edgecolor="black", lw=0.5)
        panel.errorbar(edges[:-1] + 0.5 / BINS, middle, yerr=error, fmt="none", color="black", elinewidth=0.7)
        panel.set_title(rf"$\Gamma$ = {gamma:g}")
    for panel in axes[-1]:
        panel.set_xlabel(r"$\rho^2$ of a disk")
    for panel in axes[:, 0]:
        panel.set_ylabel("probability density")
    return figure


def share(values: Numbers, low: float, high: float) -> Estimate:
    """Share of the disks with rho^2 in [low, high), packing by packing."""
    return bootstrap_mean(((values >= low) & (values < high)).mean(axis=1))


def _dense(values: Numbers, low: float, high: float) -> Estimate:
    """Density of the disks in a range."""
    found = share(values, low, high)
    return Estimate(found.mean / (high - low), found.error / (high - low))


def histogram_statements(rho: dict[float, Numbers]) -> list[Statement]:
    """What P 3.2 says of this figure."""
    groups = {g: [_dense(v, *w) for w in ((0.0, STILL), (STILL, STEADY), (STEADY, 1.01))] for g, v in rho.items()}
    stated = []
    printed: Sequence[tuple[float, str, str]] = (
        (0.3, "two groups: not rotating, and rotating steadily", "both"),
        (4.0, "practically all disks have rho^2 near one", "one"),
        (20.0, "a group of disks that do not rotate appears again", "again"),
        (29.0, "no disk rotates: no peak near one, many near zero", "zero"),
    )
    for gamma, text, kind in printed:
        if gamma in rho:
            found = ", ".join(map(str, groups[gamma]))
            words = f"density near zero, between, near one: {found}; above 0.5: {share(rho[gamma], 0.5, 1.01)} of all"
            stated.append(
                Statement.judged(
                    f"3.2, Fig. 3.8, Gamma = {gamma:g}", text, words, _group(kind, rho, gamma), CAUSES[kind]
                )
            )
    return stated


def _more(first: Estimate, second: Estimate) -> Judgement:
    return above(Estimate(first.mean - second.mean, float(np.hypot(first.error, second.error))), 0.0)


def _group(kind: str, rho: dict[float, Numbers], gamma: float) -> Judgement:
    zero, between, one = (_dense(rho[gamma], *w) for w in ((0.0, STILL), (STILL, STEADY), (STEADY, 1.01)))
    if kind == "both":
        return every([_more(zero, between), _more(one, between)], "denser near zero and near one than between")
    if kind == "one":
        return every([above(share(rho[gamma], 0.5, 1.01), 0.9)], "nine disks in ten above 0.5")
    if kind == "again":
        before = _dense(rho[4.0], 0.0, STILL) if 4.0 in rho else Estimate(0.0, 0.0)
        return every(
            [_more(zero, before), _more(zero, between)], "denser near zero than at Gamma = 4, and than between"
        )
    return every([_more(zero, between), _more(zero, one)], "denser near zero than between and than near one")


CAUSES = dict.fromkeys(("low", "top", "bottom", "beyond", "abrupt", "both", "one", "again", "zero"), "")
"""Why ours differs, by statement."""
