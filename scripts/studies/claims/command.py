"""`python -m jostle_lab claims`."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate, options
from jostle_lab.errors import LabError, did_you_mean
from jostle_lab.files import replace_text
from jostle_lab.runs.laboratory import Laboratory
from studies.examples import GENERATED

PAGE = "claims.md"


def claims(
    compute: Annotated[
        list[str] | None,
        typer.Option(metavar="ROW", help="First do the runs of a row or a figure that are not kept; or all."),
    ] = None,
    docs: Annotated[Path, typer.Option(help="Folder of the page and of the records.")] = GENERATED,
    results: Annotated[Path, typer.Option(help="Folder of the runs.")] = Path("results"),
    processes: options.ProcessesOption = 2,
    program: options.ProgramOption = None,
    scheduler: options.SchedulerOption = None,
    progress: options.ProgressOption = True,
) -> None:
    """Write docs/generated/claims.md: every claim of both papers beside what was found, from the records of the runs.

    Safe to interrupt and to repeat: finished runs are kept in results/runs.
    """
    from studies.claims.page import page
    from studies.claims.sections import FOLDER, forget_others, kept, section
    from studies.registry import ON_THE_PAGE

    wanted = _figures(compute or [], list(ON_THE_PAGE))
    laboratory = Laboratory(locate.program(program), results / "runs", processes, progress, scheduler)
    if wanted:
        (docs / FOLDER).mkdir(parents=True, exist_ok=True)  # before the work, whose records would be lost
    computed = {
        figure: section(figure, laboratory, docs, compute=True)[0] for figure in ON_THE_PAGE if figure in wanted
    }
    sections, missing = kept(laboratory, docs, computed)
    for figure in missing:
        typer.echo(f"{figure} has no whole record and is left out: --compute {figure} completes it", err=True)
    if wanted:
        forget_others(sections, docs)
    replace_text(docs / PAGE, page(sections, missing))
    typer.echo(docs / PAGE)


def _figures(names: list[str], known: list[str]) -> set[str]:
    """Figures of rows such as 3.6-2, of figures, or all."""
    if "all" in names:
        return set(known)
    figures = [name if name in known else name.rpartition("-")[0] for name in names]
    for name, figure in zip(names, figures, strict=True):
        if figure not in known:
            raise LabError(
                f"No row or figure {name}.{did_you_mean(name, known)} There are {', '.join(known)}; and all."
            )
    return set(figures)
