"""`python -m tools readme-film`: the moving picture of the README, a packing in slow motion.

A loop of whole periods of the base. A test makes it anew and compares what is seen.
"""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jostle_lab import options
from jostle_lab.film import encode
from jostle_lab.film.make import write, write_script
from jostle_lab.film.script import Script
from jostle_lab.film.sources import package
from tools.paths import README_FILM

if TYPE_CHECKING:
    import xarray as xr

FREQUENCY, AMPLITUDE = 12.0, 3e-3
"""Of the base [Hz, m]: slow and strong enough that it is seen to move."""
START, PERIODS, SAMPLES = 1.0, 4, 256
"""When the film begins [s], how many periods it shows, and samples of each."""
SLOW, FPS, HEIGHT, QUALITY = 9.0, 14.0, 376, 45


def recorded() -> "xr.Dataset":
    """The run that is shown."""
    simulation = package().Simulation("packing", **{"drive.frequency": FREQUENCY, "drive.amplitude": AMPLITUDE})
    simulation.advance_to(START)
    found: xr.Dataset = simulation.run(PERIODS / FREQUENCY, every=1.0 / (SAMPLES * FREQUENCY))
    return found


def script_of(data: "xr.Dataset", progress: bool | None = None) -> Script:
    """The film of a run of whole periods; its last frame is the one before the first of the next loop."""
    frame = 1.0 / (SLOW * FPS)
    span = float(data["time"][-1] - data["time"][0])
    end = START + (math.ceil(span / frame - 1e-6) - 1) * frame
    return write_script(
        data, ".webp", contacts=True, slow=SLOW, fps=FPS, height=HEIGHT, start=START, end=end, progress=progress
    )


def readme_film(
    out: Annotated[Path, typer.Option(help="WebP file.")] = README_FILM,
    progress: options.ProgressOption = True,
) -> None:
    """Make the moving picture of the README; some ten seconds."""
    shown = None if progress else False
    with encode.whole(out) as draft:
        write(script_of(recorded(), shown), draft, shown, QUALITY)
    typer.echo(out)
