"""`python -m studies figure`."""

import time
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate, options
from jostle_lab.errors import LabError, did_you_mean
from jostle_lab.plots.style import house_style
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Verdict, write
from studies.registry import GROUPS, MODULES, NUMBERS, STUDIES, maker


def make_figure(number: str, laboratory: Laboratory, results: Path, quick: bool, seeds: int | None) -> list[Path]:
    """Make a figure and write its folder; return the paths."""
    folder = results / f"figure-{number}"
    folder.mkdir(parents=True, exist_ok=True)  # before the work, which would be lost
    command = f"python -m studies figure {number}" + (" --quick" if quick else "")
    command += f" --seeds {seeds}" if seeds is not None else ""
    begun, counting = time.perf_counter(), replace(laboratory)
    with house_style():
        product = maker(number)(counting, quick, seeds)
        footer = (
            f"program {laboratory.version}, {counting.spent:.0f} s of one processor in all; this call "
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
        int | None, typer.Option(min=2, max=100_000, help="Packings or seeds of each point; each figure has its own.")
    ] = None,
    processes: options.ProcessesOption = 2,
    program: options.ProgramOption = None,
    scheduler: options.SchedulerOption = None,
    progress: options.ProgressOption = True,
) -> None:
    """Compute figures of the papers anew: data.csv, figure.png, figure.svg and statements.md, in results/figure-N.

    Safe to interrupt and to repeat: finished runs are kept in results/runs.
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
