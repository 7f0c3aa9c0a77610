"""P Figs 5.2, 5.3 and 5.7: mean angular velocity against the amplitude of a slow torque, for five tilts."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.curves import shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product
from studies.thesis.two_supports import amplitude_statements as stated
from studies.thesis.two_supports.runs import MARKERS, notes
from studies.thesis.two_supports.tilt_lines import TiltLine, lines, rows


def _plot(panel: Axes, found: Sequence[TiltLine], connect: bool) -> None:
    """Points of the simulation, joined or with the curve of 5.9."""
    for line, marker, colour in zip(found, MARKERS, shades(len(found)), strict=True):
        label = rf"$\theta_T$ = {line.tilt / math.pi:.2f} $\pi$"
        style = "-" if connect else ""
        panel.plot(
            line.amplitudes, line.velocities, marker + style, color=colour, mfc="white", ms=4.5, lw=0.8, label=label
        )
        if not connect:
            panel.plot(line.dense, line.curve, color=colour, lw=0.9)
    panel.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    panel.set(xlabel="$A_e$ [N m]", ylabel=r"$\bar\omega$ [rad/s]")
    panel.legend()


def linear(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 5.2."""
    found = lines(laboratory, "figure 5.2", quick)
    figure = Figure(figsize=(0.85 * WIDTH, 3.8), layout="constrained")
    _plot(figure.subplots(), found, connect=True)
    statements = [
        stated.never_upright(found),
        stated.begins_at_limit(found),
        stated.never_negative(found),
        stated.grows(found),
        stated.longer_at_easier(found),
        stated.lasting(found),
    ]
    return Product("Figure 5.2: angular velocity against torque", rows(found), figure, statements, notes())


def logarithmic(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 5.3."""
    found = lines(laboratory, "figure 5.3", quick)[1:]
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    plain, scaled = figure.subplots(1, 2)
    for line, marker, colour in zip(found, MARKERS[1:], shades(len(found)), strict=True):
        above, simulated, _ = line.between(0.0, math.inf)
        width = line.upper - line.lower
        at, theory = line.dense, line.curve
        label = rf"$\theta_T$ = {line.tilt / math.pi:.2f} $\pi$"
        plain.loglog(above, simulated, marker, color=colour, mfc="white", ms=4.5, label=label)
        scaled.loglog(above / width, simulated / width**2, marker, color=colour, mfc="white", ms=4.5)
        over = at > line.lower
        plain.loglog(at[over] - line.lower, theory[over], color=colour, lw=0.8)
        scaled.loglog((at[over] - line.lower) / width, theory[over] / width**2, color=colour, lw=0.8)
    _guides(scaled)
    plain.set(xlabel=r"$A_e - A_{S2}$ [N m]", ylabel=r"$\bar\omega$ [rad/s]", ylim=(1e-6, 1.0))
    scaled.set(
        xlabel=r"$(A_e - A_{S2})/(A_{S1} - A_{S2})$", ylabel=r"$\bar\omega/(A_{S1} - A_{S2})^2$", ylim=(0.5, 1e4)
    )
    plain.legend()
    scaled.legend(loc="lower right")
    product_notes = [
        *notes(),
        "slopes by least squares in log-log, errors from the scatter about the line; unidirectional: excess "
        "(A_e - A_S2) / (A_S1 - A_S2) from 0.08 to 0.9, bidirectional: from 3 on; lines: 5.9",
    ]
    return Product("Figure 5.3: scaling with the torque", rows(found), figure, stated.scaling(found), product_notes)


def _guides(panel: Axes) -> None:
    """Slopes 2 and 1 of the thesis: 9 u^2 / (2 pi m R^2 omega_e A_0), and twice that without the square."""
    unit = 9.0 / (math.tau * 0.1 * 0.11433)
    low, high = np.array([0.08, 1.0]), np.array([1.0, 12.0])
    panel.loglog(low, unit * low**2, "k--", lw=1.0, label="slope 2")
    panel.loglog(high, 2.0 * unit * high, "k:", lw=1.2, label="slope 1")


def closed_form(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 5.7."""
    found = lines(laboratory, "figure 5.7", quick)
    figure = Figure(figsize=(0.85 * WIDTH, 3.8), layout="constrained")
    _plot(figure.subplots(), found, connect=False)
    statements = [*stated.closed_form(found), stated.lasting(found)]
    return Product("Figure 5.7: simulation and closed form", rows(found), figure, statements, notes())
