"""`python -m jostle_lab figure`."""

import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Annotated

import matplotlib as mpl
import typer

from jostle_lab.errors import LabError
from jostle_lab.figures import STYLE
from jostle_lab.thesis.product import Product, Verdict, write
from jostle_lab.thesis.runs import Laboratory

Maker = Callable[[Laboratory, bool, int | None], Product]

MODULES = {
    "3.10": "packing_paths",
    "3.11": "packing_comparison",
    "4.3": "three_disk_region",
    "4.5": "restitution",
    "5.1": "three_disk_regimes",
    "5.2": "three_disk_amplitude:linear",
    "5.3": "three_disk_amplitude:logarithmic",
    "5.4": "three_disk_tilt:linear",
    "5.5": "three_disk_tilt:logarithmic",
    "5.6": "three_disk_path",
    "5.7": "three_disk_amplitude:closed_form",
    "5.8": "three_disk_random:against_amplitude",
    "5.9": "three_disk_random:against_tilt",
    "6.3": "wedge_dynamics",
    "6.4": "wedge_collapse",
    "6.5": "wedge_engines",
    "6.6": "wedge_friction",
    "6.7": "wedge_aperture",
    "6.8": "wedge_restitution",
    "6.9": "wedge_skin",
    "engines": "engines",
    "closed-form": "three_disk_closed_form",
    "supports": "three_disk_supports",
}
"""Figure of the thesis and the module of this package that makes it, with its function if that is not `make`."""
STUDIES = {
    "F3": "experiment:EXPERIMENT",
    "F6": "shape:ASYMMETRY",
    "F7": "shape:HEIGHT",
    "F8": "layers:NEGATIVE",
    "F9": "layers:POSITIVE",
    "F10": "frequency:LAYERS",
    "F11": "threshold:ONSET",
    "F12": "frequency:TRANSITION",
    "F13": "flow:FORWARDS",
    "F14": "flow:BACKWARDS",
}
"""Figure of F and the study in `jostle_lab.ratchet` that makes it."""
NUMBERS = (*MODULES, *STUDIES)
GROUPS = {"all": tuple(MODULES), "F": tuple(STUDIES)}
"""Names for many figures."""


def maker(number: str) -> Maker:
    """The function that makes a figure."""
    if number in STUDIES:
        module, name = STUDIES[number].split(":")
        made: Maker = getattr(import_module(f"jostle_lab.ratchet.{module}"), name).make
        return made
    module, _, function = MODULES[number].partition(":")
    found: Maker = getattr(import_module(f"jostle_lab.thesis.{module}"), function or "make")
    return found


def make_figure(number: str, laboratory: Laboratory, results: Path, quick: bool, seeds: int | None) -> list[Path]:
    """Make a figure and write its folder; return the paths."""
    command = f"python -m jostle_lab figure {number}" + (" --quick" if quick else "")
    command += f" --seeds {seeds}" if seeds is not None else ""
    begun, laboratory.spent = time.perf_counter(), 0.0
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        product = maker(number)(laboratory, quick, seeds)
        footer = (
            f"program {laboratory.version}, {laboratory.spent:.0f} s of one processor in all; this call "
            f"{time.perf_counter() - begun:.0f} s with {laboratory.processes} processes"
        )
        paths = write(product, results / f"figure-{number}", command, footer)
    counts = {v: sum(s.verdict is v for s in product.statements) for v in Verdict}
    typer.echo(f"figure {number}: " + ", ".join(f"{count} {v}" for v, count in counts.items() if count))
    return paths


def figure(
    numbers: Annotated[
        list[str],
        typer.Argument(
            help=f"Figures of the thesis, or all: {', '.join(MODULES)}; of the ratchet, or F: {', '.join(STUDIES)}."
        ),
    ],
    quick: Annotated[
        bool, typer.Option("--quick", help="Fewer points and shorter runs: at most about a minute each.")
    ] = False,
    results: Annotated[Path, typer.Option(help="Folder that gets a folder for each figure.")] = Path("results"),
    seeds: Annotated[
        int | None, typer.Option(min=2, max=1000, help="Packings or seeds of each point; each figure has its own.")
    ] = None,
    processes: Annotated[int, typer.Option(min=1, max=256, help="Runs at the same time.")] = 2,
    program: Annotated[Path, typer.Option(help="The native command line.")] = Path("target/release/jostle"),
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Dask scheduler for the ratchet's sweeps; None: this machine.")
    ] = None,
    progress: Annotated[bool, typer.Option(help="Show progress bars.")] = True,
) -> None:
    """Compute figures of the papers anew: data.csv, figure.png and statements.md, in results/figure-N.

    Safe to interrupt and to repeat: finished runs are kept in results/runs and results/ratchet-sweep.
    """
    chosen = [number for name in numbers for number in GROUPS.get(name, (name,))]
    unknown = [number for number in chosen if number not in NUMBERS]
    if unknown:
        raise LabError(f"No figure {', '.join(unknown)}. There are {', '.join(NUMBERS)}; all of the thesis; and F.")
    laboratory = Laboratory(program, results / "runs", processes, progress, scheduler)
    failures = []
    for number in chosen:
        try:
            for path in make_figure(number, laboratory, results, quick, seeds):
                typer.echo(path)
        except LabError as error:
            failures.append(f"figure {number}: {error}")
    if failures:
        raise LabError("\n".join(failures))
