"""What the laboratory needs of the grains, whatever simulates them."""

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray


class Grains(Protocol):
    """Disks in a box whose bottom follows inputs.

    An implementation guarantees: between t and t + h the base moves on the quintic from its present position, velocity
    and acceleration to those to which a polynomial through the inputs of t, and those before, leads at t + h. Of degree
    two it is the parabola through the inputs of t alone:
    (displacement + h velocity + h^2 acceleration / 2, velocity + h acceleration, acceleration).
    """

    radii: NDArray[np.float64]
    """Disk radii [m], shape (disks,)."""
    weight: float
    """Total weight of the disks [N]."""
    box_width: float
    """Inner width of the box [m]."""
    gravity: float
    """Acceleration of gravity [m/s2]."""
    extrapolation_degree: int
    """Degree of the polynomial through the inputs; -1: chosen by the errors of past predictions."""
    costs: dict[str, float]
    """Seconds of wall clock spent, by part."""

    def step(self, displacement: float, velocity: float, acceleration: float, step: float) -> float:
        """Advance by `step` [s]; return the mean force [N, up positive] of the grains on the base over it.

        The first three are the motion of the base [m, m/s, m/s2] at the present time, before the step.
        """

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

    @property
    def can_serialise(self) -> bool:
        """Whether the next two can be called."""

    def to_bytes(self) -> bytes:
        """The state, for another process."""

    def from_bytes(self, state: bytes) -> None:
        """Go on from the state of grains with the same parameters; they step to the same bits then."""

    def close(self) -> None:
        """Release everything."""


class GrainsFactory(Protocol):
    """Makes grains of a seed."""

    def __call__(self, seed: int, /, extra: Mapping[str, float] = ...) -> Grains:
        """Grains of one packing; `extra` has further parameters, which give way to those that the user chose."""
