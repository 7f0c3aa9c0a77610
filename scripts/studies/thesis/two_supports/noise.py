"""The random supports themselves against P 5.11 to 5.13: variances, correlation in time, independence.

A record is cut into pieces much longer than the memory 1 / (c omega_b). Each piece of each coordinate gives one vector
of moments; Hotelling's T^2 tests whether their mean is the formula's. The statistics must not depend on the time step.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy import stats

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement, verdict
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.tables import Table
from studies.thesis.two_supports.runs import ENGINE, SCENE

AMPLITUDE, ANGULAR_FREQUENCY = 5e-5, 20.0 * math.pi
"""A_b [m] and omega_b [rad/s] of P 5.3.1; the radius is 1 m, so that the angle has the same number."""
SAMPLE = 0.005
"""[s], of a period of 0.1 s."""
LAGS = (2, 5, 9, 14, 20)
"""In samples."""
PIECE = 5.0
"""[s]."""
SIGNIFICANT = 1e-3
COORDINATES = [f"support[{i}].{name}" for i in (1, 2) for name in ("x", "y", "angle")]
RATES = [f"support[{i}].{name}" for i in (1, 2) for name in ("x_velocity", "y_velocity", "angular_velocity")]


@dataclass(frozen=True)
class Noise:
    """One record."""

    damping_ratio: float
    """c."""
    time_step: float
    """[s]."""
    seconds: float

    def run(self) -> Run:
        """The disk on top is soft and slippery: it must not slow the run down, and does not act on the supports."""
        settings = (
            ("support.amplitude", AMPLITUDE),
            ("support.angular_frequency", ANGULAR_FREQUENCY),
            ("support.damping_ratio", self.damping_ratio),
            ("contact.stiffness_ratio", 0.01),
            ("contact.friction", 0.0),
            ("time_step", self.time_step),
        )
        return Run(SCENE, ENGINE, self.seconds, SAMPLE, settings, drive="random-supports")


def correlation(lag: float, damping_ratio: float, printed: bool = False) -> float:
    """P 5.13 over the variance, with sqrt(1 - c^2); as `printed` with sqrt(1 - c)."""
    c = damping_ratio
    root = math.sqrt(1.0 - c) if printed else math.sqrt(1.0 - c * c)
    turned = root * ANGULAR_FREQUENCY * lag
    return math.exp(-c * ANGULAR_FREQUENCY * lag) * (math.cos(turned) + c / root * math.sin(turned))


def moments(table: Table) -> Numbers:
    """One row for each coordinate and piece: x^2, v^2, x v, and x x' at each lag, without units."""
    settled = round(1.0 / SAMPLE)
    length = round(PIECE / SAMPLE)
    rows = []
    for name, rate in zip(COORDINATES, RATES, strict=True):
        x = table[name][settled:] / AMPLITUDE
        v = table[rate][settled:] / (AMPLITUDE * ANGULAR_FREQUENCY)
        for piece in range((len(x) - max(LAGS)) // length):
            inside = slice(piece * length, (piece + 1) * length)
            later = [slice(inside.start + lag, inside.stop + lag) for lag in LAGS]
            rows.append(
                [np.mean(x[inside] ** 2), np.mean(v[inside] ** 2), np.mean(x[inside] * v[inside])]
                + [np.mean(x[inside] * x[shifted]) for shifted in later]
            )
    return np.array(rows)


def expected(damping_ratio: float, printed: bool = False) -> Numbers:
    """What the moments should be, 5.11 to 5.13."""
    return np.array([1.0, 1.0, 0.0, *(correlation(lag * SAMPLE, damping_ratio, printed) for lag in LAGS)])


def hotelling(rows: Numbers, mean: Numbers) -> float:
    """p-value of the hypothesis that independent `rows` have this mean."""
    count, size = rows.shape
    rest = rows.mean(axis=0) - mean
    square = count * float(rest @ np.linalg.solve(np.cov(rows.T), rest))
    return float(stats.f.sf(square * (count - size) / (size * (count - 1)), size, count - size))


def independence(table: Table) -> float:
    """p-value of the hypothesis that no two of the six coordinates are correlated."""
    length = round(PIECE / SAMPLE)
    x = np.array([table[name][round(1.0 / SAMPLE) :] for name in COORDINATES]) / AMPLITUDE
    pairs = [(i, j) for i in range(6) for j in range(i)]
    pieces = x.shape[1] // length
    products = np.array(
        [
            [np.mean(x[i, k * length : (k + 1) * length] * x[j, k * length : (k + 1) * length]) for i, j in pairs]
            for k in range(pieces)
        ]
    )
    return hotelling(products, np.zeros(len(pairs)))


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Two damping ratios, two time steps."""
    seconds = 400.0 if quick else 2000.0
    noises = [Noise(0.5, 1e-3, seconds), Noise(0.5, 2.5e-4, seconds), Noise(0.2, 1e-3, seconds)]
    tables = laboratory.run([noise.run() for noise in noises], "supports")
    found = {noise: moments(tables[noise.run()]) for noise in noises}
    apart = {noise: independence(tables[noise.run()]) for noise in noises}
    rows = [
        _row(noise, name, column) for noise in noises for name, column in zip(_names(), found[noise].T, strict=True)
    ]
    notes = [
        f"A_b = {AMPLITUDE:g} m, omega_b = 20 pi rad/s, R = 1 m; {seconds:g} s each after 1 s, seed 1; six coordinates "
        f"in pieces of {PIECE:g} s; moments of x / A_b and v / (A_b omega_b)",
        f"p: Hotelling's T^2 over all moments together; refused below {SIGNIFICANT:g}",
    ]
    return Product("Random supports, 5.11 to 5.13", rows, _draw(found), _statements(found, apart), notes)


def _names() -> list[str]:
    return ["<x^2>", "<v^2>", "<x v>", *(f"<x x({lag * SAMPLE:g} s)>" for lag in LAGS)]


def _row(noise: Noise, name: str, column: Numbers) -> dict[str, Any]:
    return {
        "damping_ratio": noise.damping_ratio,
        "time_step": noise.time_step,
        "moment": name,
        "mean": float(column.mean()),
        "standard_error": float(column.std(ddof=1) / math.sqrt(len(column))),
        "formula": float(expected(noise.damping_ratio)[_names().index(name)]),
    }


def _draw(found: dict[Noise, Numbers]) -> Figure:
    figure = Figure(figsize=(0.8 * WIDTH, 3.6), layout="constrained")
    panel = figure.subplots()
    dense = np.linspace(0.0, 1.2 * max(LAGS) * SAMPLE, 300)
    for noise, colour, marker in zip(found, ("#14406f", "#7fa8d1", "#c0272d"), "osD", strict=True):
        rows = found[noise]
        mean, error = rows.mean(axis=0), rows.std(axis=0, ddof=1) / math.sqrt(len(rows))
        at = np.array([0, *LAGS]) * SAMPLE
        chosen = [0, *range(3, 3 + len(LAGS))]
        label = f"c = {noise.damping_ratio:g}, step {noise.time_step:g} s"
        panel.errorbar(
            at,
            mean[chosen],
            yerr=3.0 * error[chosen],
            fmt=marker,
            color=colour,
            mfc="none",
            ms=5,
            capsize=2,
            label=label,
        )
    for c, colour in ((0.5, "#14406f"), (0.2, "#c0272d")):
        panel.plot(dense, [correlation(float(t), c) for t in dense], color=colour, lw=0.9)
        panel.plot(dense, [correlation(float(t), c, printed=True) for t in dense], color=colour, lw=0.8, ls=":")
    panel.plot([], [], "k-", lw=0.9, label=r"5.13 with $\sqrt{1-c^2}$")
    panel.plot([], [], "k:", lw=0.8, label=r"as printed, $\sqrt{1-c}$")
    panel.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    panel.set(xlabel="lag [s]", ylabel=r"$\langle x_b(t)\,x_b(t+\tau)\rangle/A_b^2$")
    panel.legend()
    return figure


def _statements(found: dict[Noise, Numbers], apart: dict[Noise, float]) -> list[Statement]:
    right = {noise: hotelling(rows, expected(noise.damping_ratio)) for noise, rows in found.items()}
    wrong = {noise: hotelling(rows, expected(noise.damping_ratio, printed=True)) for noise, rows in found.items()}

    def listed(values: dict[Noise, float]) -> str:
        return "; ".join(f"c = {n.damping_ratio:g}, step {n.time_step:g} s: p = {p:.2g}" for n, p in values.items())

    def variance(index: int) -> str:
        return "; ".join(
            f"{rows[:, index].mean():.4f} +- {rows[:, index].std(ddof=1) / math.sqrt(len(rows)):.4f}"
            for rows in found.values()
        )

    def near(index: int) -> bool:
        return all(
            abs(rows[:, index].mean() - 1.0) < 4.0 * rows[:, index].std(ddof=1) / math.sqrt(len(rows))
            for rows in found.values()
        )

    first, second = (rows for noise, rows in found.items() if noise.damping_ratio == 0.5)
    same = _same(first, second)
    return [
        Statement("5.11", "<x_b^2> = A_b^2", "over A_b^2: " + variance(0), verdict(near(0))),
        Statement("5.12", "<v_b^2> = A_b^2 omega_b^2", "over that: " + variance(1), verdict(near(1))),
        Statement("5.11 to 5.13", "with sqrt(1 - c^2)", listed(right), verdict(min(right.values()) > SIGNIFICANT)),
        Statement("5.13", "sqrt(1 - c), as printed", listed(wrong), verdict(min(wrong.values()) > SIGNIFICANT)),
        Statement(
            "5.3.1",
            "x, y and angle of both supports are independent",
            listed(apart),
            verdict(min(apart.values()) > SIGNIFICANT),
        ),
        Statement(
            "5.3.1",
            "(ours) an exact Gaussian step: statistics do not depend on the time step",
            f"moments with steps of 1e-3 and 2.5e-4 s: p = {same:.2g}",
            verdict(same > SIGNIFICANT),
        ),
    ]


def _same(first: Numbers, second: Numbers) -> float:
    """p-value of the hypothesis that both have the same mean, by pairing the pieces."""
    count = min(len(first), len(second))
    return hotelling(first[:count] - second[:count], np.zeros(first.shape[1]))
