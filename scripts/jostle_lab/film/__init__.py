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

from jostle_lab.film.make import FilmWarning, film

__all__ = ["FilmWarning", "film"]
