"""F Figs 13 and 14 as studies: the quoted velocity, the fields drawn as in F, and what F reads off them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import Table as Columns
from jostle_lab.verdicts import above, below, every
from studies.ratchet import quoted
from studies.ratchet.cases import Case, Plan, Points
from studies.ratchet.fields import PHASES, Flow, MeanFields, field_run, flow_of, gather
from studies.ratchet.fields_picture import SHOWN_HEIGHT, draw
from studies.ratchet.observe import Observed, observe_runs
from studies.ratchet.sides import statements as of_sides
from studies.ratchet.sides import tables as side_tables
from studies.ratchet.study import Table, stated


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

    def observe(self, laboratory: Laboratory, quick: bool) -> tuple[MeanFields, Flow]:
        """Fields averaged over seeds of 30 s, ten unless quick, and what is read off them."""
        runs = [field_run(self.case, seed) for seed in range(1, 4 if quick else 11)]

        def compute() -> tuple[Columns, float]:
            plain = replace(laboratory, records=None)
            fields = gather(list(plain.run(runs, f"figure {self.number}, fields").values()))
            return pack(fields.mean(), flow_of(self.case, fields)), plain.spent

        return unpack(laboratory.computed(f"means over {len(runs)} seeds of {runs[0].key()}", compute))

    def make(self, laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
        """Run what is missing."""
        plan = {case: seeds or number for case, number in self.plan(quick).items()}
        observed = observe_runs(laboratory, plan, f"figure {self.number}")
        points = observed.points()
        fields, flow = self.observe(laboratory, quick)
        notes = (
            f"h = {self.case.height:g} mm, a = {self.case.asymmetry:g}, f = {self.case.frequency:g} Hz, "
            f"{self.case.disks} disks, ten teeth, tip of 0.4 mm",
            f"fields of {3 if quick else 10} seeds of 30 s after 1 s",
            "boxes of w/6, phase windows j of 2 pi/6, accumulated exactly along each flight; teeth in mid-window",
            "arrows: momentum, on one scale in Figs 13 and 14; disks: radii proportional to mass",
        )
        tables = [*self.tables(points), *side_tables(observed, self.case)]
        statements = [*self.statements(points, flow), *self._ceiling(observed), *of_sides(observed, self.case)]
        picture = draw(self.case, fields, self.windows)
        return Product(self.title, _rows(fields), picture, statements, notes, [table.markdown() for table in tables])

    def _ceiling(self, observed: Observed) -> list[Statement]:
        """F III: hardly any disk meets the upper wall."""
        share = Estimate.over_runs(
            observed.values(self.case, "collisions.ceiling") / observed.values(self.case, "collisions")
        )
        return [
            stated(
                f"III, at {quoted.PLACES[self.case]}",
                "the cell is so high that the number of particles hitting the upper wall is negligible",
                f"share of all impacts: {share}, in a cell of 600 mm",
                below(share, NEGLIGIBLE),
                "F does not give the height of its cell",
            )
        ]

    def _mechanism(self, flow: Flow) -> list[Statement]:
        place = quoted.PLACES[self.case]
        across, down = flow.sliding
        sinking = Estimate(-down.mean, down.error)
        left = f"{flow.to_the_left} of the mass thrown up near the teeth is in boxes that move to the left"
        gain = "gain of the mean horizontal velocity from the lowest to the highest base"
        more = "more runs decide"
        if self.negative:
            return [
                stated(
                    f"V, {place}",
                    "the horizontal impulse of particles that bounce off is reversed, and the net current negative",
                    f"{left}; {gain}: {flow.impulse} cm/s",
                    every(
                        [above(flow.to_the_left, 0.5), below(flow.impulse, 0.0)],
                        "more than half to the left, and the gain below 0, by two errors",
                    ),
                    more,
                )
            ]
        return [
            stated(
                f"V, {place}",
                "particles slide down the side with the smaller slope",
                f"just above that side in window 4, against the base: {across} cm/s to the right, {sinking} cm/s down",
                every([above(across, 0.0), above(sinking, 0.0)], "both above 0 by two errors"),
                more,
            ),
            stated(
                f"V, {place}",
                "while the base rises they are given a positive net horizontal impulse",
                f"{gain}: {flow.impulse} cm/s",
                above(flow.impulse, 0.0),
                more,
            ),
        ]


NEGLIGIBLE = 0.001
"""Share of impacts."""


def pack(fields: MeanFields, flow: Flow) -> Columns:
    """What is kept: the fields where they are drawn, and the numbers read off the whole of them."""
    shown = fields.y < SHOWN_HEIGHT
    numbers = (*flow.sliding, flow.impulse, flow.to_the_left)
    return {
        "x": fields.x,
        "y": fields.y[shown],
        "mass": fields.mass[:, shown].ravel(),
        "momentum": fields.momentum[:, shown].ravel(),
        "flow": np.array([n.mean for n in numbers]),
        "flow_error": np.array([n.error for n in numbers]),
    }


def unpack(kept: Columns) -> tuple[MeanFields, Flow]:
    """What `pack` made."""
    x, y = kept["x"], kept["y"]
    shape = (PHASES, len(y), len(x))
    across, down, impulse, left = (Estimate(*pair) for pair in zip(kept["flow"], kept["flow_error"], strict=True))
    fields = MeanFields(x, y, kept["mass"].reshape(shape), kept["momentum"].reshape((*shape, 2)))
    return fields, Flow((across, down), impulse, left)


def _rows(fields: MeanFields) -> list[dict[str, Any]]:
    mass, momentum = fields.mass, fields.momentum
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
