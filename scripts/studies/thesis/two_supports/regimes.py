"""P Fig. 5.1: in which directions a slow torque makes the disk slide, over tilt and amplitude."""

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict, verdict
from studies.thesis.two_supports.runs import SCENE, Torque, Turning, limits, notes, turnings

FRICTION = 0.1
SHARES = tuple(np.linspace(0.0, 0.98, 8))
"""theta_T / theta_T^D of the simulations."""
QUICK_SHARES = (0.0, 0.3, 0.6, 0.95)
MARGINS = (0.97, 0.998, 1.002, 1.03)
"""Amplitudes of the simulations over A_S1 and A_S2, so that they stand on both sides of either line."""
QUICK_MARGINS = (0.99, 1.01)
NAMES = ("none", "unidirectional", "bidirectional")
COLOURS = ("#d9d4c8", "#7fa8d1", "#14406f")


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Lines of the theory, points of the simulation."""
    unit, most = (limits(laboratory, 0.0)[name] for name in ("A_0", "detachment_tilt"))
    torques = []
    for share in QUICK_SHARES if quick else SHARES:
        at = limits(laboratory, share * most)
        for margin in QUICK_MARGINS if quick else MARGINS:
            torques += [Torque(float(share * most), margin * at[name]) for name in ("A_S1", "A_S2")]
    torques = list(dict.fromkeys(torques))
    found = turnings(laboratory, "figure 5.1", torques)
    predicted = {
        torque: int(
            laboratory.theory(SCENE, "regime", tilt=torque.tilt, torque__amplitude=torque.amplitude)["regime"][0]
        )
        for torque in torques
    }
    rows: list[dict[str, Any]] = [
        {
            "tilt": torque.tilt,
            "tilt_over_detachment": torque.tilt / most,
            "amplitude_over_A0": torque.amplitude / unit,
            "regime": turned.regime,
            "theory": predicted[torque],
            "opened": int(turned.opened),
        }
        for torque, turned in found.items()
    ]
    return Product(
        "Figure 5.1: sliding regimes",
        rows,
        _draw(laboratory, found, unit, most),
        _statements(laboratory, found, predicted),
        notes(),
    )


def _draw(laboratory: Laboratory, found: dict[Torque, Turning], unit: float, most: float) -> Figure:
    figure = Figure(figsize=(0.8 * WIDTH, 4.0), layout="constrained")
    panel = figure.subplots()
    tilts = [float(tilt) for tilt in np.linspace(0.0, most, 200)]
    table = laboratory.theory(SCENE, "limits", tilt=tilts)
    share = np.array(tilts) / most
    for name, line in (("A_S1", "-"), ("A_S2", "--")):
        label = f"${name[0]}_{{{name[2:]}}}/A_0$"
        panel.plot(share, table[name] / unit, "k" + line, lw=1.1, label=label)
    for regime, (name, colour) in enumerate(zip(NAMES, COLOURS, strict=True)):
        points = [(t.tilt / most, t.amplitude / unit) for t, turned in found.items() if turned.regime == regime]
        if points:
            panel.plot(*np.array(points).T, "o", color=colour, mec="0.2", mew=0.4, ms=4.5, label=f"simulation: {name}")
    panel.axvline(1.0, color="0.4", lw=0.8, ls=":")
    panel.text(0.995, 1.055, r"$\theta_T^D$", ha="right")
    panel.set(xlabel=r"$\theta_T/\theta_T^D$", ylabel="$A_e/A_0$", xlim=(-0.02, 1.03), ylim=(0.83, 1.07))
    panel.legend(loc="lower left")
    return figure


def _statements(laboratory: Laboratory, found: dict[Torque, Turning], predicted: dict[Torque, int]) -> list[Statement]:
    wrong = [torque for torque, turned in found.items() if turned.regime != predicted[torque]]
    opened = [torque for torque, turned in found.items() if turned.opened]
    unit = limits(laboratory, 0.0)["A_0"]
    highest = limits(laboratory, math.atan(FRICTION))["A_S1"]
    amplitude = 0.5 * (unit + highest)
    most = limits(laboratory, 0.0)["detachment_tilt"]
    tilts = [float(tilt) for tilt in np.linspace(0.0, most - 1e-9, 400)]
    regimes = laboratory.theory(SCENE, "regime", tilt=tilts, torque__amplitude=amplitude)["regime"]
    sequence = [int(r) for i, r in enumerate(regimes) if i == 0 or r != regimes[i - 1]]
    growing = laboratory.theory(SCENE, "limits", tilt=tilts)
    lower, upper = np.diff(growing["A_S2"]), np.diff(growing["A_S1"])
    peak = tilts[int(np.argmax(growing["A_S1"]))]
    return [
        Statement(
            "Fig. 5.1",
            "none below A_S2, unidirectional between A_S2 and A_S1, bidirectional above A_S1",
            f"{len(found) - len(wrong)} of {len(found)} simulations, which stand within 3 % of the lines, agree",
            verdict(not wrong),
        ),
        Statement(
            "5.2.1",
            "between A_0 and A_S1(arctan mu): reentrant, bidirectional, unidirectional, bidirectional again",
            f"regimes along the tilt at A_e = {amplitude / unit:.4f} A_0: {sequence}",
            verdict(sequence == [2, 1, 2]),
        ),
        Statement(
            "5.2, text after 5.5",
            "A_S1 has a maximum, at theta_T = arctan mu",
            f"at {peak:.4f} rad, arctan mu = {math.atan(FRICTION):.4f}; {highest / unit:.5f} A_0",
            verdict(abs(peak - math.atan(FRICTION)) < 2e-3 and bool((upper > 0).any()) and bool((upper < 0).any())),
        ),
        Statement(
            "5.2, text after 5.5",
            "A_S2 grows monotonically with tilt",
            "it falls, as 5.3 says and the thesis uses elsewhere",
            Verdict.DISAGREES if bool((lower < 0.0).all()) else Verdict.OPEN,
        ),
        Statement(
            "5.2.1",
            "below theta_T^D no contact opens",
            f"{len(opened)} of {len(found)} simulations opened one",
            verdict(not opened),
        ),
    ]
