"""P Figs 5.4 and 5.5: mean angular velocity against tilt, for five amplitudes of a slow torque."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Numbers
from studies.thesis.two_supports.lines import Line
from studies.thesis.two_supports.runs import MARKERS, SCENE, Torque, limits, notes, slope, slope_text, turnings

AMPLITUDES = (0.100, 0.105, 0.110, 0.113, 0.115)
"""A_e [N m], as in the captions."""
TILTS = tuple(0.134 * math.pi * float(share) for share in (0.0, 0.03, 0.07, *np.linspace(0.12, 1.0, 18)))
"""theta_T [rad]; the last one is half a per cent below detachment."""
QUICK_TILTS = tuple(0.134 * math.pi * float(share) for share in np.linspace(0.0, 1.0, 8))
LOWEST = 1e-9
"""Angular velocities below count as none [rad/s]."""


@dataclass(frozen=True)
class AmplitudeLine(Line):
    """One amplitude."""

    amplitude: float
    onset: float
    """theta_S2 [rad], zero if the disk slides without tilt."""
    dense: Numbers
    """Tilts of `curve` [rad]."""

    def scaling(self, low: float = 0.0, high: float = math.inf) -> tuple[Numbers, Numbers, Numbers]:
        """theta_T - theta_S2, simulation and theory where the disk turns and that is between these [rad]."""
        beyond = self.tilts - self.onset
        inside = (beyond > max(low, 1e-6)) & (beyond <= high) & (self.velocities > LOWEST) & (self.theory > LOWEST)
        return beyond[inside], self.velocities[inside], self.theory[inside]


def lines(laboratory: Laboratory, title: str, quick: bool) -> list[AmplitudeLine]:
    """Run all amplitudes."""
    regimes = laboratory.theory(SCENE, "regime", torque__amplitude=AMPLITUDES)
    onsets = dict(zip(AMPLITUDES, regimes["critical_tilt"].tolist(), strict=True))
    chosen = {}
    for amplitude, onset in onsets.items():
        tilts = QUICK_TILTS if quick else TILTS
        # Some close to the onset, where the scaling shows.
        near = [] if amplitude == AMPLITUDES[0] else [onset + step for step in (0.004, 0.01, 0.02, 0.035)]
        tilts = tuple(sorted({*tilts, *(float(tilt) for tilt in near if tilt < TILTS[-1])}))
        chosen[amplitude] = tuple(Torque(tilt, amplitude) for tilt in tilts)
    done = turnings(laboratory, title, [torque for torques in chosen.values() for torque in torques])
    dense = [float(tilt) for tilt in np.linspace(1e-4, limits(laboratory, 0.0)["detachment_tilt"] - 1e-9, 300)]
    return [
        AmplitudeLine.of(
            laboratory,
            torques,
            done,
            [Torque(tilt, amplitude) for tilt in dense],
            amplitude=amplitude,
            onset=onsets[amplitude],
            dense=np.array(dense),
        )
        for amplitude, torques in chosen.items()
    ]


def rows(found: Sequence[AmplitudeLine]) -> list[dict[str, Any]]:
    """Data, with both theories."""
    return [row for line in found for row in line.rows(theta_S2=line.onset)]


def linear(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 5.4."""
    found = lines(laboratory, "figure 5.4", quick)
    figure = Figure(figsize=(0.8 * WIDTH, 3.8), layout="constrained")
    panel = figure.subplots()
    for line, marker, colour in zip(found, MARKERS, shades(len(found)), strict=True):
        panel.plot(
            line.tilts / math.pi,
            line.velocities,
            marker,
            color=colour,
            mfc="white",
            ms=4.5,
            label=f"$A_e$ = {line.amplitude}",
        )
        panel.plot(line.dense / math.pi, line.curve, color=colour, lw=0.8)
    panel.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    panel.set(xlabel=r"$\theta_T$ [$\pi$]", ylabel=r"$\bar\omega$ [rad/s]")
    panel.legend()
    return Product("Figure 5.4: angular velocity against tilt", rows(found), figure, _linear_statements(found), notes())


def _linear_statements(found: Sequence[AmplitudeLine]) -> list[Statement]:
    first, middle, last = found[0], found[1:4], found[4]
    turned = float(np.max(np.abs(first.velocities)))
    at_rest = {
        line.amplitude: float(np.max(np.abs(line.velocities[line.tilts < line.onset - 1e-3]), initial=0.0))
        for line in middle
    }
    beyond = {line.amplitude: float(np.min(line.scaling(2e-3)[1])) for line in middle}
    regimes = {turning.regime for torque, turning in zip(last.torques, last.found, strict=True)}
    both = [
        torque.tilt / math.pi
        for torque, turning in zip(found[3].torques, found[3].found, strict=True)
        if turning.regime == 2
    ]
    largest = max(float(line.velocities.max()) for line in found)
    deviation = max(float(np.max(np.abs(line.velocities - line.theory))) for line in found) / largest
    soft = max(float(np.max(np.abs(line.velocities - line.soft))) for line in found) / largest
    return [
        Statement(
            "5.2.2",
            "A_e = 0.100 < A_S2(theta_D): the disk never rotates",
            f"largest |omega| {turned:.1e} rad/s; but A_S2 falls to 0.0995 N m at theta_D = 0.1349 pi, and from "
            f"theta_S2 = {first.onset / math.pi:.4f} pi on the disk turns, too little to be seen in print",
            Verdict.PARTLY if turned > LOWEST else Verdict.AGREES,
        ),
        Statement(
            "5.2.2",
            "A_e = 0.105, 0.110, 0.113: unidirectional sliding from theta_S2 on",
            "; ".join(
                f"{a:.3f}: theta_S2 = {line.onset / math.pi:.4f} pi, |omega| at most {at_rest[a]:.1e} rad/s below, at "
                f"least {beyond[a]:.1e} rad/s beyond"
                for a, line in ((line.amplitude, line) for line in middle)
            ),
            verdict(max(at_rest.values()) < LOWEST < min(beyond.values())),
        ),
        Statement(
            "5.2.1, 5.2.3",
            "A_e = 0.113 slides both ways at large tilts",
            f"in our runs from {min(both):.3f} pi on" if both else "not in our runs",
            verdict(bool(both)),
        ),
        Statement(
            "5.2.2",
            "A_e = 0.115: bidirectional for all tilts",
            f"regimes observed: {sorted(regimes)} (2 is bidirectional)",
            verdict(regimes == {2}),
        ),
        Statement(
            "5.2.4",
            "5.9 holds here too",
            f"largest deviation {deviation:.1e} of the largest velocity, {soft:.1e} with the overlap of the contacts",
            verdict(deviation < 1e-2),
        ),
    ]


def logarithmic(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 5.5."""
    found = lines(laboratory, "figure 5.5", quick)[1:]
    figure = Figure(figsize=(0.8 * WIDTH, 4.0), layout="constrained")
    panel = figure.subplots()
    for line, marker, colour in zip(found, MARKERS[1:], shades(len(found)), strict=True):
        beyond, simulated, _ = line.scaling()
        panel.loglog(beyond, simulated, marker, color=colour, mfc="white", ms=4.5, label=f"$A_e$ = {line.amplitude}")
        at = line.dense > line.onset + 1e-3
        panel.loglog(line.dense[at] - line.onset, line.curve[at], color=colour, lw=0.8)
    guide = np.array([3e-3, 0.4])
    panel.loglog(guide, 1.2 * guide**2, "k--", lw=1.0, label="slope 2")
    panel.set(xlabel=r"$\theta_T - \theta_{S2}$ [rad]", ylabel=r"$\bar\omega$ [rad/s]", ylim=(1e-7, 0.2))
    panel.legend()
    near, far = (0.0, 0.08), (0.2, math.inf)
    close = {line.amplitude: _slopes(line, *near) for line in found}
    wide = {line.amplitude: _slopes(line, *far) for line in found}
    stated = [
        Statement(
            "5.2.2, Fig. 5.5",
            "unidirectional: almost quadratic in theta_T - theta_S2",
            "; ".join(f"{a:.3f}: {_both(close[a])}" for a in AMPLITUDES[1:4]),
            verdict(all(abs(close[a][0][0] - 2.0) < 0.25 for a in AMPLITUDES[1:4])),
        ),
        Statement(
            "5.2.2, Fig. 5.5",
            "A_e = 0.115: quadratic for large tilts only",
            f"slope {_both(close[0.115])} at small tilts, {_both(wide[0.115])} from 0.2 rad on; omega goes as "
            "sin theta_T (A_e - A_0 cos theta_T): first as theta, then as theta^3, quadratic in between",
            Verdict.PARTLY if wide[0.115][0][0] > 2.2 else Verdict.AGREES,
        ),
    ]
    page = [*notes(), "slopes: theta_T - theta_S2 up to 0.08 rad, and from 0.2 rad on"]
    return Product("Figure 5.5: scaling with the tilt", rows(found), figure, stated, page)


Slopes = tuple[tuple[float, float], tuple[float, float]]


def _slopes(line: AmplitudeLine, low: float, high: float) -> Slopes:
    """Of the simulation and of the theory at the same points."""
    beyond, simulated, theory = line.scaling(low, high)
    if len(beyond) < 2:
        return (math.nan, math.nan), (math.nan, math.nan)
    return slope(beyond, simulated), slope(beyond, theory)


def _both(slopes: Slopes) -> str:
    return f"{slope_text(slopes[0])} (5.9: {slopes[1][0]:.3f})"
