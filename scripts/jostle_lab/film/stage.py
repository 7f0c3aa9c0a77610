"""A script's frames as pictures. What stands still is drawn once, the rest is changed in place and drawn over it.

Matplotlib's collections draw all disks in one call of compiled code: some 5 ms for 60 disks at 720 pixels.
"""

import math
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from numpy.typing import NDArray

from jostle_lab.film import words
from jostle_lab.film.pace import down_to_nice
from jostle_lab.film.recording import Numbers
from jostle_lab.film.script import Frame, Rectangle, Script

DPI = 100
Pixels = memoryview
"""Red, green, blue, opacity in 8 bits, shape (height, width, 4)."""
INK, PAPER = "#1d1d1f", "#ffffff"
AIR, SOLID = "#26282d", "#8f8a83"
"""Between the disks, and of what is solid. On dark air all disks are seen without outlines, which makes small files."""
SHADE = (0.10, 0.09, 0.10, 0.38)
"""Over the half of each disk that is darker."""
FLAT = 0.15
"""Largest distance between a circle and its polygon [pixels]."""
TEXT, SMALLEST = 0.025, 10.5
"""Height of letters over that of the film, and the least [pixels]."""


class Stage:
    """Draws frames of a script.

    Args:
        script: whose frames are drawn.

    """

    def __init__(self, script: Script) -> None:
        self.script, layout = script, script.layout
        self._figure = Figure(figsize=(layout.width / DPI, layout.height / DPI), dpi=DPI, facecolor=PAPER)
        # Matplotlib types little of what changes drawings in place.
        self._canvas: Any = FigureCanvasAgg(self._figure)
        self._axes = self._figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self._axes.set(xlim=(0, layout.width), ylim=(0, layout.height))
        self._axes.set_axis_off()
        self.letter = max(TEXT * layout.height, SMALLEST)
        self._moving: list[Any] = []
        self._title()
        self._still()
        self._side()
        self._make_moving()
        self._empty = self._drawn_once()

    def _drawn_once(self) -> Any:
        self._canvas.draw()
        return self._canvas.copy_from_bbox(self._figure.bbox)

    def background(self) -> NDArray[np.uint8]:
        """What stands still, shape (height, width, 4)."""
        self._canvas.restore_region(self._empty)
        return np.array(self._canvas.buffer_rgba(), dtype=np.uint8)

    def draw(self, frame: Frame) -> Pixels:
        """Pixels of a frame, shape (height, width, 4); they hold until the next one."""
        self._canvas.restore_region(self._empty)
        script = self.script
        solids = [
            script.layout.pixels(s.outline) + by for s, by in zip(script.scenery.solids, frame.shifts, strict=True)
        ]
        self._solids.set_verts(solids)
        centres, chosen = with_copies(frame.centres, script.radii, script.cell, script.layout.panel.left)
        radii, angles = script.radii[chosen], frame.angles[chosen]
        self._disks.set_verts(_polygons(centres, radii, angles, self._circle))
        self._disks.set_facecolor(script.colouring.palette[frame.shades[chosen]])
        self._halves.set_verts(_polygons(centres, radii, angles, self._half))
        self._lines.set_segments(list(frame.segments))
        self._lines.set_linewidth(frame.widths * 72.0 / DPI)
        self._clock.set_text(frame.clock)
        self._turn_hand(frame)
        renderer = self._canvas.get_renderer()
        for artist in self._moving:
            artist.draw(renderer)
        pixels: Pixels = self._canvas.buffer_rgba()
        return pixels

    def few_colours(self) -> Numbers:
        """Every other shade, lit and dark, and what else is drawn; in [0, 1], shape (colours, 3)."""
        shades = self.script.colouring.palette[::2]
        dark = (1.0 - SHADE[3]) * shades + SHADE[3] * np.array(SHADE[:3])
        rest = [to_rgb(colour) for colour in (INK, PAPER, AIR, SOLID, "0.3", "0.5", "0.7", "0.87")]
        return np.vstack((shades, dark, rest))

    def hand(self, frame: Frame) -> Numbers | None:
        """Ends of the hand of the dial [pixels], shape (2, 2); None without a dial."""
        if frame.hand is not None:
            return self._middle + self._reach * np.array([[0.0, 0.0], [math.cos(frame.hand), math.sin(frame.hand)]])
        if frame.lift is not None:
            return self._middle + self._reach * np.array([[0.0, 0.0], [0.0, frame.lift]])
        return None

    def clock_place(self) -> tuple[float, float]:
        """Where the time begins, at the foot of its letters [pixels]."""
        side = self.script.layout.side
        return side.left, side.bottom + 3.6 * self.letter

    def _text(self, x: float, y: float, said: str, size: float = 1.0, **style: Any) -> Text:
        points = size * self.letter * 72.0 / DPI
        return self._axes.text(x, y, said, fontsize=points, color=INK, parse_math=False, **style)

    def _title(self) -> None:
        layout, run = self.script.layout, self.script.recording
        room = layout.width - 2.0 * layout.side.bottom
        heading = self._text(layout.side.bottom, layout.height - 0.35 * self.letter, words.title(run), 1.35, va="top")
        below = self._text(layout.side.bottom, layout.height - 2.35 * self.letter, words.driven(run), 1.05, va="top")
        heading.set_fontweight("bold")
        text: Any
        for text in (heading, below):
            wide = text.get_window_extent(self._canvas.get_renderer()).width
            text.set_fontsize(text.get_fontsize() * min(1.0, 0.97 * room / wide) if wide > 0.0 else text.get_fontsize())

    def _clip(self) -> Bbox:
        panel = self.script.layout.panel
        return Bbox.from_bounds(panel.left, panel.bottom, panel.width, panel.height)

    def _still(self) -> None:
        """Air, and the edges of the periodic cell."""
        panel = self.script.layout.panel
        right, top = panel.left + panel.width, panel.bottom + panel.height
        self._axes.fill_between([panel.left, right], panel.bottom, top, color=AIR, lw=0)
        if self.script.cell is not None:
            for x in (panel.left, right):
                self._axes.plot([x, x], [panel.bottom, top], color="0.6", lw=0.8, ls=(0, (4, 4)))

    def _make_moving(self) -> None:
        radii = self.script.radii
        count = max(math.ceil(math.pi / math.sqrt(2.0 * FLAT / max(float(radii.max()), 1.0))), 12)
        self._circle = np.linspace(0.0, math.tau, 2 * count + 1)[:-1]
        self._half = np.linspace(-0.5 * math.pi, 0.5 * math.pi, count + 1)
        self._solids: Any = PolyCollection([], facecolors=SOLID, edgecolors="none")
        self._disks: Any = PolyCollection([], edgecolors="none")
        self._halves: Any = PolyCollection([], facecolors=SHADE, edgecolors="none")
        self._lines: Any = LineCollection([], colors=INK, capstyle="round")
        for collection in (self._solids, self._disks, self._halves, self._lines):
            self._axes.add_collection(collection, autolim=False)
            collection.set(animated=True, clip_box=self._clip())
            self._moving.append(collection)
        self._clock = self._text(*self.clock_place(), "", 1.15, va="baseline", animated=True)
        self._moving.append(self._clock)

    def _side(self) -> None:
        """Colour bar, key of the lines, dial, slow motion, scale, from above."""
        side, script = self.script.layout.side, self.script
        top = side.bottom + side.height
        if script.colouring.label:
            top = self._colour_bar(side, top)
        if script.forces is not None and script.forces.typical > 0.0:
            top = self._key(side, top)
        self._dial(side)
        said = words.slowness(script.pace, script.recording)
        self._text(side.left, side.bottom + 5.2 * self.letter, said, va="bottom")
        self._scale_bar(side)

    def _colour_bar(self, side: Rectangle, top: float) -> float:
        colours, letter = self.script.colouring, self.letter
        self._text(side.left, top, colours.label, va="top")
        top -= 3.0 * letter
        high, wide = 0.28 * side.height, 1.3 * letter
        extent = (side.left, side.left + wide, top - high, top)
        self._axes.imshow(
            colours.palette[::-1, None, :], extent=extent, aspect="auto", interpolation="nearest", zorder=1
        )
        self._axes.set(xlim=(0, self.script.layout.width), ylim=(0, self.script.layout.height))
        marks = "≥ ", "≤ " if colours.low < 0.0 else ""
        for share, value in ((1.0, colours.high), (0.5, 0.5 * (colours.low + colours.high)), (0.0, colours.low)):
            beyond = (marks[0] if share == 1.0 else marks[1] if share == 0.0 else "") if colours.beyond else ""
            said = f"{beyond}{value:.3g}".replace("-", "−")
            self._text(side.left + wide + 0.4 * letter, top - high + share * high, said, va="center")
        return top - high - 1.4 * letter

    def _key(self, side: Rectangle, top: float) -> float:
        """A line with its force."""
        script, letter = self.script, self.letter
        assert script.forces is not None
        typical = script.forces.typical
        shown = down_to_nice(typical)
        thick, end = script.thickest * shown / typical, side.left + 2.2 * letter
        y = top - 0.5 * letter
        self._axes.plot([side.left, end], [y, y], color=INK, lw=thick * 72.0 / DPI, solid_capstyle="butt")
        self._text(end + 0.5 * letter, y, f"{shown:.3g} N", va="center")
        if script.forces.window > 0.0:
            said = f"mean over {1e3 * script.forces.window:.2g} ms"
            self._text(side.left, y - 0.8 * letter, said, va="top")
        return top - 3.2 * letter

    def _dial(self, side: Rectangle) -> None:
        """A circle whose hand is at the phase of the drive, or a strip for a base without one."""
        first, letter = self.script.frame(0), self.letter
        radius = 0.075 * self.script.layout.height
        self._middle = np.array([side.left + radius, side.bottom + 8.6 * letter + radius])
        self._reach = radius
        x, y = self._middle
        if first.hand is None and first.lift is None:
            return
        word = "torque" if self.script.recording.drive == "harmonic-torque" else "base"
        if first.hand is not None:
            turn = np.linspace(0.0, math.tau, 73)
            self._axes.plot(x + radius * np.cos(turn), y + radius * np.sin(turn), color="0.55", lw=1.0)
            self._axes.plot([x - radius, x + radius], [y, y], color="0.75", lw=0.8)
            self._text(x + 1.18 * radius, y, f"phase\nof the\n{word}", va="center")
        else:
            self._axes.plot([x, x], [y - radius, y + radius], color="0.55", lw=1.0)
            self._axes.plot([x - 0.3 * radius, x + 0.3 * radius], [y, y], color="0.75", lw=0.8)
            self._text(x + 0.7 * radius, y, f"place\nof the\n{word}", va="center")
        self._hand = LineCollection([], colors=INK, linewidths=0.12 * letter, capstyle="round", animated=True)
        self._tip = PolyCollection([], facecolors=INK, animated=True)
        for part in (self._hand, self._tip):
            self._axes.add_collection(part, autolim=False)
            self._moving.append(part)

    def _turn_hand(self, frame: Frame) -> None:
        ends = self.hand(frame)
        if ends is None:
            return
        self._hand.set_segments([ends])
        turn = np.linspace(0.0, math.tau, 17)
        dot = 0.28 * self.letter * np.column_stack((np.cos(turn), np.sin(turn)))
        self._tip.set_verts([ends[1] + dot])

    def _scale_bar(self, side: Rectangle) -> None:
        layout, letter = self.script.layout, self.letter
        metres = down_to_nice(0.55 * side.width / layout.scale, (1.0, 2.0, 5.0))
        y, end = side.bottom + 0.6 * letter, side.left + metres * layout.scale
        self._axes.plot([side.left, end], [y, y], color=INK, lw=0.14 * letter, solid_capstyle="butt")
        for x in (side.left, end):
            self._axes.plot([x, x], [y - 0.3 * letter, y + 0.3 * letter], color=INK, lw=0.1 * letter)
        self._text(side.left, y + 0.6 * letter, words.length(metres), va="bottom")


def with_copies(centres: Numbers, radii: Numbers, cell: float | None, left: float) -> tuple[Numbers, NDArray[np.intp]]:
    """Centres with a copy of each disk that crosses an edge of the cell, and which disk each one is.

    The cell begins at `left` and is `cell` wide [pixels]; None: there is none.
    """
    every = np.arange(len(centres))
    if cell is None:
        return centres, every
    x = centres[:, 0]
    crossing = (np.flatnonzero(x - radii < left), np.flatnonzero(x + radii > left + cell))
    moved = [centres[which] + np.array([by, 0.0]) for which, by in zip(crossing, (cell, -cell), strict=True)]
    return np.vstack((centres, *moved)), np.concatenate((every, *crossing))


def _polygons(centres: Numbers, radii: Numbers, angles: Numbers, corners: Numbers) -> Numbers:
    """Shape (disks, corners, 2)."""
    turn = angles[:, None] + corners
    return np.stack(
        (centres[:, :1] + radii[:, None] * np.cos(turn), centres[:, 1:] + radii[:, None] * np.sin(turn)), axis=2
    )
