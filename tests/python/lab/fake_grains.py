"""Grains that need no FMU, with the same interface: a lump on a spring, and one that also turns sixty disks."""

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


class SpringLump:
    """A mass on a linear spring and dashpot above the base; base cubic and lump are advanced exactly.

    The work received is integrated by Gauss-Legendre quadrature with 12 nodes a step. `rest` starts the lump in
    equilibrium; the spring may pull, so that the coupled system is linear and has a stability limit.
    """

    gravity = 9.8
    box_width = 0.40

    def __init__(self, mass: float = 0.28, stiffness: float = 1e5, damping: float = 1.0, disks: int = 60) -> None:
        self.mass, self.stiffness, self.damping = mass, stiffness, damping
        self.weight = mass * self.gravity
        self.radii = np.resize([0.015, 0.02, 0.025], disks)
        self.costs: dict[str, float] = {}
        self.base = np.zeros(2)
        self.lump = np.array([0.0, 0.0])  # from equilibrium
        self.received = 0.0
        self.time = 0.0
        self._transitions: dict[float, list[NDArray[np.float64]]] = {}

    def _flows(self, step: float) -> list[NDArray[np.float64]]:
        """exp(M s) at the quadrature nodes and at the end for (y, w, x, v, a, j, impulse)."""
        if step not in self._transitions:
            k, c = self.stiffness, self.damping
            m = np.zeros((7, 7))
            m[0, 1] = m[2, 3] = m[3, 4] = m[4, 5] = 1.0
            pull = np.array([k, c, -k, -c, 0.0, 0.0, 0.0])  # force of the lump on the base, weight left out
            m[1] = -pull / self.mass
            m[6] = pull
            self._transitions[step] = [expm(m * s) for s in [*(0.5 * step * (NODES + 1.0)), step]]
        return self._transitions[step]

    def step(self, displacement: float, velocity: float, step: float) -> float:
        end = displacement + step * velocity
        x, v = self.base
        # cubic with both ends' position and velocity: x + v s + a s^2/2 + j s^3/6
        gap = end - x - step * v
        change = velocity - v
        a = 6.0 * gap / step**2 - 2.0 * change / step
        j = (change / step - a) * 2.0 / step
        state = np.array([*self.lump, x, v, a, j, 0.0])
        *nodes, last = (flow @ state for flow in self._flows(step))
        k, c = self.stiffness, self.damping
        for weight, node in zip(WEIGHTS, nodes, strict=True):
            force = k * (node[0] - node[2]) + c * (node[1] - node[3]) - self.weight
            self.received -= 0.5 * step * weight * force * node[3]
        self.lump, self.base = last[:2], np.array([end, velocity])
        self.time += step
        return float(last[6] / step - self.weight)

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

    def close(self) -> None:
        pass


class TurningLump(SpringLump):
    """A spring lump whose disks turn at constant rates, proportional to the mean square of the base velocity."""

    def __init__(self, seed: int = 1, disks: int = 60) -> None:
        super().__init__(stiffness=3e4, damping=20.0, disks=disks)
        self.rates = np.random.default_rng(seed).normal(size=disks)
        self.turned = np.zeros(disks)

    def step(self, displacement: float, velocity: float, step: float) -> float:
        self.turned = self.turned + self.rates * 60.0 * velocity**2 * step
        return super().step(displacement, velocity, step)

    def angles(self) -> NDArray[np.float64]:
        return self.turned


def make_turning_lump(seed: int) -> TurningLump:
    """Factory for the protocol (importable by a spawned process)."""
    return TurningLump(seed)
