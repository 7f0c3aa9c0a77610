"""F, Appendices A and B: printed formulas of collisions and of their times beside what they are derived from.

Nothing of the engine is used. Velocities after a collision come from the impulse in small steps: the normal one grows,
the tangential one by mu of it against the slip, until the slip is gone. Times come from the distance along the flight.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.verdicts import Verdict, exact
from studies.ratchet.collision_times import pair_statements, segment_statements

TOLERANCE = 1e-9
CASES = 200
STEPS = 400


@dataclass(frozen=True)
class Impact:
    """Two disks or balls in the frame of F A: components along n and t; velocities of the rims R omega."""

    mass: tuple[float, float]
    inertia: float
    """l of F, Theta = l m R^2."""
    restitution: float
    friction: float
    normal: tuple[float, float]
    tangential: tuple[float, float]
    rim: tuple[float, float]

    @property
    def reduced(self) -> float:
        """m_eff."""
        return self.mass[0] * self.mass[1] / sum(self.mass)

    @property
    def approach(self) -> float:
        """v_n, positive on approach (A1)."""
        return self.normal[0] - self.normal[1]

    @property
    def slip(self) -> float:
        """v_r (A4)."""
        return self.tangential[0] - self.tangential[1] + sum(self.rim)

    @property
    def slides(self) -> bool:
        """A28, times v_n."""
        return abs(self.slip) >= (1.0 + 1.0 / self.inertia) * self.friction * (1.0 + self.restitution) * self.approach


After = tuple[float, float, float, float, float, float]
"""v_n1, v_n2, v_t1, v_t2, R_1 omega_1, R_2 omega_2 after the collision."""


def drawn(generator: np.random.Generator) -> Impact:
    """An impact at random in the frame of the centre of mass; as many slide as stick, nearly."""
    mass = (float(generator.uniform(0.5, 2.0)), float(generator.uniform(0.5, 2.0)))
    first = (float(generator.uniform(0.1, 2.0)), float(generator.uniform(-1.5, 1.5)))
    share = mass[0] / mass[1]
    return Impact(
        mass,
        (0.5, 0.4)[int(generator.integers(2))],
        float(generator.uniform(0.0, 1.0)),
        float(generator.uniform(0.02, 0.5)),
        (first[0], -share * first[0]),
        (first[1], -share * first[1]),
        (float(generator.uniform(-1.5, 1.5)), float(generator.uniform(-1.5, 1.5))),
    )


def integrated(impact: Impact, steps: int = STEPS) -> After:
    """By impulses: Coulomb friction acts while there is slip; the step in which it ends is cut short."""
    (m1, m2), inertia = impact.mass, impact.inertia
    whole = (1.0 + impact.restitution) * impact.reduced * impact.approach
    v1, v2 = impact.tangential
    c1, c2 = impact.rim
    for _ in range(steps):
        slip = v1 - v2 + c1 + c2
        push = impact.friction * whole / steps
        push = min(push, abs(slip) / ((1.0 / m1 + 1.0 / m2) * (1.0 + 1.0 / inertia)))
        force = -math.copysign(push, slip)
        v1, v2 = v1 + force / m1, v2 - force / m2
        c1, c2 = c1 + force / (inertia * m1), c2 + force / (inertia * m2)
    return impact.normal[0] - whole / m1, impact.normal[1] + whole / m2, v1, v2, c1, c2


def sliding(impact: Impact) -> After:
    """A7, A8 and A16 to A19 as printed."""
    (m1, m2), m, inertia = impact.mass, impact.reduced, impact.inertia
    push = impact.friction * (1.0 + impact.restitution) * impact.approach * math.copysign(1.0, impact.slip)
    return (
        *_normal(impact),
        impact.tangential[0] - push * m / m1,
        impact.tangential[1] + push * m / m2,
        impact.rim[0] - push / inertia * m / m1,
        impact.rim[1] - push / inertia * m / m2,
    )


def sticking(impact: Impact) -> After:
    """A7, A8 and A23 to A26 as printed."""
    (m1, m2), m, inertia = impact.mass, impact.reduced, impact.inertia
    (v1, v2), (c1, c2) = impact.tangential, impact.rim
    one = 1.0 / (inertia + 1.0)
    return (
        *_normal(impact),
        one * v1 - inertia * one * m / m1 * (c1 + c2),
        one * v2 + inertia * one * m / m2 * (c1 + c2),
        c1 * (inertia * one + one * m / m2) - c2 * one * m / m1 - one * v1,
        c2 * (inertia * one + one * m / m1) - c1 * one * m / m2 + one * v2,
    )


def _normal(impact: Impact) -> tuple[float, float]:
    push = impact.restitution * impact.reduced * impact.approach
    return -push / impact.mass[0], push / impact.mass[1]


def operator(impact: Impact, second: float) -> Numbers:
    """A30 with A31 or A32 on (v_n, `second`, v_c)."""
    inertia, push = impact.inertia, impact.friction * (1.0 + impact.restitution) * math.copysign(1.0, impact.slip)
    one = 1.0 / (inertia + 1.0)
    normal = [-impact.restitution, 0.0, 0.0]
    matrix = (
        [normal, [-push, 1.0, 0.0], [-push / inertia, 0.0, 1.0]]
        if impact.slides
        else [normal, [0.0, one, -inertia * one], [0.0, -one, inertia * one]]
    )
    return np.asarray(np.array(matrix) @ np.array([impact.approach, second, sum(impact.rim)]))


def impacts() -> list[Impact]:
    """Impacts at random, always the same."""
    generator = np.random.default_rng(1)
    return [drawn(generator) for _ in range(CASES)]


def worst(
    chosen: Sequence[Impact], printed: Callable[[Impact], Sequence[float]], true: Callable[[Impact], Sequence[float]]
) -> float:
    """Largest difference over the velocity of approach."""
    return max(float(np.max(np.abs(np.subtract(printed(i), true(i))))) / i.approach for i in chosen)


def make(_laboratory: Laboratory, _quick: bool, _seeds: int | None = None) -> Product:
    """Arithmetic only."""
    chosen = impacts()
    slides, sticks = [i for i in chosen if i.slides], [i for i in chosen if not i.slides]
    notes = [
        f"{CASES} impacts at random ({len(slides)} slide, {len(sticks)} stick), disks and balls, masses to 1 : 4; "
        f"differences over the velocity of approach; impulse in {STEPS} steps, the last one of slip cut short",
        "times: random flights, the distance along them by bisection between 20000 points",
        "no run of the engine, no chance",
    ]
    rows = [
        {"slip_over_approach": i.slip / i.approach, "limit": _limit(i), "slip_after": _slip_after(integrated(i))}
        for i in chosen
    ]
    statements = [*_laws(slides, sticks), *_operator(chosen), *pair_statements(), *segment_statements()]
    return Product("F A and B: collisions and their times", rows, draw(chosen), statements, notes)


def _limit(impact: Impact) -> float:
    return (1.0 + 1.0 / impact.inertia) * impact.friction * (1.0 + impact.restitution)


def _slip_after(after: After) -> float:
    return after[2] - after[3] + after[4] + after[5]


def _laws(slides: list[Impact], sticks: list[Impact]) -> list[Statement]:
    every, what = [*slides, *sticks], "difference over the velocity of approach"

    def row(place: str, printed: str, difference: float) -> Statement:
        return Statement.judged(place, printed, f"largest {what} {difference:.0e}", exact(difference, TOLERANCE, what))

    wrong = sum(i.slides != (abs(_slip_after(integrated(i))) > 1e-9) for i in every)
    half, double = _remixed(sticks, 0.5), _remixed(sticks, 2.0)
    return [
        row("A7, A8, A11", "normal velocities after a collision", worst(every, _normal, lambda i: integrated(i)[:2])),
        row("A16 to A19", "velocities after a collision that slides throughout", worst(slides, sliding, integrated)),
        row("A23 to A26", "velocities after a collision that sticks", worst(sticks, sticking, integrated)),
        row(
            "A.",
            "with sticking the result does not depend on when the surfaces stick (friction half or twice as large)",
            max(half, double),
        ),
        row(
            "A27",
            "slip after a collision that slides throughout",
            max(
                abs(i.slip - _limit(i) * i.approach * math.copysign(1.0, i.slip) - _slip_after(integrated(i)))
                / i.approach
                for i in slides
            ),
        ),
        Statement.judged(
            "A28",
            "it slides throughout if and only if |v_r| / v_n >= (l + 1) / l mu (1 + e_n)",
            f"{len(every) - wrong} of {len(every)} impacts as said",
            exact(wrong, 0, "impacts that do otherwise"),
        ),
        row("A.4", "a wall at rest is a particle of infinite mass", _wall(every)),
    ]


def _remixed(sticks: list[Impact], factor: float) -> float:
    """Change of the result by another friction, where it still sticks."""
    pairs = [(i, Impact(**{**vars(i), "friction": factor * i.friction})) for i in sticks]
    return max(
        float(np.max(np.abs(np.subtract(integrated(a), integrated(b))))) / a.approach for a, b in pairs if not b.slides
    )


def _wall(every: list[Impact]) -> float:
    """The law against a wall, m_eff = m_1, less that against a disk of 1e12 times the mass that does not turn."""
    found = 0.0
    for i in every:
        heavy = Impact(
            (i.mass[0], 1e12 * i.mass[0]), i.inertia, i.restitution, i.friction, (i.normal[0], 0.0),
            (i.tangential[0], 0.0), (i.rim[0], 0.0),
        )  # fmt: skip
        law = sliding if heavy.slides else sticking
        whole = law(heavy)
        push = min(
            heavy.friction * (1.0 + heavy.restitution) * heavy.approach,
            abs(heavy.slip) / (1.0 + 1.0 / heavy.inertia),
        ) * math.copysign(1.0, heavy.slip)
        plain = (-heavy.restitution * heavy.approach, i.tangential[0] - push, i.rim[0] - push / i.inertia)
        found = max(found, float(np.max(np.abs(np.subtract(plain, (whole[0], whole[2], whole[4]))))) / heavy.approach)
    return found


def _operator(chosen: list[Impact]) -> list[Statement]:
    def relative(i: Impact) -> tuple[float, float, float]:
        n1, n2, t1, t2, c1, c2 = integrated(i)
        return n1 - n2, t1 - t2, c1 + c2

    def with_slip(i: Impact) -> tuple[float, float, float]:
        n, t, c = relative(i)
        return n, t + c, c

    as_printed = worst(chosen, lambda i: operator(i, i.slip).tolist(), with_slip)
    corrected = worst(chosen, lambda i: operator(i, i.tangential[0] - i.tangential[1]).tolist(), relative)
    what = "difference over the velocity of approach"
    judged = exact(as_printed, TOLERANCE, what)
    return [
        Statement.judged(
            "A29 to A32",
            "the matrices act on w = (v_n, v_r, v_c)",
            f"largest {what} {as_printed:.2g}",
            judged,
            SLIP if judged.verdict is not Verdict.AGREES else "",
        ),
        Statement.judged(
            "A30 to A32",
            "the matrices, on (v_n, v_t, v_c)",
            f"largest {what} {corrected:.0e}",
            exact(corrected, TOLERANCE, what),
        ),
    ]


SLIP = (
    "a slip of the pen in A29: with v_r = v_t + v_c the second row of A31 lacks the share of the rims, and A32 leaves "
    "a slip; the text before A29 says tangential velocity (v_t)"
)


def draw(chosen: Sequence[Impact]) -> Figure:
    """Slip after the impact against that before, both in units of the limit: F's law and the integrated impulse."""
    figure = Figure(figsize=(0.7 * WIDTH, 3.3), layout="constrained")
    panel = figure.subplots()
    before = np.array([abs(i.slip) / (_limit(i) * i.approach) for i in chosen])
    after = np.array([abs(_slip_after(integrated(i))) / (_limit(i) * i.approach) for i in chosen])
    panel.plot(before, after, "o", color="#1f5fa8", ms=3.5, mfc="white", label="impulse in small steps")
    grid = np.linspace(0.0, 4.0, 200)
    panel.plot(grid, np.maximum(grid - 1.0, 0.0), "k-", lw=0.9, label="A20, A27 and A28")
    panel.set(xlim=(0.0, 4.0), ylim=(-0.1, 3.1), ylabel=r"slip after, $|v_r'|/L$")
    panel.set_xlabel(r"slip before, $|v_r|/L$;  $L = \frac{l+1}{l}\mu(1+\varepsilon_n)v_n$")
    panel.legend(loc="upper left")
    return figure
