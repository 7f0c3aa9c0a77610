"""A figure of F as a study: which cases, how they are drawn, which statements they answer. And curves."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy import stats
from scipy.optimize import isotonic_regression

from jostle_lab.plots.curves import draw_curve, shades, velocity_axes
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, Verdict
from jostle_lab.statistics.estimates import Estimate, Numbers, bootstrap, zero_crossings
from studies.ratchet.cases import Case, Plan, Point, Points, lean_on_each_other
from studies.ratchet.observe import by_sweep

RESAMPLES = 1000
"""Of the bootstrap over runs."""


@dataclass(frozen=True)
class Table:
    """Numbers beside the statements: what an answer depends on."""

    title: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]

    def markdown(self) -> str:
        """Title and table."""
        lines = [self.header, [":--"] * len(self.header), *self.rows]
        return "\n".join([f"{self.title}:", "", *(f"| {' | '.join(cells)} |" for cells in lines)])


@dataclass(frozen=True)
class Study:
    """One figure of F."""

    number: str
    """As in `figure F6`."""
    title: str
    plan: Callable[[bool], Plan]
    """Cases and seeds, few or all."""
    draw: Callable[[Points], Figure]
    statements: Callable[[Points], list[Statement]]
    notes: Sequence[str]
    tables: Callable[[Points], list[Table]] = field(default=lambda _: [])

    def make(self, laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
        """Run what is missing; `seeds`, if given, for every point."""
        plan = {case: seeds or number for case, number in self.plan(quick).items()}
        points = lean_on_each_other(by_sweep(laboratory, plan, f"figure {self.number}"))
        tables = [table.markdown() for table in self.tables(points)]
        rows = [_row(case, point) for case, point in points.items()]
        return Product(self.title, rows, self.draw(points), self.statements(points), self.notes, tables)


def _row(case: Case, point: Point) -> dict[str, Any]:
    return {
        "height_mm": case.height,
        "asymmetry": case.asymmetry,
        "frequency_hz": case.frequency,
        "gamma": case.gamma,
        "layers": case.layers,
        "disks": case.disks,
        "teeth": case.teeth,
        "seconds": case.seconds,
        "warm_up": case.warm_up,
        "other": " ".join(f"{name}={value!r}" for name, value in case.changes),
        "runs": point.runs,
        "velocity_cm_per_s": point.estimate.mean,
        "error": point.estimate.error,
        "scatter_of_a_run": point.scatter,
    }


@dataclass(frozen=True)
class Curve:
    """Velocity against one parameter."""

    x: tuple[float, ...]
    points: tuple[Point, ...]

    @property
    def estimates(self) -> list[Estimate]:
        """Means and standard errors."""
        return [point.estimate for point in self.points]

    def at(self, x: float) -> Point:
        """The point at `x`."""
        return self.points[self.x.index(x)]

    def between(self, low: float, high: float) -> "Curve":
        """The part with x in [low, high]."""
        kept = [(x, p) for x, p in zip(self.x, self.points, strict=True) if low <= x <= high]
        return Curve(tuple(x for x, _ in kept), tuple(p for _, p in kept))

    def crossings(self) -> list[Estimate]:
        """Sign changes for certain, points at rest left out."""
        moving = [(x, p.estimate) for x, p in zip(self.x, self.points, strict=True) if not p.at_rest]
        return zero_crossings([x for x, _ in moving], [e for _, e in moving])

    def monotone(self, rising: bool) -> float:
        """How well a monotone curve fits: p-value of chi^2 against the best one."""
        means = [e.mean for e in self.estimates]
        weights = [1.0 / max(e.error, 1e-6) ** 2 for e in self.estimates]
        best = isotonic_regression(means, weights=weights, increasing=rising)
        blocks = len(best.blocks) - 1
        freedom = len(means) - blocks
        total = float(np.sum(weights * (best.x - np.array(means)) ** 2))
        return 1.0 if freedom == 0 else float(stats.chi2.sf(total, freedom))

    def extremum(self) -> Estimate:
        """Where a parabola through the points has its vertex; error by the bootstrap over runs."""
        x = np.array(self.x)

        def vertex(*runs: Numbers, axis: int) -> Numbers:
            means = np.stack([np.mean(velocities, axis=axis) for velocities in runs])
            square, linear, _ = np.polyfit(x, means, 2)
            return np.asarray(-0.5 * linear / square)

        samples = [point.numbers for point in self.points]
        drawn = bootstrap(samples, vertex, resamples=RESAMPLES)
        return Estimate(float(vertex(*samples, axis=0)), float(drawn.std(ddof=1)))


def curves(
    points: Points,
    family: Callable[[Case], float],
    x: Callable[[Case], float],
    where: Callable[[Case], bool] = lambda _: True,
) -> dict[float, Curve]:
    """Curves against x(case), one for each value of family(case), both in rising order."""
    groups: dict[float, list[tuple[float, Point]]] = {}
    for case, point in points.items():
        if where(case):
            groups.setdefault(family(case), []).append((x(case), point))
    made = {}
    for value in sorted(groups):
        ordered = sorted(groups[value], key=lambda pair: pair[0])
        made[value] = Curve(tuple(p[0] for p in ordered), tuple(p[1] for p in ordered))
    return made


def plain(case: Case) -> bool:
    """Nothing but the parameters of F IV."""
    return not case.changes and case.seconds in {30.0, 50.0} and case.warm_up == 1.0


def panel_of_curves(
    found: Mapping[float, Curve], label: Callable[[float], str], x_label: str, width: float = 0.72 * WIDTH
) -> Figure:
    """All curves in one panel, dark to light."""
    figure = Figure(figsize=(width, 3.7), layout="constrained")
    panel = figure.subplots()
    velocity_axes(panel, x_label)
    for (value, curve), colour, marker in zip(found.items(), shades(len(found)), "osv^Dph*", strict=False):
        draw_curve(panel, curve.x, curve.estimates, label(value), marker=marker, color=colour)
    panel.legend()
    return figure


def listed(pairs: Iterable[tuple[float, Estimate]]) -> str:
    """x: mean +- error, in a row."""
    return ", ".join(f"{x:g}: {e}" for x, e in pairs)


def joint(estimate: Estimate, value: float, error: float) -> float:
    """Difference from a printed value, in joint standard errors."""
    return (estimate.mean - value) / math.hypot(estimate.error, error)


def share(holds: Sequence[bool]) -> Verdict:
    """Agreement if all hold, partly if some do."""
    if all(holds):
        return Verdict.AGREES
    return Verdict.PARTLY if any(holds) else Verdict.DISAGREES
