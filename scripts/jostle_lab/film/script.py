"""What is in each frame, in pixels: who draws needs no physics. x to the right, y up, from the lower left corner."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jostle_lab.film.colours import Colouring
from jostle_lab.film.forces import Forces
from jostle_lab.film.pace import Pace
from jostle_lab.film.recording import Numbers, Recording
from jostle_lab.film.scenery import Scenery

NARROWEST, WIDEST = 0.85, 1.8
"""Width of the panel over its height."""
SIDE = 0.32
"""Width of the column at the right over the height of the film."""
HEAD = 0.12
"""Height of the title over that of the film."""
MARGIN = 0.02
THICKEST = 0.55
"""Width of the line of a typical force over the mean radius of the disks."""


@dataclass(frozen=True)
class Rectangle:
    """A part of the picture [pixels]."""

    left: float
    bottom: float
    width: float
    height: float


@dataclass(frozen=True)
class Layout:
    """Sizes, and how metres become pixels."""

    width: int
    height: int
    panel: Rectangle
    """Where the scene is; nothing of it is drawn outside."""
    side: Rectangle
    """Where colour bar, dial and clock are."""
    scale: float
    """[pixels/m]."""
    origin: tuple[float, float]
    """Pixels of (0, 0)."""

    def pixels(self, metres: Numbers) -> Numbers:
        """Of points of shape (..., 2)."""
        return np.asarray(metres * self.scale + np.array(self.origin))


@dataclass(frozen=True)
class Frame:
    """What is drawn anew in each frame [pixels]."""

    centres: Numbers
    """Shape (disks, 2)."""
    angles: Numbers
    """[rad], shape (disks,)."""
    shades: NDArray[np.uint8]
    """Number of a colour of the palette, shape (disks,)."""
    shifts: Numbers
    """Displacement of each solid, shape (solids, 2)."""
    segments: Numbers
    """Lines between disks that press on each other, shape (lines, 2, 2)."""
    widths: Numbers
    """Of the lines, shape (lines,)."""
    clock: str
    """The time."""
    hand: float | None
    """Angle of the dial's hand, or None."""
    lift: float | None
    """Displacement of the base over its largest one, in [-1, 1], or None."""


def lay_out(scenery: Scenery, height: int) -> Layout:
    """Panel for the scene at the left, a column at the right, the title above; all sizes are even."""
    margin, view = MARGIN * height, scenery.view
    room = height * (1.0 - HEAD) - margin
    aspect = min(max(view.width / view.height, NARROWEST), WIDEST)
    scale = min(room / view.height, aspect * room / view.width)
    across = round(aspect * room)
    width = 2 * math.ceil(0.5 * (across + 2.0 * margin + SIDE * height))
    shown = scale * view.width
    panel = Rectangle(margin + 0.5 * (across - shown), margin, shown, room)
    left = panel.left + 0.5 * panel.width - scale * 0.5 * (view.left + view.right)
    side = Rectangle(margin + across + margin, margin, width - across - 3.0 * margin, room)
    return Layout(width, height, panel, side, scale, (left, panel.bottom - scale * view.bottom))


@dataclass(frozen=True)
class Script:
    """A film before it is drawn."""

    recording: Recording
    pace: Pace
    scenery: Scenery
    layout: Layout
    colouring: Colouring
    forces: Forces | None
    why_not: str
    """Why there are no forces."""

    @property
    def radii(self) -> Numbers:
        """[pixels], shape (disks,)."""
        return np.asarray(self.recording.radius * self.layout.scale)

    @property
    def cell(self) -> float | None:
        """Width of the periodic cell [pixels]."""
        return None if self.scenery.cell is None else self.scenery.cell * self.layout.scale

    @property
    def thickest(self) -> float:
        """Width of the line of a typical force [pixels]."""
        return min(THICKEST * float(self.radii.mean()), 0.02 * self.layout.height)

    def frame(self, number: int) -> Frame:
        """One of `pace.frames`."""
        run, pace = self.recording, self.pace
        places = np.column_stack((pace.between(run.x, number), pace.between(run.y, number)))
        if self.scenery.cell is not None:
            places[:, 0] = np.mod(places[:, 0], self.scenery.cell)
        centres = self.layout.pixels(places)
        segments, widths = self._lines(number, centres)
        solids = self.scenery.solids
        rest = np.zeros(2)
        shifts = [rest if s.shift is None else pace.between(s.shift, number, together=True) for s in solids]
        return Frame(
            centres,
            pace.between(run.angle, number),
            self.colouring.shades[number],
            np.array(shifts) * self.layout.scale,
            segments,
            widths,
            self._clock(number),
            self._hand(number),
            self._lift(number),
        )

    def _lines(self, number: int, centres: Numbers) -> tuple[Numbers, Numbers]:
        """From centre to centre, or from a centre to the wall, and their widths."""
        typical = self.forces.typical if self.forces else 0.0
        if self.forces is None or typical == 0.0:
            return np.empty((0, 2, 2)), np.empty(0)
        contacts = self.forces.frames[number]
        points, ends = self.layout.pixels(contacts.points), []
        for side in (0, 1):
            disk = contacts.disks[:, side]
            ends.append(np.where(disk[:, None] > 0, centres[np.maximum(disk, 1) - 1], points))
        widths = self.thickest * np.minimum(contacts.normal / typical, 1.5)
        return np.stack(ends, axis=1), widths

    def _clock(self, number: int) -> str:
        step = 1.0 / (self.pace.fps * self.pace.slow)
        digits = min(max(math.ceil(-math.log10(step)), 0), 6)
        return f"t = {self.pace.times[number]:.{digits}f} s"

    def _hand(self, number: int) -> float | None:
        period, run = self.recording.period(), self.recording
        if period is None or run.base_is_at_rest():
            return None
        shift = run.parameter("drive.phase") if "drive.phase" in run.data.attrs else 0.0
        return math.tau * math.fmod(float(self.pace.times[number]) / period, 1.0) + shift

    def _lift(self, number: int) -> float | None:
        base = self.recording.base
        if base is None or self._hand(number) is not None:
            return None
        largest = float(np.abs(base).max())
        return float(self.pace.between(base, number, together=True)) / largest if largest > 0.0 else None
