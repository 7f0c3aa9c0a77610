"""Formulas of P 4.5.1 and 4.5.2 beside the integrated equations of motion."""

import math
from collections.abc import Mapping

import numpy as np

from jostle_lab.statements import Statement
from jostle_lab.verdicts import exact, true
from studies.thesis.impact import printed
from studies.thesis.impact.equations import Contact, Impact, integrate

CLOSE = 1e-8
"""Relative difference of a formula from the integration."""
DAMPING_RATIOS = (0.0346, 0.5, 0.8, 1.5)
"""c in each branch of 4.55 and 4.56."""


def of_damping_ratio(c: float, mass: float = 4.5e-3, stiffness: float = 4.5e6) -> Contact:
    """A contact with this c."""
    return Contact(mass=mass, stiffness=stiffness, damping=2.0 * c * math.sqrt(stiffness * mass))


def statements(found: Mapping[float, Impact]) -> list[Statement]:
    """All of them; `found`: impacts by kappa, all with u_n = -1 m/s."""
    return [*_normal(), *_tangential(found), *_regimes(), *_full_sliding()]


def _normal() -> list[Statement]:
    impacts = {c: integrate(of_damping_ratio(c), 1.0, 0.2) for c in DAMPING_RATIOS}
    worst = dict.fromkeys(("4.54", "4.55", "4.56", "4.57", "4.72"), 0.0)
    for c, impact in impacts.items():
        contact = impact.contact
        t = np.linspace(0.0, impact.duration, 200)
        overlap, rate, _, _ = impact.states(t)
        worst["4.54"] = max(worst["4.54"], _off(printed.overlap(contact, -1.0, t), overlap))
        worst["4.55"] = max(worst["4.55"], abs(printed.duration(contact) / impact.duration - 1.0))
        worst["4.56"] = max(worst["4.56"], abs(printed.restitution(c) / impact.restitutions[0] - 1.0))
        if c < 1.0:
            worst["4.57"] = max(
                worst["4.57"], _off(printed.normal_force(contact, -1.0, t), contact.normal(overlap, rate))
            )
            slope = np.array([contact.normal_rate(a, b) for a, b in zip(overlap, rate, strict=True)])
            worst["4.72"] = max(worst["4.72"], _off(printed.normal_rate(contact, -1.0, t), slope))
    texts = {
        "4.54": "overlap during the impact, under-damped and over-damped",
        "4.55": "duration t_c, until the normal force vanishes, in three branches",
        "4.56": "e_n in three branches",
        "4.57": "normal force during the impact, c < 1",
        "4.72": "its derivative",
    }
    cases = ", ".join(f"{c:g}" for c in DAMPING_RATIOS)
    rows = [
        Statement.judged(
            place, text, f"relative difference at most {worst[place]:.0e} for c = {cases}", exact(worst[place], CLOSE)
        )
        for place, text in texts.items()
    ]
    first = impacts[0.5]
    start = float(first.states(np.array([0.0]))[1, 0])
    rows.append(
        Statement.judged(
            "text before 4.54",
            "boundary condition delta'(0) = u_n, where u_n < 0 on approach (4.57, 4.73)",
            f"the overlap of 4.54 starts with {start:+.3g} m/s at u_n = -1 m/s",
            exact(start + 1.0, CLOSE, "delta'(0) less u_n over |u_n|"),
            "a sign was lost in print: delta'(0) = -u_n, as stated above 4.53; 4.54 itself has it right",
        )
    )
    return [*rows, *_limits(), *_materials(), _discontinuous(), _attractive()]


def _off(formula: object, integrated: object) -> float:
    """Largest difference over the largest value."""
    a, b = np.asarray(formula, dtype=np.float64), np.asarray(integrated, dtype=np.float64)
    return float(np.max(np.abs(a - b)) / np.max(np.abs(b)))


def _limits() -> list[Statement]:
    near = {c: integrate(of_damping_ratio(c), 1.0, 0.2).restitutions[0] for c in (1.0 - 1e-6, 1.0 + 1e-6)}
    formula = {c: printed.restitution(c) for c in near}
    rest = max(abs(v / math.exp(-2.0) - 1.0) for v in (*near.values(), *formula.values()))
    half = 1.0 / math.sqrt(2.0)
    jump = abs(printed.restitution(half - 1e-7) / printed.restitution(half + 1e-7) - 1.0)
    return [
        Statement.judged(
            "4.56",
            "branches meet at c = 1 (0/0 as printed): e_n -> e^-2",
            f"formula {', '.join(f'{v:.5f}' for v in formula.values())}, equations "
            f"{', '.join(f'{v:.5f}' for v in near.values())} on both sides, e^-2 = {math.exp(-2.0):.5f}",
            exact(rest, 1e-4, "relative difference 1e-6 beside c = 1"),
        ),
        Statement.judged(
            "4.56",
            "branches meet at c = 1 / sqrt 2 (division by zero as printed)",
            f"relative jump {jump:.0e} from 1e-7 below to 1e-7 above; e_n = {printed.restitution(half + 1e-7):.5f}",
            exact(jump, 1e-5, "relative jump"),
        ),
    ]


def _materials() -> list[Statement]:
    found = [
        integrate(of_damping_ratio(0.3, mass, stiffness), speed, 0.1).restitutions[0]
        for mass, stiffness, speed in ((4.5e-3, 4.5e6, 1.0), (0.1, 1e3, 1.0), (4.5e-3, 4.5e6, 0.01))
    ]
    spread = max(found) / min(found) - 1.0
    laboratory = integrate(Contact(), 1.0, 0.2).restitutions[0]
    return [
        Statement.judged(
            "4.5.1",
            "e_n depends only on c, not on the velocity",
            f"c = 0.3, two materials, velocities from 0.01 to 1 m/s: relative spread {spread:.0e}",
            exact(spread, CLOSE, "relative spread"),
        ),
        Statement.judged(
            "Fig. 4.5, 6.2",
            "k_n = 4.5e6, gamma = 9.84, m = 4.5 g give e_n = 0.9",
            f"{laboratory:.5f}",
            exact(laboratory - 0.9, 0.005, "difference from a printed number of one digit"),
        ),
    ]


def _discontinuous() -> Statement:
    contact = Contact()
    first = float(integrate(contact, 1.0, 0.2).forces(np.array([0.0]))[0][0])
    return Statement.judged(
        "4.5.1",
        "the normal force jumps from zero to -gamma_n u_n at first touch",
        f"{first:.4f} N, gamma_n |u_n| = {contact.damping:.4f} N",
        exact(first / contact.damping - 1.0, CLOSE, "relative difference"),
    )


def _attractive() -> Statement:
    contact = of_damping_ratio(0.3)
    _, _, omega = printed.rates(contact)
    times = np.linspace(0.0, math.pi / omega, 1000)
    force = printed.normal_force(contact, -1.0, times)
    share = float(-force.min() / force.max())
    return Statement.judged(
        "4.5.1",
        "with t_c = pi / omega_n the normal force is negative near the end",
        f"c = 0.3: down to {share:.2f} of the largest force; e_n would be "
        f"{math.exp(-0.3 * contact.frequency * math.pi / omega):.3f} instead of {printed.restitution(0.3):.3f}",
        true(share > 0.0, "the smallest force is negative; no chance"),
    )


def _tangential(found: Mapping[float, Impact]) -> list[Statement]:
    worst = dict.fromkeys(("4.62 to 4.64", "4.66", "4.67", "4.68", "4.71"), 0.0)
    for impact in found.values():
        c, scale = impact.contact, 1.0
        peak = float(np.max(impact.forces(np.linspace(0.0, impact.duration, 400))[0]))
        for index, phase in enumerate(impact.phases):
            t = np.linspace(phase.start, phase.end, 60)
            y, first = phase.state(t), phase.state(phase.start)
            force = -c.tangential * y[2]
            if phase.sliding:
                sign = float(np.sign(first[2]))
                slip = printed.sliding_slip(c, -1.0, sign, phase.start, float(first[3]), t)
                worst["4.66"] = max(worst["4.66"], float(np.max(np.abs(slip - y[3]))) / scale)
                tau = printed.sliding_force(c, -1.0, sign, t)
                worst["4.67"] = max(worst["4.67"], float(np.max(np.abs(tau - force))) / peak)
                if index + 1 < len(impact.phases):
                    rate = float(printed.normal_rate(c, -1.0, t[-1:])[0])
                    rest = float(y[3][-1]) - sign * c.friction / c.tangential * rate
                    worst["4.71"] = max(worst["4.71"], abs(rest) / scale)
            else:
                parts = printed.sticking(c, float(first[2]), float(first[3]), t - phase.start)
                worst["4.62 to 4.64"] = max(worst["4.62 to 4.64"], float(np.max(np.abs(parts[2] - force))) / peak)
                limit = c.friction * float(c.normal(y[0][-1], y[1][-1]))
                worst["4.68"] = max(worst["4.68"], abs(abs(float(force[-1])) - limit) / peak)
    texts = {
        "4.62 to 4.64": "stretch, slip and force while the contact sticks",
        "4.66": "slip while it slides, from any start",
        "4.67": "tangential force while it slides",
        "4.68": "from sticking to sliding where k_t |delta_t| = mu n",
        "4.71": "from sliding to sticking where u_t = sgn mu n' / k_t",
    }
    cases = ", ".join(f"{k:g}" for k in found)
    rows = [
        Statement.judged(
            place, text, f"relative difference at most {worst[place]:.0e}, kappa = {cases}", exact(worst[place], 1e-7)
        )
        for place, text in texts.items()
    ]
    return [*rows, _limited(found)]


def _limited(found: Mapping[float, Impact]) -> Statement:
    excess, signs = 0.0, {}
    for kappa, impact in found.items():
        normal, tangential = impact.forces(np.linspace(0.0, impact.duration, 2000)[1:-1])
        limit = impact.contact.friction * normal
        excess = max(excess, float(np.max(np.abs(tangential) - limit) / limit.max()))
        signs[kappa] = int(np.count_nonzero(np.diff(np.sign(tangential))))
    return Statement.judged(
        "Fig. 4.4",
        "tangential forces oscillate, limited by mu n, faster for larger kappa",
        f"largest excess over the limit {max(excess, 0.0):.0e} of it; changes of sign: "
        + ", ".join(f"kappa = {k:g}: {n}" for k, n in signs.items()),
        exact(max(excess, 0.0), 1e-9, "excess over the limit")
        & true(sorted(signs.values()) == list(signs.values()) and max(signs.values()) > 1, "changes of sign grow"),
    )


def _regimes() -> list[Statement]:
    impacts = [integrate(Contact(ratio=k), 1.0, r) for k in (0.1, 0.773, 3.0) for r in (0.02, 0.2, 1.0, 5.0)]
    first = [impact.phases[0].sliding for impact in impacts]
    last = [impact.phases[-1].sliding for impact in impacts]
    soft = [integrate(Contact(ratio=k, damping=0.0), 1.0, s * 0.1 / k) for k in (0.1, 1.0, 3.0) for s in (0.97, 1.03)]
    starts = [impact.phases[0].sliding for impact in soft]
    return [
        Statement.judged(
            "4.5.2",
            "with damping there is no initial sliding, a contact always slides at the end, and switches at least once",
            f"{len(impacts)} impacts, kappa 0.1 to 3, |u_t/u_n| 0.02 to 5: {sum(first)} start sliding, {sum(last)} end "
            "sliding",
            true(not any(first) and all(last), "every impact; no chance"),
        ),
        Statement.judged(
            "4.76",
            "without damping it starts sliding if |u_t/u_n| > mu k_n / k_t",
            f"3 % below and above, kappa = 0.1, 1, 3: {['sticks', 'slides'][starts[0]]} and "
            f"{['sticks', 'slides'][starts[1]]}; the start is a comparison of rates in the equations",
            true(starts == [False, True] * 3, "on both sides of each limit; no chance"),
        ),
        _switch(),
    ]


def _switch() -> Statement:
    found = []
    for kappa, ratio in ((1.0, 0.3), (1.0, 0.45), (10.0, 0.25), (0.5, 0.35)):
        contact = Contact(ratio=kappa, damping=0.0)
        impact = integrate(contact, 1.0, ratio)
        found.append(printed.first_switch(contact, ratio) / impact.phases[0].end - 1.0)
    return Statement.judged(
        "4.77",
        "without damping the first sliding ends at t_s1",
        f"relative difference at most {max(map(abs, found)):.0e}, four pairs of kappa and |u_t/u_n|",
        exact(max(map(abs, found)), 1e-7, "relative difference"),
    )


def _full_sliding() -> list[Statement]:
    ratios = (5.0, 20.0, 100.0)
    contact = Contact(ratio=0.773)
    off = {}
    for ratio in ratios:
        e_n, e_t = integrate(contact, 1.0, ratio).restitutions
        off[ratio] = abs(e_t - printed.full_sliding(contact, e_n, ratio))
    undamped = Contact(ratio=1.0 / 3.0, damping=0.0)
    impact = integrate(undamped, 1.0, 0.4)
    negative = impact.restitutions[1]
    through = len(impact.phases) == 1 and impact.phases[0].sliding
    formula = printed.full_sliding(undamped, 1.0, 0.4)
    e_n, e_t = integrate(contact, 2.0, 10.0).restitutions
    change, jump = 10.0 * (e_t - 1.0), 3.0 * contact.friction * (1.0 + e_n)
    return [
        Statement.judged(
            "4.75",
            "e_t = 1 - 3 mu (1 + e_n) |u_n/u_t| in the limit of full sliding",
            "difference, kappa = 0.773: " + ", ".join(f"|u_t/u_n| = {r:g}: {d:.0e}" for r, d in off.items()),
            exact(max(off.values()), 1e-3),
        ),
        Statement.judged(
            "4.74",
            "u_t' - u_t = 3 sgn(u_t) mu (1 + e_n), without u_n",
            f"u_n = -2 m/s: {change:.4f} m/s, as printed {jump:.4f}, with u_n {-2.0 * jump:.4f}",
            exact(change / jump - 1.0, 1e-2, "relative difference"),
            "the factor u_n of 4.73 was lost in print; 4.75, which follows from 4.74, has it",
        ),
        Statement.judged(
            "4.5.2, against [45]",
            "e_t can be less than zero for full sliding",
            f"kappa = 1/3, no damping, |u_t/u_n| = 0.4: slides {'throughout' if through else 'in part'}, e_t = "
            f"{negative:.6f}, 4.75 {formula:.6f}",
            true(through and negative < 0.0, "one phase of sliding with e_t below zero; no chance"),
        ),
        Statement.judged(
            "4.76, 4.78",
            "it slides throughout only if |u_t/u_n| exceeds both mu / kappa and 6 mu - mu / kappa",
            f"six impacts on both sides of the larger one, kappa = 0.1, 1, 5: {_throughout()} as said",
            true(_throughout() == 6, "every impact; no chance"),
        ),
    ]


def _throughout() -> int:
    """How many of six impacts without damping slide throughout just where they should."""
    right = 0
    for kappa in (0.1, 1.0, 5.0):
        limit = max(0.1 / kappa, 0.6 - 0.1 / kappa)
        for side in (0.97, 1.03):
            impact = integrate(Contact(ratio=kappa, damping=0.0), 1.0, side * limit)
            right += (len(impact.phases) == 1 and impact.phases[0].sliding) == (side > 1.0)
    return right
