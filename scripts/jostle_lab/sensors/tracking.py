"""Marks of each picture in, the path of each mark out: the nearest one in the next picture is the same (P 2.4.3)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from jostle_lab.errors import LabError
from jostle_lab.sensors.markings import Marks


@dataclass(frozen=True)
class Tracks:
    """What is taken for the same marks from picture to picture."""

    centres: NDArray[np.float64]
    """(column, row) [pixels], shape (frames, marks, 2); the marks are those of the first picture."""
    angles: NDArray[np.float64]
    """In [0, pi) [rad], shape (frames, marks)."""


def follow(pictures: Sequence[Marks]) -> Tracks:
    """Follow the marks of the first picture.

    Nothing forbids that two of them go on as the same mark: if one is not found in a picture, its nearest neighbour is
    taken for it, and stays it. P's script has the same rule.
    """
    centres, angles = [pictures[0].centres], [pictures[0].angles]
    for number, marks in enumerate(pictures[1:], 1):
        if len(marks.angles) == 0:
            raise LabError(f"Picture {number} shows no mark. Raise the resolution or the light.")
        _, same = KDTree(marks.centres).query(centres[-1])
        centres.append(marks.centres[same])
        angles.append(marks.angles[same])
    return Tracks(np.array(centres), np.array(angles))
