"""Simulations along a line in the plane of tilt and amplitude of the torque, with the theory beside them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statistics.estimates import Numbers
from studies.thesis.two_supports.runs import NORMAL_STIFFNESS, Torque, Turning, row, velocity


@dataclass(frozen=True)
class Line:
    """Torques at one tilt or of one amplitude."""

    torques: tuple[Torque, ...]
    found: tuple[Turning, ...]
    theory: Numbers
    """5.9 at the same torques, rigid contacts [rad/s]."""
    soft: Numbers
    """The same with the overlap of soft contacts."""
    curve: Numbers
    """5.9 at torques close together, rigid contacts [rad/s]."""

    @classmethod
    def of(
        cls,
        laboratory: Laboratory,
        torques: tuple[Torque, ...],
        done: Mapping[Torque, Turning],
        close: Sequence[Torque],
        **properties: Any,
    ) -> Self:
        """The line through `torques`, whose simulations are in `done`, with the theory there and at `close`."""

        def theory(at: Sequence[Torque], normal_stiffness: float = math.inf) -> Numbers:
            tilts = list(dict.fromkeys(torque.tilt for torque in at))
            amplitudes = list(dict.fromkeys(torque.amplitude for torque in at))
            return velocity(laboratory, tilts, amplitudes, normal_stiffness=normal_stiffness)["angular_velocity"]

        found = tuple(done[torque] for torque in torques)
        return cls(torques, found, theory(torques), theory(torques, NORMAL_STIFFNESS), theory(close), **properties)

    @property
    def tilts(self) -> Numbers:
        """theta_T [rad]."""
        return np.array([torque.tilt for torque in self.torques])

    @property
    def amplitudes(self) -> Numbers:
        """A_e [N m]."""
        return np.array([torque.amplitude for torque in self.torques])

    @property
    def velocities(self) -> Numbers:
        """Simulated [rad/s]."""
        return np.array([found.velocity for found in self.found])

    def rows(self, **columns: float) -> list[dict[str, Any]]:
        """Data, with both theories."""
        points = zip(self.torques, self.found, self.theory.tolist(), self.soft.tolist(), strict=True)
        return [row(torque, f, rigid) | {"theory_with_overlap": soft, **columns} for torque, f, rigid, soft in points]
