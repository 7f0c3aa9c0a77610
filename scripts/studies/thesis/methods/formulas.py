"""P 2.1 and 2.3: printed formulas of places, collisions, times and base velocities beside what they follow from."""

import math
from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.verdicts import every, exact, true
from studies.thesis.methods.base_sampling import first_met
from studies.thesis.methods.impact_times import time_statements

CASES = 200
TOLERANCE = 1e-9
RAYS = 20_000
RATIOS = (0.1, 0.3, 0.6, 0.9, 1.5)
"""|v_n| / (A omega_b)."""


def placed(a: Numbers, b: Numbers, first: float, second: float) -> Numbers:
    """2.3 and 2.4: centre of a disk at distances `first` from a and `second` from b."""
    d = b - a
    square = float(d @ d)
    root = math.sqrt((square - (first - second) ** 2) * ((first + second) ** 2 - square))
    along = square + first**2 - second**2
    return np.asarray(a + np.array([along * d[0] - root * d[1], along * d[1] + root * d[0]]) / (2.0 * square))


def placed_at_wall(wall: Numbers, normal: Numbers, d: Numbers, radius: float, reach: float, sign: float) -> Numbers:
    """2.5 and 2.6 with the upper signs (1) or the lower ones (-1)."""
    depth = float(normal @ (wall - d)) + radius
    root = math.sqrt(reach**2 - depth**2)
    return np.asarray(
        d + np.array([depth * normal[0] - sign * root * normal[1], depth * normal[1] + sign * root * normal[0]])
    )


def make(_laboratory: Laboratory, _quick: bool, _seeds: int | None = None) -> Product:
    """Arithmetic only."""
    ratios = np.linspace(0.01, 1.0, 100)
    rows = [{"ratio": float(x), "exact": _phase(float(x)), "fit_2_41": _fit(float(x))} for x in ratios]
    return Product(
        "P 2.1 and 2.3: places, collisions, times, base velocities",
        rows,
        draw(ratios),
        [*_places(), *_rules(), *time_statements(), *_base()],
        [
            f"{CASES} places, impacts and flights at random, always the same; impacts from the linear equations of "
            "momentum, angular momentum and restitution; times by bisection of the distance along the flight",
            f"base: {RAYS} rays of even phase, each followed to where it first meets the sine",
            "no run of the engine, no chance",
        ],
    )


def _places() -> list[Statement]:
    generator, rest, above, below = np.random.default_rng(1), 0.0, 0, 0
    for _ in range(CASES):
        radii = generator.uniform(0.015, 0.025, 3)
        a = np.zeros(2)
        angle = generator.uniform(-0.8, 0.8)
        b = a + (radii[0] + radii[1] + generator.uniform(0.0, 0.5) * radii[2]) * np.array(
            [math.cos(angle), math.sin(angle)]
        )
        ra, rb = radii[0] + radii[2], radii[1] + radii[2]
        top, other = placed(a, b, ra, rb), placed(b, a, rb, ra)
        rest = max(rest, *(abs(float(np.hypot(*(p - q))) - r) for p in (top, other) for q, r in ((a, ra), (b, rb))))
        above += top[1] > other[1]
        below += other[1] > top[1]
    walls, at_wall = {"left": (1.0, 0.0), "right": (-1.0, 0.0), "floor": (0.0, 1.0)}, 0.0
    for normal in map(np.array, walls.values()):
        for _ in range(CASES):
            radius, reach = 0.02, generator.uniform(0.035, 0.045)
            wall, d = generator.uniform(-0.1, 0.1, 2), np.zeros(2)
            d = wall + normal * generator.uniform(0.005, 0.05) + normal[::-1] * generator.uniform(-0.1, 0.1)
            for sign in (1.0, -1.0):
                p = placed_at_wall(wall, normal, d, radius, reach, sign)
                gaps = (float(np.hypot(*(p - d))) - reach, float((p - wall) @ normal) - radius)
                at_wall = max(at_wall, *map(abs, gaps))
    return [
        Statement.judged(
            "2.3, 2.4",
            "place of a disk that touches a and b",
            f"largest error of the distances {rest:.0e} m",
            exact(rest, TOLERANCE, "error [m]"),
        ),
        Statement.judged(
            "2.1.1",
            "of both solutions it is the one at the top",
            f"a left of b: {above} of {CASES}; a right of b: {below} of {CASES}",
            every([true(above == CASES, ""), true(below == CASES, "")], "always, whichever is called a; no chance"),
            "the upper root needs a to be left of b: a front that is listed from left to right",
        ),
        Statement.judged(
            "2.5, 2.6",
            "place of a disk that touches a wall and a disk",
            f"both signs, left, right wall and floor: largest error of the distances {at_wall:.0e} m",
            exact(at_wall, TOLERANCE, "error [m]"),
        ),
    ]


def solved(
    mass: Numbers, inertia: Numbers, radius: Numbers, before: Numbers, restitution: tuple[float, float]
) -> Numbers:
    """v_n, v_t and omega of both disks after an impact, shape (3, 2), from the linear equations that hold.

    Momentum along n and t, angular momentum about the point of contact of each disk, 2.7 and 2.8.
    """
    apart = -restitution[0] * (before[0, 0] - before[0, 1])
    normal = np.linalg.solve(np.array([mass, [1.0, -1.0]]), np.array([mass @ before[0], apart]))
    slip = before[1, 0] - before[1, 1] + radius @ before[2]
    matrix = np.array(
        [
            [mass[0], mass[1], 0.0, 0.0],
            [mass[0] * radius[0], 0.0, -inertia[0], 0.0],
            [0.0, mass[1] * radius[1], 0.0, inertia[1]],
            [1.0, -1.0, radius[0], radius[1]],
        ]
    )
    known = matrix @ np.array([*before[1], *before[2]])
    known[3] = restitution[1] * slip
    tangential = np.linalg.solve(matrix, known)
    return np.array([normal, tangential[:2], tangential[2:]])


def _rules() -> list[Statement]:
    generator = np.random.default_rng(2)
    worst = dict.fromkeys(("normal", "general", "disks", "wall"), 0.0)
    for _ in range(CASES):
        mass, radius = generator.uniform(1e-3, 5e-3, 2), generator.uniform(0.015, 0.025, 2)
        inertia = generator.uniform(0.3, 0.6, 2) * mass * radius**2
        before = generator.uniform(-0.1, 0.1, (3, 2)) * np.array([[1.0], [1.0], [1.0 / 0.02]])
        e = (float(generator.uniform(0.0, 1.0)), float(generator.uniform(-1.0, 1.0)))
        reduced = mass.prod() / mass.sum()
        slip = before[1, 0] - before[1, 1] + radius @ before[2]
        scale = float(np.abs(before[:2]).max())
        sign = np.array([-1.0, 1.0])
        normal = before[0] + sign * reduced / mass * (1.0 + e[0]) * (before[0, 0] - before[0, 1])
        push = (1.0 - e[1]) * slip / (1.0 + reduced * float(np.sum(radius**2 / inertia)))
        true_one = solved(mass, inertia, radius, before, e)
        _worsen(worst, "normal", normal - true_one[0], scale)
        _worsen(worst, "general", before[1] + sign * reduced / mass * push - true_one[1], scale)
        _worsen(worst, "general", radius * (before[2] - radius * reduced / inertia * push - true_one[2]), scale)
        third, disk = (1.0 - e[1]) * slip / 3.0, solved(mass, 0.5 * mass * radius**2, radius, before, e)
        _worsen(worst, "disks", before[1] + sign * reduced / mass * third - disk[1], scale)
        _worsen(worst, "disks", radius * (before[2] - 2.0 * reduced / (radius * mass) * third - disk[2]), scale)
        heavy, still = np.array([mass[0], 1e12 * mass[0]]), before * np.array([[1.0, 1.0], [1.0, 1.0], [1.0, 0.0]])
        wall = solved(heavy, 0.5 * heavy * radius**2, radius, still, e)[:, 0]
        met = (1.0 - e[1]) * (still[1, 0] - still[1, 1] + radius[0] * still[2, 0]) / 3.0
        printed = (
            -e[0] * still[0, 0] + (1.0 + e[0]) * still[0, 1],
            still[1, 0] - met,
            still[2, 0] - 2.0 * met / radius[0],
        )
        _worsen(worst, "wall", (np.array(printed) - wall) * np.array([1.0, 1.0, radius[0]]), scale)
    names = {
        "normal": ("2.9, 2.10", "normal velocities after a collision"),
        "general": ("2.15 to 2.18", "tangential and angular velocities, any moments of inertia"),
        "disks": ("2.19 to 2.22", "the same for disks, I = m R^2 / 2"),
        "wall": ("2.11, 2.23, 2.24", "velocities after a collision with a heavy moving wall"),
    }
    what = "difference over the largest velocity"
    return [
        Statement.judged(place, printed, f"largest {what} {worst[name]:.0e}", exact(worst[name], TOLERANCE, what))
        for name, (place, printed) in names.items()
    ]


def _worsen(worst: dict[str, float], name: str, difference: Numbers, scale: float) -> None:
    worst[name] = max(worst[name], float(np.max(np.abs(difference))) / scale)


def _phase(x: float) -> float:
    """Omega t_B: where the ray that grazed the crest before meets the base."""
    return first_met(x)[0]


def _fit(x: float) -> float:
    """Omega t_B by 2.41, v_n = -x A omega_b."""
    return -1.5 * math.pi * x + 0.5 * math.pi if x < 1.0 else -math.pi


def _density(x: float) -> Callable[[Numbers], Numbers]:
    """Distribution function of v_b / (A omega_b) by 2.40 with the true t_B, its constant chosen for one in all."""
    first = _phase(x)
    phase = (np.arange(100_000) + 0.5) / 100_000 * math.pi
    value = np.cos(phase[::-1])  # evenly in dv_b / sqrt(A^2 omega_b^2 - v_b^2)
    beyond = value > math.cos(first)
    times = np.where(value < -x, 0.0, np.where(beyond, 0.0 if first > 0.0 else 2.0, 1.0))
    weight = times * (value + x)
    return lambda v: np.interp(v, value, np.cumsum(weight) / weight.sum())


def _base() -> list[Statement]:
    apart = {x: _distance(x) for x in RATIOS}
    misfit = max(abs(_fit(x) - _phase(x)) for x in np.linspace(0.01, 0.999, 200))
    norm = math.tau * 80.0
    return [
        Statement.judged(
            "2.39",
            "density of the velocity of the base, 1 / (w pi sqrt(A^2 omega_b^2 - v_b^2))",
            f"its integral is 1 / w: {1.0 / norm:.1e} at 80 Hz, if w is omega_b",
            exact(1.0 / norm - 1.0, TOLERANCE, "integral less 1"),
            "a factor w too many: 1 / (pi sqrt(A^2 omega_b^2 - v_b^2)) has the integral 1",
        ),
        Statement.judged(
            "2.40",
            "density of the velocity at which a disk meets the base, up to a constant",
            "largest difference of the distribution functions of 2.40 and of rays that are followed, by |v_n| / (A "
            "omega_b): " + ", ".join(f"{x:g}: {d:.1g}" for x, d in apart.items()),
            true(max(apart.values()) < 0.01, "below 0.01 everywhere; no chance"),
        ),
        Statement.judged(
            "2.41",
            "t_B is linear in v_n",
            f"largest error of omega_b t_B {misfit:.2f} rad",
            exact(misfit, 0.1, "error [rad]"),
            "the fit is right at both ends and off in between; sin tau + x tau = const has one root, found exactly",
        ),
    ]


def _distance(x: float) -> float:
    """Kolmogorov's distance of 2.40 and of rays."""
    first, last = first_met(x)
    rays = (np.arange(RAYS) + 0.5) / RAYS
    # A ray is sin tau + x tau = K, K even over one period of the grazing ray: follow each by bisection in [t_B, t_A].
    low, high = np.full(RAYS, first), np.full(RAYS, last)
    target = (math.sin(first) + x * first) + rays * math.tau * x
    for _ in range(60):
        middle = 0.5 * (low + high)
        under = np.sin(middle) + x * middle < target
        low, high = np.where(under, middle, low), np.where(under, high, middle)
    met = np.sort(np.cos(low))
    return float(np.max(np.abs(_density(x)(met) - rays)))


def draw(ratios: Numbers) -> Figure:
    """t_B against the velocity of the disk: exact, and by 2.41."""
    figure = Figure(figsize=(0.7 * WIDTH, 3.2), layout="constrained")
    panel = figure.subplots()
    panel.plot(ratios, [_phase(float(x)) for x in ratios], "k-", lw=1.0, label="exact")
    panel.plot(ratios, [_fit(float(x)) for x in ratios], "--", color="0.5", lw=1.0, label="2.41")
    panel.set(xlabel=r"$|v_n|/(A\omega_b)$", ylabel=r"$\omega_b t_B$ [rad]")
    panel.legend()
    return figure
