"""Exponents: exact ones, noise, and why two points know no error."""

import math

import numpy as np
import pytest

from jostle_lab.statistics.estimates import Estimate
from jostle_lab.statistics.power_law import power_law, weighted_power_law
from jostle_lab.verdicts import Verdict, near


def test_power_law_is_found() -> None:
    x = np.geomspace(0.1, 10.0, 20)
    exact = power_law(x, 3.0 * x**1.7)
    assert exact.mean == pytest.approx(1.7, abs=1e-12)
    assert exact.error < 1e-12


def test_error_is_that_of_the_scatter() -> None:
    generator = np.random.default_rng(5)
    x = np.geomspace(1.0, 100.0, 30)
    found = [power_law(x, x * np.exp(generator.normal(0.0, 0.2, len(x)))) for _ in range(400)]
    spread = float(np.std([e.mean for e in found], ddof=1))
    assert float(np.mean([e.error for e in found])) == pytest.approx(spread, rel=0.1)


def test_line_through_two_points_has_no_error() -> None:
    two = power_law(np.array([1.0, 2.0]), np.array([1.0, 4.0]))
    assert two.mean == pytest.approx(2.0)
    assert math.isnan(two.error)
    assert near(two, 2.0, 0.1).verdict is Verdict.OPEN
    assert math.isnan(power_law(np.array([1.0]), np.array([1.0])).mean)


def test_weighted_exponent_and_its_error() -> None:
    generator = np.random.default_rng(6)
    x = np.geomspace(1.0, 10.0, 6)
    errors = 0.02 * x
    found = [
        weighted_power_law(x, [Estimate(m, e) for m, e in zip(generator.normal(x, errors), errors, strict=True)])
        for _ in range(400)
    ]
    means = np.array([e.mean for e in found])
    assert float(means.mean()) == pytest.approx(1.0, abs=3e-3)
    assert float(means.std(ddof=1)) == pytest.approx(found[0].error, rel=0.15)
