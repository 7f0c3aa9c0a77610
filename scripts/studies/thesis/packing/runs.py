"""Runs of the 60-disk packing of P 3.2 and 3.3, and what is read from them."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jostle_lab.runs.run import Run
from jostle_lab.statistics.rotation import RPM
from jostle_lab.tables import Table

GRAVITY = 9.8
FREQUENCY = 80.0
DISKS = 60


def amplitude(gamma: float) -> float:
    """A [m] of dimensionless acceleration Gamma = A omega_b^2 / g."""
    return gamma * GRAVITY / (math.tau * FREQUENCY) ** 2


@dataclass(frozen=True)
class Method:
    """How a packing is simulated."""

    engine: str
    base: int | None
    """Bottom of the event-driven packing: 1 random phase, 2 moving."""
    name: str


MOLECULAR = Method("molecular-dynamics", None, "MD")
RANDOM_PHASE = Method("event-driven", 1, "ED, random phase")
MOVING = Method("event-driven", 2, "ED, moving base")


@dataclass(frozen=True)
class Record:
    """Settle unobserved, then observe, both whole numbers of samples [s]."""

    settling: float
    observed: float
    sample: float


def packing_run(method: Method, gamma: float, stiffness: float, seed: int, record: Record) -> Run:
    """The packing of `seed` at Gamma, other parameters as in P 3.2 (the scene's defaults)."""
    settings: list[tuple[str, float]] = [
        ("seed", seed),
        ("gravity", GRAVITY),
        ("drive.amplitude", amplitude(gamma)),
        ("drive.frequency", FREQUENCY),
        ("contact.normal_stiffness", stiffness),
    ]
    if method.base is not None:
        settings.append(("base.model", method.base))
    return Run("packing", method.engine, record.settling + record.observed, record.sample, tuple(settings))


def angles(table: Table, record: Record) -> NDArray[np.float64]:
    """Angles of the disks [rad] from the end of settling on, shape (samples, disks)."""
    observed = table["time"] > record.settling - 0.5 * record.sample
    return np.column_stack([table[f"disk.angle[{disk}]"][observed] for disk in range(1, DISKS + 1)])


def mean_velocities(paths: NDArray[np.float64], sample: float) -> NDArray[np.float64]:
    """Mean angular velocity of each disk [RPM]: whole excursion over time."""
    return np.asarray((paths[-1] - paths[0]) / ((len(paths) - 1) * sample) / RPM)


def mean_square(paths: NDArray[np.float64], sample: float) -> float:
    """<omega^2> [RPM^2] as in the thesis: whole excursion over time, squared, mean over disks."""
    return float(np.mean(mean_velocities(paths, sample) ** 2))


def persistent_square(paths: NDArray[np.float64], sample: float) -> float:
    """<omega_1 omega_2> [RPM^2] of the two halves of the record: what of <omega^2> lasts.

    <omega^2> of a finite record also holds the random walk of the angles; it drops out of this product.
    """
    half = (len(paths) - 1) // 2
    first = (paths[half] - paths[0]) / (half * sample)
    second = (paths[2 * half] - paths[half]) / (half * sample)
    return float(np.mean(first * second) / RPM**2)
