"""P 6.3.1 and 6.3.2: the printed map of a disk in a wedge beside the flights that it stands for.

A flight is followed as a parabola from the wall it starts on to the first wall it meets; no equation of P is used.
"""

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from scipy.optimize import brentq

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.verdicts import every, exact

GRAVITY, RADIUS = 9.81, 0.02
CASES = 200
TOLERANCE = 1e-8
HALF = math.pi / 6.0
"""Inclination of either wall of a wedge of 120 degrees without tilt."""


@dataclass(frozen=True)
class Flight:
    """A point that leaves a wall through the origin, at `x` on it, with v_n, v_t after the collision."""

    start: float
    """Angle of the wall it starts on."""
    end: float
    """Angle of the wall it meets."""
    x: float
    normal: float
    tangential: float

    @property
    def height(self) -> float:
        """y_k."""
        return math.tan(self.start) * self.x

    def velocity(self) -> tuple[float, float]:
        """In Cartesian directions, 6.2 and 6.3."""
        s, c = math.sin(self.start), math.cos(self.start)
        return -s * self.normal + c * self.tangential, c * self.normal + s * self.tangential

    def followed(self) -> tuple[float, float, float, float]:
        """Time of flight, v_n, v_t and y at the wall that it meets."""
        u, w = self.velocity()

        def above(t: float) -> float:
            x, y = self.x + u * t, self.height + w * t - 0.5 * GRAVITY * t * t
            return -math.sin(self.end) * x + math.cos(self.end) * y

        # The distance from a wall is a parabola: where it is largest, and from there down through zero.
        crest = (-math.sin(self.end) * u + math.cos(self.end) * w) / (GRAVITY * math.cos(self.end))
        late = max(crest, 0.0) + 1e-3
        while above(late) > 0.0:
            late *= 2.0
        time = float(brentq(above, max(crest, 1e-12), late, xtol=1e-15))
        fallen = w - GRAVITY * time
        s, c = math.sin(self.end), math.cos(self.end)
        return time, -s * u + c * fallen, c * u + s * fallen, self.height + w * time - 0.5 * GRAVITY * time**2

    def printed(self, gravity: float = GRAVITY) -> tuple[float, float, float, float]:
        """6.16 to 6.18 and 6.20."""
        (si, ci), (sf, cf) = _sine_cosine(self.start), _sine_cosine(self.end)
        sif, cif = _sine_cosine(self.start - self.end)
        across = cif * self.normal + sif * self.tangential
        root = math.sqrt(across**2 + 2.0 * gravity * cf / si * sif * self.height)
        time = (across + root) / (gravity * cf)
        along = (-si * self.normal + ci * self.tangential) / cf - sf / cf * root
        height = self.height + (ci * self.normal + si * self.tangential) * time - 0.5 * gravity * time**2
        return time, -root, along, height

    def on_one_wall(self) -> tuple[float, float, float, float]:
        """6.21, 6.22, 6.24 and 6.25."""
        slope = math.tan(self.start)
        time = 2.0 * self.normal / (GRAVITY * math.cos(self.start))
        height = self.height - 2.0 * slope * self.normal / GRAVITY * (slope * self.normal - self.tangential)
        return time, -self.normal, self.tangential - 2.0 * slope * self.normal, height


def _sine_cosine(angle: float) -> tuple[float, float]:
    return math.sin(angle), math.cos(angle)


@dataclass(frozen=True)
class Collision:
    """Before a collision, with its law: e_n, e_t, and the base's velocity along the normal and the tangent."""

    normal: float
    tangential: float
    rim: float
    """R omega."""
    restitution: float
    tangential_restitution: float
    base: float
    """v_b^n."""
    slip: float
    """u_t."""

    def after(self) -> tuple[float, float, float]:
        """v_n, v_t and R omega by 2.11, 2.23 and 2.24."""
        third = (1.0 - self.tangential_restitution) / 3.0 * self.slip
        return (
            -self.restitution * self.normal + (1.0 + self.restitution) * self.base,
            self.tangential - third,
            self.rim - 2.0 * third,
        )


def make(_laboratory: Laboratory, _quick: bool, _seeds: int | None = None) -> Product:
    """Arithmetic only."""
    flights = _flights()
    notes = [
        f"{CASES} flights at random from wall to wall and {CASES} on one wall, 120 degrees, tilts up to 20 degrees; "
        "picture: a tilt of 0.2 rad",
        "differences over the velocity of departure, in units of it for times and heights; no run of the engine, no "
        "chance",
    ]
    rows = [{"start": f.start, "end": f.end, "x": f.x, "time": f.followed()[0]} for f in flights]
    return Product("P 6.3.1 and 6.3.2: equations of the map", rows, draw(_flights(6, 0.2)[:6]), statements(), notes)


def _flights(count: int = CASES, tilt: float | None = None) -> list[Flight]:
    """Half of them from wall to wall, the others on one wall; at random tilts, or all at `tilt`."""
    generator = np.random.default_rng(1)
    made: list[Flight] = []
    while len(made) < 2 * count:
        lean = float(generator.uniform(-0.35, 0.35)) if tilt is None else tilt
        walls = (-HALF + lean, HALF + lean)
        first = int(generator.integers(2))
        across = len(made) < count
        x = float(generator.uniform(1e-5, 1e-3)) * (1.0 if first else -1.0)
        speed = 0.1
        normal, tangential = float(generator.uniform(0.2, 1.0)) * speed, float(generator.uniform(-1.0, 1.0)) * speed
        end = walls[1 - first] if across else walls[first]
        flight = Flight(walls[first], end, x, normal, tangential)
        landed = x + flight.velocity()[0] * flight.followed()[0]
        if (landed > 0.0) == (end == walls[1]):  # on the wall itself, not on its line beyond the vertex
            made.append(flight)
    return made


def scaled(found: tuple[float, ...], flight: Flight) -> Numbers:
    """Time, velocities and height in units of the velocity of departure."""
    speed = math.hypot(flight.normal, flight.tangential)
    return np.asarray(np.array(found) / np.array([speed / GRAVITY, speed, speed, speed**2 / GRAVITY]))


def statements() -> list[Statement]:
    """Each group of equations."""
    between, same = _flights()[:CASES], _flights()[CASES:]
    general = max(_apart(f, f.printed()) for f in between)
    simple = max(_apart(f, f.on_one_wall()) for f in same)
    unit = max(_dimensionless(f) for f in between)
    shift = RADIUS / math.cos(HALF)  # the vertex of the lines on which the centre moves, above that of the walls
    what = "difference"
    return [
        Statement.judged(
            "6.16 to 6.20",
            "time of flight, velocities and height at the next wall",
            f"largest {what} {general:.0e}",
            exact(general, TOLERANCE, what),
        ),
        Statement.judged(
            "6.21 to 6.25",
            "the same on one wall, theta_i = theta_f",
            f"largest {what} {simple:.0e}",
            exact(simple, TOLERANCE, what),
        ),
        Statement.judged(
            "6.26 to 6.30",
            "from before one collision to before the next",
            f"largest {what} {_composed(GRAVITY):.0e}",
            exact(_composed(GRAVITY), TOLERANCE, what),
        ),
        Statement.judged(
            "6.31, 6.32, 6.34, 6.35",
            "the same without dimensions: lengths in (A omega_b)^2 / g, velocities in A omega_b",
            f"largest {what} {unit:.0e}",
            exact(unit, TOLERANCE, what),
        ),
        Statement.judged(
            "6.36, 6.37, 6.39, 6.40",
            "without dimensions, on one wall",
            f"largest {what} {_on_one_wall():.0e}",
            exact(_on_one_wall(), TOLERANCE, what),
        ),
        _spin(),
        Statement.judged(
            "6.6",
            "the walls are y = tan(theta) x, from the vertex of the wedge, for the centre of the disk",
            f"the centre of a disk of {1e3 * RADIUS:g} mm that touches both walls is {1e3 * shift:.1f} mm above it",
            exact(shift, 1e-6, "distance of the centre from the vertex [m]"),
            "the centre moves between lines that are R inside of the walls and meet R / sin(theta_W / 2) up the "
            "bisector: the map is right with its origin there",
        ),
    ]


def _apart(flight: Flight, printed: tuple[float, ...]) -> float:
    return float(np.max(np.abs(scaled(flight.followed(), flight) - scaled(printed, flight))))


def _dimensionless(flight: Flight) -> float:
    """6.31 to 6.35 from the velocities after a collision, times their units, against the flight."""
    speed = 0.3
    length, time = speed**2 / GRAVITY, speed / GRAVITY
    unit = Flight(flight.start, flight.end, flight.x / length, flight.normal / speed, flight.tangential / speed)
    found = unit.printed(gravity=1.0)
    back = (found[0] * time, found[1] * speed, found[2] * speed, found[3] * length)
    return _apart(flight, back)


def _collisions(flight: Flight, generator: np.random.Generator) -> Collision:
    """A collision after which the disk flies off as in `flight`."""
    e, et = float(generator.uniform(0.3, 1.0)), float(generator.uniform(-0.9, 0.9))
    base, slip = float(generator.uniform(0.0, 0.05)), float(generator.uniform(-0.2, 0.2))
    normal = ((1.0 + e) * base - flight.normal) / e
    return Collision(normal, flight.tangential + (1.0 - et) / 3.0 * slip, 0.1, e, et, base, slip)


def _composed(gravity: float) -> float:
    """6.26, 6.27, 6.29 and 6.30 as printed."""
    generator, worst = np.random.default_rng(3), 0.0
    for flight in _flights()[:CASES]:
        hit = _collisions(flight, generator)
        si, ci = _sine_cosine(flight.start)
        cf = math.cos(flight.end)
        sif, cif = _sine_cosine(flight.start - flight.end)
        n = -hit.restitution * hit.normal + (1.0 + hit.restitution) * hit.base
        t = hit.tangential - (1.0 - hit.tangential_restitution) / 3.0 * hit.slip
        normal = -math.sqrt((cif * n + sif * t) ** 2 + 2.0 * gravity * cf / si * sif * flight.height)
        along = (-si * n + ci * t) / cf + math.tan(flight.end) * normal
        time = (cif * n + sif * t - normal) / (gravity * cf)
        height = flight.height + (ci * n + si * t) * time - 0.5 * gravity * time**2
        worst = max(worst, _apart(flight, (time, normal, along, height)))
    return worst


def _on_one_wall() -> float:
    """6.36, 6.37, 6.39 and 6.40 as printed, times their units."""
    generator, worst, speed = np.random.default_rng(4), 0.0, 0.3
    length = speed**2 / GRAVITY
    for flight in _flights()[CASES:]:
        hit, slope = _collisions(flight, generator), math.tan(flight.start)
        normal, base, slip = hit.normal / speed, hit.base / speed, hit.slip / speed
        back = hit.restitution * normal - (1.0 + hit.restitution) * base
        t = hit.tangential / speed - (1.0 - hit.tangential_restitution) / 3.0 * slip
        height = flight.height / length - 2.0 * slope * back * (slope * back + t)
        time = -2.0 * back / math.cos(flight.start)
        found = (time * speed / GRAVITY, back * speed, (t + 2.0 * slope * back) * speed, height * length)
        worst = max(worst, _apart(flight, found))
    return worst


def _spin() -> Statement:
    """6.33: with lengths in l_0 the radius is R / l_0."""
    speed, e_t, slip = 0.3, 0.5, 0.1
    length, time = speed**2 / GRAVITY, speed / GRAVITY
    true_change = -2.0 * (1.0 - e_t) / (3.0 * RADIUS) * slip * time
    as_printed = -2.0 * (1.0 - e_t) / (3.0 * RADIUS) * (slip / speed)
    corrected = -2.0 * (1.0 - e_t) / (3.0 * RADIUS / length) * (slip / speed)
    return Statement.judged(
        "6.33, 6.38, 6.3.2",
        "angular velocity after a collision, omega - 2 (1 - e_t) u_t / (3 R): A, omega_b and g have disappeared",
        f"change of omega t_0 by {true_change:.4f}; with R / l_0 {corrected:.4f}, with R in metres {as_printed:.4f}",
        every(
            [exact(corrected / true_change - 1.0, TOLERANCE), exact(as_printed / true_change - 1.0, TOLERANCE)],
            "right with a radius that is scaled like other lengths; and without A, omega_b and g in it; no chance",
        ),
        "l_0 stays in R / l_0; R omega / (A omega_b), which P plots, needs no radius at all",
    )


def draw(flights: list[Flight]) -> Figure:
    """Some flights at a tilt of 0.2 rad between the lines that confine the centre, and their ends by the equations."""
    figure = Figure(figsize=(0.7 * WIDTH, 3.3), layout="constrained")
    panel = figure.subplots()
    for number, flight in enumerate(flights):
        time = flight.followed()[0]
        t, (u, w) = np.linspace(0.0, time, 100), flight.velocity()
        x, y = flight.x + u * t, flight.height + w * t - 0.5 * GRAVITY * t**2
        panel.plot(1e3 * x, 1e3 * y, "-", color="0.5", lw=0.9, label=None if number else "flight, followed")
        height = flight.printed()[3]
        across = height / math.tan(flight.end)
        panel.plot([1e3 * across], [1e3 * height], "o", color="#c0272d", ms=4, mfc="white",
                   label=None if number else "6.16, 6.20")  # fmt: skip
    for angle, end in ((0.2 - HALF, -1.2), (0.2 + HALF, 1.2)):
        panel.plot([0.0, end], [0.0, math.tan(angle) * end], "k-", lw=1.2)
    panel.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    panel.legend()
    return figure
