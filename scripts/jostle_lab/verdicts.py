"""Rules by which a printed statement agrees with what was found, or does not, or the errors do not tell.

Every rule looks at intervals of two standard errors (95 %): a statement agrees if the whole interval does, disagrees if
none of it does, and is open in between. So more runs can only turn an open verdict into a decided one.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from scipy import stats
from scipy.optimize import isotonic_regression

from jostle_lab.statistics.estimates import Estimate, chi_square

SIGNIFICANCE = 2.0
"""Half of an interval, in standard errors."""
LEAST_PROBABILITY = 0.01
"""A hypothesis of chance whose probability is smaller is rejected."""


class Verdict(StrEnum):
    """Whether a printed statement holds."""

    AGREES = "agrees"
    PARTLY = "partly"
    DISAGREES = "disagrees"
    OPEN = "open"


def verdict(holds: bool) -> Verdict:
    """Agreement, yes or no."""
    return Verdict.AGREES if holds else Verdict.DISAGREES


@dataclass(frozen=True)
class Judgement:
    """A verdict and the rule that gave it."""

    verdict: Verdict
    rule: str

    def __and__(self, other: "Judgement") -> "Judgement":
        """Both parts of a statement."""
        return every([self, other], f"{self.rule}; and {other.rule}")


def near(found: Estimate, printed: float, margin: float) -> Judgement:
    """Whether `found` is the printed number, to a margin that is stated: what counts as the same number."""
    away, reach = abs(found.mean - printed), SIGNIFICANCE * found.error
    rule = f"within {margin:.2g} of {printed:g}, with the whole interval of two errors"
    if not _decided(found):
        return Judgement(Verdict.OPEN, rule)
    if away + reach <= margin:
        return Judgement(Verdict.AGREES, rule)
    return Judgement(Verdict.DISAGREES if away - reach > margin else Verdict.OPEN, rule)


def compatible(found: Estimate, printed: float, printed_error: float, widest: float = math.inf) -> Judgement:
    """Whether `found` and a printed number with an error are the same within two joint errors.

    An error of ours above `widest` decides nothing that agrees: everything would.
    """
    joint = math.hypot(found.error, printed_error)
    rule = f"within two joint errors of {printed:g} +- {printed_error:g}"
    if math.isfinite(widest):
        rule += f", our error at most {widest:.2g}"
    if not _decided(found):
        return Judgement(Verdict.OPEN, rule)
    if abs(found.mean - printed) > SIGNIFICANCE * joint:
        return Judgement(Verdict.DISAGREES, rule)
    return Judgement(Verdict.AGREES if found.error <= widest else Verdict.OPEN, rule)


def above(found: Estimate, bound: float) -> Judgement:
    """Whether `found` is above a bound for certain."""
    rule = f"above {bound:.3g} by two errors"
    return Judgement(_side(found.mean - bound, found), rule)


def below(found: Estimate, bound: float) -> Judgement:
    """Whether `found` is below a bound for certain."""
    rule = f"below {bound:.3g} by two errors"
    return Judgement(_side(bound - found.mean, found), rule)


def _side(distance: float, found: Estimate) -> Verdict:
    reach = SIGNIFICANCE * found.error
    if not _decided(found) or abs(distance) < reach:
        return Verdict.OPEN
    return verdict(distance >= 0.0)


def _decided(found: Estimate) -> bool:
    return math.isfinite(found.mean) and math.isfinite(found.error)


def vanish(found: Sequence[Estimate], scale: float) -> Judgement:
    """Whether all of `found` are zero by chance, where errors are small beside `scale`, what would not be zero."""
    rule = f"chi^2 of all from zero has p > {LEAST_PROBABILITY:g}, no interval of two errors goes beyond {scale:.2g}"
    errors = [e.error for e in found]
    if not all(map(_decided, found)):
        return Judgement(Verdict.OPEN, rule)
    if max(errors) == 0.0 or all(e.mean == 0.0 for e in found):
        return Judgement(verdict(all(abs(e.mean) <= 1e-9 * scale for e in found)), rule)
    _, probability = chi_square([e.mean for e in found], [max(e, 1e-12 * scale) for e in errors])
    if probability <= LEAST_PROBABILITY:
        return Judgement(Verdict.DISAGREES, rule)
    sharp = all(abs(e.mean) + SIGNIFICANCE * e.error < scale for e in found)
    return Judgement(Verdict.AGREES if sharp else Verdict.OPEN, rule)


def rises(found: Sequence[Estimate]) -> Judgement:
    """Whether a curve rises: a monotone one fits, and its end is above its start for certain."""
    rule = f"the best rising curve fits with p > {LEAST_PROBABILITY:g}, and the end is above the start by three errors"
    means = np.array([e.mean for e in found])
    floor = 1e-12 * float(np.max(np.abs(means))) or 1e-300
    weights = np.array([1.0 / max(e.error, floor) ** 2 for e in found])
    best = isotonic_regression(means, weights=weights, increasing=True)
    freedom = len(means) - (len(best.blocks) - 1)
    total = float(np.sum(weights * (best.x - means) ** 2))
    fits = freedom == 0 or float(stats.chi2.sf(total, freedom)) > LEAST_PROBABILITY
    if not fits:
        return Judgement(Verdict.DISAGREES, rule)
    first, last = found[0], found[-1]
    gain, error = last.mean - first.mean, math.hypot(first.error, last.error)
    if gain > 3.0 * error:
        return Judgement(Verdict.AGREES, rule)
    return Judgement(Verdict.DISAGREES if gain < -3.0 * error else Verdict.OPEN, rule)


def falls(found: Sequence[Estimate]) -> Judgement:
    """Whether a curve falls."""
    judgement = rises([Estimate(-e.mean, e.error) for e in found])
    rule = judgement.rule.replace("rising", "falling").replace("above", "below")
    return Judgement(judgement.verdict, rule)


def exact(difference: float, tolerance: float, what: str = "difference") -> Judgement:
    """Whether numbers without chance are equal to a tolerance."""
    return Judgement(verdict(abs(difference) <= tolerance), f"{what} at most {tolerance:g}; no chance")


def true(holds: bool, rule: str) -> Judgement:
    """A rule of one's own about numbers whose errors it knows, or which have none."""
    return Judgement(verdict(holds), rule)


def every(parts: Iterable[Judgement], rule: str) -> Judgement:
    """A statement of several parts: partly, if some agree and some do not."""
    found = {part.verdict for part in parts}
    if found == {Verdict.AGREES}:
        return Judgement(Verdict.AGREES, rule)
    if Verdict.PARTLY in found or found >= {Verdict.AGREES, Verdict.DISAGREES}:
        return Judgement(Verdict.PARTLY, rule)
    return Judgement(Verdict.DISAGREES if Verdict.DISAGREES in found else Verdict.OPEN, rule)
