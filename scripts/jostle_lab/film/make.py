"""A run in, a film out."""

import math
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from tqdm import tqdm

from jostle_lab.errors import LabError, require
from jostle_lab.film import colours, encode, forces, pace, player, recording, sources
from jostle_lab.film.forces import Forces, NoForcesError, Replayable
from jostle_lab.film.recording import Recording
from jostle_lab.film.scenery import scenery
from jostle_lab.film.script import Script, lay_out
from jostle_lab.film.stage import Stage

if TYPE_CHECKING:
    import xarray as xr

ENDINGS = (".mp4", ".gif", ".webp", ".html")
"""Of films."""
SMALL = (".gif", ".webp")
"""Endings for pages and mails, of less height."""
RATES = {".mp4": 30.0, ".html": 30.0, ".webp": 25.0, ".gif": 10.0}
"""Frames a second; a GIF keeps whole frames, so that few of them make it small."""


class FilmWarning(UserWarning):
    """What a viewer of the film should know."""


def film(
    data: "xr.Dataset | str | Path",
    out: str | Path,
    *,
    colour: str = "spin",
    contacts: bool | None = None,
    slow: float | None = None,
    start: float | None = None,
    end: float | None = None,
    height: int | None = None,
    fps: float | None = None,
    progress: bool | None = None,
) -> Path:
    """Write a film of a run.

    Args:
        data: what `jostle.Simulation.run` returned, or a file of it (`.nc`, or `.csv` and `.parquet` of `jostle run`).
        out: file; its ending is the kind: `.mp4`, `.gif`, `.webp`, or `.html` for one page that plays it offline.
        colour: of the disks: `spin` (mean angular velocity over a period of the drive), `speed`, `force` (sum of the
            normal forces on it), `none`.
        contacts: draw a line where two bodies press on each other, as wide as the force. None: if the forces are known;
            True: raise LabError if not. They are computed by doing the run again, which is checked bit by bit.
        slow: how many times slower than real. None: such that a period of the drive takes 0.6 s.
        start: simulated time of the first frame [s]; None: the first sample.
        end: simulated time of the last frame [s]; None: the last sample.
        height: of the film [pixels], 160 to 2160. None: 720; GIF and WebP 480.
        fps: frames a second, 1 to 60. None: 30; WebP 25, GIF 10.
        progress: show a bar; None: in a terminal.

    Returns:
        the file.

    Raises:
        LabError: an argument or data that make no film; says which, what is allowed, and what to do.

    Warns:
        FilmWarning: samples too far apart for the drive, or forces that are not known.

    """
    path = Path(out)
    check(path, colour, height, fps)
    script = write_script(
        data,
        path.suffix.lower(),
        colour=colour,
        contacts=contacts,
        slow=slow,
        start=start,
        end=end,
        height=height,
        fps=fps,
        progress=progress,
    )
    with encode.whole(path) as draft:
        write(script, draft, progress)
    return path


def write_script(
    data: "xr.Dataset | str | Path",
    ending: str = ".mp4",
    *,
    colour: str = "spin",
    contacts: bool | None = None,
    slow: float | None = None,
    start: float | None = None,
    end: float | None = None,
    height: int | None = None,
    fps: float | None = None,
    progress: bool | None = None,
    make: Callable[[Recording], Replayable] | None = None,
) -> Script:
    """Decide what is in each frame; the arguments are those of `film`."""
    height = height or (480 if ending in SMALL else 720)
    run = _recorded(data)
    chosen = pace.pace(run, slow, start, end, fps or RATES[ending])
    if told := pace.warning(run):
        warnings.warn(told, FilmWarning, stacklevel=3)
    shown = slice(int(chosen.earlier[0]), int(chosen.earlier[-1]) + 2)
    seen = scenery(run, shown)
    layout = lay_out(seen, height)
    if ending in SMALL:
        encode.check_memory(chosen.frames, (layout.width, layout.height))
    found, why_not = _forces(run, chosen, contacts, colour, progress, make)
    coloured = colours.colouring(run, chosen, colour, found, why_not)
    return Script(run, chosen, seen, layout, coloured, found if contacts is not False else None, why_not)


def write(script: Script, path: Path, progress: bool | None = None, quality: int = encode.QUALITY) -> None:
    """Draw a script and write it, to a file whose ending is the kind; `quality` from 0 to 100 is that of a WebP."""
    count, size = script.pace.frames, (script.layout.width, script.layout.height)
    if path.suffix.lower() == ".html":
        player.write_page(script, path, _bar(range(count), "frames", progress))
        return
    stage = Stage(script)
    pictures = (stage.draw(script.frame(number)) for number in _bar(range(count), "frames", progress))
    if path.suffix.lower() == ".mp4":
        encode.write_mp4(path, pictures, size, script.pace.fps)
    elif path.suffix.lower() == ".gif":
        encode.write_gif(path, encode.images(pictures, size), script.pace.fps, stage.few_colours())
    else:
        encode.write_webp(path, encode.images(pictures, size), script.pace.fps, count, quality)


def check(path: Path, colour: str, height: int | None, fps: float | None) -> None:
    """Refuse, before anything is computed, what no film can be made of."""
    if path.suffix.lower() not in ENDINGS:
        found = f"ends with {path.suffix}" if path.suffix else "has no ending"
        raise LabError(f"{path} {found}, allowed are {', '.join(ENDINGS)}.")
    encode.check_place(path)
    colours.check(colour)
    if height is not None:
        require("height [pixels]", height, 160, 2160, "A film has 480 to 1080.")
        if height % 2:
            raise LabError(f"height = {height} pixels is odd; films have even sizes. Take {height + 1}.")
    if fps is not None:
        require("fps", fps, 1.0, 60.0, "A film has 25 or 30 frames a second.")
        if path.suffix.lower() == ".gif" and not math.isclose(100.0 / fps, round(100.0 / fps)):
            near = 100.0 / max(round(100.0 / fps), 2)
            raise LabError(
                f"fps = {fps:g} is not possible in a GIF, which counts in hundredths of a second: 10, 12.5, 20, 25, "
                f"50 are. Take {near:.4g}."
            )


def _recorded(data: "xr.Dataset | str | Path") -> Recording:
    if isinstance(data, str | Path):
        return recording.record(sources.read(Path(data)), str(data))
    if not hasattr(data, "attrs") or not hasattr(data, "coords"):
        raise LabError(
            f"data is a {type(data).__name__}, not an xarray.Dataset or the name of a file. Give what "
            "jostle.Simulation.run returned."
        )
    return recording.record(data)


def _forces(
    run: Recording,
    chosen: pace.Pace,
    contacts: bool | None,
    colour: str,
    progress: bool | None,
    make: Callable[[Recording], Replayable] | None,
) -> tuple[Forces | None, str]:
    if contacts is False and colour != "force":
        return None, "they were not asked for."
    try:
        return forces.find(run, chosen, make, lambda samples: _bar(samples, "forces", progress)), ""
    except NoForcesError as reason:
        said = str(reason)
    if contacts:
        raise LabError(f"Lines of force are not possible: {said} Leave contacts out.")
    if colour != "force":
        warnings.warn(f"No lines of force are drawn: {said}", FilmWarning, stacklevel=4)
    return None, said


def _bar(steps: range, label: str, progress: bool | None) -> Iterator[int]:
    hidden = not sys.stderr.isatty() if progress is None else not progress
    return iter(tqdm(steps, desc=label, disable=hidden, leave=False))
