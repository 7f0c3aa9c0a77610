"""Ensembles of 60-disk packings (P 3.2, 3.3): which runs there are, and what each packing's rotation outputs say.

The same packings, seeds 1 to 25 or more, are shaken at every Gamma, with every stiffness and by every engine, so that
ratios and slopes are of the same packings. The model itself measures the rotation, once a second as P's camera did, so
that no trajectory is kept.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statistics.estimates import Estimate, Numbers, bootstrap_mean
from jostle_lab.statistics.rotation import RPM
from jostle_lab.tables import Table
from studies.thesis.packing.runs import DISKS, FREQUENCY, MOLECULAR, RANDOM_PHASE, Method, shaken

GAMMAS = (
    *(0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 5.0, 6.5, 8.0),
    *(10.0, 12.0, 16.0, 20.0, 25.0, 29.0),
)
"""Of molecular dynamics at k_n = 1e4 N/m; P goes from 0.1 to 29."""
EVENT_GAMMAS = (2.0, 3.0, 5.0, 10.0, 20.0, 29.0)
"""Of event-driven dynamics."""
STIFFNESSES = (1e4, 1e5, 1e6)
"""k_n [N/m] of P 3.2."""
SOFT_GAMMAS = {
    1e4: GAMMAS,
    1e5: (0.2, 0.4, 0.6, 0.8, 0.9, 1.0, 1.2, 2.0, 3.0, 5.0, 10.0, 20.0),
    1e6: (0.4, 0.8, 0.9, 1.0, 1.2, 2.0, 5.0, 10.0, 20.0),
}
"""Of molecular dynamics, by stiffness: the stiffer, the more a second costs."""
PACKINGS = {1e4: 25, 1e5: 25, 1e6: 25}
"""By stiffness."""
EVENT_PACKINGS = 100
EVENT_LENGTH = 1000
"""As in P [s]."""
EVENT_LENGTH_LOW = 200
"""Below Gamma = 5, where a second costs most [s]."""


@dataclass(frozen=True)
class Point:
    """An ensemble: method, stiffness, Gamma, and how long its packings are shaken."""

    method: Method
    stiffness: float
    """k_n [N/m]."""
    gamma: float
    settling: int
    """Unobserved [s]."""
    observed: int
    """[s]."""
    packings: int
    frequency: float = FREQUENCY
    """[Hz]."""

    def run(self, seed: int) -> Run:
        """The run of a packing, other parameters as in P 3.2 (the scene's defaults)."""
        settings = shaken(self.method, self.stiffness, self.gamma, seed, self.settling, self.frequency)
        whole = float(self.settling + self.observed)
        return Run("packing", self.method.engine, whole, whole, settings)


def soft(stiffness: float, gamma: float) -> Point:
    """Molecular dynamics. Weak shaking settles slowly; strong shaking makes angles walk at random, which takes long."""
    if stiffness == 1e4:
        settling, observed = (40 if gamma < 0.25 else 10), (60 if gamma >= 10.0 else 30)
    elif stiffness == 1e5:
        settling, observed = (10 if gamma < 1.0 else 6), 12
    else:
        settling, observed = (8 if gamma < 1.0 else 4), 6
    return Point(MOLECULAR, stiffness, gamma, settling, observed, PACKINGS[stiffness])


def hard(method: Method, stiffness: float, gamma: float) -> Point:
    """Event-driven dynamics, as long as the soft disks it is compared with; the stiffness decides the restitution."""
    like = soft(stiffness, gamma)
    return Point(method, stiffness, gamma, like.settling, like.observed, like.packings)


def hard_at_length(gamma: float) -> Point:
    """Event-driven dynamics of as many packings as P has, and for as long, but at low Gamma."""
    return Point(RANDOM_PHASE, 1e4, gamma, 10, EVENT_LENGTH if gamma >= 5.0 else EVENT_LENGTH_LOW, EVENT_PACKINGS)


def soft_points(stiffness: float) -> list[Point]:
    """All Gamma of molecular dynamics at a stiffness."""
    return [soft(stiffness, gamma) for gamma in SOFT_GAMMAS[stiffness]]


def compared_gammas(stiffness: float) -> list[float]:
    """Gamma of P's event-driven range at which there are soft disks of a stiffness as well."""
    return [p.gamma for p in soft_points(stiffness) if p.gamma in EVENT_GAMMAS]


def hard_points(method: Method) -> list[Point]:
    """Event-driven dynamics beside molecular dynamics, all stiffnesses."""
    return [hard(method, stiffness, gamma) for stiffness in STIFFNESSES for gamma in compared_gammas(stiffness)]


@dataclass(frozen=True)
class Ensemble:
    """What the packings of a point do; arrays of shape (packings,), in the order of the seeds."""

    point: Point
    mean_square: Numbers
    """<omega^2> of each packing [RPM^2]: excursion over time, squared, mean over its disks."""
    persistent: Numbers
    """<omega^2> without what the random walk of the angles adds to a finite record [RPM^2]."""
    correlation: Numbers
    """<rho^2> over its disks."""
    adjusted_deviation: Numbers
    """<sigma_a> over its disks."""

    def estimate(self, quantity: str) -> Estimate:
        """Mean over the packings; error by drawing packings."""
        return bootstrap_mean(getattr(self, quantity))


def observe(laboratory: Laboratory, points: Iterable[Point], title: str) -> dict[Point, Ensemble]:
    """Run every packing of every point."""
    wanted = list(points)
    tables = laboratory.run([p.run(seed) for p in wanted for seed in range(1, p.packings + 1)], title)
    return {p: _ensemble(p, [tables[p.run(seed)] for seed in range(1, p.packings + 1)]) for p in wanted}


def _ensemble(point: Point, tables: Sequence[Table]) -> Ensemble:
    def last(name: str) -> Numbers:
        return np.array([table[f"rotation.{name}"][-1] for table in tables])

    square = RPM**2
    return Ensemble(
        point,
        last("mean_square") / square,
        last("persistent_mean_square") / square,
        last("correlation"),
        last("adjusted_deviation"),
    )


def correlations(laboratory: Laboratory, points: Iterable[Point], title: str) -> dict[Point, Numbers]:
    """rho^2 of every disk of every packing, shape (packings, disks)."""
    return _each_disk(laboratory, points, title, "rotation_correlation")


def velocities(laboratory: Laboratory, points: Iterable[Point], title: str) -> dict[Point, Numbers]:
    """Mean angular velocity of every disk of every packing [RPM], shape (packings, disks)."""
    return {p: v / RPM for p, v in _each_disk(laboratory, points, title, "mean_angular_velocity").items()}


def _each_disk(laboratory: Laboratory, points: Iterable[Point], title: str, name: str) -> dict[Point, Numbers]:
    wanted = list(points)
    tables = laboratory.run([p.run(seed) for p in wanted for seed in range(1, p.packings + 1)], title)
    return {
        p: np.array(
            [
                [tables[p.run(seed)][f"disk.{name}[{disk}]"][-1] for disk in range(1, DISKS + 1)]
                for seed in range(1, p.packings + 1)
            ]
        )
        for p in wanted
    }


def effort(points: Sequence[Point]) -> str:
    """How many packings for how long, as words."""
    packings = sorted({p.packings for p in points})
    observed = sorted({p.observed for p in points})
    settling = sorted({p.settling for p in points})

    def span(values: list[int]) -> str:
        return str(values[0]) if len(values) == 1 else f"{values[0]} to {values[-1]}"

    return f"{span(packings)} packings, seeds 1 and up; {span(settling)} s unobserved, then {span(observed)} s"
