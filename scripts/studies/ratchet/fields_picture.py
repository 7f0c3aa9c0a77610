"""F Figs 13 and 14 drawn: arrows of momentum above, disks of mass below, in three windows of the phase."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from jostle_lab.plots.style import WIDTH
from jostle_lab.statistics.estimates import Numbers
from studies.ratchet.cases import Case
from studies.ratchet.fields import BOX, PHASES, TOOTH, MeanFields, lift_of, surface

INK = "#1f3f78"
ARROW = 0.25
"""Length of an arrow [mm] for each disk that moves at 1 cm/s: the same in both figures, as in F."""
SCALE = 10.0
"""Of the arrow in the corner: disks times cm/s."""
MASSES = (0.01, 0.02)
"""Shares of the mass of the disks in the corner."""
SHOWN_TEETH = 3
SHOWN_HEIGHT = 16.0
"""[mm]; F shows a third of its cell, whose height it does not give."""


def draw(case: Case, fields: MeanFields, windows: Sequence[int]) -> Figure:
    """Both rows, with a scale in each."""
    figure = Figure(figsize=(WIDTH, 5.0), layout="constrained")
    axes = figure.subplots(2, len(windows), sharex=True, sharey=True)
    momentum = case.disks * fields.momentum
    heaviest = float(fields.mass[list(windows)].max())
    for column, j in enumerate(windows):
        arrows, disks = axes[0, column], axes[1, column]
        for panel in (arrows, disks):
            _teeth(panel, case, j)
        x, y = np.meshgrid(fields.x, fields.y)
        shown = (y < SHOWN_HEIGHT) & (fields.mass[j] > 0.0)
        for tooth in range(SHOWN_TEETH):
            shifted = x[shown] + tooth * TOOTH
            _arrows(arrows, shifted, y[shown], *(momentum[j, :, :, axis][shown] for axis in (0, 1)))
            disks.add_collection(_circles(shifted, y[shown], _radii(fields.mass[j][shown], heaviest)))
        phases = f"{360 * j // PHASES}° to {360 * (j + 1) // PHASES}°"
        arrows.set_title(f"({'abc'[column]}) j = {j}, phase {phases}", pad=3.0, fontsize=8.0)
        disks.set_xlabel("x [mm]")
    for row, name in enumerate(("momentum in a box", "mass in a box")):
        axes[row, 0].set_ylabel(f"{name}\ny [mm]")
    _arrow_scale(axes[0, -1])
    _mass_scale(axes[1, -1], heaviest)
    return figure


def _arrows(panel: Axes, x: Numbers, y: Numbers, across: Numbers, up: Numbers, zorder: float = 2.0) -> None:
    style: dict[str, Any] = {"scale_units": "xy", "scale": 1.0, "width": 0.004, "headwidth": 3.5, "color": INK}
    panel.quiver(x, y, ARROW * across, ARROW * up, angles="xy", zorder=zorder, **style)


def _radii(mass: Numbers, heaviest: float) -> Numbers:
    """Radii [mm] proportional to mass, as in F, the largest half a box."""
    return np.asarray(0.5 * BOX * mass / heaviest)


def _circles(x: Numbers, y: Numbers, radii: Numbers) -> PatchCollection:
    kept = radii > 0.02 * BOX
    patches = [Circle((a, b), r) for a, b, r in zip(x[kept], y[kept], radii[kept], strict=True)]
    return PatchCollection(patches, facecolors=INK, linewidths=0)


def _arrow_scale(panel: Axes) -> None:
    """An arrow of known length in the corner."""
    x, y = np.array([7.2]), np.array([SHOWN_HEIGHT - 1.2])
    _box(panel, 6.7, y[0] - 0.9, 11.2, 1.8)
    _arrows(panel, x, y, np.array([SCALE]), np.array([0.0]), zorder=5.0)
    panel.text(x[0] + ARROW * SCALE + 0.4, y[0], f"{SCALE:g} disks × cm/s", va="center", fontsize=6.5, zorder=5)


def _mass_scale(panel: Axes, heaviest: float) -> None:
    """Disks of known mass in the corner."""
    y = SHOWN_HEIGHT - 1.2
    _box(panel, 4.2, y - 0.9, 13.7, 1.8)
    for place, mass in zip((5.0, 8.7), MASSES, strict=True):
        radius = float(_radii(np.array([mass]), heaviest)[0])
        panel.add_patch(Circle((place, y), radius, facecolor=INK, lw=0, zorder=5))
        panel.text(place + 0.8, y, f"{100 * mass:g} %", va="center", fontsize=6.5, zorder=5)
    panel.text(11.9, y, "of all mass", va="center", fontsize=6.5, zorder=5)


def _box(panel: Axes, x: float, y: float, width: float, height: float) -> None:
    panel.fill_between([x, x + width], y, y + height, color="white", ec="0.6", lw=0.5, zorder=4)


def _teeth(panel: Axes, case: Case, j: int) -> None:
    x = np.linspace(0.0, SHOWN_TEETH * TOOTH, 1200)
    lift = lift_of(j)
    panel.fill_between(x, surface(case, x, lift), -3.0, color="0.82", lw=0)
    panel.plot(x, surface(case, x, lift), color="0.35", lw=0.7)
    panel.set(xlim=(0.0, SHOWN_TEETH * TOOTH), ylim=(-3.0, SHOWN_HEIGHT), aspect="equal")
