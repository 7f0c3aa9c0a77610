"""What P 5.3.2 says of the mean angular velocity on random supports, judged on the points of Figs 5.8 and 5.9."""

import math
from collections.abc import Mapping, Sequence

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate, chi_square
from jostle_lab.verdicts import Judgement, Verdict, above, every, falls, near, vanish
from studies.thesis.two_supports.random_runs import Measured, Place

Found = Mapping[Place, Measured]

ONSET = 1e-5
"""A_b at which P 5.3.3 sees the disk start to rotate [m]."""
FACTOR = 2.0
"""`around` the printed onset: within this factor."""


def upright(found: Found) -> Statement:
    """No rotation without tilt: the mean of runs as drawn, beside the rotation with tilt."""
    pairs = [(m, strongest(found, m.place.amplitude)) for m in found.values() if m.place.tilt == 0.0 and m.lasting]
    compared = [(still, turns) for still, turns in pairs if turns > 3.0 * still.velocity.error]
    ratios = [Estimate(still.velocity.mean / turns, still.velocity.error / turns) for still, turns in compared]
    text = "; ".join(f"{m.place.amplitude:.1e} m: {m.velocity} rad/s" for m, _ in pairs)
    chi, p = chi_square([m.velocity.mean for m, _ in pairs], [m.velocity.error for m, _ in pairs])
    judgement = vanish(ratios, 1.0) if ratios else Judgement(Verdict.OPEN, "no point that turns when tilted")
    rule = f"of omega over the fastest rotation at the same amplitude, where that is above 3 errors: {judgement.rule}"
    return Statement.judged(
        "5.3.2",
        "without tilt the disk does not rotate",
        f"mean of runs as drawn, without mirrored ones: {text}; from zero: chi^2 per point {chi:.2f}, p = {p:.2g}",
        Judgement(judgement.verdict, rule),
        "runs as drawn scatter with the square root of their time: four times the runs halve the error bars",
    )


def strongest(found: Found, amplitude: float) -> float:
    """Fastest rotation of a tilted disk at an amplitude [rad/s]; NaN if contacts opened in all."""
    return max((abs(m.velocity.mean) for m in tilted(found) if m.place.amplitude == amplitude), default=math.nan)


def tilted(found: Found) -> list[Measured]:
    """Points with tilt at which no contact opened."""
    return [m for m in found.values() if m.place.tilt > 0.0 and m.lasting]


def negative(found: Found) -> Statement:
    """Opposite sign to that under a torque."""
    points = tilted(found)
    strongest = min(points, key=lambda m: m.velocity.mean / m.velocity.error)
    gain = sum((m.single / m.velocity.error) ** 2 for m in points) / len(points)
    below, above_zero, judgement = sign([m.velocity for m in points])
    return Statement.judged(
        "5.3.2",
        "for positive tilt the rotation is negative, opposite to that under a torque",
        f"{below} of {len(points)} points below zero by 2 errors, {above_zero} above by 3; most certain: "
        f"{strongest.velocity} rad/s at {strongest.place.tilt / math.pi:.2f} pi, {strongest.place.amplitude:.0e} m; "
        f"pairs save a factor {gain:.1f} of runs",
        judgement,
    )


def sign(velocities: Sequence[Estimate]) -> tuple[int, int, Judgement]:
    """Points below zero by two errors, above by three, and whether all are negative."""
    below = sum(v.mean < -2.0 * v.error for v in velocities)
    positive = sum(v.mean > 3.0 * v.error for v in velocities)
    rule = "no point above zero by 3 errors, at least half of the points below by 2"
    if positive:
        return below, positive, Judgement(Verdict.DISAGREES if positive >= below else Verdict.PARTLY, rule)
    return below, positive, Judgement(Verdict.AGREES if 2 * below >= len(velocities) else Verdict.OPEN, rule)


def monotonic(found: Found) -> Statement:
    """The velocity falls with the amplitude until a contact opens."""
    lines = [line for line in by_tilt(found) if len(line) > 1]
    judged = [falls([m.velocity for m in line]) for line in lines]
    text = "; ".join(
        f"{line[0].place.tilt / math.pi:.2f} pi: {line[0].velocity} to {line[-1].velocity} rad/s, {judgement.verdict}"
        for line, judgement in zip(lines, judged, strict=True)
    )
    return Statement.judged(
        "5.3.2, 7",
        "the velocity falls monotonically with the amplitude until a contact opens",
        text,
        every(judged, f"at each tilt: {judged[0].rule}"),
        "where the end of a curve is not below its start for certain, more seeds would tell",
    )


def by_tilt(found: Found) -> list[list[Measured]]:
    """Lasting points of each tilt but zero, by amplitude."""
    tilts = sorted({place.tilt for place in found if place.tilt > 0.0})
    return [
        sorted((m for m in tilted(found) if m.place.tilt == tilt), key=lambda m: m.place.amplitude) for tilt in tilts
    ]


def opening(found: Found, along: str) -> Statement:
    """Contacts open earlier as the other parameter grows: along the amplitude (5.8) or along the tilt (5.9)."""
    amplitude = along == "amplitude"

    def first(other: float) -> float:
        at = [
            m.place.amplitude if amplitude else m.place.tilt
            for m in found.values()
            if not m.lasting and (m.place.tilt if amplitude else m.place.amplitude) == other
        ]
        return min(at, default=math.inf)

    others = sorted({place.tilt if amplitude else place.amplitude for place in found})
    firsts = [first(other) for other in others]
    unit = 1.0 if amplitude else math.pi
    text = ", ".join(
        (f"{o / math.pi:.2f} pi" if amplitude else f"{o:.0e} m")
        + ": "
        + ("none" if math.isinf(f) else f"{f / unit:.2g}" + (" m" if amplitude else " pi"))
        for o, f in zip(others, firsts, strict=True)
    )
    falling = firsts == sorted(firsts, reverse=True)
    earlier = firsts[-1] < firsts[0]
    verdict = Verdict.DISAGREES if not falling else (Verdict.AGREES if earlier else Verdict.OPEN)
    printed = (
        "with tilt contacts open at smaller amplitudes"
        if amplitude
        else "contacts open at smaller tilts as A_b increases"
    )
    return Statement.judged(
        "5.3.2",
        printed,
        f"first with an open contact in some run: {text}",
        Judgement(verdict, "the first grid point with an open contact never moves up, and moves down in all"),
        "a finer grid would tell",
    )


def onset(found: Found) -> Statement:
    """A_b at which the disk starts to rotate, at each tilt with three points that turn."""
    starts = {line[0].place.tilt: straight_onset(line) for line in by_tilt(found) if line}
    starts = {tilt: start for tilt, start in starts.items() if math.isfinite(start.mean)}
    decades = [Estimate(math.log10(s.mean / ONSET), s.error / (s.mean * math.log(10.0))) for s in starts.values()]
    judged = [near(d, 0.0, math.log10(FACTOR)) for d in decades] or [Judgement(Verdict.OPEN, "no curve that turns")]
    weakest = by_tilt(found)[0]
    text = ", ".join(f"{m.place.amplitude:.1e} m: {m.velocity}" for m in weakest[:3])
    return Statement.judged(
        "5.3.3, Fig. 5.8",
        "the disk starts to rotate at A_b of about 1e-5",
        "straight line through the first three points that turn by 5 errors reaches zero at "
        + ", ".join(f"{s.mean:.2e} +- {s.error:.0e} m at {t / math.pi:.2f} pi" for t, s in starts.items())
        + f"; at {weakest[0].place.tilt / math.pi:.2f} pi [rad/s] {text}",
        every(judged, "at each tilt log10 of that place over 1e-5 is within 0.3 of 0 (a factor 2), with two errors"),
        "no threshold: the velocity goes to zero smoothly, so that where it starts depends on the scale of the picture",
    )


def straight_onset(line: Sequence[Measured]) -> Estimate:
    """Where the line by least squares through the first three points that turn by five errors is zero [m]; else NaN."""
    turning = [m for m in line if abs(m.velocity.mean) > 5.0 * m.velocity.error][:3]
    if len(turning) < 3:
        return Estimate(math.nan, math.nan)
    weights = [m.velocity.error**-2 for m in turning]
    x = [m.place.amplitude for m in turning]
    y = [m.velocity.mean for m in turning]
    total = sum(weights)
    x_mean = sum(w * a for w, a in zip(weights, x, strict=True)) / total
    y_mean = sum(w * b for w, b in zip(weights, y, strict=True)) / total
    spread = sum(w * (a - x_mean) ** 2 for w, a in zip(weights, x, strict=True))
    slope = sum(w * (a - x_mean) * b for w, a, b in zip(weights, x, y, strict=True)) / spread
    zero = x_mean - y_mean / slope
    return Estimate(zero, math.sqrt(1.0 / total + (zero - x_mean) ** 2 / spread) / abs(slope))


def minimum(found: Found) -> Statement:
    """As the tilt grows the velocity falls to a minimum and comes back."""
    amplitudes = sorted({place.amplitude for place in found})
    lines = {
        a: sorted((m for m in found.values() if m.place.amplitude == a and m.lasting), key=lambda m: m.place.tilt)
        for a in amplitudes
    }
    text, judged = [], []
    for a, line in lines.items():
        lowest = min(line, key=lambda m: m.velocity.mean)
        back = Estimate(
            line[-1].velocity.mean - lowest.velocity.mean, math.hypot(line[-1].velocity.error, lowest.velocity.error)
        )
        down = Estimate(
            line[0].velocity.mean - lowest.velocity.mean, math.hypot(line[0].velocity.error, lowest.velocity.error)
        )
        inner = lowest is not line[-1]
        judged.append(
            every([above(down, 0.0), above(back, 0.0)], "") if inner else Judgement(Verdict.OPEN, "no point beyond")
        )
        text.append(
            f"{a:.0e} m: {lowest.velocity} rad/s at {lowest.place.tilt / math.pi:.2f} pi, {line[-1].velocity} at the "
            f"last tilt without an open contact, {line[-1].place.tilt / math.pi:.2f} pi: {judged[-1].verdict}"
        )
    return Statement.judged(
        "5.3.2, 7",
        "as the tilt grows the velocity falls to a minimum and comes back towards zero",
        "; ".join(text),
        every(judged, "at each amplitude the lowest point is below both ends by two joint errors"),
        "where contacts open before the minimum there is nothing to see; elsewhere four times the seeds, "
        "three hours of one processor, would tell",
    )
