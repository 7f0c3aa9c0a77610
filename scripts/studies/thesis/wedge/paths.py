"""P Fig. 6.2: the angle of the upper disk over five minutes, as the laboratory of P 6.1 records it, simulated."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.statistics.power_law import power_law
from jostle_lab.statistics.rotation import squared_correlation
from jostle_lab.verdicts import above, every, near, vanish

GRAVITY, RADIUS, FREQUENCY = 9.81, 0.0125, 200.0
"""[m/s^2]; disks of 2.5 cm diameter; drive of P 6.1 [Hz]."""
TILTS = {0.0: "0.6", 8.0: "-", 12.0: "--", 16.0: ":"}
"""Tilts [degrees] and lines of P Fig. 6.2; no tilt is told in the text."""
GAMMAS = (1.2, 1.5)
"""The paper says: strong enough to keep the disk slightly bouncing without tilt. The first is drawn."""
SECONDS = 300.0
SEEDS, UPRIGHT_SEEDS = range(1, 5), range(1, 17)
LAGS = np.array([1, 2, 4, 8, 16, 32])
"""[s]."""


def run(tilt: float, gamma: float, seed: int) -> Run:
    """Five minutes with a row each second."""
    settings = (
        ("seed", seed),
        ("gravity", GRAVITY),
        ("wedge.aperture", 2.0 * math.pi / 3.0),
        ("wedge.tilt", math.radians(tilt)),
        ("disk.radius", RADIUS),
        ("collision.restitution", 0.9),
        ("contact.friction", 0.1),
        ("contact.stiffness_ratio", 0.773),
        ("drive.frequency", FREQUENCY),
        ("drive.amplitude", gamma * GRAVITY / (math.tau * FREQUENCY) ** 2),
    )
    return Run("wedge", "event-driven", SECONDS, 1.0, settings)


Paths = dict[tuple[float, float], Numbers]
"""By tilt [degrees] and Gamma: angles [rad], shape (seconds + 1, seeds)."""


def make(laboratory: Laboratory, _quick: bool, _seeds: int | None = None) -> Product:
    """Four tilts, two intensities; it takes seconds, so that there is one effort only."""
    cases = {(tilt, gamma): UPRIGHT_SEEDS if tilt == 0.0 else SEEDS for tilt in TILTS for gamma in GAMMAS}
    runs = {(*case, seed): run(*case, seed) for case, seeds in cases.items() for seed in seeds}
    tables = laboratory.run(list(runs.values()), "figure 6.2")
    paths = {
        case: np.column_stack([tables[runs[*case, seed]]["disk.angle[1]"] for seed in seeds])
        for case, seeds in cases.items()
    }
    rows: list[dict[str, Any]] = [
        {"tilt": tilt, "gamma": gamma, "seed": seed, "time": second, "angle": float(angle)}
        for (tilt, gamma), found in paths.items()
        for seed, column in enumerate(found.T, 1)
        for second, angle in enumerate(column)
    ]
    notes = [
        "a wedge of 120 degrees in the place of the two fixed disks, exactly moving at 200 Hz, event-driven; "
        "disk of 2.5 cm "
        "diameter, angle each second for five minutes (P 6.1)",
        "not given by P: e_n = 0.9, mu = 0.1, kappa = 0.773 as in its simulations; Gamma = 1.2 and 1.5",
        f"{len(SEEDS)} seeds for each tilt, {len(UPRIGHT_SEEDS)} without tilt, none mirrored; errors from seed to seed",
    ]
    return Product("Figure 6.2: angle of the upper disk", rows, draw(paths), statements(paths), notes)


def draw(paths: Paths) -> Figure:
    """One path for each tilt, and all without tilt on a scale of their own."""
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    panel, still = figure.subplots(1, 2, width_ratios=(3, 2))
    gamma = GAMMAS[0]
    time = np.arange(len(paths[0.0, gamma]))
    for (tilt, line), colour in zip(TILTS.items(), ("0.6", *shades(4)[:3]), strict=True):
        if tilt > 0.0:
            label = rf"$\theta_T$ = {tilt:g}$\degree$"
            panel.plot(time, paths[tilt, gamma][:, 0] / math.tau, line, color=colour, lw=1.4, label=label)
    panel.plot(time, paths[0.0, gamma][:, 0] / math.tau, color="0.6", lw=1.0, label=r"$\theta_T$ = 0")
    still.plot(time, paths[0.0, gamma] / math.tau, color="0.6", lw=0.6)
    still.axhline(0.0, color="0.2", lw=0.6, ls=":")
    still.set(xlabel="time [s]", title=rf"$\theta_T$ = 0, {len(UPRIGHT_SEEDS)} seeds")
    panel.set(xlabel="time [s]", ylabel=rf"angle [turns], $\Gamma$ = {gamma:g}")
    panel.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    panel.legend()
    return figure


def velocity(path: Numbers) -> Estimate:
    """Mean angular velocity of the seeds [rad/s]."""
    return Estimate.over_runs((path[-1] - path[0]) / SECONDS)


def spread_exponent(path: Numbers) -> Estimate:
    """Exponent of the mean squared change of angle against its lag, by seeds: 2 ballistic, 1 a random walk."""
    found = []
    for column in path.T:
        squares = np.array([np.mean((column[lag:] - column[:-lag]) ** 2) for lag in LAGS])
        found.append(power_law(LAGS.astype(np.float64), squares).mean)
    return Estimate.over_runs(np.array(found))


def statements(paths: Paths) -> list[Statement]:
    """What P 6.1 says."""
    tilted = [case for case in paths if case[0] > 0.0]
    upright = [case for case in paths if case[0] == 0.0]
    speeds = {case: velocity(path) for case, path in paths.items()}
    return [
        _sustained(paths, tilted),
        _depends(speeds),
        _upright(speeds, upright),
        _random(paths, upright, tilted),
    ]


def _listed(values: dict[tuple[float, float], Estimate], unit: str) -> str:
    return "; ".join(f"{tilt:g} degrees, Gamma = {gamma:g}: {value}" for (tilt, gamma), value in values.items()) + unit


def _sustained(paths: Paths, tilted: Sequence[tuple[float, float]]) -> Statement:
    squares = {case: Estimate.over_runs(squared_correlation(paths[case])) for case in tilted}
    return Statement.judged(
        "6.1, Fig. 6.2",
        "tilted by 8, 12 and 16 degrees the disk rotates steadily: the angle grows linearly with time",
        _listed(squares, ", squared correlation with time"),
        every([near(e, 1.0, 0.05) for e in squares.values()], "squared correlation within 0.05 of 1, at each tilt"),
        "near the tilt where the sense changes the mean rotation is small beside its fluctuations: parameters of the "
        "laboratory's disks, which P does not give, decide where that is",
    )


def _depends(speeds: dict[tuple[float, float], Estimate]) -> Statement:
    tilts = [tilt for tilt in TILTS if tilt > 0.0]
    judged = []
    for gamma in GAMMAS:
        first, last = speeds[tilts[0], gamma], speeds[tilts[-1], gamma]
        judged.append(above(Estimate(abs(first.mean - last.mean), math.hypot(first.error, last.error)), 0.0))
    for tilt in (tilts[0], tilts[-1]):
        weak, strong = (speeds[tilt, gamma] for gamma in GAMMAS)
        judged.append(above(Estimate(abs(strong.mean - weak.mean), math.hypot(strong.error, weak.error)), 0.0))
    return Statement.judged(
        "6.1, Fig. 6.2",
        "the average velocity depends on tilt and on the intensity of the driving",
        _listed({case: e for case, e in speeds.items() if case[0] > 0.0}, " rad/s"),
        every(
            judged, "differences between 8 and 16 degrees, and between both intensities, are above zero by two errors"
        ),
    )


def _upright(speeds: dict[tuple[float, float], Estimate], upright: Sequence[tuple[float, float]]) -> Statement:
    ratios = [
        Estimate(speeds[case].mean / size, speeds[case].error / size)
        for case in upright
        for size in (max(abs(speeds[tilt, case[1]].mean) for tilt in TILTS),)
    ]
    return Statement.judged(
        "6.1",
        "for zero tilt the overall rotation is very small",
        _listed({case: speeds[case] for case in upright}, " rad/s; over the fastest of the tilts: ")
        + ", ".join(map(str, ratios)),
        vanish(ratios, 0.1),
    )


def _random(paths: Paths, upright: Sequence[tuple[float, float]], tilted: Sequence[tuple[float, float]]) -> Statement:
    still = {case: spread_exponent(paths[case]) for case in upright}
    turning = {case: spread_exponent(paths[case]) for case in tilted}
    return Statement.judged(
        "6.1",
        "for zero tilt the rotation is random, not ballistic",
        "exponent of the mean squared change of angle with the lag, 1 to 32 s: "
        + _listed(still, "; tilted: ")
        + _listed(turning, ""),
        every(
            [near(e, 1.0, 0.25) for e in still.values()], "exponent within 0.25 of 1, a random walk (2 is ballistic)"
        ),
    )
