"""`python -m tools film-frames`: the pictures of docs/film.md, one frame of three films each."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from PIL import Image

from jostle_lab.film.make import write_script
from jostle_lab.film.sources import run_scene
from jostle_lab.film.stage import Stage
from tools.paths import ROOT

SECONDS, HEIGHT, COLOURS = 0.12, 360, 192


@dataclass(frozen=True)
class Still:
    """One frame of a film of a scene."""

    name: str
    scene: str
    values: dict[str, float]
    frame: int
    engine: str | None = None
    disks: int | None = None
    start: float = 0.0
    options: dict[str, Any] = field(default_factory=dict)


STILLS = (
    Still("film-packing.png", "packing", {}, 18, start=0.5, options={"colour": "force"}),
    Still("film-ratchet.png", "ratchet", {}, 40, disks=60, start=0.5, options={"contacts": False}),
    Still("film-wedge.png", "wedge", {"drive.amplitude": 3e-3, "drive.frequency": 15.0}, 24, "molecular-dynamics"),
)


def draw(folder: Path) -> Iterator[Path]:
    """Draw all of them into a folder."""
    for still in STILLS:
        data = run_scene(still.scene, SECONDS, None, still.start, still.engine, None, still.disks, still.values)
        script = write_script(data, height=HEIGHT, progress=False, **still.options)
        picture = Image.fromarray(np.array(Stage(script).draw(script.frame(still.frame)))).convert("RGB")
        picture.quantize(COLOURS).save(folder / still.name, "PNG", optimize=True)
        yield folder / still.name


def film_frames(out: Annotated[Path, typer.Option(help="Folder.")] = ROOT / "docs") -> None:
    """Draw the pictures of docs/film.md; some seconds."""
    for path in draw(out):
        typer.echo(path)
