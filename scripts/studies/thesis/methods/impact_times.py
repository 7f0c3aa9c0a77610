"""P 2.3.2: times of collisions as printed, beside the first zero of the distance along the flights."""

import math

import numpy as np

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.verdicts import every, exact, true
from studies.ratchet.collision_times import HORIZON, first_contact

GRAVITY = 9.8
CASES = 100
TOLERANCE = 1e-9
"""[s]."""


def pair_time(place: Numbers, velocity: Numbers, reach: float) -> float:
    """2.30; not a number where its root is not real."""
    approach, speed = float(place @ velocity), float(velocity @ velocity)
    apart = float(place @ place) - reach**2
    if approach >= 0.0:
        return math.inf
    root = approach**2 - speed * apart
    return apart / (-approach + math.sqrt(root)) if root >= 0.0 else math.nan


def wall_time(gap: float, velocity: float, up: float) -> float:
    """2.36: `gap` is r.n - R, `velocity` v.n, `up` n_y; not a number where its root is not real."""
    root = velocity**2 + 2.0 * GRAVITY * up * gap
    if velocity < 0.0:
        return 2.0 * gap / (-velocity + math.sqrt(root)) if root >= 0.0 else math.nan
    if velocity > 0.0 and up > 0.0:
        return (velocity + math.sqrt(root)) / (GRAVITY * up)
    return math.inf


def time_statements() -> list[Statement]:
    """2.30 and 2.36."""
    return [_pairs(), *_walls()]


def _pairs() -> Statement:
    generator, found, silent = np.random.default_rng(4), [], 0
    for _ in range(CASES):
        place = np.array([0.06, 0.0]) + generator.uniform(-0.01, 0.01, 2)
        velocity = np.array([-0.4, 0.0]) + generator.uniform(-0.25, 0.25, 2)
        met = first_contact(
            lambda t, p=place, v=velocity: np.hypot(p[0] + v[0] * t, p[1] + v[1] * t) - 0.04  # type: ignore[misc]
        )
        printed = pair_time(place, velocity, 0.04)
        if math.isfinite(met):
            found.append(abs(printed - met))
        silent += math.isnan(printed) and math.isfinite(met)
    return Statement.judged(
        "2.30",
        "time until two disks that approach each other collide",
        f"{len(found)} of {CASES} pairs meet, largest difference {max(found):.0e} s; for others the root is not real",
        every(
            [exact(max(found), TOLERANCE), true(silent == 0, "")], "difference at most 1e-9 s, none missed; no chance"
        ),
    )


def _walls() -> list[Statement]:
    worst, void = _against((1.0, 0.0))
    ceiling, over = _against((-1.0,))
    return [
        Statement.judged(
            "2.36",
            "time until a disk meets the floor or a side wall",
            f"largest difference {worst:.0e} s; {void} without a real root",
            exact(worst, TOLERANCE, "difference [s]"),
        ),
        Statement.judged(
            "2.36",
            "the first branch holds for every wall that a disk moves towards (v.n < 0)",
            f"ceiling: largest difference {ceiling:.0e} s where a disk reaches it; in {over} of {CASES} flights it "
            "turns back before, and the root is not real",
            true(over == 0, "a real time in every flight; no chance"),
            "the discriminant is to be looked at first; P's box has no ceiling (2.4.1)",
        ),
    ]


def _against(ups: tuple[float, ...]) -> tuple[float, int]:
    """Largest difference, and flights without a real root, of walls with these n_y."""
    generator, worst, void = np.random.default_rng(5), 0.0, 0
    for up in ups:
        for _ in range(CASES):
            gap, velocity = float(generator.uniform(0.005, 0.05)), float(generator.uniform(-1.2, 0.8))
            velocity = -abs(velocity) if up < 0.0 else velocity
            met = first_contact(
                lambda t, g=gap, v=velocity, u=up: g + v * t - 0.5 * GRAVITY * u * t**2  # type: ignore[misc]
            )
            printed = wall_time(gap, velocity, up)
            void += math.isnan(printed)
            if math.isfinite(met):
                worst = max(worst, abs(printed - met))
            elif math.isfinite(printed) and printed < HORIZON:
                worst = math.inf
    return worst, void
