"""A ball on teeth at rest: the law of collision against F's matrices, geometry against its definition, symmetry."""

import math

import numpy as np
import pytest

from studies.ratchet.falling_ball import Law, Tooth, fall

FLAT = np.array([[0.0, 1.0]])


def matrices(law: Law, v_n: float, v_t: float, v_c: float) -> np.ndarray:
    """F A31 and A32 on (v_n, v_t, v_c), chosen by A28; the wall is particle 2, below, so that v_n > 0 approaches."""
    e, mu, inertia = law.restitution, law.friction, law.inertia
    v_r = v_t + v_c
    if abs(v_r) >= (inertia + 1.0) / inertia * mu * (1.0 + e) * v_n:
        push = mu * (1.0 + e) * math.copysign(1.0, v_r)
        matrix = [[-e, 0.0, 0.0], [-push, 1.0, 0.0], [-push / inertia, 0.0, 1.0]]
    else:
        both = inertia + 1.0
        matrix = [[-e, 0, 0], [0, 1 / both, -inertia / both], [0, -1 / both, inertia / both]]
    return np.array(matrix) @ np.array([v_n, v_t, v_c])


def test_impacts_are_those_of_the_matrices_of_the_paper() -> None:
    """With n down and t to the right; v_c = R omega, the velocity of the rim at the lowest point."""
    generator = np.random.default_rng(2)
    for law in (Law(), Law(friction=0.6), Law(inertia=0.5, restitution=0.5), Law(friction=0.0)):
        for v_n, v_t, rim in generator.uniform([0.1, -1.0, -1.0], [1.0, 1.0, 1.0], (50, 3)):
            velocity, after = law.collide(np.array([[v_t, -v_n]]), np.array([rim]), FLAT)
            expected = matrices(law, v_n, v_t, rim)
            np.testing.assert_allclose([-velocity[0, 1], velocity[0, 0], after[0]], expected, atol=1e-12)


def test_no_impact_gains_energy_and_frozen_rotation_stays_frozen() -> None:
    generator = np.random.default_rng(3)
    velocity = np.stack([generator.uniform(-1, 1, 200), generator.uniform(-1, -0.1, 200)], axis=1)
    rim, normal = generator.uniform(-1, 1, 200), np.repeat(FLAT, 200, axis=0)
    law = Law(friction=0.3)
    after, spun = law.collide(velocity, rim, normal)
    before = np.sum(velocity**2, axis=1) + law.inertia * rim**2
    assert np.all(np.sum(after**2, axis=1) + law.inertia * spun**2 <= before + 1e-12)
    assert np.all(Law(inertia=math.inf).collide(velocity, rim, normal)[1] == rim)


def test_a_ball_on_flat_teeth_bounces_by_the_laws_of_a_plane() -> None:
    """Teeth of no height: to the left leaves what comes from the right, if there is no spin to turn it."""
    angles = np.radians(np.array([-20.0, -5.0, 5.0, 20.0]))
    falls = fall(Tooth(6.0, 1e-6, 0.3), Law(friction=0.05), 1.1, np.array([1.0, 2.0, 3.0, 4.0]), angles)
    assert falls.to_the_left.tolist() == [True, True, False, False]
    assert falls.impacts.tolist() == [1, 1, 1, 1]


@pytest.mark.parametrize("law", [Law(), Law(friction=0.5), Law(inertia=math.inf)])
def test_teeth_in_a_mirror_send_balls_the_other_way(law: Law) -> None:
    generator = np.random.default_rng(4)
    places, angles = generator.uniform(0.0, 6.0, 3000), np.radians(generator.uniform(-15.0, 15.0, 3000))
    one = fall(Tooth(6.0, 6.0, 0.25), law, 1.1, places, angles)
    other = fall(Tooth(6.0, 6.0, 0.75), law, 1.1, 6.0 - places, -angles)
    went = ~one.stayed
    assert np.mean(one.to_the_left[went] == ~other.to_the_left[went]) > 0.995
    assert abs(one.to_the_left.mean() - 0.5) > 0.02


def test_the_tip_of_a_tooth_touches_both_sides() -> None:
    tooth = Tooth(6.0, 6.0, 0.25)
    left, right = tooth.normals
    apex = np.array([1.5, 6.0])
    assert (apex - tooth.arc_centre) @ left == pytest.approx(tooth.tip_radius)
    assert (apex - tooth.arc_centre) @ right == pytest.approx(tooth.tip_radius)
    assert tooth.top < 6.0
