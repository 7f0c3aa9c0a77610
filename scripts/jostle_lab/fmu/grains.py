"""What the laboratory needs of the grains, whatever simulates them."""

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray


class Grains(Protocol):
    """Disks in a box whose bottom follows inputs.

    An implementation guarantees: between t and t + h the base moves on the cubic that continues its present position
    and velocity to (displacement + h velocity, velocity), of the inputs given at t.
    """

    radii: NDArray[np.float64]
    """Disk radii [m], shape (disks,)."""
    weight: float
    """Total weight of the disks [N]."""
    box_width: float
    """Inner width of the box [m]."""
    gravity: float
    """Acceleration of gravity [m/s2]."""
    costs: dict[str, float]
    """Seconds of wall clock spent, by part."""

    def step(self, displacement: float, velocity: float, step: float) -> float:
        """Advance by `step` [s]; return the mean force [N, up positive] of the grains on the base over it."""

    def energy_input(self) -> float:
        """Work [J] done by the base on the grains since the start."""

    def angles(self) -> NDArray[np.float64]:
        """Unwrapped angles [rad, counter-clockwise], shape (disks,)."""

    def positions(self) -> NDArray[np.float64]:
        """Centres (x, y) [m], shape (disks, 2)."""

    def save(self) -> Any:
        """Handle of a copy of the state, for `restore` and `discard`."""

    def restore(self, saved: Any) -> None:
        """Return to the state of `saved`; `saved` stays valid."""

    def discard(self, saved: Any) -> None:
        """Free `saved`."""

    def close(self) -> None:
        """Release everything."""
