"""Solid things of a scene, from its parameters: walls, teeth, supports, how they move, and what part is looked at.

The shapes are those of the engines (docs/physics.md): the box of a packing is centred, its floor at y = 0 while the
base is at rest; teeth begin at multiples of their width; the vertex of a wedge is the origin; the disk on two supports
is at the origin where it just touches both.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from jostle_lab.errors import LabError
from jostle_lab.film.recording import Numbers, Recording

ARC_POINTS = 25
"""Of the rounded tip of a tooth."""


@dataclass(frozen=True)
class Solid:
    """A polygon, and how it is displaced."""

    outline: Numbers
    """Corners [m], shape (corners, 2)."""
    shift: Numbers | None = None
    """Displacement at each sample [m], shape (samples, 2); None: at rest."""


@dataclass(frozen=True)
class View:
    """What is looked at [m]."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def width(self) -> float:
        """[m]."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """[m]."""
        return self.top - self.bottom


@dataclass(frozen=True)
class Scenery:
    """All of it."""

    solids: tuple[Solid, ...]
    view: View
    cell: float | None = None
    """Width of the periodic cell, which begins at x = 0 [m]."""


def scenery(recording: Recording, shown: slice) -> Scenery:
    """Solids and view of a scene; the view holds all disks of the samples `shown`."""
    builders: dict[str, Callable[[Recording, slice], Scenery]] = {
        "packing": _box,
        "ratchet": _teeth,
        "wedge": _wedge,
        "three_disk": _supports,
    }
    return builders[recording.scene](recording, shown)


def _lift(recording: Recording) -> Numbers:
    """Displacement of the base, shape (samples, 2)."""
    if recording.base is None:
        raise LabError(
            f"base.position was not recorded, but {recording.scene} cannot be drawn without it. "
            "Record it, or all outputs."
        )
    return np.column_stack((np.zeros_like(recording.base), recording.base))


def _rectangle(left: float, right: float, bottom: float, top: float) -> Numbers:
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top]])


def _top(recording: Recording, shown: slice) -> float:
    return float(np.max(recording.y[shown] + recording.radius))


def _box(recording: Recording, shown: slice) -> Scenery:
    half, lift = 0.5 * recording.parameter("box.width"), _lift(recording)
    thick = 0.04 * half
    low, high = float(lift[shown, 1].min()), _top(recording, shown) + 0.6 * float(recording.radius.mean())
    view = View(-half - thick, half + thick, min(low, 0.0) - 1.5 * thick, high)
    far = 2.0 * (view.height + view.width)
    moved = lift if recording.option("wall.motion") == "with_base" else None
    solids = (
        Solid(_rectangle(-half, half, -far, 0.0), lift),
        Solid(_rectangle(-half - far, -half, -far, far), moved),
        Solid(_rectangle(half, half + far, -far, far), moved),
    )
    return Scenery(solids, view)


def tooth(width: float, height: float, asymmetry: float, tip_radius: float) -> Numbers:
    """Surface of one tooth from its left foot to before its right one [m], shape (points, 2).

    `asymmetry` is the horizontal extent of the left side over the width; the arc of the tip is tangent to both sides.
    """
    apex = np.array([asymmetry * width, height])
    if height == 0.0:
        return np.zeros((1, 2))
    feet = np.array([[0.0, 0.0], [width, 0.0]])
    down = (feet - apex) / np.linalg.norm(feet - apex, axis=1)[:, None]
    half = 0.5 * math.acos(float(np.clip(down[0] @ down[1], -1.0, 1.0)))
    if tip_radius == 0.0 or half == 0.0:
        return np.array([feet[0], apex])
    centre = apex + (down[0] + down[1]) / np.linalg.norm(down[0] + down[1]) * tip_radius / math.sin(half)
    touched = apex + down * tip_radius / math.tan(half) - centre
    first, last = (math.atan2(y, x) for x, y in touched)
    turn = np.linspace(first, last, ARC_POINTS)
    return np.vstack((feet[:1], centre + tip_radius * np.column_stack((np.cos(turn), np.sin(turn)))))


def _teeth(recording: Recording, shown: slice) -> Scenery:
    width, height = recording.parameter("tooth.width"), recording.parameter("tooth.height")
    count, lift = round(recording.parameter("tooth.count")), _lift(recording)
    one = tooth(width, height, recording.parameter("tooth.asymmetry"), recording.parameter("tooth.tip_radius"))
    cell, low = count * width, float(lift[shown, 1].min())
    radius = float(recording.radius.mean())
    view = View(0.0, cell, low - max(radius, 0.2 * height), _top(recording, shown) + 0.6 * radius)
    far = 2.0 * (view.height + view.width)
    surface = np.vstack([one + np.array([number * width, 0.0]) for number in range(count)])
    outline = np.vstack((surface, [[cell, 0.0], [cell, -far], [0.0, -far]]))
    ceiling = recording.parameter("cell.height")
    solids = (Solid(outline, lift), Solid(_rectangle(0.0, cell, ceiling, ceiling + far)))
    return Scenery(solids, view, cell)


def slopes(half: float, tilt: float) -> tuple[Numbers, Numbers]:
    """Directions up the left and the right wall, and their normals to the disk, each of shape (2, 2).

    `half` is the slope of both walls without tilt; a tilt is counter-clockwise [rad].
    """
    left, right = half - tilt, half + tilt
    up = np.array([[-math.cos(left), math.sin(left)], [math.cos(right), math.sin(right)]])
    normals = np.array([[math.sin(left), math.cos(left)], [-math.sin(right), math.cos(right)]])
    return up, normals


def _wedge(recording: Recording, shown: slice) -> Scenery:
    half = 0.5 * (math.pi - recording.parameter("wedge.aperture"))
    up, normals = slopes(half, recording.parameter("wedge.tilt"))
    lift, radius = _lift(recording), float(recording.radius[0])
    x, y = recording.x[shown], recording.y[shown]
    view = View(
        min(float(x.min()) - 1.6 * radius, -2.2 * radius),
        max(float(x.max()) + 1.6 * radius, 2.2 * radius),
        min(float(lift[shown, 1].min()), 0.0) - 0.45 * radius,
        float(y.max()) + 1.5 * radius,
    )
    long, thick = 2.0 * (view.width + view.height), 0.3 * radius
    # Outer surfaces are parallel to the inner ones and meet below the vertex.
    corner = -thick * normals.sum(axis=0) / (1.0 + float(normals[0] @ normals[1]))
    ends = long * up
    outline = np.array(
        [ends[0], [0.0, 0.0], ends[1], ends[1] - thick * normals[1], corner, ends[0] - thick * normals[0]]
    )
    return Scenery((Solid(outline, lift),), view)


def _supports(recording: Recording, shown: slice) -> Scenery:
    radius, half = float(recording.radius[0]), recording.parameter("support.angle")
    up, normals = slopes(half, recording.parameter("tilt"))
    solids = []
    for index, (along, normal) in enumerate(zip(up, normals, strict=True)):
        if recording.option("support.shape") == "disks":
            turn = np.linspace(0.0, math.tau, 121)[:-1]
            outline = -2.0 * radius * normal + radius * np.column_stack((np.cos(turn), np.sin(turn)))
        else:
            # Inner and outer surfaces of both walls meet in corners below the disk.
            corner, thick = -normals.sum(axis=0) / (1.0 + float(normals[0] @ normals[1])), 0.2 * radius
            end = -radius * normal + 1.5 * radius * along
            outline = np.array([radius * corner, end, end - thick * normal, (radius + thick) * corner])
        solids.append(Solid(outline, support_motion(recording, index)))
    wide = 2.0 if recording.option("support.shape") == "disks" else 1.6
    low = -wide * radius * float(normals[:, 1].max()) + (-0.4 * radius if wide == 2.0 else 0.2 * radius)
    x, y = recording.x[shown], recording.y[shown]
    view = View(float(x.min()) - wide * radius, float(x.max()) + wide * radius, low, float(y.max()) + 1.2 * radius)
    return Scenery(tuple(solids), view)


def support_motion(recording: Recording, index: int) -> Numbers | None:
    """Displacement of the left (0) or right (1) support at each sample [m], shape (samples, 2); None: at rest."""
    if recording.drive == "sine":
        phase = math.tau * recording.parameter("drive.frequency") * recording.time + recording.parameter("drive.phase")
        ahead = recording.parameter("drive.phase_difference") if index else 0.0
        moved = recording.parameter("drive.amplitude") * np.sin(phase + ahead)
        direction = recording.parameter("drive.direction")
        return np.column_stack((moved * math.cos(direction), moved * math.sin(direction)))
    if recording.drive == "random-supports":
        missing = [name for name in ("support.x", "support.y") if name not in recording.data]
        if missing:
            raise LabError(f"{missing[0]} was not recorded, but moves the supports. Record it, or all outputs.")
        return np.column_stack([recording.data[name].values[:, index] for name in ("support.x", "support.y")])
    return None
