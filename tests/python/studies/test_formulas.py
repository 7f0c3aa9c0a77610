"""F A and B, P 2.1, 2.3 and 6.3.1: what printed formulas are held against obeys the laws that define it."""

import math

import numpy as np
import pytest

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product
from jostle_lab.verdicts import Verdict
from studies.ratchet.appendix import impacts, integrated, sliding, sticking
from studies.ratchet.collision_times import Pair, first_contact
from studies.registry import maker
from studies.thesis.methods.formulas import placed, solved
from studies.thesis.methods.impact_times import wall_time
from studies.thesis.wedge.map_equations import Flight


def test_the_impulse_in_small_steps_conserves_momentum_and_obeys_coulomb() -> None:
    for impact in impacts():
        n1, n2, t1, t2, c1, c2 = integrated(impact)
        (m1, m2), slip = impact.mass, t1 - t2 + c1 + c2
        assert m1 * n1 + m2 * n2 == pytest.approx(0.0, abs=1e-12)
        assert m1 * t1 + m2 * t2 == pytest.approx(0.0, abs=1e-12)
        assert n2 - n1 == pytest.approx(impact.restitution * impact.approach)
        pushed, limit = m1 * abs(t1 - impact.tangential[0]), impact.friction * m1 * abs(n1 - impact.normal[0])
        assert pushed <= limit * (1.0 + 1e-9)
        assert abs(slip) < 1e-9 or pushed == pytest.approx(limit)


def test_the_law_of_the_other_case_is_told_apart() -> None:
    chosen = [i for i in impacts() if i.slides][:10]
    assert all(np.allclose(sliding(i), integrated(i)) for i in chosen)
    assert not any(np.allclose(sticking(i), integrated(i)) for i in chosen)


def test_the_first_contact_is_the_first_fall_through_zero() -> None:
    assert first_contact(lambda t: np.cos(40.0 * t)) == pytest.approx(math.pi / 80.0)
    assert math.isinf(first_contact(lambda t: 1.0 + t))
    pair = Pair(np.array([[-0.01, 0.0], [0.01, 0.0]]), np.array([[0.1, 0.0], [-0.1, 0.0]]), np.zeros(2), reach=2e-3)
    assert first_contact(pair.distance) == pytest.approx(0.018 / 0.2)


def test_a_disk_is_placed_on_two_others_and_impacts_solve_their_laws() -> None:
    centre = placed(np.zeros(2), np.array([2.0, 0.0]), 2.0, 2.0)
    assert centre == pytest.approx([1.0, math.sqrt(3.0)])
    before = np.array([[1.0, 0.0], [0.0, 0.0], [0.0, 0.0]])
    after = solved(np.ones(2), np.full(2, 0.5), np.ones(2), before, (1.0, 1.0))
    assert after == pytest.approx(np.array([[0.0, 1.0], [0.0, 0.0], [0.0, 0.0]]))


def test_a_ceiling_that_is_not_reached_has_no_real_time() -> None:
    assert math.isnan(wall_time(0.05, -0.5, -1.0))
    assert wall_time(0.02, -0.5, 0.0) == pytest.approx(0.04)


def test_a_followed_flight_ends_on_its_wall() -> None:
    flight = Flight(-0.5, 0.6, -2e-3, 0.1, 0.05)
    time, normal, _, height = flight.followed()
    u, _ = flight.velocity()
    assert height == pytest.approx(math.tan(0.6) * (flight.x + u * time))
    assert normal < 0.0


@pytest.mark.parametrize("number", ["2.3", "6.3.1", "FA"])
def test_every_formula_has_a_rule_and_every_slip_a_cause(number: str, laboratory: Laboratory) -> None:
    product: Product = maker(number)(laboratory, True, None)
    assert product.picture.axes
    assert {s.verdict for s in product.statements} >= {Verdict.AGREES, Verdict.DISAGREES}
    for s in product.statements:
        assert s.rule
        assert s.cause or s.verdict is Verdict.AGREES, s
