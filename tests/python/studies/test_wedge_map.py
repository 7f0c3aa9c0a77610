"""The map of P 6.3 written anew: phases of the base, the law of impacts, the mirror; a disk on two disks."""

import math

import numpy as np
import pytest

from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Verdict
from studies.thesis.methods.base_sampling import moments
from studies.thesis.wedge.curves import Curve, Wedge
from studies.thesis.wedge.friction_trials import NO_SIDEWAYS, RIGID, SAME, agreement
from studies.thesis.wedge.map_anew import RESTITUTION, Variant, phases, scaled_velocity, tangential_law
from studies.thesis.wedge.three_disks import DISKS, Place


@pytest.mark.parametrize("approach", [0.1, 0.7, 1.5])
def test_phases_have_the_moments_of_rays_that_are_followed(approach: float) -> None:
    drawn = np.cos(phases(np.full(20_000, approach), np.random.default_rng(1)))
    mean, square = moments(approach)
    assert float(drawn.mean()) == pytest.approx(mean, abs=0.02)
    assert float(np.mean(drawn**2)) == pytest.approx(square, abs=0.02)


def test_fast_impacts_slide_to_the_end_and_no_impact_gains_energy() -> None:
    for friction in (0.05, 0.15, 0.3):
        before, after = tangential_law(friction, 0.773)
        sliding = before[-1] - 3.0 * friction * (1.0 + RESTITUTION)
        assert after[-1] == pytest.approx(sliding, abs=5e-3)
        assert np.all(np.abs(after) <= before + 1e-9)
    assert tangential_law(0.0, 0.773)[1] == pytest.approx(tangential_law(0.0, 0.773)[0])


def test_a_wedge_in_the_mirror_turns_the_disk_the_other_way() -> None:
    one, other = (scaled_velocity(Variant(0.1, tilt), 100, 300, 5) for tilt in (20.0, -20.0))
    assert one.mean < -10.0 * one.error
    assert abs(one.mean + other.mean) < 4.0 * math.hypot(one.error, other.error)


def test_agreement_is_seen_only_where_there_is_one() -> None:
    found = {
        mu: Curve(Wedge(friction=mu), (8.0, 12.0, 20.0), (Estimate(-0.3, 1e-3),) * 3, 1.0) for mu in (0.1, 0.15, 0.3)
    }
    others = dict.fromkeys((*NO_SIDEWAYS, *RIGID), Estimate(0.0, 1e-3))
    assert agreement(found, dict.fromkeys(SAME, Estimate(-0.301, 1e-3)) | others).verdict is Verdict.AGREES
    assert agreement(found, dict.fromkeys(SAME, Estimate(-0.28, 1e-3)) | others).verdict is Verdict.DISAGREES


def test_a_disk_that_is_tilted_more_has_less_to_climb() -> None:
    """By hand: theta_0 - theta_T = 22 and 10 degrees at Gamma = 2 and 80 Hz, where l_0 / R is 0.0078."""
    low, high = Place(DISKS, 8.0, 80.0), Place(DISKS, 20.0, 80.0)
    assert low.size == pytest.approx(7.77e-3, rel=1e-2)
    assert low.barrier == pytest.approx(0.14563 / low.size, rel=1e-3)
    assert high.barrier == pytest.approx(0.03038 / high.size, rel=1e-3)
