"""P Figs 5.2, 5.3 and 5.7: mean angular velocity against the amplitude of a slow torque, for five tilts."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.curves import shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Numbers
from studies.thesis.two_supports.lines import Line
from studies.thesis.two_supports.runs import MARKERS, Torque, limits, notes, slope, slope_text, turnings

TILTS = tuple(share * math.pi for share in (0.0, 0.03, 0.06, 0.09, 0.12))
"""theta_T [rad], as in the captions."""
EXCESS = tuple(np.geomspace(0.1, 12.0, 13))
"""(A_e - A_S2) / (A_S1 - A_S2): unidirectional below 1."""
QUICK_EXCESS = (0.1, 0.3, 0.8, 1.5, 4.0, 10.0)


@dataclass(frozen=True)
class TiltLine(Line):
    """One tilt."""

    tilt: float
    lower: float
    """A_S2 [N m], rigid contacts."""
    upper: float
    """A_S1 [N m]."""
    dense: Numbers
    """Amplitudes of `curve` [N m]."""

    def between(self, low: float, high: float) -> tuple[Numbers, Numbers, Numbers]:
        """A_e - A_S2, simulation and theory where that is between so many widths A_S1 - A_S2."""
        excess = (self.amplitudes - self.lower) / (self.upper - self.lower)
        inside = (excess >= low) & (excess <= high)
        return self.amplitudes[inside] - self.lower, self.velocities[inside], self.theory[inside]


def lines(laboratory: Laboratory, title: str, quick: bool) -> list[TiltLine]:
    """Run all tilts."""
    bounds = {tilt: limits(laboratory, tilt) for tilt in TILTS}
    widest = bounds[TILTS[1]]["A_S1"] - bounds[TILTS[1]]["A_S2"]
    chosen: dict[float, tuple[Torque, ...]] = {}
    for tilt, bound in bounds.items():
        width = bound["A_S1"] - bound["A_S2"] or widest
        above = QUICK_EXCESS if quick else EXCESS
        amplitudes = [0.97 * bound["A_S2"], *(bound["A_S2"] + width * np.asarray(above))]
        chosen[tilt] = tuple(Torque(tilt, float(amplitude)) for amplitude in amplitudes)
    done = turnings(laboratory, title, [torque for torques in chosen.values() for torque in torques])
    found = []
    for tilt, torques in chosen.items():
        lower, upper = bounds[tilt]["A_S2"], bounds[tilt]["A_S1"]
        dense = np.linspace(0.95 * lower, torques[-1].amplitude, 200)
        close = [Torque(tilt, float(amplitude)) for amplitude in dense]
        line = TiltLine.of(laboratory, torques, done, close, tilt=tilt, lower=lower, upper=upper, dense=dense)
        found.append(line)
    return found


def rows(found: Sequence[TiltLine]) -> list[dict[str, Any]]:
    """Data, with both theories."""
    return [row for line in found for row in line.rows(A_S1=line.upper, A_S2=line.lower)]


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


def _deviation(line: TiltLine, theory: Numbers) -> float:
    """Largest deviation from a theory while no contact opens, relative to the largest velocity of the line."""
    lasting = np.array([not found.opened for found in line.found])
    return float(np.max(np.abs(line.velocities - theory)[lasting]) / np.max(np.abs(theory)))


def linear(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 5.2."""
    found = lines(laboratory, "figure 5.2", quick)
    figure = Figure(figsize=(0.8 * WIDTH, 3.8), layout="constrained")
    _plot(figure.subplots(), found, connect=True)
    still = max(abs(v) for v in found[0].velocities)
    onsets = [_onset(line) for line in found[1:]]
    below = max(abs(line.found[0].velocity) for line in found)
    stated = [
        Statement(
            "5.2.2, Fig. 5.2",
            "without tilt the disk never rotates",
            f"largest |omega| {still:.1e} rad/s, of {found[-1].velocities.max():.2f} rad/s at the largest tilt",
            verdict(still < 1e-3 * found[-1].velocities.max()),
        ),
        Statement(
            "5.2.2",
            "sliding begins earlier as the tilt grows, at A_S2 (5.3)",
            "; ".join(
                f"{line.tilt / math.pi:.2f} pi: {onset:.5f}, A_S2 = {line.lower:.5f} N m"
                for line, onset in zip(found[1:], onsets, strict=True)
            )
            + f"; |omega| at 0.97 A_S2 at most {below:.1e} rad/s",
            verdict(
                onsets == sorted(onsets, reverse=True)
                and all(abs(o - line.lower) < 1e-3 * line.lower for o, line in zip(onsets, found[1:], strict=True))
            ),
        ),
        Statement(
            "5.2",
            "for positive tilt the angular velocity is never negative",
            f"smallest: {min(line.velocities.min() for line in found[1:]):.1e} rad/s",
            verdict(min(line.velocities.min() for line in found[1:]) > -1e-6),
        ),
        _lasting(found),
    ]
    return Product("Figure 5.2: angular velocity against torque", rows(found), figure, stated, notes())


def _onset(line: TiltLine) -> float:
    """Amplitude from which on the disk turns: where the root of the unidirectional velocities vanishes [N m]."""
    excess = (line.amplitudes - line.lower) / (line.upper - line.lower)
    inside = (excess > 0.0) & (excess < 0.6)
    # omega ~ (A - A_S)^2 / A_S (1 + ...): a straight line in the root, bent a little.
    root = np.sqrt(line.velocities[inside] * line.amplitudes[inside])
    degree = min(2, int(np.count_nonzero(inside)) - 1)
    return float(np.polyval(np.polyfit(root, line.amplitudes[inside], degree), 0.0))


def _lasting(found: Sequence[TiltLine]) -> Statement:
    runs = [pair for line in found for pair in zip(line.torques, line.found, strict=True)]
    opened = [torque for torque, turned in runs if turned.opened]
    where = "; ".join(f"{t.tilt / math.pi:.2f} pi, {t.amplitude:.3f} N m" for t in opened)
    return Statement(
        "5.2.1",
        "below the detachment tilt no contact opens",
        f"{len(opened)} of {len(runs)} runs with an open contact" + (f": {where}, after a stop" if opened else ""),
        Verdict.PARTLY if opened else Verdict.AGREES,
    )


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
        "(A_e - A_S2) / (A_S1 - A_S2) from 0.08 to 0.9, bidirectional: from 3 on",
    ]
    return Product(
        "Figure 5.3: scaling with the torque", rows(found), figure, _scaling_statements(found), product_notes
    )


def _guides(panel: Axes) -> None:
    """Slopes 2 and 1 of the thesis: 9 u^2 / (2 pi m R^2 omega_e A_0), and twice that without the square."""
    unit = 9.0 / (math.tau * 0.1 * 0.11433)
    low, high = np.array([0.08, 1.0]), np.array([1.0, 12.0])
    panel.loglog(low, unit * low**2, "k--", lw=1.0, label="slope 2")
    panel.loglog(high, 2.0 * unit * high, "k:", lw=1.2, label="slope 1")


def _scaling_statements(found: Sequence[TiltLine]) -> list[Statement]:
    ranges = {"unidirectional": (0.08, 0.9), "bidirectional": (3.0, math.inf)}
    slopes = {
        name: [(slope(x, y), slope(x, t)) for x, y, t in (line.between(*window) for line in found)]
        for name, window in ranges.items()
    }

    def slopes_of(name: str) -> str:
        return "; ".join(
            f"{line.tilt / math.pi:.2f} pi: {slope_text(ours)}, 5.9 {theory[0]:.3f}"
            for line, (ours, theory) in zip(found, slopes[name], strict=True)
        )

    collapsed = []
    for excess in (0.5, 5.0):
        values = []
        for line in found:
            above, simulated, _ = line.between(0.0, math.inf)
            width = line.upper - line.lower
            values.append(
                math.exp(np.interp(math.log(excess), np.log(above / width), np.log(np.maximum(simulated, 1e-12))))
                / width**2
            )
        collapsed.append(max(values) / min(values))
    return [
        Statement(
            "5.2.2, Fig. 5.3",
            "unidirectional sliding: slope 2",
            slopes_of("unidirectional"),
            verdict(all(abs(ours[0] - 2.0) < 0.1 for ours, _ in slopes["unidirectional"])),
        ),
        Statement(
            "5.2.2, Fig. 5.3",
            "bidirectional sliding: slope 1",
            slopes_of("bidirectional")
            + "; 5.9 is 2u - 1 while A_e is close to A_S2, u the excess, and bends down beyond",
            Verdict.AGREES if all(abs(ours[0] - 1.0) < 0.15 for ours, _ in slopes["bidirectional"]) else Verdict.PARTLY,
        ),
        Statement(
            "Fig. 5.3",
            "all curves collapse",
            "largest over smallest of omega / (A_S1 - A_S2)^2 at the excess 0.5 and 5: "
            + ", ".join(f"{ratio:.3f}" for ratio in collapsed),
            Verdict.AGREES if max(collapsed) < 1.2 else Verdict.PARTLY,
        ),
    ]


def closed_form(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 5.7."""
    found = lines(laboratory, "figure 5.7", quick)
    figure = Figure(figsize=(0.8 * WIDTH, 3.8), layout="constrained")
    _plot(figure.subplots(), found, connect=False)
    rigid = {line.tilt: _deviation(line, line.theory) for line in found[1:]}
    soft = {line.tilt: _deviation(line, line.soft) for line in found[1:]}

    def listed(deviations: dict[float, float]) -> str:
        return ", ".join(f"{tilt / math.pi:.2f} pi: {deviation:.1e}" for tilt, deviation in deviations.items())

    stated = [
        Statement(
            "5.2.4, Fig. 5.7",
            "simulations agree very well with 5.9",
            "largest deviation over the largest velocity: " + listed(rigid),
            verdict(max(rigid.values()) < 1e-2),
        ),
        Statement(
            "5.2.4",
            "5.9 is exact",
            "with the overlap of the soft contacts in A_S1 and A_S2 there remain "
            + listed(soft)
            + ", the inertia of the "
            "centre, which goes with omega_e^2 (figure closed-form)",
            Verdict.AGREES if max(soft.values()) < 2e-3 else Verdict.PARTLY,
        ),
        _lasting(found),
    ]
    return Product("Figure 5.7: simulation and closed form", rows(found), figure, stated, notes())
