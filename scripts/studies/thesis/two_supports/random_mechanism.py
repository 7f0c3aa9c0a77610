"""What P 5.3.3 assumes of the sliding points on random supports: counts, durations, balance of torques, estimates."""

import math
from collections.abc import Sequence

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Judgement, Verdict, every, exact, near
from studies.thesis.two_supports.random_runs import POINTS, Measured
from studies.thesis.two_supports.runs import SCENE, TANGENTIAL_STIFFNESS

FRICTION, WEIGHT, MASS = 0.1, 1.0, 0.1
"""mu, m g [N], m [kg] of P 5.1."""
DAMPING_RATIO, SUPPORT_FREQUENCY = 0.5, 20.0 * math.pi
"""c and omega_b [rad/s] of P 5.3.1."""
EQUAL = 0.1
"""Numbers count as equal within this part of them."""


def _by_amplitude(points: Sequence[Measured]) -> list[Measured]:
    return sorted(points, key=lambda m: m.place.amplitude)


def _listed(m: Measured, values: dict[str, Estimate], unit: float = 1.0) -> str:
    shown = ", ".join(f"{n.upper()} {Estimate(v.mean / unit, v.error / unit)}" for n, v in values.items())
    return f"{m.place.amplitude:.1e} m: {shown}"


def equal_counts(points: Sequence[Measured], trial: Measured) -> Statement:
    """N / 4 visits of each point (P 5.14, 5.20), at one tilt."""
    found = [(m, {name: m.share_of_counts(name) for name in POINTS}) for m in _by_amplitude(points)]
    judged = [near(share, 0.25, 0.25 * EQUAL) for _, shares in found for share in shares.values()]
    heavy = {name: trial.share_of_counts(name) for name in POINTS}
    return Statement.judged(
        "5.14, 5.20, 5.3.3",
        "each of S1, S2, T1 and T2 is visited as often: N^j = N/4",
        f"shares of the visits at {points[0].place.tilt / math.pi:.2f} pi: "
        + "; ".join(_listed(m, shares) for m, shares in found),
        every(judged, f"each share at each amplitude: {judged[0].rule}"),
        "at S both contacts must slide the same way, and there the torque turns the disk, whose spin follows the "
        "supports within sqrt(m / k_t) and so ends the slide; at T it cannot. Trial: with 100 times the inertia at the "
        "same weight the shares are "
        + ", ".join(f"{name.upper()} {share}" for name, share in heavy.items())
        + f" at {trial.place.amplitude:.0e} m",
    )


def equal_durations(upright: Sequence[Measured], points: Sequence[Measured]) -> list[Statement]:
    """Mean times of a visit without tilt and at a small tilt."""
    cause = (
        "symmetry maps S1 on S2, but T1 and T2 each on itself: it does not ask that S and T, nor that T1 and T2, last "
        "as long. The torques at T vanish without tilt, so that the argument of P 5.3.3 does not need it"
    )
    printed = (
        ("5.3.3", "without tilt symmetry requires that the mean durations at S1, S2, T1 and T2 are equal", upright),
        ("5.3.3", "slightly tilted, the mean durations remain equal at first", points),
    )
    statements = []
    for place, text, chosen in printed:
        found = [(m, {name: m.duration(name) for name in POINTS}) for m in _by_amplitude(chosen)]
        judged = [_alike(list(values.values())) for _, values in found]
        statements.append(
            Statement.judged(
                place,
                text,
                f"at {chosen[0].place.tilt / math.pi:.2f} pi [ms]: "
                + "; ".join(_listed(m, values, 1e-3) for m, values in found),
                every(judged, f"each within {EQUAL:.0%} of the mean of the four, with the interval of two errors"),
                cause,
            )
        )
    return [*statements, _mirrored(upright)]


def _mirrored(upright: Sequence[Measured]) -> Statement:
    """What symmetry does require."""
    found = []
    for m in _by_amplitude(upright):
        one, two = m.duration("s1"), m.duration("s2")
        error = math.hypot(one.error / one.mean, two.error / two.mean)
        found.append(Estimate(two.mean / one.mean, error * two.mean / one.mean))
    judged = [near(ratio, 1.0, EQUAL) for ratio in found]
    return Statement.judged(
        "5.3.3",
        "of these, without tilt S1 and S2 last as long",
        "duration at S2 over that at S1 by amplitude: " + ", ".join(map(str, found)),
        every(judged, f"each {judged[0].rule}"),
        "few visits of S at the smallest amplitudes: more runs would tell",
    )


def _alike(values: Sequence[Estimate]) -> Judgement:
    mean = float(np.mean([v.mean for v in values]))
    return every([near(Estimate(v.mean / mean, v.error / mean), 1.0, EQUAL) for v in values], "")


def balance(laboratory: Laboratory, points: Sequence[Measured]) -> Statement:
    """Whether the torques of 5.15 to 5.18, weighted by the times found, balance (5.19), as a stationary spin needs."""
    tilt = points[0].place.tilt
    table = laboratory.theory(SCENE, "torques", tilt=tilt)
    torques = {name: float(table[name.upper()][0]) for name in POINTS}
    found = []
    for m in _by_amplitude(points):
        sums = sum(torques[name] * m.times[name] for name in POINTS)
        size = sum(abs(torques[name]) * float(np.mean(m.times[name])) for name in POINTS)
        found.append((m, Estimate.over_runs(np.asarray(sums) / size)))
    judged = [near(rest, 0.0, EQUAL) for _, rest in found]
    return Statement.judged(
        "5.19, 5.3.3",
        "the mean durations adjust until the mean torque of the four points is zero",
        f"sum of T^j t^j over sum of |T^j| t^j at {tilt / math.pi:.2f} pi, T^j of equilibrium: "
        + "; ".join(f"{m.place.amplitude:.1e} m: {rest}" for m, rest in found),
        every(judged, f"at each amplitude {judged[0].rule}"),
        "normal forces at the points are not those of equilibrium (row of Fig. 4.3), and single sliding contacts and "
        "sticking ones, which 5.19 leaves out, carry torque too",
    )


def always_sliding(points: Sequence[Measured]) -> Statement:
    """Both contacts slide nearly all the time."""
    found = _by_amplitude(points)
    judged = [near(m.slipping, 1.0, EQUAL) for m in found]
    both = [Estimate.over_runs(sum(m.times[name] for name in POINTS) / m.seconds) for m in found]  # type: ignore[arg-type]
    return Statement.judged(
        "5.3.3",
        "contacts are always sliding: the elastic phase is much shorter than the sliding phase and can be ignored",
        f"share of the time that a contact slides at {found[0].place.tilt / math.pi:.2f} pi: "
        + "; ".join(
            f"{m.place.amplitude:.1e} m: {m.slipping}, both at once {b}" for m, b in zip(found, both, strict=True)
        ),
        every(judged, f"at each amplitude {judged[0].rule}"),
        "the estimate compares A_b with the L of one contact; but the disk spins along with its supports and so takes "
        "away what both have in common, and a contact that stops sticks until its spring has swung over by 2 L",
    )


def estimates(small: Sequence[Measured]) -> list[Statement]:
    """Numbers of P 5.1 and 5.3.3."""
    stretch = FRICTION * WEIGHT / TANGENTIAL_STIFFNESS
    memory = 1.0 / (DAMPING_RATIO * SUPPORT_FREQUENCY)
    period = math.sqrt(MASS / TANGENTIAL_STIFFNESS)
    rows = [
        ("L ~ mu m g / k_t ~ 1e-7", stretch, 1e-7, " m"),
        ("A_b ~ 1e-5 is at least two orders of magnitude above L", 1e-5 / stretch, 100.0, ""),
        ("t_c ~ 1 / (c omega_b) ~ 3e-2", memory, 3e-2, " s"),
        ("sqrt(m / k_t) ~ 3e-4", period, 3e-4, " s"),
    ]
    found = [
        Statement.judged(
            "5.3.3", printed, f"{value:.3g}{unit}", exact(value / number - 1.0, 0.1, "relative difference")
        )
        for printed, value, number, unit in rows
    ]
    fastest = math.sqrt(4.0 * TANGENTIAL_STIFFNESS / MASS)
    found.append(
        Statement.judged(
            "5.1",
            "the time step of 1e-6 s is at least a hundred times shorter than the tangential oscillation",
            f"spin on two tangential springs: {math.tau / fastest:.2e} s",
            Judgement(Verdict.AGREES if math.tau / fastest >= 1e-4 else Verdict.DISAGREES, "period at least 1e-4 s"),
        )
    )
    ratios = [10.0 * s / (2.0 * math.sqrt(1e3 * s * MASS)) for s in (2.0 * 0.75, 2.0 * 0.25)]
    found.append(
        Statement.judged(
            "5.1",
            "k_n = 1e3, gamma = 10, m = 0.1: normal oscillations are under-damped",
            f"damping ratios of the centre up and sideways: {ratios[0]:.2f}, {ratios[1]:.2f}",
            Judgement(Verdict.AGREES if max(ratios) < 1.0 else Verdict.DISAGREES, "both below 1; no chance"),
        )
    )
    line = _by_amplitude(small)
    first = min((m.place.amplitude for m in line if m.slips > 0.0), default=math.inf)
    within = 1.01 * stretch < first <= 10.0 * stretch
    found.append(
        Statement.judged(
            "5.3.3",
            "a displacement of the order of L makes a contact slide",
            f"slips per second at {line[0].place.tilt / math.pi:.2f} pi: "
            + ", ".join(f"{m.place.amplitude:.0e} m: {m.slips:.3g}" for m in line),
            Judgement(
                Verdict.AGREES if within else Verdict.DISAGREES,
                "no slip at A_b = L on a grid that begins there, some up to 10 L",
            ),
        )
    )
    return found
