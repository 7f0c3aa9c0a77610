"""What P 5.2.2 and 5.2.4 say of the mean angular velocity against the amplitude of a slow torque."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.statistics.power_law import power_law
from jostle_lab.verdicts import above, every, exact, near, rises, true
from studies.thesis.two_supports.tilt_lines import TiltLine

Found = Sequence[TiltLine]

SLOPE_MARGIN = 0.1
"""A printed exponent of one digit."""
HIDDEN = 0.1
"""Part of a value that a symbol of a printed plot hides: a symbol is about a tenth of a decade high."""


def _tilt(line: TiltLine) -> str:
    return f"{line.tilt / math.pi:.2f} pi"


def never_upright(found: Found) -> Statement:
    """No rotation without tilt."""
    still = max(abs(v) for v in found[0].velocities)
    largest = max(float(line.velocities.max()) for line in found)
    return Statement.judged(
        "5.2.2, Fig. 5.2",
        "without tilt the disk never rotates",
        f"largest |omega| {still:.1e} rad/s, of {largest:.2f} rad/s at the largest tilt",
        exact(still / largest, 1e-6, "|omega| over the largest of all"),
    )


def begins_at_limit(found: Found) -> Statement:
    """Sliding begins at A_S2."""
    onsets = [onset(line) for line in found[1:]]
    below = max(abs(line.found[0].velocity) for line in found)
    judged = [near(o, line.lower, 1e-2 * line.lower) for o, line in zip(onsets, found[1:], strict=True)]
    falling = [above(Estimate(a.mean - b.mean, math.hypot(a.error, b.error)), 0.0) for a, b in pairwise(onsets)]
    text = "; ".join(
        f"{_tilt(line)}: {o} N m, A_S2 = {line.lower:.5f} N m" for line, o in zip(found[1:], onsets, strict=True)
    )
    return Statement.judged(
        "5.2.2",
        "sliding begins earlier as the tilt grows, at A_S2 (5.3)",
        f"{text}; |omega| at 0.97 A_S2 at most {below:.1e} rad/s",
        every([*judged, *falling], "each within 1 % of A_S2, each below the one before by two errors"),
    )


def onset(line: TiltLine) -> Estimate:
    """Amplitude from which on the disk turns: where the root of the unidirectional velocities vanishes [N m]."""
    excess = (line.amplitudes - line.lower) / (line.upper - line.lower)
    inside = (excess > 0.0) & (excess < 0.6)
    root = np.sqrt(line.velocities[inside] * line.amplitudes[inside])
    # omega ~ (A - A_S)^2 / A_S (1 + ...): a straight line in the root, bent a little.
    degree = 2
    if len(root) < degree + 2:
        return Estimate(float(np.polyval(np.polyfit(root, line.amplitudes[inside], 1), 0.0)), math.nan)
    fitted, covariance = np.polyfit(root, line.amplitudes[inside], degree, cov=True)
    return Estimate(float(fitted[-1]), float(math.sqrt(covariance[-1, -1])))


def never_negative(found: Found) -> Statement:
    """For positive tilt the sense is counter-clockwise."""
    lowest = min((turned.estimate for line in found[1:] for turned in line.found), key=lambda e: e.mean)
    return Statement.judged(
        "5.2",
        "for positive tilt the angular velocity is never negative",
        f"smallest of {sum(len(line.found) for line in found[1:])}: {lowest.mean:.1e} rad/s, which changed by "
        f"{lowest.error:.0e} from the period before",
        true(lowest.mean > -1e-8, "none below -1e-8 rad/s, the rolling of a disk that does not slide; no chance"),
    )


def grows(found: Found) -> Statement:
    """Monotonic in the amplitude."""
    judged = [rises([turned.estimate for turned in line.found]) for line in found[1:]]
    return Statement.judged(
        "7, Fig. 5.2",
        "the angular velocity grows monotonically with the amplitude of the torque",
        "; ".join(f"{_tilt(line)}: {j.verdict}" for line, j in zip(found[1:], judged, strict=True)),
        every(judged, f"at each tilt, errors from the period before: {judged[0].rule}"),
    )


def longer_at_easier(found: Found) -> Statement:
    """More time at S2 than at S1."""
    turned = [t for line in found[1:] for t in line.found if t.regime > 0]
    ratios = [t.clockwise / t.counter_clockwise for t in turned]
    return Statement.judged(
        "7, 5.2",
        "tilted, the time spent sliding at S2 is always larger than at S1",
        f"time at S1 over that at S2 in {len(turned)} runs that slide: {min(ratios):.3f} to {max(ratios):.3f}",
        true(max(ratios) < 1.0, "below 1 in every run; no chance"),
    )


def lasting(found: Found) -> Statement:
    """No contact opens below the tilt of detachment."""
    runs = [pair for line in found for pair in zip(line.torques, line.found, strict=True)]
    opened = [torque for torque, turned in runs if turned.opened]
    where = "; ".join(f"{t.tilt / math.pi:.2f} pi, {t.amplitude:.3f} N m" for t in opened)
    judgement = every([true(not turned.opened, "") for _, turned in runs], "in no run; no chance")
    return Statement.judged(
        "5.2.1",
        "below the detachment tilt no contact opens",
        f"{len(opened)} of {len(runs)} runs with an open contact" + (f": {where}" if opened else ""),
        judgement,
        "5.2.1 is quasi-static, the end of a slide is not: the friction forces then swing from their limits to what "
        "balances the torque within a period of the springs, however slow the torque is (trial: the same run at "
        "omega_e = 0.5 and 0.25 rad/s opens too), and close to theta_T^D the light contact has no force to spare",
    )


def scaling(found: Found) -> list[Statement]:
    """Slopes 2 and 1, and the collapse of Fig. 5.3."""
    statements = []
    for name, window, expected, cause in (
        ("unidirectional", (0.08, 0.9), 2.0, ""),
        (
            "bidirectional",
            (3.0, math.inf),
            1.0,
            "5.9, which the runs follow, is 2u - 1 while A_e is near A_S2, u the excess, so that its slope falls to 1 "
            "from above, and bends down where A_e is no longer near A_S2",
        ),
    ):
        slopes = [(power_law(x, y), power_law(x, t)) for x, y, t in (line.between(*window) for line in found)]
        judged = [exact(ours.mean - expected, SLOPE_MARGIN, "slope less the printed one") for ours, _ in slopes]
        text = "; ".join(
            f"{_tilt(line)}: {ours}, of 5.9 {theory.mean:.3f}"
            for line, (ours, theory) in zip(found, slopes, strict=True)
        )
        statements.append(
            Statement.judged(
                "5.2.2, Fig. 5.3",
                f"{name} sliding: slope {expected:g}",
                text,
                every(judged, f"at each tilt: {judged[0].rule}"),
                cause,
            )
        )
    return [*statements, _collapse(found)]


def _collapse(found: Found) -> Statement:
    spreads = {}
    for excess in (0.5, 5.0):
        values = [_scaled(line, line.velocities, excess) for line in found]
        theory = [_scaled(line, line.theory, excess) for line in found]
        spreads[excess] = (max(values) / min(values) - 1.0, max(theory) / min(theory) - 1.0)
    worst = max(ours for ours, _ in spreads.values())
    return Statement.judged(
        "Fig. 5.3",
        "all curves collapse when scaled by A_S1 - A_S2",
        "; ".join(f"at the excess {e:g} they spread by {o:.1%}, 5.9 by {t:.1%}" for e, (o, t) in spreads.items()),
        exact(worst, HIDDEN, "largest over smallest, less 1,"),
        "the collapse is not exact: the prefactor 1 / A_S2 of 5.9 grows by 12 % over these tilts",
    )


def _scaled(line: TiltLine, velocities: Numbers, excess: float) -> float:
    """Omega / (A_S1 - A_S2)^2 at an excess, between points in the logarithm."""
    width = line.upper - line.lower
    u = (line.amplitudes - line.lower) / width
    inside = u > 0.0
    return float(np.exp(np.interp(math.log(excess), np.log(u[inside]), np.log(velocities[inside])))) / width**2


def closed_form(found: Found) -> list[Statement]:
    """5.9 beside the runs."""
    rigid = {line.tilt: deviation(line, line.theory) for line in found[1:]}
    soft = {line.tilt: deviation(line, line.soft) for line in found[1:]}

    def listed(deviations: dict[float, float]) -> str:
        return ", ".join(f"{tilt / math.pi:.2f} pi: {value:.1e}" for tilt, value in deviations.items())

    return [
        Statement.judged(
            "5.2.4, Fig. 5.7",
            "simulations agree very well with 5.9",
            "largest deviation over the largest velocity: " + listed(rigid),
            exact(max(rigid.values()), 1e-2, "deviation over the largest velocity, the width of a line in print,"),
        ),
        _exact_form(rigid, listed(soft), max(soft.values())),
    ]


def _exact_form(rigid: dict[float, float], text: str, rest: float) -> Statement:
    judgement = every(
        [exact(max(rigid.values()), 1e-4), exact(rest, 1e-2)],
        "as printed within 1e-4, or in part if within 1e-2 once the overlap is in A_S1 and A_S2",
    )
    return Statement.judged(
        "5.2.4",
        "5.9 is exact",
        f"as printed within {max(rigid.values()):.1e}; with the overlap of the soft contacts in A_S1 and A_S2: {text}",
        judgement,
        "it is exact for rigid contacts and an infinitely slow torque (figure closed-form): the overlap n / k_n turns "
        "the lines of centres, and the centre has inertia, which goes with omega_e^2",
    )


def deviation(line: TiltLine, theory: Numbers) -> float:
    """Largest deviation from a theory while no contact opens, relative to the largest velocity of the line."""
    chosen = np.array([not found.opened for found in line.found])
    return float(np.max(np.abs(line.velocities - theory)[chosen]) / np.max(np.abs(theory)))
