"""`jostle_lab film`: a film of a recorded run, or of a scene that is run now."""

import warnings
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import options
from jostle_lab.errors import LabError, require

COLOUR_HELP = "Of the disks: spin, speed, force or none."


def film(
    run: Annotated[
        str,
        typer.Argument(
            metavar="RUN",
            help="File of a run: .nc, .csv or .parquet; or a scene: packing, ratchet, wedge, three_disk.",
        ),
    ],
    out: Annotated[Path, typer.Option(help="File: .mp4, .gif, .webp, or .html, one page that plays offline.")],
    colour: Annotated[str, typer.Option(help=COLOUR_HELP)] = "spin",
    contacts: Annotated[
        bool | None,
        typer.Option(help="Draw lines between disks that press on each other. Without it: where forces are known."),
    ] = None,
    slow: Annotated[
        float | None,
        typer.Option(help="How many times slower than real. Without it: a period of the drive takes some 0.6 s."),
    ] = None,
    start: Annotated[float | None, typer.Option(help="Simulated time of the first frame [s].")] = None,
    end: Annotated[float | None, typer.Option(help="Simulated time of the last frame [s]; of a file.")] = None,
    height: Annotated[int | None, typer.Option(help="Of the film [pixels]; 720, GIF and WebP 480.")] = None,
    fps: Annotated[float | None, typer.Option(help="Frames a second; 30, WebP 25, GIF 10.")] = None,
    seconds: Annotated[float | None, typer.Option(help="Simulated time of a scene [s].")] = None,
    every: Annotated[
        float | None, typer.Option(help="Time between two samples of a scene [s]. Without it: 32 a period.")
    ] = None,
    engine: Annotated[str | None, typer.Option(help="Of a scene; without it its first one.")] = None,
    drive: Annotated[str | None, typer.Option(help="Of a scene; without it a sine where there is one.")] = None,
    disks: Annotated[int | None, typer.Option(help="Of a scene.")] = None,
    settings: options.SetOption = None,
    progress: options.ProgressOption = True,
) -> None:
    """Film of a run: disks that turn, the base that moves, forces between them; in slow motion."""
    from jostle_lab.film import FilmWarning, make, sources

    make.check(out, colour, height, fps)
    if sources.is_file(run):
        given = {"--seconds": seconds, "--every": every, "--engine": engine, "--drive": drive, "--disks": disks}
        if wrong := [name for name, value in given.items() if value is not None] + (["--set"] if settings else []):
            raise LabError(f"{wrong[0]} is for a scene, but {run} is a file. Leave it out, or name a scene.")
        data, begin = sources.read(Path(run)), start
    else:
        if end is not None:
            raise LabError("--end is for a file. A scene runs for --seconds from --start on.")
        begin = None
        values = dict(options.parameters(settings))
        from_time = require("--start [s]", start or 0.0, 0.0, 1e9, "Give a time in seconds.")
        data = sources.run_scene(run, seconds, every, from_time, engine, drive, disks, values)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        made = make.film(
            data,
            out,
            colour=colour,
            contacts=contacts,
            slow=slow,
            start=begin,
            end=end,
            height=height,
            fps=fps,
            progress=None if progress else False,
        )
    for warning in told:
        if issubclass(warning.category, FilmWarning):
            typer.echo(f"warning: {warning.message}", err=True)
    typer.echo(made)
