"""F Figs 13 and 14 as studies: the quoted velocity, the fields drawn as in F, and what F reads off them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement, verdict
from jostle_lab.statistics.estimates import Estimate
from studies.ratchet import quoted
from studies.ratchet.cases import Case, Plan, Points
from studies.ratchet.fields import Fields, Flow, draw, flow_of, observe
from studies.ratchet.observe import by_sweep
from studies.ratchet.study import Table


@dataclass(frozen=True)
class FlowStudy:
    """One of the two figures."""

    number: str
    title: str
    case: Case
    windows: Sequence[int]
    """Phase windows j of (a), (b), (c)."""
    negative: bool

    def plan(self, quick: bool) -> Plan:
        """Runs of the quoted velocity."""
        return quoted.plan(self.case, quick)

    def statements(self, points: Points, flow: Flow) -> list[Statement]:
        """The velocity, then the mechanism."""
        return [*quoted.statements(points, self.case), *self._mechanism(flow)]

    def tables(self, points: Points) -> list[Table]:
        """What the velocity depends on."""
        return quoted.tables(points, self.case)

    def observe(self, laboratory: Laboratory, quick: bool) -> Fields:
        """The fields: ten seeds of 30 s."""
        return observe(laboratory, self.case, 3 if quick else 10, f"figure {self.number}, fields")

    def make(self, laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
        """Run what is missing."""
        plan = {case: seeds or number for case, number in self.plan(quick).items()}
        points = by_sweep(laboratory, plan, f"figure {self.number}")
        fields = self.observe(laboratory, quick)
        notes = (
            f"h = {self.case.height:g} mm, a = {self.case.asymmetry:g}, f = {self.case.frequency:g} Hz, "
            f"{self.case.disks} disks, ten teeth, tip of 0.4 mm; fields of {len(fields.mass)} seeds of 30 s after 1 s",
            "boxes of w/6, phase windows j of 2 pi/6, accumulated exactly along each flight; teeth in mid-window",
            "arrows: momentum, on one scale in Figs 13 and 14; disks: radii proportional to mass",
        )
        tables = [table.markdown() for table in self.tables(points)]
        picture = draw(self.case, fields, self.windows)
        statements = self.statements(points, flow_of(self.case, fields))
        return Product(self.title, _rows(fields), picture, statements, notes, tables)

    def _mechanism(self, flow: Flow) -> list[Statement]:
        place = quoted.PLACES[self.case]
        across, down = flow.sliding
        sinking = Estimate(-down.mean, down.error)
        left = f"{flow.to_the_left} of the mass thrown up near the teeth is in boxes that move to the left"
        if self.negative:
            return [
                Statement(
                    f"V, {place}",
                    "particles that bounce off hit the opposite side, which reverses their horizontal impulse",
                    f"{left}; gain of the mean horizontal velocity while the base rises: {flow.impulse} cm/s",
                    verdict(flow.to_the_left.mean > 0.5 and flow.impulse.mean < -3.0 * flow.impulse.error),
                )
            ]
        return [
            Statement(
                f"V, {place}",
                "particles slide down the side with the smaller slope",
                f"just above that side in window 4, against the base: {across} cm/s to the right, {sinking} cm/s down",
                verdict(across.mean > 3.0 * across.error and down.mean < -3.0 * down.error),
            ),
            Statement(
                f"V, {place}",
                "while the base rises they are given a positive net horizontal impulse",
                f"gain of the mean horizontal velocity from the lowest to the highest base: {flow.impulse} cm/s",
                verdict(flow.impulse.mean > 3.0 * flow.impulse.error),
            ),
            Statement(
                f"V, {place}",
                "most particles do not collide with the opposite side",
                f"{left}; collisions of single disks are not in the fields",
                verdict(flow.to_the_left.mean < 0.5),
            ),
        ]


def _rows(fields: Fields) -> list[dict[str, Any]]:
    mass, momentum = fields.mass.mean(axis=0), fields.momentum.mean(axis=0)
    return [
        {
            "phase": j,
            "x_mm": float(x),
            "y_mm": float(y),
            "mass": float(mass[j, row, column]),
            "momentum_x": float(momentum[j, row, column, 0]),
            "momentum_y": float(momentum[j, row, column, 1]),
        }
        for j in range(len(mass))
        for row, y in enumerate(fields.y)
        for column, x in enumerate(fields.x)
        if mass[j, row, column] > 0.0
    ]


FORWARDS = FlowStudy("F13", "F Fig. 13: positive transport", quoted.POSITIVE, (4, 0, 2), negative=False)
BACKWARDS = FlowStudy("F14", "F Fig. 14: negative transport", quoted.NEGATIVE, (4, 0, 1), negative=True)
