"""Statements that several figures of the wedge share: no rotation without tilt, change of sense, one curve or not."""

from collections.abc import Mapping, Sequence

import numpy as np

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate, chi_square, places, zero_crossings
from jostle_lab.verdicts import LEAST_PROBABILITY, SIGNIFICANCE, Judgement, Verdict, true, vanish
from studies.thesis.wedge.curves import Curve

SMALL = 0.05
"""Part of the strongest rotation that counts as none, where errors must be smaller."""


def peak(curves: Sequence[Curve]) -> float:
    """Strongest |R omega / (A omega_b)| of several curves."""
    return max(abs(point.mean) for curve in curves for point in curve.points)


def less(curve: Curve, other: Curve) -> list[Estimate]:
    """Differences at the tilts of `curve`, with both errors."""
    pairs = [(point, other.at(tilt)) for tilt, point in zip(curve.tilts, curve.points, strict=True)]
    return [Estimate(a.mean - b.mean, float(np.hypot(a.error, b.error))) for a, b in pairs]


def rms(points: Sequence[Estimate]) -> Estimate:
    """Root of the mean square of values, what their errors add taken off; its error to first order."""
    means, errors = np.array([p.mean for p in points]), np.array([p.error for p in points])
    size = float(np.sqrt(max(np.mean(means**2 - errors**2), 0.0)))
    spread = float(np.sqrt(np.sum((means * errors) ** 2))) / len(means)
    floor = float(np.sqrt(np.mean(errors**2) / len(means)))
    return Estimate(size, max(spread / size if size > 0.0 else floor, floor))


def alike(differences: Sequence[Estimate], strongest: float, lost: int = 0) -> tuple[str, Judgement]:
    """Whether curves are one: chi^2 of differences, `lost` degrees fitted, and how small they are for certain."""
    ratio, p = chi_square([d.mean for d in differences], [d.error for d in differences], lost)
    reach = max(abs(d.mean) + SIGNIFICANCE * d.error for d in differences)
    rule = (
        f"chi^2 with p > {LEAST_PROBABILITY:g}, no interval of two errors beyond {2 * SMALL:.0%} of the largest value"
    )
    text = (
        f"chi^2 per degree of freedom {ratio:.2f}, p = {p:.2g}; rms difference {rms(differences)}, "
        f"{100.0 * rms(differences).mean / strongest:.1f} % of the largest value"
    )
    if p <= LEAST_PROBABILITY:
        return text, Judgement(Verdict.DISAGREES, rule)
    return text, Judgement(Verdict.AGREES if reach < 2.0 * SMALL * strongest else Verdict.OPEN, rule)


LONGER = "runs four times as long, an hour of one processor, halve the errors"
"""What tells whether a symmetric wedge turns the disk, of a figure with a quarter of an hour of runs."""


def symmetric(curves: Mapping[str, Curve], place: str = "6.1", cause: str = LONGER) -> Statement:
    """A symmetric wedge does not turn the disk; seeds of the curves are independent runs, none mirrored."""
    zero = {name: curve.at(0.0) for name, curve in curves.items()}
    strongest = peak(list(curves.values()))
    return Statement.judged(
        place,
        "a symmetric wedge does not turn the disk",
        from_zero(zero),
        vanish(list(zero.values()), SMALL * strongest),
        cause,
    )


def from_zero(points: Mapping[str, Estimate]) -> str:
    """Values that should be zero, and chi^2 of those that are not exactly so (a disk at rest is)."""
    moving = [z for z in points.values() if (z.mean, z.error) != (0.0, 0.0)]
    ratio, p = chi_square([z.mean for z in moving], [z.error for z in moving])
    listed = "; ".join(f"{name}: {z.mean:.1e} +- {z.error:.0e}" for name, z in points.items())
    return f"{listed}; chi^2 per point {ratio:.2f}, p = {p:.2g}"


def changes_sense(curves: Mapping[str, Curve], every_one: bool = False) -> Statement:
    """The sense of rotation changes with tilt, by at least three errors on both sides."""
    found = {name: zero_crossings(curve.tilts, curve.points) for name, curve in curves.items()}
    holds = all(found.values()) if every_one else any(found.values())
    which = "every curve" if every_one else "some curve"
    return Statement.judged(
        "6.2",
        "the rotation is not monotonic in the tilt, and may change direction as the tilt is increased",
        "changes of sign: " + "; ".join(f"{name}: {places(c, 'degrees')}" for name, c in found.items()),
        true(holds, f"{which} is beyond zero by three errors on both sides"),
    )
