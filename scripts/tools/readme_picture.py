"""`python -m tools readme-picture`: the picture of the README, as `scripts/demo` draws it.

Of the demo only the first packing is shaken, and only with the amplitudes down to the one that is drawn: nothing that
comes later changes it. Kept in few colours, which makes the file small. A test makes it anew and compares.
"""

import tempfile
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray
from PIL import Image, ImageChops

from jostle_lab import options
from jostle_lab.demos.packing.command import demo
from jostle_lab.demos.packing.figures import GAMMA_DRAWN
from jostle_lab.demos.packing.schedules import AMPLITUDES
from jostle_lab.errors import LabError
from jostle_lab.protocol.results import Results
from tools.paths import README_PICTURE

PICTURE = "packing.png"
SHAKEN = 4
"""Amplitudes of the demo from the strongest on."""
COLOURS = 64
THUMBNAIL = (160, 100)
"""Size at which two pictures are compared [pixels]."""
ALIKE = 3.0
"""Largest `difference` of pictures that show the same; one without any text differs by 2.2, the next Gamma by 17."""
SHIFTS = (-6, -4, -2, 0, 2, 4, 6)
"""By which one may be moved to fit the other [pixels]."""


def make(fmu: Path | None, out: Path, progress: bool = False) -> None:
    """Shake as the demo does, and write the picture."""
    amplitudes = ",".join(AMPLITUDES.split(",")[:SHAKEN])
    with tempfile.TemporaryDirectory() as folder:
        demo(fmu, Path(folder), amplitudes=amplitudes, packings=1, processes=1, progress=progress)
        weakest = min(row["gamma_true"] for row in Results(Path(folder)).amplitudes_of(1))
        if weakest > GAMMA_DRAWN:
            raise LabError(f"Gamma is {weakest:.2f} at the last of {amplitudes}: the demo may draw a later one.")
        Image.open(Path(folder) / PICTURE).convert("RGB").quantize(COLOURS).save(out, "PNG", optimize=True)


def difference(first: Path, second: Path) -> float:
    """Mean difference of two pictures in steps of 255, each made small and one moved by some pixels to fit the other.

    So edges are averaged away, and text of another width, which moves what is beside it. Disks of other colours or in
    other places are not.
    """
    with Image.open(first) as one, Image.open(second) as other:
        wanted, found = one.convert("RGB"), other.convert("RGB").resize(one.size)
    reference = _small(wanted)
    moved = (ImageChops.offset(found, x, y) for x in SHIFTS for y in SHIFTS)
    return min(float(np.abs(reference - _small(picture)).mean()) for picture in moved)


def _small(picture: Image.Image) -> NDArray[np.float64]:
    return np.asarray(picture.resize(THUMBNAIL, Image.Resampling.BOX), dtype=np.float64)


def readme_picture(
    fmu: options.FmuOption = None,
    out: Annotated[Path, typer.Option(help="PNG file.")] = README_PICTURE,
    progress: options.ProgressOption = True,
) -> None:
    """Draw the picture of the README as `scripts/demo` does; about a minute."""
    make(fmu, out, progress)
    typer.echo(out)
