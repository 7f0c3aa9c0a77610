"""Curves with error bars, and axes that several pictures have."""

from collections.abc import Sequence
from typing import Any

from matplotlib import colormaps
from matplotlib.axes import Axes

from jostle_lab.statistics.estimates import Estimate


def draw_curve(panel: Axes, x: Sequence[float], points: Sequence[Estimate], label: str, **style: Any) -> None:
    """A curve with error bars."""
    line = {"ms": 4, "lw": 0.9, "elinewidth": 0.7, "capsize": 1.5, "mew": 0.8, **style}
    panel.errorbar(x, [p.mean for p in points], yerr=[p.error for p in points], label=label, **line)


def shades(count: int) -> list[Any]:
    """Colours from dark to light for an ordered family of curves; they differ in grey as well."""
    return [colormaps["viridis"](0.88 * i / max(count - 1, 1)) for i in range(count)]


def velocity_axes(panel: Axes, label: str) -> None:
    """Labels, and the line of no transport."""
    panel.axhline(0.0, color="0.5", lw=0.6, zorder=0)
    panel.set_xlabel(label)
    panel.set_ylabel(r"$\langle v_x \rangle$ [cm/s]")
