"""P Figs 5.8 and 5.9: mean angular velocity on supports that vibrate randomly, against amplitude and tilt."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.curves import shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.verdicts import exact, true
from studies.thesis.two_supports import random_mechanism as mechanism
from studies.thesis.two_supports import random_statements as stated
from studies.thesis.two_supports.random_runs import FULL, POINTS, QUICK, SETTLING, Effort, Measured, Place, measure
from studies.thesis.two_supports.random_statements import Found
from studies.thesis.two_supports.runs import MARKERS, SCENE

TILTS_58 = tuple(share * math.pi for share in (0.0, 0.02, 0.04, 0.06, 0.08))
AMPLITUDES_59 = (2e-5, 4e-5, 6e-5, 8e-5, 1e-4)
"""As in the captions."""
AMPLITUDES_58 = (1e-5, 1.5e-5, 2e-5, 4e-5, 6e-5, 8e-5, 1e-4)
TILTS_59 = tuple(share * math.pi for share in (0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.12))
SMALL = (1e-7, 3e-7, 1e-6, 3e-6, 5e-6)
"""Amplitudes down to L = mu m g / k_t at the steepest tilt: where slip, sliding and rotation begin [m]."""
HEAVY = Place(TILTS_58[2], 4e-5, inertia=100.0)
"""Trial of what makes S rarer than T."""


def _effort(quick: bool, seeds: int | None) -> Effort:
    chosen = QUICK if quick else FULL
    return Effort(chosen.seconds, seeds or chosen.seeds)


def _notes(effort: Effort) -> list[str]:
    return [
        "omega_b = 20 pi rad/s, c = 0.5, k_n = 1e3 N/m, k_t = 1e6 N/m, gamma_n = 10 kg/s, mu = 0.1, g = 10 m/s^2",
        f"each point: {effort.seeds} seeds, each as drawn and mirrored; without tilt {3 * effort.seeds} seeds "
        "as drawn, "
        f"since mirrored pairs cancel there by construction; {effort.seconds:g} s after {SETTLING:g} s",
        "seeds of a point: from 1e4 A_b / 1e-7 m + 100 theta_T / 0.01 pi + 1 on, so that points are independent; error "
        "bars: standard error from pair to pair",
        "points at which a contact opened in some run are left out of all statements, as in the thesis",
        "settled after first runs had been seen: how many seeds there are without tilt, that their mean is held "
        "against the fastest rotation, and the line that gives the onset; other seeds for all would take an hour",
    ]


def _draw(panel: Axes, points: Sequence[Measured], at: Sequence[float], label: str, style: dict[str, Any]) -> None:
    panel.plot(at, [p.velocity.mean for p in points], "-", lw=0.7, color=style["color"])
    for lasting, marker, name in ((True, style["marker"], label), (False, "x", None)):
        inside = [(x, p) for x, p in zip(at, points, strict=True) if p.lasting is lasting]
        if not inside and name is None:
            continue
        panel.errorbar(
            [x for x, _ in inside],
            [p.velocity.mean for _, p in inside],
            yerr=[p.velocity.error for _, p in inside],
            fmt=marker,
            color=style["color"],
            mfc="white",
            ms=4.5,
            capsize=1.5,
            elinewidth=0.8,
            label=name,
        )


def _finish(panel: Axes, found: Found) -> None:
    panel.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    if not all(m.lasting for m in found.values()):
        panel.plot([], [], "x", color="0.3", ms=4.5, label="a contact opened\n(left out in P)")
    panel.plot([], [], " ", label="bars: standard error")
    panel.set_ylabel(r"$\bar\omega$ [rad/s], counter-clockwise")
    panel.legend()


def against_amplitude(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Figure 5.8."""
    effort = _effort(quick, seeds)
    tilts = TILTS_58[::2] if quick else TILTS_58
    amplitudes = AMPLITUDES_58[::2] if quick else AMPLITUDES_58
    found = measure(laboratory, "figure 5.8", [Place(t, a) for t in tilts for a in amplitudes], effort)
    small = measure(laboratory, "figure 5.8, small amplitudes", [Place(tilts[-1], a) for a in SMALL], effort)
    trial = measure(laboratory, "figure 5.8, trial", [HEAVY], effort)[HEAVY]
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    panel, visits = figure.subplots(1, 2, width_ratios=(3, 2))
    for tilt, colour in zip(tilts, shades(len(tilts)), strict=True):
        line = [found[Place(tilt, amplitude)] for amplitude in amplitudes]
        label = rf"$\theta_T$ = {tilt / math.pi:.2f} $\pi$"
        style = {"color": colour, "marker": MARKERS[TILTS_58.index(tilt)]}
        _draw(panel, line, [1e5 * a for a in amplitudes], label, style)
    panel.set_xlabel("$A_b$ [$10^{-5}$ m]")
    _finish(panel, found)
    middle = [m for m in found.values() if m.place.tilt == HEAVY.tilt and m.lasting]
    _draw_counts(visits, middle)
    rows = [measured.row() for measured in (*found.values(), *small.values(), trial)]
    upright = [m for m in found.values() if m.place.tilt == 0.0 and m.lasting]
    slight = [m for m in found.values() if m.place.tilt == tilts[1] and m.lasting]
    statements = [
        stated.upright(found),
        stated.negative(found),
        stated.monotonic(found),
        stated.opening(found, "amplitude"),
        stated.onset({**found, **small}),
        accessible(middle),
        mechanism.equal_counts(middle, trial),
        *mechanism.equal_durations(upright, slight),
        mechanism.balance(laboratory, middle),
        mechanism.always_sliding(middle),
        *mechanism.estimates(list(small.values())),
    ]
    title = "Figure 5.8: random supports, against amplitude"
    return Product(title, rows, figure, statements, _notes(effort))


def _draw_counts(panel: Axes, points: Sequence[Measured]) -> None:
    """Shares of the visits of the four points against the amplitude, at one tilt."""
    line = sorted(points, key=lambda m: m.place.amplitude)
    for name, marker, colour in zip(POINTS, ("o", "s", "^", "v"), shades(len(POINTS)), strict=True):
        shares = [m.share_of_counts(name) for m in line]
        panel.errorbar(
            [1e5 * m.place.amplitude for m in line],
            [s.mean for s in shares],
            yerr=[s.error for s in shares],
            fmt=marker + "-",
            lw=0.7,
            ms=4.5,
            color=colour,
            mfc="white",
            capsize=1.5,
            label=f"${name[0].upper()}_{name[1]}$",
        )
    panel.axhline(0.25, color="0.3", lw=0.9, ls="--", label="$N^j = N/4$ (P)")
    panel.set(xlabel="$A_b$ [$10^{-5}$ m]", ylabel=f"share of the visits at {HEAVY.tilt / math.pi:.2f} $\\pi$")
    panel.set_ylim(0.0, 0.6)
    panel.legend(ncols=2)


def accessible(points: Sequence[Measured]) -> Statement:
    """All four points are reached."""
    line = sorted(points, key=lambda m: m.place.amplitude)
    least = {m.place.amplitude: min(float(np.min(m.counts[name])) for name in POINTS) for m in line}
    return Statement.judged(
        "5.3.3",
        "S1, S2, T1 and T2 are all accessible when the supports vibrate",
        f"fewest visits of any point in any pair of runs at {line[0].place.tilt / math.pi:.2f} pi: "
        + ", ".join(f"{a:.1e} m: {n:.0f}" for a, n in least.items()),
        true(min(least.values()) > 0.0, "each point is visited in each pair of runs at each amplitude"),
    )


def against_tilt(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Figure 5.9."""
    effort = _effort(quick, seeds)
    amplitudes = AMPLITUDES_59[1::2] if quick else AMPLITUDES_59
    tilts = TILTS_59[::2] if quick else TILTS_59
    found = measure(laboratory, "figure 5.9", [Place(t, a) for a in amplitudes for t in tilts], effort)
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    panel, torque = figure.subplots(1, 2, width_ratios=(2, 1))
    for amplitude, colour in zip(amplitudes, shades(len(amplitudes)), strict=True):
        line = [found[Place(tilt, amplitude)] for tilt in tilts]
        style = {"color": colour, "marker": MARKERS[AMPLITUDES_59.index(amplitude)]}
        label = rf"$A_b$ = {1e5 * amplitude:g}$\times 10^{{-5}}$ m"
        _draw(panel, line, [tilt / math.pi for tilt in tilts], label, style)
    panel.set_xlabel(r"$\theta_T$ [$\pi$]")
    _finish(panel, found)
    dense = [float(tilt) for tilt in np.linspace(0.0, 0.134 * math.pi, 50)]
    means = laboratory.theory(SCENE, "torques", tilt=dense)
    torque.plot(np.array(dense) / math.pi, 1e3 * means["mean"], "k-", lw=1.0, label="S and T, 5.21")
    torque.plot(np.array(dense) / math.pi, 1e3 * means["mean_of_S"], "k--", lw=1.0, label="S alone")
    torque.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    torque.set(xlabel=r"$\theta_T$ [$\pi$]", ylabel=r"mean torque [$10^{-3}$ N m]", title="theory")
    torque.legend()
    statements = [
        stated.minimum(found),
        stated.negative(found),
        stated.upright(found),
        stated.opening(found, "tilt"),
        *torques(laboratory),
    ]
    rows = [measured.row() for measured in found.values()]
    return Product("Figure 5.9: random supports, against tilt", rows, figure, statements, _notes(effort))


def torques(laboratory: Laboratory) -> list[Statement]:
    """5.15 to 5.18 and 5.21 beside the theory, and their signs."""
    tilts = [float(tilt) for tilt in np.linspace(0.01, 0.134, 20) * math.pi]
    table = laboratory.theory(SCENE, "torques", tilt=tilts)
    t, mu, half = np.array(tilts), mechanism.FRICTION, math.pi / 6.0
    base = mechanism.WEIGHT * mu / ((1.0 + mu**2) * math.cos(half))
    printed = {
        "S1": base * (np.cos(t) + mu * np.sin(t)),
        "S2": -base * (np.cos(t) - mu * np.sin(t)),
        "T1": mechanism.WEIGHT * mu * np.sin(t) / (math.sin(half) + mu * math.cos(half)),
        "T2": -mechanism.WEIGHT * mu * np.sin(t) / (math.sin(half) - mu * math.cos(half)),
    }
    away = {n: float(np.max(np.abs(printed[n] / table[n] - 1.0))) for n in printed}
    swapped = max(float(np.max(np.abs(printed[a] / table[b] - 1.0))) for a, b in (("T1", "T2"), ("T2", "T1")))
    mean = (
        mechanism.WEIGHT
        * mu**2
        * (mu**2 + (1.0 + mu**2) * math.cos(2.0 * half))
        * np.sin(t)
        / (math.cos(half) ** 3 * 2.0 * (1.0 + mu**2) * (mu**2 - math.tan(half) ** 2))
    )
    rest = float(np.max(np.abs(mean / table["mean"] - 1.0)))
    signs = bool(np.all(table["mean"] < 0.0) and np.all(table["mean_of_S"] > 0.0))
    return [
        Statement.judged(
            "5.15, 5.16",
            "torques at S1 and S2",
            f"relative difference from the saturated balance of forces {max(away['S1'], away['S2']):.0e}, theta_h = "
            "theta_0",
            exact(max(away["S1"], away["S2"]), 1e-9, "relative difference"),
        ),
        Statement.judged(
            "5.17, 5.18",
            "torques at T1 and T2",
            f"relative difference {min(away['T1'], away['T2']):.1f} as printed, {swapped:.0e} with T1 and T2 exchanged",
            exact(max(away["T1"], away["T2"]), 1e-9, "relative difference"),
            "printed the wrong way round: 4.47 and 4.49 in 4.18 give 5.17 at T2 and 5.18 at T1; their mean is the same",
        ),
        Statement.judged(
            "5.21",
            "mean of the four torques",
            f"relative difference from the mean of the theory {rest:.0e}",
            exact(rest, 1e-9, "relative difference"),
        ),
        Statement.judged(
            "5.3.3",
            "the mean torque of S1, S2, T1, T2 (5.21) is always negative, that of S1, S2 alone positive",
            f"at 0.134 pi {float(table['mean'][-1]):.2e} and {float(table['mean_of_S'][-1]):.2e} N m",
            true(signs, "at 20 tilts up to 0.134 pi; no chance"),
        ),
    ]
