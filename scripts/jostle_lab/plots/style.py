"""Style and colours of all pictures."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import matplotlib as mpl
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from jostle_lab.files import replacing

STYLE = {
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.0,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.7,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "savefig.dpi": 200,
    "mathtext.fontset": "dejavusans",
}
CLOCKWISE, COUNTER_CLOCKWISE = "#c0272d", "#1f5fa8"
SENSE = LinearSegmentedColormap.from_list("sense", [CLOCKWISE, "#f4f2ee", COUNTER_CLOCKWISE])
"""Red clockwise, blue counter-clockwise, as in P Fig. 1.8."""
WIDTH = 7.2
"""Width of every picture [inch]."""


def save(figure: Figure, path: Path) -> None:
    """Write a picture, whole or not at all; what fails names the file."""
    with replacing(path) as draft:
        figure.savefig(draft, format=path.suffix[1:])


@contextmanager
def house_style() -> Iterator[None]:
    """Draw and save in this style."""
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        yield
