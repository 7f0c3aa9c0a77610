"""P 1 and 2: first contacts, restitution, moments of the random phase, profiles of the base, on made-up data."""

import math

import numpy as np
import pytest

from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Verdict
from studies.thesis.methods.base_sampling import constant, first_met, moments
from studies.thesis.methods.parameters import restitution, touching


@pytest.mark.parametrize("x", [0.1, 0.3, 0.7, 1.5])
def test_moments_are_those_of_rays_that_are_followed(x: float) -> None:
    rays = np.linspace(0.0, math.tau, 400, endpoint=False)
    met = []
    for crest in rays:  # the ray passes the height 1 at this phase
        phase = np.arange(crest, crest + 2.0 / x + 0.01, 1e-3)
        met.append(math.cos(phase[np.argmax(np.sin(phase) >= 1.0 - x * (phase - crest))]))
    mean, square = moments(x)
    assert np.mean(met) == pytest.approx(mean, abs=0.01)
    assert np.mean(np.square(met)) == pytest.approx(square, abs=0.01)


def test_a_slow_ray_meets_the_base_near_its_top() -> None:
    first, last = first_met(1e-4)
    assert 1.5 < first < last < 1.6


def test_restitution_is_that_of_the_printed_branches() -> None:
    k, m = 4.5e6, 4.5e-3
    assert restitution(k, 9.84, m) == pytest.approx(0.89916, abs=2e-5)
    critical = 2.0 * math.sqrt(k * m)
    assert restitution(k, critical, m) == pytest.approx(math.exp(-2.0))
    assert restitution(k, 0.999 * critical, m) > restitution(k, 1.001 * critical, m)


def test_contacts_and_overlaps_are_counted() -> None:
    centres = np.array([[-0.19, 0.01], [-0.17, 0.01], [0.0, 0.2]])
    contacts, overlap = touching(centres, np.full(3, 0.01))
    assert contacts.tolist() == [3, 2, 0]
    assert overlap < 1e-12
    assert touching(centres, np.array([0.01, 0.011, 0.01]))[1] == pytest.approx(0.001)


def test_a_constant_factor_is_told_from_one_that_varies_and_from_not_knowing() -> None:
    even = [Estimate(1.5 + d, 0.02) for d in (-0.02, 0.0, 0.02)]
    assert constant(even, 0.2)[2].verdict is Verdict.AGREES
    assert constant([*even, Estimate(2.5, 0.02)], 0.2)[2].verdict is Verdict.DISAGREES
    assert constant([Estimate(1.5, 0.5) for _ in range(3)], 0.2)[2].verdict is Verdict.OPEN
