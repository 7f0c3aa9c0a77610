"""Runs of a disk on supports that vibrate randomly (P 5.3), and what they measure at a tilt and an amplitude.

Each seed of a tilted disk is run twice, its noise as drawn and mirrored. Both are equally likely, and the mean of the
two keeps what the tilt does and loses most of the chance. A disk without tilt turns exactly the other way in the
mirror: such a pair cancels whatever the program does, so that without tilt there are runs as drawn only.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.tables import Table
from studies.thesis.two_supports.runs import ENGINE, SCENE, TIME_STEP

SETTLING = 0.5
"""Time unobserved at the start of a run [s]; noise is forgotten in 1 / (c omega_b) = 0.03 s."""
AS_DRAWN, MIRRORED = 1, 3
POINTS = ("s1", "s2", "t1", "t2")


@dataclass(frozen=True)
class Effort:
    """How long each point is run."""

    seconds: float
    """Of each run, after SETTLING."""
    seeds: int
    """Of a tilted disk; without tilt there are three times as many, none of them mirrored."""


QUICK, FULL = Effort(3.0, 4), Effort(20.0, 8)


@dataclass(frozen=True)
class Place:
    """A tilt and an amplitude of the supports."""

    tilt: float
    """theta_T [rad]."""
    amplitude: float
    """A_b [m]."""
    inertia: float = 1.0
    """Times the mass of P 5.1, at the same weight."""

    def run(self, seed: int, noise: int, effort: Effort) -> Run:
        """One run."""
        settings: tuple[tuple[str, float], ...] = (
            ("tilt", self.tilt),
            ("support.amplitude", self.amplitude),
            ("seed", seed),
            ("support.noise", noise),
            ("time_step", TIME_STEP),
            ("measure.start", SETTLING),
        )
        if self.inertia != 1.0:
            settings += (("disk.mass", 0.1 * self.inertia), ("gravity", 10.0 / self.inertia))
        seconds = SETTLING + effort.seconds
        return Run(SCENE, ENGINE, seconds, seconds, settings, drive="random-supports")

    def seeds(self, count: int) -> range:
        """Seeds that no other place of the figures has, so that all points are independent."""
        first = 10_000 * round(self.amplitude / 1e-7) + 100 * round(self.tilt / (0.01 * math.pi)) + 1
        return range(first, first + count)

    def groups(self, effort: Effort) -> list[list[Run]]:
        """Runs that share their chance: pairs of a tilted disk, single runs without tilt."""
        if self.tilt == 0.0:
            return [[self.run(seed, AS_DRAWN, effort)] for seed in self.seeds(3 * effort.seeds)]
        noises = (AS_DRAWN, MIRRORED)
        return [[self.run(seed, noise, effort) for noise in noises] for seed in self.seeds(effort.seeds)]


@dataclass(frozen=True)
class Measured:
    """What the runs of a place show; numbers of visits and times are per run."""

    place: Place
    velocity: Estimate
    """Mean angular velocity, its error from group to group [rad/s]."""
    single: float
    """Standard error that as many runs without pairs would have [rad/s]."""
    opened: float
    """Share of the runs in which a contact opened."""
    counts: Mapping[str, Numbers]
    """Times that the contacts came to S1, S2, T1, T2, a number for each group."""
    times: Mapping[str, Numbers]
    """Time at S1, S2, T1, T2 [s]."""
    slips: float
    """Times that a contact began to slip, per second."""
    slipping: Estimate
    """Share of the time that a contact slips."""
    seconds: float
    """Observed in each run."""

    @property
    def lasting(self) -> bool:
        """Whether no contact opened: the thesis leaves the others out."""
        return self.opened == 0.0

    def share_of_counts(self, name: str) -> Estimate:
        """Share of a point among all visits."""
        return _ratio(self.counts[name], np.sum([self.counts[n] for n in POINTS], axis=0))

    def share_of_time(self, name: str) -> Estimate:
        """Share of the whole time that is spent at a point."""
        return Estimate.over_runs(self.times[name] / self.seconds)

    def duration(self, name: str) -> Estimate:
        """Mean time of a visit [s]."""
        return _ratio(self.times[name], self.counts[name])

    def row(self) -> dict[str, Any]:
        """Data."""
        return {
            "tilt_over_pi": self.place.tilt / math.pi,
            "support_amplitude": self.place.amplitude,
            "angular_velocity": self.velocity.mean,
            "standard_error": self.velocity.error,
            "standard_error_without_pairs": self.single,
            "runs_with_open_contacts": self.opened,
            "slips_per_second": self.slips,
            "share_of_time_slipping": self.slipping.mean,
            **{f"count_{name}": float(np.mean(self.counts[name])) for name in POINTS},
            **{f"time_{name}": float(np.mean(self.times[name])) for name in POINTS},
        }


def _ratio(above: Numbers, below: Numbers) -> Estimate:
    """Ratio of two means over the same groups, its error to first order; NaN if nothing is below."""
    if len(above) < 2 or not below.any():
        return Estimate(math.nan, math.nan)
    ratio = float(above.sum() / below.sum())
    rest = (above - ratio * below) / below.mean()
    return Estimate(ratio, float(rest.std(ddof=1)) / math.sqrt(len(rest)))


def measure(laboratory: Laboratory, title: str, places: Sequence[Place], effort: Effort) -> dict[Place, Measured]:
    """Run all places."""
    groups = {place: place.groups(effort) for place in places}
    tables = laboratory.run([run for found in groups.values() for group in found for run in group], title)
    return {
        place: measured(place, [[tables[run] for run in group] for group in found], effort)
        for place, found in groups.items()
    }


def measured(place: Place, groups: Sequence[Sequence[Table]], effort: Effort) -> Measured:
    """What the last rows of the runs of a place show; runs of one group share their chance."""

    def last(name: str) -> Numbers:
        """Shape (groups, runs of a group)."""
        return np.array([[table[name][-1] for table in group] for group in groups])

    values = last("time_averaged_angular_velocity")
    slipping = (last("contact[1].slip_time") + last("contact[2].slip_time")) / (2.0 * effort.seconds)
    return Measured(
        place,
        Estimate.over_runs(values.mean(axis=1)),
        float(values.std(ddof=1) / math.sqrt(values.size)),
        float(np.mean(last("detachments") > 0)),
        {name: last(f"sliding.{name}.count").mean(axis=1) for name in POINTS},
        {name: last(f"sliding.{name}.time").mean(axis=1) for name in POINTS},
        float(last("slips").mean()) / effort.seconds,
        Estimate.over_runs(slipping.mean(axis=1)),
        effort.seconds,
    )
