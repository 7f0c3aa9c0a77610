"""P 5.9 against simulation on a grid of amplitudes and tilts: how far off it is, and why.

Two things are not in 5.9, and `jostle theory` knows both. The disk sinks into its supports by n / k_n, which turns the
lines of centres and so shifts A_S1 and A_S2. And its centre moves when a slide begins and must be stopped, which turns
the disk on: a relative m omega_e^2 / (k_n (A_e / A_S - 1)). Loading the tangential spring does the same with k_t.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.power_law import power_law
from jostle_lab.verdicts import every, exact, true
from studies.thesis.two_supports.runs import (
    NORMAL_STIFFNESS,
    Torque,
    Turning,
    limits,
    turnings,
    velocity,
)

TILTS = tuple(share * math.pi for share in (0.02, 0.05, 0.08, 0.11))
SHARES = (0.25, 1.0, 3.0, 10.0)
"""Amplitudes: A_S2 and so many widths A_S1 - A_S2 above it; and one at RANGE of the range of 5.9."""
RANGE = 0.9
SLOWNESS = (4.0, 2.0, 1.0, 0.5, 0.25)
"""omega_e [rad/s] of the scaling."""
QUICK_SLOWNESS = (4.0, 2.0)
STIFFNESSES = (1e3, 1e4, 1e5)
"""k_n [N/m] of the scaling; the damping stays."""
QUICK_STIFFNESSES = (1e3, 1e4)
GRID_SLOWNESS, QUICK_GRID_SLOWNESS = 0.25, 2.0
PROBE = (TILTS[2], 3.0)
"""Tilt and share of the scaling."""


@dataclass(frozen=True)
class Comparison:
    """A run beside 5.9."""

    torque: Torque
    found: Turning
    rigid: float
    """5.9 [rad/s]."""
    soft: float
    """5.9 with the overlap of the contacts [rad/s]."""
    full: float
    """5.9 with overlap and inertia of the centre [rad/s]."""

    def deviation(self, theory: float) -> float:
        """Relative."""
        return self.found.velocity / theory - 1.0

    def row(self) -> dict[str, Any]:
        """Data."""
        return {
            "tilt_over_pi": self.torque.tilt / math.pi,
            "torque_amplitude": self.torque.amplitude,
            "torque_angular_frequency": self.torque.angular_frequency,
            "normal_stiffness": self.torque.normal_stiffness,
            "angular_velocity": self.found.velocity,
            "change_from_period_before": self.found.change,
            "closed_form": self.rigid,
            "closed_form_with_overlap": self.soft,
            "closed_form_with_overlap_and_inertia": self.full,
            "deviation": self.deviation(self.rigid),
            "deviation_with_overlap": self.deviation(self.soft),
            "deviation_with_both": self.deviation(self.full),
            "opened": int(self.found.opened),
        }


def compare(laboratory: Laboratory, torques: Sequence[Torque]) -> list[Comparison]:
    """Run and put 5.9 beside."""
    found = turnings(laboratory, "closed form", torques)

    def closed(torque: Torque, stiffness: float, inertia: bool) -> float:
        table = velocity(laboratory, [torque.tilt], [torque.amplitude], torque.angular_frequency, stiffness)
        return float(table["closed_form_with_inertia" if inertia else "closed_form"][0])

    return [
        Comparison(
            torque,
            found[torque],
            closed(torque, math.inf, False),
            closed(torque, torque.normal_stiffness, False),
            closed(torque, torque.normal_stiffness, True),
        )
        for torque in torques
    ]


def amplitude(laboratory: Laboratory, tilt: float, share: float | None) -> float:
    """A_e [N m] so many widths above A_S2, or at RANGE of the range of 5.9."""
    bounds = limits(laboratory, tilt)
    if share is None:
        return RANGE * bounds["A_rest"]
    return bounds["A_S2"] + share * (bounds["A_S1"] - bounds["A_S2"])


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Grid, scaling with omega_e at several stiffnesses."""
    slow = QUICK_GRID_SLOWNESS if quick else GRID_SLOWNESS
    grid = compare(
        laboratory,
        [Torque(tilt, amplitude(laboratory, tilt, share), slow) for tilt in TILTS for share in (*SHARES, None)],
    )
    probe = amplitude(laboratory, *PROBE)
    slowness, stiffnesses = (QUICK_SLOWNESS, QUICK_STIFFNESSES) if quick else (SLOWNESS, STIFFNESSES)
    scaling = compare(laboratory, [Torque(PROBE[0], probe, w, k) for k in stiffnesses for w in slowness])
    notes = [
        f"grid: omega_e = {slow:g} rad/s, k_n = 1e3 N/m; the other parameters of P 5.1",
        f"scaling: tilt {PROBE[0] / math.pi:g} pi, A_e = {probe:.5f} N m; k_t = 1e6 N/m, gamma_n = 10 kg/s at all k_n",
        "deviation: omega / (5.9) - 1 over the third period; with overlap: A_S1, A_S2 of the disk that has sunk in; "
        "with both: and the angular velocity with which a slide starts",
    ]
    rows = [comparison.row() for comparison in (*grid, *scaling)]
    return Product("Closed form 5.9 against simulation", rows, _draw(grid, scaling), _statements(grid, scaling), notes)


def _draw(grid: Sequence[Comparison], scaling: Sequence[Comparison]) -> Figure:
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    for tilt, colour in zip(TILTS, shades(len(TILTS)), strict=True):
        line = sorted((c for c in grid if c.torque.tilt == tilt), key=lambda c: c.torque.amplitude)
        at = [c.torque.amplitude for c in line]
        label = rf"{tilt / math.pi:.2f} $\pi$"
        left.semilogy(at, [abs(c.deviation(c.rigid)) for c in line], "o:", color=colour, mfc="white", ms=4, lw=0.7)
        left.semilogy(at, [abs(c.deviation(c.soft)) for c in line], "s--", color=colour, mfc="white", ms=3.5, lw=0.7)
        left.semilogy(at, [abs(c.deviation(c.full)) for c in line], "s-", color=colour, ms=3.5, lw=0.7, label=label)
    left.axhline(1e-4, color="0.5", lw=0.7, ls="-.")
    left.set(xlabel="$A_e$ [N m]", ylabel="relative deviation of the simulation")
    left.set_title("circles: 5.9; squares: with overlap; filled: and inertia", fontsize=8)
    left.legend(title=r"$\theta_T$", loc="upper right")
    stiffnesses = sorted({c.torque.normal_stiffness for c in scaling})
    for stiffness, colour in zip(stiffnesses, shades(len(stiffnesses)), strict=True):
        line = [c for c in scaling if c.torque.normal_stiffness == stiffness]
        at = [c.torque.angular_frequency for c in line]
        right.loglog(at, [abs(c.deviation(c.rigid)) for c in line], "o:", color=colour, mfc="white", ms=4, lw=0.7)
        right.loglog(at, [abs(c.deviation(c.soft)) for c in line], "s--", color=colour, mfc="white", ms=3.5, lw=0.7)
        label = f"{stiffness:.0e}"
        right.loglog(at, [abs(c.deviation(c.full)) for c in line], "s-", color=colour, ms=3.5, lw=0.7, label=label)
    guide = np.array([min(c.torque.angular_frequency for c in scaling), 4.0])
    right.loglog(guide, 2e-3 * guide**2, "k:", lw=1.0, label=r"$\propto \omega_e^2$")
    ticks = sorted({c.torque.angular_frequency for c in scaling})
    right.set_xticks(ticks, [f"{t:g}" for t in ticks])
    right.minorticks_off()
    right.set(xlabel=r"$\omega_e$ [rad/s]")
    right.legend(title="$k_n$ [N/m]")
    return figure


def _statements(grid: Sequence[Comparison], scaling: Sequence[Comparison]) -> list[Statement]:
    def worst(comparisons: Sequence[Comparison], of: Callable[[Comparison], float]) -> float:
        return max(abs(c.deviation(of(c))) for c in comparisons)

    slowest = min(c.torque.angular_frequency for c in scaling)
    at_rest = [c for c in scaling if c.torque.angular_frequency == slowest]
    stiffest = max(at_rest, key=lambda c: c.torque.normal_stiffness)
    soft, full = (worst(grid, of) for of in (_soft, _full))
    middle = float(np.median([abs(c.deviation(c.rigid)) for c in grid]))
    return [
        Statement.judged(
            "5.2.4",
            "5.9 agrees very well with simulations",
            f"{len(grid)} points: half of them within {middle:.1e}, the one closest to A_S2 within "
            f"{worst(grid, _rigid):.1e}",
            exact(middle, 1e-2, "median relative deviation"),
        ),
        Statement.judged(
            "5.2.4",
            "5.9 is exact where its assumptions hold",
            f"k_n = {stiffest.torque.normal_stiffness:.0e} N/m, omega_e = {slowest:g} rad/s: "
            f"{stiffest.deviation(stiffest.rigid):+.1e} from 5.9 as printed, {stiffest.deviation(stiffest.full):+.1e} "
            "with overlap and inertia",
            exact(stiffest.deviation(stiffest.rigid), 1e-4, "relative deviation with stiff contacts and a slow torque"),
        ),
        Statement.judged(
            "5.2.4",
            "5.9 is exact with the parameters of 5.1",
            f"on the grid within {soft:.1e} with the overlap in A_S1, A_S2, within {full:.1e} with the inertia too; "
            f"{sum(abs(c.deviation(c.full)) < 1e-4 for c in grid)} of {len(grid)} points within 1e-4",
            every([exact(c.deviation(c.full), 1e-4) for c in grid], "every point within 1e-4 with both corrections"),
            "next to A_S2 the velocity vanishes while second-order terms of the inertia do not",
        ),
        *_assumptions(scaling, at_rest),
    ]


def _assumptions(scaling: Sequence[Comparison], at_rest: Sequence[Comparison]) -> list[Statement]:
    softest = [c for c in scaling if c.torque.normal_stiffness == NORMAL_STIFFNESS]
    with_speed = power_law(
        np.array([c.torque.angular_frequency for c in softest]), np.array([abs(c.deviation(c.soft)) for c in softest])
    )
    fastest = max(c.torque.angular_frequency for c in scaling)
    hasty = [c for c in scaling if c.torque.angular_frequency == fastest]
    inertia = [abs(c.deviation(c.soft)) for c in hasty]
    # What the overlap does, free of inertia: rigid less soft theory.
    overlap = np.array([abs(c.soft / c.rigid - 1.0) for c in at_rest])
    with_stiffness = power_law(np.array([c.torque.normal_stiffness for c in at_rest]), overlap)
    return [
        Statement.judged(
            "5.2",
            "the torque is slow if omega_e << sqrt(k / m) with k = max(k_n, k_t)",
            f"deviation without that of the overlap at omega_e = {fastest:g} rad/s, k_t = 1e6 N/m: "
            + ", ".join(
                f"k_n = {c.torque.normal_stiffness:.0e} N/m: {d:.1e}" for c, d in zip(hasty, inertia, strict=True)
            ),
            true(
                max(inertia) < 2.0 * min(inertia), "it does not depend on k_n < k_t by more than a factor 2; no chance"
            ),
            "the softest mode decides, omega_e << sqrt(k_n / m): the centre must follow the torque",
        ),
        Statement.judged(
            "5.2.4",
            "assumption: no inertia of the centre, a quasi-static torque",
            f"with overlap there remains a deviation that goes as omega_e to the {with_speed}; the first order of the "
            "inertia takes away all but "
            f"{abs(hasty[0].deviation(hasty[0].full) / hasty[0].deviation(hasty[0].soft)):.1%}",
            exact(with_speed.mean - 2.0, 0.3, "exponent less 2"),
        ),
        Statement.judged(
            "5.2.4",
            "assumption: no overlap",
            f"its share goes as k_n to the {with_stiffness}: "
            + ", ".join(f"{c.torque.normal_stiffness:.0e} N/m: {c.deviation(c.rigid):+.1e}" for c in at_rest),
            exact(with_stiffness.mean + 1.0, 0.05, "exponent plus 1"),
        ),
    ]


def _rigid(comparison: Comparison) -> float:
    return comparison.rigid


def _soft(comparison: Comparison) -> float:
    return comparison.soft


def _full(comparison: Comparison) -> float:
    return comparison.full
