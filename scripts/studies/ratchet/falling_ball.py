"""Which way a ball leaves that falls onto teeth at rest, by F's law of collision (A.1 to A.4) written anew.

A check of F V that shares no code with the engine. As in a geometrical model, the ball flies straight between impacts:
the way between the teeth takes so little time that gravity turns it little. Then only shape, restitution, friction and
moment of inertia matter, not speed. Lengths are in units of mm.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jostle_lab.statistics.estimates import Numbers

MOST_IMPACTS = 200
"""A ball that has not left after so many has come to rest in a valley."""
CLEAR = 1e-9
"""Nearer than this a ball touches [mm]."""


@dataclass(frozen=True)
class Tooth:
    """A tooth with a rounded tip, F Fig. 5, of period `width`."""

    width: float
    height: float
    """Of the sharp apex."""
    asymmetry: float
    tip_radius: float = 0.4

    @property
    def normals(self) -> tuple[Numbers, Numbers]:
        """Outward normals of the left and the right side."""
        apex = self.asymmetry * self.width
        left, right = np.array([-self.height, apex]), np.array([self.height, self.width - apex])
        return left / math.hypot(*left), right / math.hypot(*right)

    @property
    def arc_centre(self) -> Numbers:
        """Centre of the arc of the tip: the tip's radius below both sides."""
        left, right = self.normals
        apex = np.array([self.asymmetry * self.width, self.height])
        return np.asarray(apex - self.tip_radius * (left + right) / (1.0 + float(left @ right)))

    @property
    def top(self) -> float:
        """Height of the rounded tip."""
        return float(self.arc_centre[1]) + self.tip_radius


@dataclass(frozen=True)
class Law:
    """F A.1 to A.4 against a wall at rest."""

    restitution: float = 0.8
    friction: float = 0.1
    inertia: float = 0.4
    """l of F: 2/5 a ball, 1/2 a disk; infinite: the rotation is frozen."""

    def collide(self, velocity: Numbers, rim: Numbers, normal: Numbers) -> tuple[Numbers, Numbers]:
        """Velocities, shape (balls, 2), and rim velocities R omega after impacts on surfaces with outward `normal`."""
        tangent = np.stack([normal[:, 1], -normal[:, 0]], axis=1)
        along_normal = np.sum(velocity * normal, axis=1)
        along_tangent = np.sum(velocity * tangent, axis=1)
        # Tangent to the right of the outward normal: there the rim moves at R omega along it.
        slip = along_tangent + rim
        push = (1.0 + self.restitution) * np.abs(along_normal)
        compliance = 1.0 + (0.0 if math.isinf(self.inertia) else 1.0 / self.inertia)
        limit = np.minimum(self.friction * push, np.abs(slip) / compliance)
        change = -np.sign(slip) * limit
        after_rim = rim if math.isinf(self.inertia) else rim + change / self.inertia
        tangential = (along_tangent + change)[:, None] * tangent
        return tangential - self.restitution * along_normal[:, None] * normal, after_rim


@dataclass(frozen=True)
class Falls:
    """How balls left."""

    to_the_left: NDArray[np.bool_]
    stayed: NDArray[np.bool_]
    """In a valley."""
    impacts: NDArray[np.int64]


def fall(tooth: Tooth, law: Law, radius: float, places: Numbers, angles: Numbers) -> Falls:
    """Drop balls.

    Args:
        tooth: at rest.
        law: of collision.
        radius: of a ball [mm].
        places: where each would meet the height of the tips [mm].
        angles: of each from the downward vertical, positive to the right [rad].

    """
    position = np.stack([places, np.full_like(places, tooth.top + radius + 1.0)], axis=1)
    velocity = np.stack([np.sin(angles), -np.cos(angles)], axis=1)
    position[:, 0] -= (radius + 1.0) * np.tan(angles)
    rim = np.zeros_like(places)
    impacts = np.zeros(len(places), dtype=np.int64)
    flying = np.ones(len(places), dtype=bool)
    for _ in range(MOST_IMPACTS):
        active = np.flatnonzero(flying)
        if len(active) == 0:
            break
        time, normal = _next_impact(tooth, radius, position[active], velocity[active])
        hit = np.isfinite(time)
        flying[active[~hit]] = False
        active, time, normal = active[hit], time[hit], normal[hit]
        position[active] += time[:, None] * velocity[active]
        velocity[active], rim[active] = law.collide(velocity[active], rim[active], normal)
        impacts[active] += 1
    return Falls(~flying & (velocity[:, 0] < 0.0), flying, impacts)


def _next_impact(tooth: Tooth, radius: float, position: Numbers, velocity: Numbers) -> tuple[Numbers, Numbers]:
    """Time to the first impact and the normal there; infinite for a ball that leaves."""
    best, normal = np.full(len(position), np.inf), np.zeros_like(position)
    home = np.floor(position[:, 0] / tooth.width)
    for shift in range(-3, 4):
        local = position - np.stack([(home + shift) * tooth.width, np.zeros_like(home)], axis=1)
        for time, found in (*_sides(tooth, radius, local, velocity), _tip(tooth, radius, local, velocity)):
            sooner = time < best
            best[sooner], normal[sooner] = time[sooner], found[sooner]
    return best, normal


def _sides(tooth: Tooth, radius: float, position: Numbers, velocity: Numbers) -> list[tuple[Numbers, Numbers]]:
    """Impacts on the flat parts: lines that the centre meets, a radius away from the side, above the valley."""
    found = []
    tangent_points = [tooth.arc_centre + tooth.tip_radius * normal for normal in tooth.normals]
    feet = (np.array([0.0, 0.0]), np.array([tooth.width, 0.0]))
    for normal, top, foot in zip(tooth.normals, tangent_points, feet, strict=True):
        distance = (position - foot) @ normal - radius
        approach = -(velocity @ normal)
        with np.errstate(divide="ignore", invalid="ignore"):
            time = np.where(approach > 0.0, np.maximum(distance, 0.0) / approach, np.inf)
            touch = position + np.where(np.isfinite(time), time, 0.0)[:, None] * velocity - radius * normal
        side = (top - foot) / np.linalg.norm(top - foot)
        reach = (touch - foot) @ side
        on = (distance > -1e-6) & (reach >= -CLEAR) & (reach <= float(np.linalg.norm(top - foot)))
        found.append((np.where(on, time, np.inf), np.broadcast_to(normal, position.shape)))
    return found


def _tip(tooth: Tooth, radius: float, position: Numbers, velocity: Numbers) -> tuple[Numbers, Numbers]:
    """Impacts on the arc: the centre meets a circle of both radii, in the part between the sides."""
    centre, reach = tooth.arc_centre, tooth.tip_radius + radius
    away = position - centre
    approach = -np.sum(away * velocity, axis=1)
    speed = np.sum(velocity**2, axis=1)
    root = approach**2 - speed * (np.sum(away**2, axis=1) - reach**2)
    meets = (approach > 0.0) & (root > 0.0)
    time = np.where(meets, np.maximum(approach - np.sqrt(np.maximum(root, 0.0)), 0.0) / speed, np.inf)
    normal = (away + np.where(meets, time, 0.0)[:, None] * velocity) / reach
    left, right = tooth.normals
    # On the arc if the normal is between those of the sides.
    between = (left[0] * normal[:, 1] - left[1] * normal[:, 0] <= 0.0) & (
        normal[:, 0] * right[1] - normal[:, 1] * right[0] <= 0.0
    )
    return np.where(meets & between, time, np.inf), normal
