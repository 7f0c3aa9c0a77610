"""Disks in, the picture of a webcam out: the packing before a back light, a black mark on each disk (P 2.4.1).

The disks are translucent white acrylic, the marks rectangles of black tape through which no light comes. The gaps
between the disks are darker than the disks, bottom and bolts are black. A pixel is the mean of the light on it
(coverage by signed distance, so edges are smooth), times the fall of light towards the corners, plus noise, in 8 bits.
Not here: motion during the exposure, distortion and perspective of the lens.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError, require

PANE = 0.44, 0.50
"""Width and height of the front pane [m] (P 2.4.1)."""
BELOW = 0.008
"""What is seen below the bottom's rest position [m]."""
BOLT_RADIUS = 0.5 * 0.25 * 0.0254
"""Of a bolt of 1/4 inch [m]."""
BOLT_HEIGHTS = (0.04, 0.24, 0.44)
"""Of the six bolts, in the middle of the stripes at both sides [m]."""
DISK, GAP, STRIPE, BLACK = 0.86, 0.66, 0.74, 0.05
"""Light that comes through, as a share of what the sensor takes in 8 bits."""

Image = NDArray[np.uint8]
"""Grey, shape (rows, columns), the first row at the top."""
Light = NDArray[np.float32]


@dataclass(frozen=True)
class Webcam:
    """A camera and the marks that it looks at."""

    resolution: float = 1920.0
    """[pixels/m]; 960 pixels for the pane's height of 50 cm."""
    noise: float = 2.0
    """Standard deviation of a pixel [steps of 255]."""
    vignetting: float = 0.3
    """Share of the light that the corners lose; it grows with the square of the distance from the middle."""
    mark_length: float = 0.020
    """[m]; neither P's text nor its picture gives a size: this one fits the smallest disk."""
    mark_width: float = 0.006
    """[m]."""

    def __post_init__(self) -> None:
        """Refuse what shows nothing."""
        require("resolution [pixels/m]", self.resolution, 200.0, 20000.0, "A webcam has 1000 to 4000 on 50 cm.")
        require("noise [steps of 255]", self.noise, 0.0, 100.0, "A webcam has 1 to 5.")
        require("vignetting", self.vignetting, 0.0, 0.9, "A share, such as 0.3.")
        if not 0.0 < self.mark_width < self.mark_length:
            raise LabError(f"A mark of {self.mark_length:g} by {self.mark_width:g} m is no rectangle with a long side.")

    def mark_area(self) -> float:
        """Pixels of a mark."""
        return self.mark_length * self.mark_width * self.resolution**2


class BackLight:
    """The scene: what stands still is drawn once, the disks anew in each snapshot.

    Args:
        webcam: that looks.
        box_width: inner width of the box [m]; x = 0 is its middle, y = 0 the bottom at rest.
        radii: of the disks [m], shape (disks,).

    """

    def __init__(self, webcam: Webcam, box_width: float, radii: NDArray[np.float64]) -> None:
        if math.hypot(webcam.mark_length, webcam.mark_width) >= 2.0 * float(np.min(radii)):
            raise LabError(
                f"A mark of {webcam.mark_length:g} m does not fit on a disk of radius {np.min(radii):g} m. Shorten it."
            )
        self.webcam, self.radii = webcam, radii
        width, height = max(PANE[0], box_width + 0.04), PANE[1]
        self.columns, self.rows = (math.ceil(length * webcam.resolution) for length in (width, height))
        self._left, self._top = -0.5 * self.columns / webcam.resolution, self.rows / webcam.resolution - BELOW
        x = self._left + (np.arange(self.columns, dtype=np.float32) + 0.5) / webcam.resolution
        y = self._top - (np.arange(self.rows, dtype=np.float32) + 0.5) / webcam.resolution
        self._fall = self._falling_light()
        self._empty = self._still_life(x, y, 0.5 * box_width)

    def _falling_light(self) -> Light:
        down, right = (np.linspace(-1.0, 1.0, n, dtype=np.float32) ** 2 for n in (self.rows, self.columns))
        shape = np.array([self.rows, self.columns], dtype=np.float32) ** 2
        along, across = shape / shape.sum()
        lost = along * down[:, None] + across * right[None, :]
        return np.asarray(255.0 * (1.0 - self.webcam.vignetting * lost), dtype=np.float32)

    def _still_life(self, x: Light, y: Light, half: float) -> Light:
        """Stripes beside the box, bolts and the bottom, shape (rows, columns)."""
        outside = _covered((np.abs(x) - half) * self.webcam.resolution)
        light = np.broadcast_to(GAP + (STRIPE - GAP) * outside, (self.rows, self.columns)).astype(np.float32)
        middle = half + 0.5 * (abs(self._left) - half)
        for height in BOLT_HEIGHTS:
            distance = np.hypot(np.abs(x)[None, :] - middle, y[:, None] - height)
            light += (BLACK - light) * _covered((BOLT_RADIUS - distance) * self.webcam.resolution)
        light += (BLACK - light) * _covered(-y * self.webcam.resolution)[:, None]
        return light

    def take(
        self, positions: NDArray[np.float64], angles: NDArray[np.float64], generator: np.random.Generator
    ) -> Image:
        """A snapshot of disks at `positions` [m], shape (disks, 2), whose marks stand at `angles` [rad]."""
        light = self._empty.copy()
        columns, rows = self.to_pixels(positions).T
        for column, row, radius, angle in zip(columns, rows, self.radii, angles, strict=True):
            self._draw(light, column, row, radius * self.webcam.resolution, angle)
        light *= self._fall
        if self.webcam.noise > 0.0:
            light += self.webcam.noise * generator.standard_normal(light.shape, dtype=np.float32)
        return np.clip(np.rint(light), 0.0, 255.0).astype(np.uint8)

    def _draw(self, light: Light, column: float, row: float, radius: float, angle: float) -> None:
        """One disk with its mark, all in pixels; the angle counts from x to y, which points up."""
        top, left = max(math.floor(row - radius) - 1, 0), max(math.floor(column - radius) - 1, 0)
        window = light[top : math.ceil(row + radius) + 2, left : math.ceil(column + radius) + 2]
        if window.size == 0:
            return
        x = (left + np.arange(window.shape[1], dtype=np.float32) - np.float32(column))[None, :]
        y = (np.float32(row) - top - np.arange(window.shape[0], dtype=np.float32))[:, None]
        window += (DISK - window) * _covered(radius - np.hypot(x, y))
        cosine, sine = np.float32(math.cos(angle)), np.float32(math.sin(angle))
        length, width = (
            0.5 * side * self.webcam.resolution for side in (self.webcam.mark_length, self.webcam.mark_width)
        )
        along, across = np.abs(cosine * x + sine * y), np.abs(cosine * y - sine * x)
        window += (BLACK - window) * _covered(length - along) * _covered(width - across)

    def to_pixels(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """(column, row) of (x, y) [m], shape (n, 2); whole numbers are the middles of pixels."""
        x, y = positions.T
        scale = self.webcam.resolution
        return np.column_stack(((x - self._left) * scale - 0.5, (self._top - y) * scale - 0.5))

    def to_metres(self, pixels: NDArray[np.float64]) -> NDArray[np.float64]:
        """(x, y) [m] of (column, row), shape (n, 2)."""
        column, row = pixels.T
        scale = self.webcam.resolution
        return np.column_stack((self._left + (column + 0.5) / scale, self._top - (row + 0.5) / scale))


def _covered(depth: NDArray[np.floating[Any]]) -> Light:
    """Share of a pixel inside of a straight edge, of the depth of its middle inside [pixels]."""
    return np.asarray(np.clip(depth + np.float32(0.5), 0.0, 1.0), dtype=np.float32)
