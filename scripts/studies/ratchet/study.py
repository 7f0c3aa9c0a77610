"""A figure of F as a study: which cases, how they are drawn, which statements they answer. And curves."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, shades, velocity_axes
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, Numbers, bootstrap, zero_crossings
from jostle_lab.verdicts import Judgement, Verdict, above, below, every
from studies.ratchet.cases import Case, Plan, Point, Points, lean_on_each_other
from studies.ratchet.observe import Observed, observe_runs

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
    others: Callable[[Observed], list[Statement]] = field(default=lambda _: [])
    """Statements on other outputs than the velocity."""

    def make(self, laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
        """Run what is missing; `seeds`, if given, for every point."""
        plan = {case: seeds or number for case, number in self.plan(quick).items()}
        observed = observe_runs(laboratory, plan, f"figure {self.number}")
        points = lean_on_each_other(observed.points())
        tables = [table.markdown() for table in self.tables(points)]
        rows = [_row(case, point) for case, point in points.items()]
        statements = [*self.statements(points), *self.others(observed)]
        return Product(self.title, rows, self.draw(points), statements, self.notes, tables)


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

    def moving(self) -> "Curve":
        """The part whose points are not at rest."""
        kept = [(x, p) for x, p in zip(self.x, self.points, strict=True) if not p.at_rest]
        return Curve(tuple(x for x, _ in kept), tuple(p for _, p in kept))

    def crossings(self) -> list[Estimate]:
        """Sign changes for certain, points at rest left out."""
        moving = [(x, p.estimate) for x, p in zip(self.x, self.points, strict=True) if not p.at_rest]
        return zero_crossings([x for x, _ in moving], [e for _, e in moving])

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
    found: Mapping[float, Curve], label: Callable[[float], str], x_label: str, width: float = 0.86 * WIDTH
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


def stated(place: str, printed: str, found: str, judgement: Judgement, cause: str = "") -> Statement:
    """A statement with the verdict of a judgement; `cause` is told where that is not agreement."""
    told = "" if judgement.verdict is Verdict.AGREES else cause
    return Statement.judged(place, printed, found, judgement, told)


def signed(estimates: Sequence[Estimate], sign: int) -> Judgement:
    """Whether all of `estimates` have the sign 1 or -1."""
    side, rule = (above, "above") if sign > 0 else (below, "below")
    return every((side(e, 0.0) for e in estimates), f"every one {rule} 0 by two errors")


def reverses(curve: Curve) -> Judgement:
    """Whether a curve has exactly one sign change, and ends with the sign that it did not have before."""
    crossings, moving = curve.crossings(), [p for p in curve.points if not p.at_rest]
    rule = "exactly one sign change between points that are three errors from 0, and the last point is beyond it"
    if len(crossings) == 1 and moving[-1].sign() != 0:
        return Judgement(Verdict.AGREES, rule)
    # Without a change for certain the errors may hide one near a point that is not of either sign.
    undecided = not crossings and any(p.sign() == 0 for p in moving)
    return Judgement(Verdict.OPEN if undecided else Verdict.DISAGREES, rule)
