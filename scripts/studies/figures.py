"""`python -m studies figure`."""

import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate, options
from jostle_lab.errors import LabError, did_you_mean
from jostle_lab.plots.style import house_style
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Verdict, write

Maker = Callable[[Laboratory, bool, int | None], Product]

MODULES = {
    "3.10": "packing.paths",
    "3.11": "packing.comparison",
    "4.3": "two_supports.region",
    "4.5": "restitution",
    "5.1": "two_supports.regimes",
    "5.2": "two_supports.amplitude:linear",
    "5.3": "two_supports.amplitude:logarithmic",
    "5.4": "two_supports.tilt:linear",
    "5.5": "two_supports.tilt:logarithmic",
    "5.6": "two_supports.path",
    "5.7": "two_supports.amplitude:closed_form",
    "5.8": "two_supports.random_supports:against_amplitude",
    "5.9": "two_supports.random_supports:against_tilt",
    "6.3": "wedge.dynamics",
    "6.4": "wedge.collapse",
    "6.5": "wedge.engines",
    "6.6": "wedge.friction",
    "6.7": "wedge.aperture",
    "6.8": "wedge.restitution",
    "6.9": "wedge.stiffness_ratio",
    "engines": "engines",
    "closed-form": "two_supports.closed_form",
    "supports": "two_supports.noise",
}
"""Figure of the thesis and the module of `studies.thesis` that makes it, with its function if that is not `make`."""
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
"""Figure of F and the study in `studies.ratchet` that makes it."""
NUMBERS = (*MODULES, *STUDIES)
GROUPS = {"all": tuple(MODULES), "F": tuple(STUDIES)}
"""Names for many figures."""


def maker(number: str) -> Maker:
    """The function that makes a figure."""
    if number in STUDIES:
        module, name = STUDIES[number].split(":")
        made: Maker = getattr(import_module(f"studies.ratchet.{module}"), name).make
        return made
    module, _, function = MODULES[number].partition(":")
    found: Maker = getattr(import_module(f"studies.thesis.{module}"), function or "make")
    return found


def make_figure(number: str, laboratory: Laboratory, results: Path, quick: bool, seeds: int | None) -> list[Path]:
    """Make a figure and write its folder; return the paths."""
    folder = results / f"figure-{number}"
    folder.mkdir(parents=True, exist_ok=True)  # before the work, which would be lost
    command = f"python -m studies figure {number}" + (" --quick" if quick else "")
    command += f" --seeds {seeds}" if seeds is not None else ""
    begun, laboratory.spent = time.perf_counter(), 0.0
    with house_style():
        product = maker(number)(laboratory, quick, seeds)
        footer = (
            f"program {laboratory.version}, {laboratory.spent:.0f} s of one processor in all; this call "
            f"{time.perf_counter() - begun:.0f} s with {laboratory.processes} processes"
        )
        paths = write(product, folder, command, footer)
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
    processes: options.ProcessesOption = 2,
    program: options.ProgramOption = None,
    scheduler: options.SchedulerOption = None,
    progress: options.ProgressOption = True,
) -> None:
    """Compute figures of the papers anew: data.csv, figure.png and statements.md, in results/figure-N.

    Safe to interrupt and to repeat: finished runs are kept in results/runs and results/ratchet-sweep.
    """
    chosen = [number for name in numbers for number in GROUPS.get(name, (name,))]
    unknown = [number for number in chosen if number not in NUMBERS]
    if unknown:
        near = did_you_mean(unknown[0], (*NUMBERS, *GROUPS))
        raise LabError(
            f"No figure {', '.join(unknown)}.{near} There are {', '.join(NUMBERS)}; all of the thesis; and F."
        )
    laboratory = Laboratory(locate.program(program), results / "runs", processes, progress, scheduler)
    failures = []
    for number in chosen:
        try:
            for path in make_figure(number, laboratory, results, quick, seeds):
                typer.echo(path)
        except LabError as error:
            failures.append(f"figure {number}: {error}")
    if failures:
        raise LabError("\n".join(failures))
