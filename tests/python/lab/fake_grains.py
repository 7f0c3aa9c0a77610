"""Grains that need no FMU, with the same interface: a lump on a spring, and one that also turns sixty disks."""

import copy
import pickle
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from jostle_lab.coupling.exchange import LANDING_DEGREE
from jostle_lab.coupling.master import Motion

NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


def _quintic(start: Motion, end: Motion, step: float) -> tuple[float, ...]:
    """Derivatives of order 0 to 5 at the start of the path between two motions."""
    straight = start.moved(step)
    x, v, a = (last - kept for last, kept in zip(end, straight, strict=True))
    v, a = v * step, a * step**2
    return (
        *start,
        (60.0 * x - 24.0 * v + 3.0 * a) / step**3,
        (-360.0 * x + 168.0 * v - 24.0 * a) / step**4,
        (720.0 * x - 360.0 * v + 60.0 * a) / step**5,
    )


class SpringLump:
    """A mass on a linear spring and dashpot above the base; base quintic and lump are advanced exactly.

    The work received is integrated by Gauss-Legendre quadrature with 12 nodes a step. `rest` starts the lump in
    equilibrium; the spring may pull, so that the coupled system is linear and has a stability limit.
    """

    gravity = 9.8
    box_width = 0.40
    extrapolation_degree = LANDING_DEGREE

    def __init__(self, mass: float = 0.28, stiffness: float = 1e5, damping: float = 1.0, disks: int = 60) -> None:
        self.mass, self.stiffness, self.damping = mass, stiffness, damping
        self.weight = mass * self.gravity
        self.radii = np.resize([0.015, 0.02, 0.025], disks)
        self.costs: dict[str, float] = {}
        self.base = Motion(0.0, 0.0, 0.0)
        self.lump = np.array([0.0, 0.0])  # from equilibrium
        self.received = 0.0
        self.time = 0.0
        self._transitions: dict[float, NDArray[np.float64]] = {}

    def _flows(self, step: float) -> NDArray[np.float64]:
        """exp(M s) at the quadrature nodes and at the end for (y, w, base and its five derivatives, impulse)."""
        if step not in self._transitions:
            k, c = self.stiffness, self.damping
            m = np.zeros((9, 9))
            m[0, 1] = 1.0
            m[2:7, 3:8] = np.eye(5)
            pull = np.array([k, c, -k, -c, 0.0, 0.0, 0.0, 0.0, 0.0])  # force of the lump on the base, weight left out
            m[1] = -pull / self.mass
            m[8] = pull
            times = np.array([*(0.5 * step * (NODES + 1.0)), step])
            self._transitions[step] = expm(times[:, None, None] * m)
        return self._transitions[step]

    def step(self, displacement: float, velocity: float, acceleration: float, step: float) -> float:
        end = Motion(displacement, velocity, acceleration).moved(step)
        flows = self._flows(step) @ np.array([*self.lump, *_quintic(self.base, end, step), 0.0])
        y, w, x, v = flows[:-1, :4].T
        force = self.stiffness * (y - x) + self.damping * (w - v) - self.weight
        self.received -= 0.5 * step * float(WEIGHTS @ (force * v))
        self.lump, self.base, last = flows[-1, :2], end, flows[-1]
        self.time += step
        return float(last[8] / step - self.weight)

    def energy_input(self) -> float:
        return float(self.received)

    def angles(self) -> NDArray[np.float64]:
        return np.zeros(len(self.radii))

    def positions(self) -> NDArray[np.float64]:
        n = np.arange(len(self.radii))
        return np.column_stack((-0.18 + 0.04 * (n % 10), 0.025 + 0.045 * (n // 10)))

    def save(self) -> Any:
        return {name: copy.copy(value) for name, value in vars(self).items() if not name.startswith("_")}

    def restore(self, saved: Any) -> None:
        vars(self).update({name: copy.copy(value) for name, value in saved.items()})

    def discard(self, saved: Any) -> None:
        pass

    can_serialise = True

    def to_bytes(self) -> bytes:
        return pickle.dumps(self.save())

    def from_bytes(self, state: bytes) -> None:
        self.restore(pickle.loads(state))

    def close(self) -> None:
        pass


class TurningLump(SpringLump):
    """A spring lump whose disks turn at constant rates, proportional to the mean square of the base velocity."""

    def __init__(self, seed: int = 1, disks: int = 60) -> None:
        super().__init__(stiffness=3e4, damping=20.0, disks=disks)
        self.rates = np.random.default_rng(seed).normal(size=disks)
        self.turned = np.zeros(disks)

    def step(self, displacement: float, velocity: float, acceleration: float, step: float) -> float:
        self.turned = self.turned + self.rates * 60.0 * velocity**2 * step
        return super().step(displacement, velocity, acceleration, step)

    def angles(self) -> NDArray[np.float64]:
        return self.turned


def make_turning_lump(seed: int, extra: object = None) -> TurningLump:
    """Factory for the protocol (importable by a spawned process)."""
    del extra
    return TurningLump(seed)
