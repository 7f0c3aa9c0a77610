"""Rules of verdicts, on made-up data that should agree, that should not, and that cannot tell."""

import math

import numpy as np
import pytest

from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import (
    Judgement,
    Verdict,
    above,
    below,
    compatible,
    every,
    exact,
    falls,
    near,
    rises,
    true,
    vanish,
)

AGREES, PARTLY, DISAGREES, OPEN = Verdict.AGREES, Verdict.PARTLY, Verdict.DISAGREES, Verdict.OPEN


@pytest.mark.parametrize(
    ("mean", "error", "expected"),
    [
        (3.9, 0.02, AGREES),
        (3.9, 0.2, OPEN),
        (4.5, 0.02, DISAGREES),
        (4.04, 0.02, OPEN),
        (math.nan, 0.1, OPEN),
        (3.85, math.nan, OPEN),
        (3.85, 0.0, AGREES),
    ],
)
def test_a_number_is_near_if_its_whole_interval_is(mean: float, error: float, expected: Verdict) -> None:
    assert near(Estimate(mean, error), 3.85, 0.2).verdict is expected


@pytest.mark.parametrize(
    ("mean", "error", "expected"), [(3.7, 0.1, AGREES), (5.0, 0.1, DISAGREES), (5.0, 5.0, OPEN), (3.9, 1.0, OPEN)]
)
def test_an_error_that_fits_everything_decides_nothing(mean: float, error: float, expected: Verdict) -> None:
    assert compatible(Estimate(mean, error), 3.9, 0.3, widest=0.5).verdict is expected


def test_a_bound_is_kept_broken_or_not_told() -> None:
    assert above(Estimate(1.0, 0.1), 0.5).verdict is AGREES
    assert above(Estimate(1.0, 0.1), 1.5).verdict is DISAGREES
    assert above(Estimate(1.0, 0.1), 0.9).verdict is OPEN
    assert below(Estimate(1.0, 0.1), 1.5).verdict is AGREES
    assert below(Estimate(1.0, math.inf), 1.5).verdict is OPEN


def test_zero_is_told_from_a_small_number_and_from_not_knowing() -> None:
    noise = np.random.default_rng(1).normal(0.0, 0.01, 50)
    assert vanish([Estimate(v, 0.01) for v in noise], 1.0).verdict is AGREES
    assert vanish([Estimate(v + 0.02, 0.01) for v in noise], 1.0).verdict is DISAGREES
    assert vanish([Estimate(v, 0.01) for v in noise], 0.01).verdict is OPEN
    assert vanish([Estimate(0.0, 0.0)], 1.0).verdict is AGREES
    assert vanish([Estimate(0.1, 0.0)], 1.0).verdict is DISAGREES


def test_a_curve_rises_in_spite_of_noise_but_not_with_a_dip() -> None:
    noise = np.random.default_rng(2).normal(0.0, 0.1, 10)
    rising = [Estimate(0.3 * i + n, 0.1) for i, n in enumerate(noise)]
    assert rises(rising).verdict is AGREES
    assert falls(rising).verdict is DISAGREES
    dip = [*rising[:5], Estimate(-2.0, 0.1), *rising[6:]]
    assert rises(dip).verdict is DISAGREES
    assert rises([Estimate(n, 0.1) for n in noise]).verdict is OPEN
    assert "falling" in falls(rising).rule


def test_a_statement_of_parts_is_partly_true() -> None:
    yes, no, unknown = (Judgement(v, "") for v in (AGREES, DISAGREES, OPEN))
    assert every([yes, yes], "").verdict is AGREES
    assert every([yes, no], "").verdict is PARTLY
    assert every([no, no], "").verdict is DISAGREES
    assert every([yes, unknown], "").verdict is OPEN
    assert every([no, unknown], "").verdict is DISAGREES
    assert (yes & no).verdict is PARTLY


def test_numbers_without_chance_are_held_against_a_tolerance() -> None:
    assert exact(-1e-7, 1e-6).verdict is AGREES
    assert exact(1e-5, 1e-6).verdict is DISAGREES
    assert true(False, "said").rule == "said"
