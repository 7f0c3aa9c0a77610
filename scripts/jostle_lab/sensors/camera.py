"""Angles in, what a camera at one frame a second makes of them out (P 2.4.3).

The marks on the disks are rectangles: a picture gives their angle only modulo 180 degrees. The paths are made
continuous by the rule of the thesis with its sign put right: a jump above +90 degrees shifts the past by +180, one
below -90 by -180. So a disk that turns more than 90 degrees between frames is taken for one that turns less or the
other way: at one frame a second every mean rate above 15 RPM is wrong.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

HALF_TURN = math.pi


@dataclass(frozen=True)
class Camera:
    """A camera that takes `frame_rate` pictures a second."""

    frame_rate: float = 1.0
    """[Hz]."""

    def alias_limit(self) -> float:
        """Largest angular velocity [rad/s] that the camera measures correctly: 90 degrees a frame, 15 RPM at 1 Hz."""
        return 0.5 * HALF_TURN * self.frame_rate


def photograph(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles of the marks in [0, pi) [rad] of any angles [rad], same shape."""
    remainder = np.mod(angles, HALF_TURN)
    return np.where(remainder >= HALF_TURN, 0.0, remainder)  # the remainder of a tiny negative angle rounds to pi


def unwrap(photographed: NDArray[np.float64]) -> NDArray[np.float64]:
    """Continuous paths [rad] of angles modulo 180 degrees, shape (frames, disks); the last frame stays as it is."""
    return np.asarray(np.unwrap(photographed[::-1], period=HALF_TURN, axis=0)[::-1])


@dataclass(frozen=True)
class Aliasing:
    """Mean angular velocities [rad/s] by the camera and in truth, shape (disks,), and where they differ."""

    true_velocity: NDArray[np.float64]
    camera_velocity: NDArray[np.float64]
    differs: NDArray[np.bool_]

    def count(self) -> int:
        """Number of disks whose excursion by the camera is wrong."""
        return int(np.count_nonzero(self.differs))


def aliasing(angles: NDArray[np.float64], interval: float) -> Aliasing:
    """Compare camera and truth over frames `interval` [s] apart; `angles` [rad, unwrapped], shape (frames, disks).

    The excursion by camera is either right to rounding or off by whole half turns.
    """
    duration = (angles.shape[0] - 1) * interval
    path = unwrap(photograph(angles))
    true_excursion = angles[-1] - angles[0]
    camera_excursion = path[-1] - path[0]
    differs = np.abs(camera_excursion - true_excursion) > 0.5 * HALF_TURN
    return Aliasing(true_excursion / duration, camera_excursion / duration, differs)
