"""Points from a sweep, or from the file of docs/generated/ that keeps them."""

from collections.abc import Mapping
from pathlib import Path

from jostle_lab.errors import LabError
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.store import Store
from jostle_lab.runs.sweep import Sweep, Workers
from jostle_lab.runs.worker import FAILED, Program
from jostle_lab.tables import read_text_rows, write_table
from studies.ratchet.cases import Case, Plan, Point, Points

CENTIMETRE = 100.0
"""cm in a metre."""


def by_sweep(laboratory: Laboratory, plan: Plan, title: str) -> dict[Case, Point]:
    """Every case's runs, by a sweep into the folder of the laboratory's runs."""
    program = Program(str(laboratory.program.resolve()), laboratory.version)
    workers = Workers(laboratory.scheduler, laboratory.processes)
    sweep = Sweep(Store(laboratory.kept.parent / "ratchet-sweep"), program, workers, laboratory.show_progress)
    runs = {(case, seed): case.run(seed) for case, seeds in plan.items() for seed in range(1, seeds + 1)}
    rows = sweep.run(list(runs.values()), title)
    failed = [row for row in rows.values() if row["state"] == FAILED]
    if failed:
        raise LabError(f"{len(failed)} of {len(rows)} runs failed. First: {failed[0]['command']}\n{failed[0]['error']}")
    laboratory.spent += sum(row["processor_seconds"] for row in rows.values())
    return {
        case: Point(
            tuple(
                round(CENTIMETRE * float(rows[runs[case, seed]]["transport_velocity"]), DECIMALS)
                for seed in range(1, seeds + 1)
            )
        )
        for case, seeds in plan.items()
    }


DECIMALS = 3
"""Of the velocities [cm/s]; a single run scatters by 0.1 and more."""
HEADER = ["height_mm", "asymmetry", "frequency_hz", "disks", "teeth", "seconds", "warm_up_s", "other", "cm_per_s"]


def write_points(path: Path, points: Points) -> None:
    """One line for each case: its parameters, and the velocity of every run, in the order of the seeds."""
    rows = []
    for case, point in sorted(points.items(), key=lambda item: str(item[0])):
        numbers = (case.height, case.asymmetry, case.frequency, case.disks, case.teeth, case.seconds, case.warm_up)
        other = " ".join(f"{name}={value!r}" for name, value in case.changes)
        velocities = " ".join(f"{v:g}" for v in point.velocities)
        rows.append(dict(zip(HEADER, (*map(repr, numbers), other, velocities), strict=True)))
    write_table(path, rows)


def read_points(path: Path) -> dict[Case, Point]:
    """What `write_points` wrote."""
    points = {}
    for row in read_text_rows([path]):
        height, asymmetry, frequency, disks, teeth, seconds, warm_up, other, velocities = (row[name] for name in HEADER)
        changes = tuple((name, float(value)) for name, value in (word.split("=") for word in other.split()))
        case = Case(
            float(height),
            float(asymmetry),
            float(frequency),
            int(disks),
            int(teeth),
            float(seconds),
            float(warm_up),
            changes,
        )
        points[case] = Point(tuple(map(float, velocities.split())))
    return points


def chosen(points: Mapping[Case, Point], plan: Plan) -> dict[Case, Point]:
    """The points of a plan, with at most as many runs as it says; raises LabError if one is not there."""
    missing = [case for case in plan if case not in points]
    if missing:
        raise LabError(
            f"{len(missing)} points are not kept, first {missing[0]}. "
            "Compute them: python -m studies ratchet-page --compute"
        )
    return {case: Point(points[case].velocities[:seeds]) for case, seeds in plan.items()}
