"""A point of a figure of F: what is shaken how, and the transport velocities of its runs."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from jostle_lab.runs.run import Run
from jostle_lab.statistics.estimates import Estimate, Numbers

GRAVITY = 9.81
AMPLITUDE = 2e-3
"""A [m] of F IV."""
TOOTH_WIDTH = 6e-3
"""w [m] of F IV."""
SMALLEST_DIAMETER = 2.1e-3
"""[m]; this many lie side by side in a layer."""


def frequency_of(gamma: float) -> float:
    """Frequency [Hz] of Gamma at the amplitude of F IV."""
    return math.sqrt(gamma * GRAVITY / AMPLITUDE) / math.tau


def gamma_of(frequency: float) -> float:
    """Gamma = A (2 pi f)^2 / g at the amplitude of F IV."""
    return AMPLITUDE * (math.tau * frequency) ** 2 / GRAVITY


@dataclass(frozen=True)
class Case:
    """Parameters of one point; what it does not name is that of F IV, the default of the scene."""

    height: float
    """h [mm]."""
    asymmetry: float
    """a = l/w."""
    frequency: float
    """f [Hz]."""
    disks: int
    teeth: int = 10
    seconds: float = 30.0
    """Over which the velocity is averaged."""
    warm_up: float = 1.0
    """Before that [s]."""
    changes: tuple[tuple[str, float], ...] = ()
    """Other parameters of the scene, by name."""

    @property
    def layers(self) -> float:
        """Layer count n = N / k."""
        width = self.teeth * dict(self.changes).get("tooth.width", TOOTH_WIDTH)
        diameter = 2.0 * dict(self.changes).get("disk.radius_min", 0.5 * SMALLEST_DIAMETER)
        return self.disks * diameter / width

    @property
    def gamma(self) -> float:
        """A (2 pi f)^2 / g."""
        return gamma_of(self.frequency)

    def with_changes(self, **changes: float) -> "Case":
        """The same with other parameters; `tooth__tip_radius` is `tooth.tip_radius`."""
        added = {**dict(self.changes), **{name.replace("__", "."): value for name, value in changes.items()}}
        return replace(self, changes=tuple(sorted(added.items())))

    def run(self, seed: int) -> Run:
        """The run of one seed."""
        settings: dict[str, float] = {
            "tooth.height": 1e-3 * self.height,
            "tooth.asymmetry": self.asymmetry,
            "tooth.count": self.teeth,
            "drive.frequency": self.frequency,
            "measure.start": self.warm_up,
            **dict(self.changes),
            "seed": seed,
        }
        whole = self.warm_up + self.seconds
        return Run("ratchet", "event-driven", whole, whole, tuple(settings.items()), disks=self.disks)


AT_REST = 0.05
"""A point whose runs are all slower [cm/s] is at rest, which scatters less."""


@dataclass(frozen=True)
class Point:
    """The transport velocity of a case by independent runs."""

    velocities: tuple[float, ...]
    """One for each seed [cm/s]."""
    prior: float | None = None
    """Variance of single runs of points like this one, for those of few runs; see `lean_on_each_other`."""

    @cached_property
    def numbers(self) -> Numbers:
        """The same as an array."""
        return np.array(self.velocities)

    @property
    def runs(self) -> int:
        """Number of seeds."""
        return len(self.velocities)

    @cached_property
    def estimate(self) -> Estimate:
        """Mean over runs and its standard error."""
        return Estimate(float(self.numbers.mean()), self.scatter / math.sqrt(self.runs))

    @cached_property
    def scatter(self) -> float:
        """Standard deviation of single runs."""
        variance = float(self.numbers.var(ddof=1))
        if self.prior is not None:
            variance = ((self.runs - 1) * variance + PRIOR_FREEDOM * self.prior) / (self.runs - 1 + PRIOR_FREEDOM)
        return math.sqrt(variance)

    @property
    def at_rest(self) -> bool:
        """Whether all runs are slower than `AT_REST`."""
        return bool(np.all(np.abs(self.numbers) < AT_REST))

    def sign(self, significance: float = 3.0) -> int:
        """1 or -1 if it moves and the mean is that many standard errors from zero, else 0."""
        mean, error = self.estimate.mean, self.estimate.error
        return 0 if self.at_rest or abs(mean) <= significance * error else int(math.copysign(1, mean))


FEW = 5
"""Runs from which on a point stands alone."""
PRIOR_FREEDOM = 4.0
"""Degrees of freedom that the variance of the others counts for."""


def lean_on_each_other(points: "Points") -> dict[Case, Point]:
    """The same points; the errors of those of few runs lean on the others of their kind.

    Two or three runs often agree by chance. So where there are fewer than `FEW`, the variance of a run is a mean, by
    degrees of freedom, of the point's own and of the median over points of as many disks, teeth and seconds that move.
    """
    kinds: dict[tuple[float, ...], list[float]] = {}
    for case, point in points.items():
        if not point.at_rest:
            kinds.setdefault(_kind(case), []).append(float(point.numbers.var(ddof=1)))
    return {
        case: replace(point, prior=float(np.median(kinds[_kind(case)])))
        if point.runs < FEW and not point.at_rest
        else point
        for case, point in points.items()
    }


def _kind(case: Case) -> tuple[float, ...]:
    return case.disks, case.teeth, case.seconds


Points = Mapping[Case, Point]
Plan = Mapping[Case, int]
"""Cases and how many seeds each has, 1 to that many."""


def estimates(points: Points, cases: Sequence[Case]) -> list[Estimate]:
    """Mean velocities of some cases."""
    return [points[case].estimate for case in cases]


def layers_to_disks(layers: float, teeth: int = 10) -> int:
    """N of n layers."""
    return round(layers * teeth * TOOTH_WIDTH / SMALLEST_DIAMETER)
