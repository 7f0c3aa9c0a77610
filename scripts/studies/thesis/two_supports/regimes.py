"""P Fig. 5.1: in which directions a slow torque makes the disk slide, over tilt and amplitude."""

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.verdicts import exact, true
from studies.thesis.two_supports.runs import SCENE, Torque, Turning, limits, notes, turnings

FRICTION, WEIGHT = 0.1, 1.0
"""mu, and m g [N]."""
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
    figure = Figure(figsize=(0.85 * WIDTH, 4.0), layout="constrained")
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
            panel.plot(
                *np.array(points).T, "ovs"[regime], color=colour, mec="0.2", mew=0.5, ms=5, label=f"simulation: {name}"
            )
    panel.axvline(1.0, color="0.4", lw=0.8, ls=":")
    panel.text(0.995, 1.055, r"$\theta_T^D$", ha="right")
    panel.set(xlabel=r"$\theta_T/\theta_T^D$", ylabel="$A_e/A_0$", xlim=(-0.02, 1.03), ylim=(0.83, 1.07))
    panel.legend(loc="lower left")
    return figure


def _statements(laboratory: Laboratory, found: dict[Torque, Turning], predicted: dict[Torque, int]) -> list[Statement]:
    wrong = [torque for torque, turned in found.items() if turned.regime != predicted[torque]]
    opened = [torque for torque, turned in found.items() if turned.opened]
    by_tilt: dict[float, list[tuple[float, int]]] = {}
    for torque, turned in found.items():
        by_tilt.setdefault(torque.tilt, []).append((torque.amplitude, turned.regime))
    rising = all(sorted(r for _, r in sorted(line)) == [r for _, r in sorted(line)] for line in by_tilt.values())
    complete = sum({r for _, r in line} == {0, 1, 2} for line in by_tilt.values())
    return [
        Statement.judged(
            "Fig. 5.1",
            "none below A_S2, unidirectional between A_S2 and A_S1, bidirectional above A_S1",
            f"{len(found) - len(wrong)} of {len(found)} simulations, which stand within 3 % of the lines, agree",
            true(not wrong, "every simulation; no chance"),
        ),
        Statement.judged(
            "5.2.1",
            "at a fixed tilt, as A_e grows: none, unidirectional, bidirectional",
            f"simulations at {len(by_tilt)} tilts: in this order at {'all' if rising else 'not all'}, all "
            "three found at "
            f"{complete} (upright there is no unidirectional regime)",
            true(rising and complete >= len(by_tilt) - 1, "at each tilt; no chance"),
        ),
        *_limits(laboratory),
        *_at_fixed_amplitude(laboratory),
        Statement.judged(
            "5.2.1",
            "below theta_T^D no contact opens",
            f"{len(opened)} of {len(found)} simulations opened one",
            true(not opened, "no simulation; no chance"),
        ),
    ]


def _limits(laboratory: Laboratory) -> list[Statement]:
    """5.3 to 5.5 as printed, and how they change with the tilt."""
    most = limits(laboratory, 0.0)["detachment_tilt"]
    tilts = np.linspace(0.0, most - 1e-9, 400)
    table = laboratory.theory(SCENE, "limits", tilt=tilts.tolist())
    unit = WEIGHT * FRICTION / (math.cos(math.pi / 6.0) * (1.0 + FRICTION**2))
    printed = {
        "A_S2": unit * (np.cos(tilts) - FRICTION * np.sin(tilts)),
        "A_0": np.full_like(tilts, unit),
        "A_S1": unit * (np.cos(tilts) + FRICTION * np.sin(tilts)),
    }
    rest = max(float(np.max(np.abs(table[name] / printed[name] - 1.0))) for name in printed)
    lower = np.diff(table["A_S2"])
    peak, highest = float(tilts[int(np.argmax(table["A_S1"]))]), float(table["A_S1"].max()) / unit
    step = float(tilts[1] - tilts[0])
    return [
        Statement.judged(
            "5.3, 5.4, 5.5",
            "A_S2 = A_0 (cos theta_T - mu sin theta_T), A_0 = g m mu R / (cos theta_0 (1 + mu^2)), A_S1 = A_0 (cos "
            "theta_T + mu sin theta_T)",
            f"A_0 = {unit:.5f} N m; relative difference from the theory of the program {rest:.0e}",
            exact(rest, 1e-12, "relative difference"),
        ),
        Statement.judged(
            "5.2, text after 5.5",
            "A_S1 grows with the tilt, has a maximum, at theta_T = arctan mu (5.2.1), and falls",
            f"maximum {highest:.5f} A_0 at {peak:.4f} rad, arctan mu = {math.atan(FRICTION):.4f}",
            exact(peak - math.atan(FRICTION), step, "difference of the tilts [rad], a step of the grid,"),
        ),
        Statement.judged(
            "5.2, text after 5.5",
            "A_S2 grows monotonically with theta_T",
            f"it falls at {int(np.sum(lower < 0.0))} of {len(lower)} steps of the tilt",
            true(bool((lower > 0.0).all()), "it grows at every step; no chance"),
            "a slip of the pen in the thesis: 5.3 falls, and 5.2.2 and Fig. 5.2 say so",
        ),
    ]


def _at_fixed_amplitude(laboratory: Laboratory) -> list[Statement]:
    """Regimes along horizontal lines of Fig. 5.1, by the theory that the simulations beside its lines test."""
    most = limits(laboratory, 0.0)["detachment_tilt"]
    last = limits(laboratory, most - 1e-9)
    unit = last["A_0"]
    highest = limits(laboratory, math.atan(FRICTION))["A_S1"]
    tilts = [float(tilt) for tilt in np.linspace(0.0, most - 1e-9, 400)]
    cases = [
        ("below A_S2(theta_D): never leaves no sliding", 0.98 * last["A_S2"], [0]),
        ("from A_S2(theta_D) to A_S1(theta_D): none, then unidirectional", 0.5 * (last["A_S2"] + last["A_S1"]), [0, 1]),
        ("from A_S1(theta_D) to A_0: none, unidirectional, bidirectional", 0.5 * (last["A_S1"] + unit), [0, 1, 2]),
        (
            "from A_0 to the maximum of A_S1: reentrant, bidirectional, unidirectional, bidirectional",
            0.5 * (unit + highest),
            [2, 1, 2],
        ),
        ("above the maximum of A_S1: always bidirectional", 1.01 * highest, [2]),
    ]
    found = []
    for printed, amplitude, expected in cases:
        regimes = laboratory.theory(SCENE, "regime", tilt=tilts, torque__amplitude=amplitude)["regime"]
        sequence = [int(r) for i, r in enumerate(regimes) if i == 0 or r != regimes[i - 1]]
        found.append(
            Statement.judged(
                "5.2.1",
                f"as the tilt grows at A_e {printed}",
                f"at {amplitude / unit:.4f} A_0: {', '.join(NAMES[r] for r in sequence)}",
                true(sequence == expected, "the sequence over 400 tilts up to theta_T^D; no chance"),
            )
        )
    return found
