"""The admissible region in the plane of departure and stretch (P 4.4): corners, edges, distances."""

import math
from dataclasses import dataclass

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statistics.estimates import Numbers
from studies.thesis.two_supports.runs import SCENE

QUADRILATERAL = ("S1", "T2", "S2", "T1")
"""Corners in their order around the region."""


@dataclass(frozen=True)
class Region:
    """Corners by name, each (delta_theta, Theta) [rad]."""

    corners: dict[str, Numbers]

    @property
    def outline(self) -> Numbers:
        """The quadrilateral, closed; shape (5, 2)."""
        return np.array([self.corners[name] for name in (*QUADRILATERAL, QUADRILATERAL[0])])

    @property
    def size(self) -> float:
        """Distance from S1 to S2 [rad]."""
        return float(np.linalg.norm(self.corners["S2"] - self.corners["S1"]))

    def outside(self, points: Numbers) -> Numbers:
        """Distance of each point (rows) beyond the quadrilateral [rad], zero inside."""
        outline = self.outline
        along = np.diff(outline, axis=0)
        # The corners go round counter-clockwise: inside is on the left of every edge.
        from_start = points[:, None, :] - outline[None, :-1, :]
        side = along[None, :, 0] * from_start[:, :, 1] - along[None, :, 1] * from_start[:, :, 0]
        beyond = distance_to_path(points, outline)
        return np.where((side < 0.0).any(axis=1), beyond, 0.0)

    def cycle(self) -> Numbers:
        """Path of bidirectional sliding (P 5.2.3), closed: S1, along Theta = Theta_S1, T2 S2, S2, Theta_S2, T1 S1."""
        s_1, s_2 = self.corners["S1"], self.corners["S2"]
        return np.array(
            [
                s_1,
                _at_stretch(self.corners["T2"], s_2, s_1[1]),
                s_2,
                _at_stretch(self.corners["T1"], s_1, s_2[1]),
                s_1,
            ]
        )


def region(laboratory: Laboratory, tilt: float, normal_stiffness: float = math.inf) -> Region:
    """Quasi-static region at a tilt [rad], of rigid contacts or of soft ones."""
    return Region(corners(laboratory, tilt, normal_stiffness))


def corners(
    laboratory: Laboratory,
    tilt: float,
    normal_stiffness: float = math.inf,
    acceleration: tuple[float, float] = (0.0, 0.0),
) -> dict[str, Numbers]:
    """Corners by name at an acceleration of the centre [m/s^2], each (departure, stretch) [rad]."""
    table = laboratory.theory(
        SCENE,
        "points",
        tilt=tilt,
        contact__normal_stiffness=normal_stiffness,
        acceleration__x=acceleration[0],
        acceleration__y=acceleration[1],
    )
    names = [name.partition(".")[0] for name in table if name.endswith(".departure")]
    return {name: np.array([table[f"{name}.departure"][0], table[f"{name}.stretch"][0]]) for name in names}


def distance_to_path(points: Numbers, path: Numbers) -> Numbers:
    """Distance of each point (rows) from a path of straight pieces."""
    starts, along = path[:-1], np.diff(path, axis=0)
    from_start = points[:, None, :] - starts[None, :, :]
    share = np.clip(np.sum(from_start * along, axis=2) / np.sum(along * along, axis=1), 0.0, 1.0)
    rest = from_start - share[:, :, None] * along
    return np.asarray(np.sqrt(np.min(np.sum(rest * rest, axis=2), axis=1)))


def _at_stretch(start: Numbers, end: Numbers, stretch: float) -> Numbers:
    """Point of the line through two corners that has this stretch."""
    share = (stretch - start[1]) / (end[1] - start[1])
    return np.asarray(start + share * (end - start))
