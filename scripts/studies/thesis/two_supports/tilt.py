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
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.statistics.power_law import power_law
from jostle_lab.verdicts import every, exact, true
from studies.thesis.two_supports.lines import Line
from studies.thesis.two_supports.runs import MARKERS, SCENE, Torque, limits, notes, turnings

AMPLITUDES = (0.100, 0.105, 0.110, 0.113, 0.115)
"""A_e [N m], as in the captions."""
TILTS = tuple(0.134 * math.pi * float(share) for share in (0.0, 0.03, 0.07, *np.linspace(0.12, 1.0, 18)))
"""theta_T [rad]; the last one is half a per cent below detachment."""
QUICK_TILTS = tuple(0.134 * math.pi * float(share) for share in np.linspace(0.0, 1.0, 8))
ALMOST = 0.2
"""What `almost` quadratic may be off."""
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
    figure = Figure(figsize=(0.85 * WIDTH, 3.8), layout="constrained")
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
    return Product(
        "Figure 5.4: angular velocity against tilt", rows(found), figure, _linear_statements(laboratory, found), notes()
    )


def _linear_statements(laboratory: Laboratory, found: Sequence[AmplitudeLine]) -> list[Statement]:
    last = found[4]
    regimes = {turning.regime for turning in last.found}
    both = [t.tilt / math.pi for t, turned in zip(found[3].torques, found[3].found, strict=True) if turned.regime == 2]
    expected = next(
        (float(t) / math.pi for t in found[3].dense if limits(laboratory, float(t))["A_S1"] < found[3].amplitude),
        math.nan,
    )
    largest = max(float(line.velocities.max()) for line in found)
    rigid = max(float(np.max(np.abs(line.velocities - line.theory))) for line in found) / largest
    soft = max(float(np.max(np.abs(line.velocities - line.soft))) for line in found) / largest
    return [
        *_still(laboratory, found[0]),
        _unidirectional(found[1:4]),
        Statement.judged(
            "5.2.1, 5.2.3",
            "A_e = 0.113 > A_S1 slides both ways at large tilts",
            f"bidirectional from {min(both, default=math.nan):.3f} pi on, A_S1 < A_e from {expected:.3f} pi on",
            true(
                bool(both) and abs(min(both) - expected) < 0.01, "some run, and the first within 0.01 pi of A_S1 = A_e"
            ),
        ),
        Statement.judged(
            "5.2.2",
            "A_e = 0.115: bidirectional for all tilts",
            f"{sum(turning.regime == 2 for turning in last.found)} of {len(last.found)} runs",
            true(regimes == {2}, "every run; no chance"),
        ),
        Statement.judged(
            "5.2.4",
            "5.9 holds here too",
            f"largest deviation {rigid:.1e} of the largest velocity, {soft:.1e} with the overlap of the contacts",
            exact(rigid, 1e-2, "deviation over the largest velocity, the width of a line in print,"),
        ),
    ]


def _still(laboratory: Laboratory, line: AmplitudeLine) -> list[Statement]:
    """The amplitude that is printed to lie below all A_S2."""
    most = limits(laboratory, 0.0)["detachment_tilt"]
    least = limits(laboratory, most - 1e-9)["A_S2"]
    turning = np.abs(line.velocities) > LOWEST
    quiet = line.tilts[~turning]
    cause = "the same slip: theta_S2 of A_e = 0.100 is below theta_T^D, too little rotation to be seen in print"
    return [
        Statement.judged(
            "5.2.2",
            "0.100 < A_S2(theta_T^D)",
            f"A_S2 = {least:.5f} N m at theta_T^D = {most / math.pi:.4f} pi",
            true(line.amplitude < least, "as printed; no chance"),
            "5.3 with the parameters of 5.1 falls below 0.100 just before theta_T^D",
        ),
        Statement.judged(
            "5.2.2",
            "A_e = 0.100: the disk never rotates",
            f"not at the {len(quiet)} tilts up to {float(quiet.max()) / math.pi:.4f} pi; theta_S2 = "
            f"{line.onset / math.pi:.4f} pi, beyond it {float(np.max(np.abs(line.velocities))):.1e} rad/s",
            every(
                [true(not turns, "") for turns in turning], f"|omega| below {LOWEST:g} rad/s in every run; no chance"
            ),
            cause,
        ),
    ]


def _unidirectional(middle: Sequence[AmplitudeLine]) -> Statement:
    text, holds = [], []
    for line in middle:
        below = np.abs(line.velocities[line.tilts < line.onset - 1e-3])
        beyond = line.scaling(2e-3)[1]
        first = [
            t.regime for t, tilt in zip(line.found, line.tilts, strict=True) if line.onset < tilt < line.onset + 0.03
        ]
        holds.append(float(np.max(below, initial=0.0)) < LOWEST < float(np.min(beyond)) and set(first) == {1})
        text.append(
            f"{line.amplitude:.3f}: theta_S2 = {line.onset / math.pi:.4f} pi, |omega| at most "
            f"{float(np.max(below, initial=0.0)):.1e} rad/s below, at least {float(np.min(beyond)):.1e} rad/s beyond"
        )
    return Statement.judged(
        "5.2.2",
        "A_e = 0.105, 0.110, 0.113: unidirectional sliding from theta_S2 on, the root of A_e = A_S2",
        "; ".join(text),
        true(all(holds), f"|omega| below {LOWEST:g} rad/s before and above beyond, sliding one way just beyond"),
    )


def logarithmic(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 5.5."""
    found = lines(laboratory, "figure 5.5", quick)[1:]
    figure = Figure(figsize=(0.85 * WIDTH, 4.0), layout="constrained")
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
    page = [*notes(), "slopes: theta_T - theta_S2 up to 0.08 rad, and from 0.2 rad on; lines: 5.9"]
    return Product("Figure 5.5: scaling with the tilt", rows(found), figure, _scaling_statements(found), page)


def _scaling_statements(found: Sequence[AmplitudeLine]) -> list[Statement]:
    near, far = (0.0, 0.08), (0.2, math.inf)
    close = {line.amplitude: _slopes(line, *near) for line in found}
    wide = {line.amplitude: _slopes(line, *far) for line in found}
    always = found[-1].amplitude
    return [
        Statement.judged(
            "5.2.2, Fig. 5.5",
            "unidirectional: almost quadratic in theta_T - theta_S2",
            "; ".join(f"{a:.3f}: {_both(close[a])}" for a in AMPLITUDES[1:4]),
            every(
                [exact(close[a][0].mean - 2.0, ALMOST, "slope less 2") for a in AMPLITUDES[1:4]],
                f"each slope within {ALMOST:g} of 2 (almost); no chance",
            ),
        ),
        Statement.judged(
            "5.2.2, Fig. 5.5",
            "A_e = 0.115: quadratic for large tilts only",
            f"slope {_both(close[always])} up to 0.08 rad, {_both(wide[always])} from 0.2 rad on",
            every(
                [
                    true(abs(close[always][0].mean - 2.0) > ALMOST, ""),
                    exact(wide[always][0].mean - 2.0, ALMOST, "slope less 2"),
                ],
                f"slope within {ALMOST:g} of 2 at large tilts, not at small ones; no chance",
            ),
            "omega goes as sin theta_T (A_e - A_0 cos theta_T), as 5.9 too: first as theta, then as theta^3; quadratic "
            "only in between",
        ),
    ]


Slopes = tuple[Estimate, Estimate]


def _slopes(line: AmplitudeLine, low: float, high: float) -> Slopes:
    """Of the simulation and of the theory at the same points."""
    beyond, simulated, theory = line.scaling(low, high)
    return power_law(beyond, simulated), power_law(beyond, theory)


def _both(slopes: Slopes) -> str:
    return f"{slopes[0]} (5.9: {slopes[1].mean:.3f})"
