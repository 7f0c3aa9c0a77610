"""`python -m studies laboratory`."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate, options


def laboratory(
    seconds_per_amplitude: Annotated[
        int, typer.Option(min=8, max=1200, help="Simulated seconds for each amplitude, a quarter of them to relax.")
    ] = 1200,
    packings: Annotated[int, typer.Option(min=2, max=1000, help="Number of packings, and of nearest neighbours.")] = 25,
    results: options.ResultsOption = Path("results"),
    processes: Annotated[int, typer.Option(min=1, max=256, help="Packings shaken at the same time.")] = 2,
    program: options.ProgramOption = None,
    progress: options.ProgressOption = True,
) -> None:
    """Figures 3.1 to 3.4 of the thesis and its chapter 2.4 at an effort of your own, such as that of the thesis.

    The whole schedule of 32 amplitudes on the loudspeaker; finished packings are kept in results/laboratory. Without
    options it is the protocol of the thesis, a day or two of one processor.
    """
    from jostle_lab.plots.style import house_style
    from jostle_lab.runs.laboratory import Laboratory
    from jostle_lab.statements import write
    from studies.thesis.laboratory.figures import products
    from studies.thesis.laboratory.shaking import LISTED, Effort

    effort = Effort(f"schedule-{seconds_per_amplitude}-s", packings, seconds_per_amplitude, LISTED, paths=True)
    native = locate.program(program)
    words = f"python -m studies laboratory --seconds-per-amplitude {seconds_per_amplitude} --packings {packings}"
    with house_style():
        made = products(Laboratory(native, results / "runs", processes, progress), effort)
        for number, product in made.items():
            folder = results / f"laboratory-{seconds_per_amplitude}-s" / f"figure-{number}"
            for path in write(product, folder, words, f"{packings} packings, {seconds_per_amplitude} s each amplitude"):
                typer.echo(path)
