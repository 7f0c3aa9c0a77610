"""P Fig. 6.4: nine pairs of Gamma and omega_b fall on one curve when scaled by A omega_b."""

from itertools import product

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.statistics.power_law import weighted_power_law
from jostle_lab.verdicts import near
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Effort, Wedge, curves, effort, tilt_axes
from studies.thesis.wedge.rules import alike, changes_sense, peak, symmetric

GAMMAS = (1.0, 10.0, 100.0)
FREQUENCIES = (1.0, 10.0, 100.0)
"""omega_b [1/s]."""
MARKERS = dict(zip(GAMMAS, "osv", strict=True))
COLOURS = dict(zip(FREQUENCIES, ("#1f5fa8", "#d07a1f", "#2e7d4f"), strict=True))


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run the nine pairs, each with seeds of its own, and test whether they are one curve."""
    chosen = effort(quick, seeds)
    tilts = QUICK_TILTS if quick else TILTS
    found = nine(laboratory, tilts, chosen)
    rows = [row for curve in found for row in curve.rows()]
    notes = [
        "map with a random phase; theta_W = 120 degrees, mu = 0.1, e_n = 0.9, kappa = 0.773, g = 9.81 m/s2",
        "pair number i (from 0) has the seeds 100 i + 1, 100 i + 2, ...: all pairs are independent",
        *chosen.notes(),
    ]
    return Product("Figure 6.4: collapse of nine pairs (Gamma, omega_b)", rows, draw(found), statements(found), notes)


def nine(laboratory: Laboratory, tilts: tuple[float, ...], effort: Effort) -> list[Curve]:
    """The nine curves; pair number i has the seeds from 100 i + 1 on."""
    wedges = [Wedge("map", gamma, frequency) for gamma, frequency in product(GAMMAS, FREQUENCIES)]
    return list(curves(laboratory, "figure 6.4", dict.fromkeys(wedges, tilts), effort, seed_stride=100).values())


def draw(found: list[Curve]) -> Figure:
    """The collapse, and below it what is left after the common mean is taken off."""
    figure = Figure(figsize=(0.85 * WIDTH, 5.0), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[2.4, 1.0])
    common = [average([curve.points[i] for curve in found]) for i in range(len(found[0].tilts))]
    for number, curve in enumerate(found):
        wedge = curve.wedge
        style = {"marker": MARKERS[wedge.gamma], "color": COLOURS[wedge.angular_frequency], "mfc": "none"}
        label = rf"$\Gamma$ = {wedge.gamma:g}, $\omega_b$ = {wedge.angular_frequency:g} s$^{{-1}}$"
        draw_curve(upper, curve.tilts, curve.points, label, **style)
        rest = [Estimate(1e3 * (p.mean - c.mean), 1e3 * p.error) for p, c in zip(curve.points, common, strict=True)]
        shifted = [tilt + 0.05 * (number - 4) for tilt in curve.tilts]
        draw_curve(lower, shifted, rest, label, **{**style, "linestyle": "none", "ms": 3})
    tilt_axes(upper)
    tilt_axes(lower)
    upper.set_xlabel("")
    lower.set_ylabel(r"difference [$10^{-3}$]")
    handles, labels = upper.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    return figure


def average(points: list[Estimate]) -> Estimate:
    """Mean weighted by inverse squared errors."""
    weights = np.array([1.0 / p.error**2 for p in points])
    mean = float(np.sum(weights * [p.mean for p in points]) / weights.sum())
    return Estimate(mean, float(weights.sum()) ** -0.5)


def statements(found: list[Curve]) -> list[Statement]:
    """Collapse, proportionality, sign change, symmetric wedge."""
    tilts = found[0].tilts
    common = Curve(found[0].wedge, tilts, tuple(average([c.points[i] for c in found]) for i in range(len(tilts))), 1.0)
    differences = [
        Estimate(p.mean - c.mean, p.error) for curve in found for p, c in zip(curve.points, common.points, strict=True)
    ]
    text, judgement = alike(differences, peak(found), lost=len(tilts))
    zero = {"mean of nine": Curve(common.wedge, tilts, common.points, 1.0)}
    return [
        Statement.judged(
            "Fig. 6.4",
            "the nine pairs are indistinguishable when scaled by A omega_b",
            text,
            judgement,
        ),
        linear(found),
        changes_sense({"mean of nine": common}),
        symmetric(zero),
    ]


def linear(found: list[Curve]) -> Statement:
    """The angular velocity is proportional to A omega_b: exponent where the rotation is strongest."""
    index = max(range(len(found[0].tilts)), key=lambda i: abs(found[0].points[i].mean))
    speeds = np.array([curve.wedge.base_velocity for curve in found])
    sign = np.sign(found[0].points[index].mean)
    points = [
        Estimate(float(sign * c.points[index].mean * v), c.points[index].error * float(v))
        for c, v in zip(found, speeds, strict=True)
    ]
    exponent = weighted_power_law(speeds, points)
    return Statement.judged(
        "6.3.2",
        "the rotational velocity scales linearly with A omega_b",
        f"exponent {exponent} at a tilt of {found[0].tilts[index]:g} degrees, A omega_b from {speeds.min():.2g} to "
        f"{speeds.max():.3g} m/s",
        near(exponent, 1.0, 0.01),
    )
