"""Recorded paths in, what a webcam and P's processing of its pictures make of them out, beside the truth (P 2.4.3)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from jostle_lab.errors import LabError
from jostle_lab.sensors.camera import photograph, unwrap
from jostle_lab.sensors.markings import Threshold, find_marks
from jostle_lab.sensors.tracking import follow
from jostle_lab.sensors.webcam import BackLight


@dataclass(frozen=True)
class Seen:
    """Paths by pictures of those disks whose marks were found in the first one."""

    disks: NDArray[np.intp]
    """Numbers of the disks, from 0, shape (found,)."""
    angles: NDArray[np.float64]
    """Continuous [rad], shape (frames, found)."""
    swapped: NDArray[np.bool_]
    """Whether the mark that is followed is another disk's by now, shape (frames, found)."""
    angle_error: NDArray[np.float64]
    """Angle of the mark less that of the disk it is on, in (-pi/2, pi/2] [rad], shape (frames, found)."""
    lost: int
    """Marks that were not found, over all pictures."""
    extra: int
    """What was taken for a mark and is none, over all pictures."""

    def rms_angle_error(self) -> float:
        """[rad]."""
        return float(np.sqrt(np.mean(self.angle_error**2)))

    def swapped_share(self) -> float:
        """Share of the disks that are taken for another one at some time."""
        return float(np.mean(self.swapped.any(axis=0)))


def look(
    scene: BackLight,
    positions: NDArray[np.float64],
    angles: NDArray[np.float64],
    generator: np.random.Generator,
    threshold: Threshold = Threshold.ISODATA,
) -> Seen:
    """Take a picture of each frame, find the marks, and follow them.

    Args:
        scene: camera and box.
        positions: of the disks [m], shape (frames, disks, 2).
        angles: of the disks [rad], shape (frames, disks).
        generator: of the camera's noise.
        threshold: what tells black from white.

    """
    area, found = scene.webcam.mark_area(), []
    for places, turned in zip(positions, angles, strict=True):
        found.append(find_marks(scene.take(places, turned, generator), area, threshold))
    if len(found[0].angles) == 0:
        raise LabError("The first picture shows no mark. Raise the resolution or the light.")
    tracks = follow(found)
    nearest = [
        KDTree(places).query(scene.to_metres(centres))[1]
        for places, centres in zip(positions, tracks.centres, strict=True)
    ]
    disk = np.array(nearest)
    true = photograph(np.take_along_axis(angles, disk, axis=1))
    error = np.mod(tracks.angles - true + 0.5 * math.pi, math.pi) - 0.5 * math.pi
    beside = np.array([len(marks.angles) for marks in found]) - angles.shape[1]
    lost, extra = int(-np.minimum(beside, 0).sum()), int(np.maximum(beside, 0).sum())
    return Seen(disk[0], unwrap(tracks.angles), disk != disk[0], error, lost, extra)
