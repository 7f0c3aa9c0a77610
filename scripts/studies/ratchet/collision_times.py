"""F B: times of collisions as printed, beside the first zero of the distance along the flights."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.verdicts import exact

GRAVITY, AMPLITUDE, FREQUENCY = 9.81, 2e-3, 25.0
CASES, HORIZON, GRID = 100, 0.5, 20_000
TOLERANCE = 1e-9
"""[s]."""


def first_contact(distance: Callable[[Numbers], Numbers], begin: float = 1e-7) -> float:
    """First time [s] at which a distance falls through zero; infinite if it does not within half a second."""
    times = np.linspace(begin, HORIZON, GRID)
    values = distance(times)
    falling = np.flatnonzero((values[:-1] > 0.0) & (values[1:] <= 0.0))
    if len(falling) == 0:
        return math.inf
    k = int(falling[0])
    return float(brentq(lambda t: float(distance(np.array([t]))[0]), times[k], times[k + 1], xtol=1e-14))


@dataclass(frozen=True)
class Pair:
    """Two particles in flight since different times (B1, B2); arrays of shape (2, 2) and (2,)."""

    place: Numbers
    velocity: Numbers
    since: Numbers
    reach: float = 2.2e-3
    """R_1 + R_2 [m]."""

    def distance(self, times: Numbers) -> Numbers:
        """Between the rims."""
        flown = times[None, :] - self.since[:, None]
        at = self.place[:, :, None] + self.velocity[:, :, None] * flown[:, None, :]
        at[:, 1] -= 0.5 * GRAVITY * flown**2
        return np.asarray(np.hypot(*(at[0] - at[1])) - self.reach)

    def printed(self) -> float:
        """t_1 of B6, if the three conditions hold."""
        up, since = np.array([0.0, 1.0]), self.since
        p = self.velocity[0] - self.velocity[1] + up * GRAVITY * (since[0] - since[1])
        q = self.place[0] - self.place[1] + self.velocity[1] * since[1] - self.velocity[0] * since[0]
        q = q - up * 0.5 * GRAVITY * (since[0] ** 2 - since[1] ** 2)
        root = float((p @ q) ** 2 - (p @ p) * (q @ q - self.reach**2))
        time = (-float(p @ q) - math.sqrt(root)) / float(p @ p) if root > 0.0 else math.inf
        return time if time > 0.0 else math.inf


def pair_statements() -> list[Statement]:
    """B5 and B6 on two disks that are thrown at each other."""
    generator, found, agreed = np.random.default_rng(2), [], 0
    for _ in range(CASES):
        apart = np.array([[-0.02, 0.0], [0.02, 0.0]])
        place = apart + generator.uniform(-2e-3, 2e-3, (2, 2))
        pair = Pair(place, -10.0 * apart + generator.uniform(-0.02, 0.02, (2, 2)), generator.uniform(-5e-3, 0.0, 2))
        printed, true = pair.printed(), first_contact(pair.distance)
        if math.isfinite(true) and math.isfinite(printed):
            found.append(abs(true - printed))
        agreed += (true < HORIZON) == (printed < HORIZON)
    return [
        Statement.judged(
            "B5, B6",
            "two particles collide at t_1, if and only if |p| is not 0, D > 0 and t_1 > 0",
            f"{agreed} of {CASES} pairs meet or miss as said, {len(found)} meet; largest difference {max(found):.0e} s",
            exact(max(found) + (CASES - agreed), TOLERANCE, "difference [s], and number that miss or meet wrongly"),
        )
    ]


def segment_statements() -> list[Statement]:
    """B9 to B12 on a segment at rest, B15 and B16 on one that oscillates."""
    generator = np.random.default_rng(3)
    resting: dict[str, list[float]] = {"printed": [], "corrected": []}
    moving: dict[str, list[float]] = {"printed": [], "corrected": []}
    for _ in range(CASES):
        angle, radius, begun = generator.uniform(-1.2, 1.2), 1.1e-3, -generator.uniform(0.0, 0.01)
        normal = np.array([-math.sin(angle), math.cos(angle)])
        place = (radius + generator.uniform(0.005, 0.03)) * normal + generator.uniform(-0.01, 0.01, 2) * normal[::-1]
        velocity = generator.uniform(-0.3, 0.3, 2)
        u, v, w, ahead = _coefficients(place, velocity, normal, radius, begun)
        true = first_contact(ahead)
        if math.isfinite(true):
            for name, discriminant in (("printed", v * v - 4.0 * u * v), ("corrected", v * v - 4.0 * u * w)):
                roots = _roots(u, v, discriminant)
                resting[name].append(min((abs(r - true) for r in roots), default=math.inf))
        lifted = normal[1]

        def gap(t: Numbers, ahead: Callable[[Numbers], Numbers] = ahead, lifted: float = lifted) -> Numbers:
            return np.asarray(ahead(t) - lifted * AMPLITUDE * np.sin(math.tau * FREQUENCY * t))

        met = first_contact(gap)
        if math.isfinite(met):
            sine = math.sin(math.tau * FREQUENCY * met)
            scaled = (-0.5 * GRAVITY / AMPLITUDE, v / (AMPLITUDE * lifted), w / (AMPLITUDE * lifted))
            bare = scaled[2] + radius / (AMPLITUDE * lifted)
            moving["corrected"].append(abs(scaled[0] * met**2 + scaled[1] * met + scaled[2] - sine))
            moving["printed"].append(abs(scaled[0] * met**2 + scaled[1] * met + bare - AMPLITUDE * sine))
    return [*_resting(resting), *_moving(moving)]


def _coefficients(
    place: Numbers, velocity: Numbers, normal: Numbers, radius: float, begun: float
) -> tuple[float, float, float, Callable[[Numbers], Numbers]]:
    """u, v and w of B10, s_1 in the origin, and the distance from the line itself."""
    up = np.array([0.0, 1.0])
    u = -0.5 * GRAVITY * float(up @ normal)
    v = float((up * GRAVITY * begun + velocity) @ normal)
    w = float((place - velocity * begun - up * 0.5 * GRAVITY * begun**2) @ normal) - radius

    def ahead(t: Numbers) -> Numbers:
        flown = t - begun
        at = place[:, None] + velocity[:, None] * flown - up[:, None] * 0.5 * GRAVITY * flown**2
        return np.asarray(normal @ at - radius)

    return u, v, w, ahead


def _roots(u: float, v: float, discriminant: float) -> list[float]:
    """B12."""
    if discriminant <= 0.0:
        return []
    return [(-v + sign * math.sqrt(discriminant)) / (2.0 * u) for sign in (-1.0, 1.0)]


def _resting(found: dict[str, list[float]]) -> list[Statement]:
    texts, what = {name: _spread(values, "s") for name, values in found.items()}, "difference of the nearest root [s]"
    return [
        Statement.judged(
            "B10, B12",
            "collision with a resting segment, D = v^2 - 4uv",
            f"nearest root: {texts['printed']}",
            exact(max(found["printed"]), TOLERANCE, what),
            "a slip of the pen: the discriminant of u t^2 + v t + w is v^2 - 4uw; with it the row below",
        ),
        Statement.judged(
            "B10, B12",
            "collision with a resting segment, with D = v^2 - 4uw",
            f"nearest root: {texts['corrected']}",
            exact(max(found["corrected"]), TOLERANCE, what),
        ),
    ]


def _moving(found: dict[str, list[float]]) -> list[Statement]:
    what = "remainder of the equation at the contact"
    return [
        Statement.judged(
            "B15, B16",
            "collision with an oscillating segment: u t^2 + v t + w = A sin(2 pi f t + phi_0), w without the radius",
            f"{what}: {_spread(found['printed'], '')}",
            exact(max(found["printed"]), 1e-6, what),
            "B16 is divided by A (j.n) on its left side only, w lacks the radius of the particle, and v is printed as "
            "b; with all three the row below",
        ),
        Statement.judged(
            "B15, B16",
            "collision with an oscillating segment, with sin on the right side, and w less R / (A j.n)",
            f"{what}: {_spread(found['corrected'], '')}",
            exact(max(found["corrected"]), 1e-6, what),
        ),
    ]


def _spread(values: list[float], unit: str) -> str:
    """Median and largest of differences, and how many have none."""
    finite = [v for v in values if math.isfinite(v)]
    lost = len(values) - len(finite)
    text = f"{len(values)} contacts, median {np.median(finite):.2g}, largest {max(finite):.2g} {unit}".rstrip()
    return text + (f", {lost} without a root" if lost else "")
