"""Films of runs: disks that turn, the base that moves, forces between them.

>>> from jostle_lab.film import film
>>> film(data, "packing.mp4", colour="spin")  # of data = simulation.run(...), or the name of a file

    sources    a file, or a run now -> dataset     recording  dataset -> what is needed, checked
    pace       which instants are shown            scenery    walls, teeth, supports
    forces     the run again, with its contacts    colours    values -> colours
    script     what is in each frame [pixels]      words      title and figures
    stage      a frame -> a picture                encode     pictures -> MP4, GIF, WebP
    player     all frames -> a page                make       all of it
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jostle_lab.film.make import FilmWarning, film

__all__ = ["FilmWarning", "film"]


def __getattr__(name: str) -> Any:
    """Import what films need only if one is made: the command line lists its commands without it."""
    if name in __all__:
        return getattr(import_module("jostle_lab.film.make"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
