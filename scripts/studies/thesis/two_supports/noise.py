"""The random supports themselves against P 5.11 to 5.13: variances, correlation in time, independence.

A record is cut into pieces much longer than the memory 1 / (c omega_b). Each piece of each coordinate gives one vector
of moments; Hotelling's T^2 tests whether their mean is the formula's. The statistics must not depend on the time step.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy import stats

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.tables import Table
from jostle_lab.verdicts import LEAST_PROBABILITY, Judgement, every, near, true
from studies.thesis.two_supports.runs import ENGINE, SCENE

AMPLITUDE, ANGULAR_FREQUENCY = 5e-5, 20.0 * math.pi
"""A_b [m] and omega_b [rad/s] of P 5.3.1; the radius is 1 m, so that the angle has the same number."""
SAMPLE = 0.005
"""[s], of a period of 0.1 s."""
LAGS = (2, 5, 9, 14, 20)
"""In samples."""
PIECE = 10.0
"""[s]."""
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


def products(table: Table) -> Numbers:
    """Mean product of each pair of coordinates in each piece, without units; shape (pieces, 15)."""
    length = round(PIECE / SAMPLE)
    x = np.array([table[name][round(1.0 / SAMPLE) :] for name in COORDINATES]) / AMPLITUDE
    pairs = [(i, j) for i in range(6) for j in range(i)]
    cut = [x[:, k * length : (k + 1) * length] for k in range(x.shape[1] // length)]
    return np.array([[np.mean(piece[i] * piece[j]) for i, j in pairs] for piece in cut])


def independence(rows: Numbers) -> float:
    """p-value of the hypothesis that no two of the six coordinates are correlated."""
    return hotelling(rows, np.zeros(rows.shape[1]))


def kept(laboratory: Laboratory, noise: Noise, what: str, reduce: Callable[[Table], Numbers]) -> Numbers:
    """What a record is reduced to, rows by columns; the record itself is too long to be kept."""

    def compute() -> tuple[Table, float]:
        plain = replace(laboratory, records=None)
        rows = reduce(plain.run([noise.run()], "supports")[noise.run()])
        return {str(i): column for i, column in enumerate(rows.T)}, plain.spent

    table = laboratory.computed(f"{what} of {noise.run().key()}", compute)
    return np.column_stack([table[str(i)] for i in range(len(table))])


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Two damping ratios, two time steps."""
    seconds = 400.0 if quick else 800.0
    noises = [Noise(0.5, 1e-3, seconds), Noise(0.5, 2.5e-4, seconds), Noise(0.2, 1e-3, seconds)]
    found = {noise: kept(laboratory, noise, "moments", moments) for noise in noises}
    apart = {noise: independence(kept(laboratory, noise, "products", products)) for noise in noises}
    rows = [
        _row(noise, name, column) for noise in noises for name, column in zip(_names(), found[noise].T, strict=True)
    ]
    notes = [
        f"A_b = {AMPLITUDE:g} m, omega_b = 20 pi rad/s, R = 1 m; {seconds:g} s each after 1 s, seed 1; six coordinates "
        f"in pieces of {PIECE:g} s; moments of x / A_b and v / (A_b omega_b)",
        f"p: Hotelling's T^2 over all moments together; refused below {LEAST_PROBABILITY:g}",
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
    figure = Figure(figsize=(0.85 * WIDTH, 3.6), layout="constrained")
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

    def variance(index: int) -> list[Estimate]:
        return [Estimate.over_runs(rows[:, index]) for rows in found.values()]

    def judged(values: dict[Noise, float]) -> Judgement:
        rule = f"p > {LEAST_PROBABILITY / len(values):.1g} in each record, which is {LEAST_PROBABILITY:g} in all"
        return every([true(p > LEAST_PROBABILITY / len(values), "") for p in values.values()], rule)

    first, second = (rows for noise, rows in found.items() if noise.damping_ratio == 0.5)
    same = _same(first, second)
    variances = [
        Statement.judged(
            place,
            printed,
            "over that: " + "; ".join(map(str, variance(index))),
            every([near(v, 1.0, 0.05) for v in variance(index)], "each record within 5 %, with two errors"),
        )
        for place, printed, index in (("5.11", "<x_b^2> = A_b^2", 0), ("5.12", "<v_b^2> = A_b^2 omega_b^2", 1))
    ]
    return [
        *variances,
        Statement.judged("5.11 to 5.13", "all moments, 5.13 with sqrt(1 - c^2)", listed(right), judged(right)),
        Statement.judged(
            "5.13",
            "sqrt(1 - c), as printed",
            listed(wrong),
            judged(wrong),
            "the damped frequency of 5.10 is omega_b sqrt(1 - c^2): a square was lost in print",
        ),
        Statement.judged("5.3.1", "x, y and angle of both supports are independent", listed(apart), judged(apart)),
        Statement.judged(
            "5.3.1",
            "(ours) an exact Gaussian step: statistics do not depend on the time step",
            f"moments with steps of 1e-3 and 2.5e-4 s: p = {same:.2g}",
            true(same > LEAST_PROBABILITY, f"p > {LEAST_PROBABILITY:g}"),
        ),
    ]


def _same(first: Numbers, second: Numbers) -> float:
    """p-value of the hypothesis that both have the same mean, by pairing the pieces."""
    count = min(len(first), len(second))
    return hotelling(first[:count] - second[:count], np.zeros(first.shape[1]))
