"""The same packings by molecular dynamics and by event-driven dynamics, three stiffnesses (P 3.3)."""

from dataclasses import dataclass

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statistics.estimates import Estimate, Numbers, bootstrap_mean, bootstrap_ratio
from studies.thesis.packing.ensemble import (
    EVENT_GAMMAS,
    STIFFNESSES,
    Ensemble,
    Point,
    compared_gammas,
    hard,
    hard_at_length,
    observe,
    soft,
    velocities,
)
from studies.thesis.packing.runs import MOLECULAR, MOVING, RANDOM_PHASE, Method

QUICK_GAMMAS = (2.0, 10.0)
FOLLOWED = (2.0, 10.0)
"""Gamma at which the disks are compared one by one."""

Key = tuple[Method, float, float]
"""Method, k_n [N/m], Gamma."""


@dataclass(frozen=True)
class Comparison:
    """The same packings by every method, and hard disks at the effort of P."""

    found: dict[Key, Ensemble]
    turning: dict[Key, Numbers]
    """Mean angular velocity of each disk [RPM], shape (packings, disks); at some Gamma."""
    long: dict[float, Ensemble]
    """Hard disks at length, by Gamma."""
    cost: dict[Key, float]
    """Processor time of a simulated second of one packing [s]."""

    def gammas(self, stiffness: float) -> list[float]:
        """Gamma of a stiffness."""
        return [g for m, k, g in self.found if m is MOLECULAR and k == stiffness]

    def ratio(self, method: Method, stiffness: float, gamma: float) -> Estimate:
        """<omega^2> over that of molecular dynamics, packing by packing the same."""
        return bootstrap_ratio(
            self.found[method, stiffness, gamma].mean_square, self.found[MOLECULAR, stiffness, gamma].mean_square
        )

    def alike(self, one: Method, other: Method, stiffness: float, gammas: list[float]) -> Estimate:
        """Correlation of the velocities of the same disks by two methods, mean over Gamma."""
        by_gamma = [
            [
                np.corrcoef(a, b)[0, 1]
                for a, b in zip(self.turning[one, stiffness, g], self.turning[other, stiffness, g], strict=True)
            ]
            for g in gammas
        ]
        return bootstrap_mean(np.mean(by_gamma, axis=0))


def compare(laboratory: Laboratory, quick: bool) -> Comparison:
    """Run every packing by every method."""
    points: dict[Key, Point] = {}
    for stiffness in STIFFNESSES:
        for gamma in QUICK_GAMMAS if quick else compared_gammas(stiffness):
            points[MOLECULAR, stiffness, gamma] = soft(stiffness, gamma)
            for method in (RANDOM_PHASE, MOVING):
                points[method, stiffness, gamma] = hard(method, stiffness, gamma)
    if quick:
        points = {key: Point(p.method, p.stiffness, p.gamma, 2, 5, 3) for key, p in points.items()}
    found: dict[Point, Ensemble] = {}
    cost: dict[Key, float] = {}
    for key, p in points.items():
        before = laboratory.spent
        found |= observe(laboratory, [p], "figure 3.11")
        cost[key] = (laboratory.spent - before) / (p.packings * (p.settling + p.observed))
    followed = {key: p for key, p in points.items() if p.gamma in FOLLOWED}
    turning = velocities(laboratory, followed.values(), "figure 3.11")
    long = {} if quick else observe(laboratory, map(hard_at_length, EVENT_GAMMAS), "figure 3.11, at length")
    return Comparison(
        {key: found[p] for key, p in points.items()},
        {key: turning[p] for key, p in followed.items()},
        {p.gamma: e for p, e in long.items()},
        cost,
    )
