"""Points of a plan: the runs of every case and what is read off their last row."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.tables import Table
from studies.ratchet.cases import Case, Plan, Point

CENTIMETRE = 100.0
"""cm in a metre."""


@dataclass(frozen=True)
class Observed:
    """The tables of the runs of a plan."""

    tables: Mapping[Run, Table]
    seeds: Mapping[Case, int]

    def values(self, case: Case, output: str) -> Numbers:
        """Last value of an output in every run of a case, in SI units, in the order of the seeds."""
        runs = [case.run(seed) for seed in range(1, self.seeds[case] + 1)]
        return np.array([self.tables[run][output][-1] for run in runs])

    def mean(self, case: Case, output: str, factor: float = 1.0) -> Estimate:
        """Mean over the runs of a case, times `factor`."""
        return Estimate.over_runs(factor * self.values(case, output))

    def points(self) -> dict[Case, Point]:
        """Transport velocities of every case."""
        return {
            case: Point(tuple((CENTIMETRE * self.values(case, "transport_velocity")).tolist())) for case in self.seeds
        }


def observe_runs(laboratory: Laboratory, plan: Plan, title: str) -> Observed:
    """Every case's runs."""
    runs = [case.run(seed) for case, seeds in plan.items() for seed in range(1, seeds + 1)]
    return Observed(laboratory.run(runs, title), plan)
