"""Picture of an onset: velocity against Gamma with the fit and the printed law, and the same log-log."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, velocity_axes
from studies.ratchet.onset import Onset
from studies.ratchet.study import Curve

OURS, FIT, PRINTED = "#1f5fa8", "#c0272d", "0.25"


def draw_onset(
    figure: Figure, curve: Curve, onset: Onset, largest: float, printed: tuple[float, float], label: str
) -> None:
    """Two panels. `printed`: threshold and exponent of F, whose factor is that of a curve through ours at `largest`."""
    whole, log = figure.subplots(1, 2)
    velocity_axes(whole, r"$\Gamma$")
    style = {"marker": "o", "ms": 3, "color": OURS, "linestyle": "none"}
    draw_curve(whole, curve.x, curve.estimates, label, **style)
    x = np.linspace(min(curve.x), largest, 600)
    threshold, exponent = onset.threshold.value, onset.exponent.value
    fitted = rf"our fit: $\Gamma_c$ = {threshold:.2f}, exponent {exponent:.2f}"
    whole.plot(x, onset.velocity(x), color=FIT, lw=1.1, label=fitted)
    theirs, power = printed
    factor = float(onset.velocity(np.array([largest]))[0]) / (largest / theirs - 1.0) ** power
    law = rf"F: $\Gamma_c$ = {theirs:g}, exponent {power:g}; factor ours"
    whole.plot(x, factor * np.maximum(x / theirs - 1.0, 0.0) ** power, color=PRINTED, lw=1.0, ls="--", label=law)
    whole.legend(loc="lower right", fontsize=7.0)
    above = [(g / threshold - 1.0, e) for g, e in zip(curve.x, curve.estimates, strict=True)]
    above = [(d, e) for d, e in above if d > 0.005 and e.mean > 0.0]
    draw_curve(log, [d for d, _ in above], [e for _, e in above], "", **style)
    d = np.geomspace(0.01, largest / threshold - 1.0, 50)
    log.plot(d, onset.scale * d**exponent, color=FIT, lw=1.1)
    log.plot(d, factor * d**power, color=PRINTED, lw=1.0, ls="--")
    log.set(
        xscale="log", yscale="log", xlabel=r"$(\Gamma - \Gamma_c)/\Gamma_c$", ylabel=r"$\langle v_x \rangle$ [cm/s]"
    )
    _plain_ticks(log, [e.mean for _, e in above])


def _plain_ticks(log: Axes, velocities: Sequence[float]) -> None:
    """Velocities as numbers, not as powers."""
    low, high = 0.6 * min(velocities), 1.3 * max(velocities)
    ticks = [t for t in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0) if low < t < high]
    log.set_ylim(low, high)
    log.set_yticks(ticks, [f"{t:g}" for t in ticks])
    log.minorticks_off()
