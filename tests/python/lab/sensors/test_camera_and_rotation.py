"""Camera: the paper's loop, and where it aliases. Analysis: rho^2 of a random walk, sigma_a, regression."""

import math

import numpy as np
import pytest

from jostle_lab.sensors.camera import Camera, aliasing, photograph, unwrap
from jostle_lab.statistics.rotation import RPM, nearest_neighbours_regression, rotation, squared_correlation


def unwrap_by_the_loop_of_the_thesis(degrees):
    """P 2.4.3, line by line, for one disk, the sign of both shifts put right."""
    theta = list(degrees)
    for i in range(1, len(theta)):
        difference = theta[i] - theta[i - 1]
        if difference > 90:
            for j in range(i):
                theta[j] += 180
        elif difference < -90:
            for j in range(i):
                theta[j] -= 180
    return np.array(theta)


def test_unwrap_is_the_loop_of_the_thesis_with_the_sign_corrected():
    seen = np.random.default_rng(3).uniform(0.0, math.pi, (300, 4))
    for disk in range(4):
        expected = unwrap_by_the_loop_of_the_thesis(np.degrees(seen[:, disk]))
        np.testing.assert_allclose(np.degrees(unwrap(seen)[:, disk]), expected, atol=1e-9)


@pytest.mark.parametrize("rpm", [-14.9, -7.0, -0.01, 0.0, 3.0, 14.9])
def test_slow_disks_are_measured_correctly(rpm):
    angles = (0.4 + rpm * RPM * np.arange(200.0))[:, None]
    path = unwrap(photograph(angles))
    np.testing.assert_allclose(path - path[0], angles - angles[0], atol=1e-9)
    assert aliasing(angles, 1.0).count() == 0


@pytest.mark.parametrize(("rpm", "seen"), [(15.1, -14.9), (16.0, -14.0), (29.0, -1.0), (31.0, 1.0), (-17.0, 13.0)])
def test_fast_disks_alias_by_thirty_rpm(rpm, seen):
    compared = aliasing((rpm * RPM * np.arange(101.0))[:, None], 1.0)
    assert compared.differs.tolist() == [True]
    assert compared.camera_velocity[0] / RPM == pytest.approx(seen, abs=1e-9)
    assert compared.true_velocity[0] / RPM == pytest.approx(rpm)


def test_alias_limit():
    assert Camera().alias_limit() / RPM == pytest.approx(15.0)
    assert Camera(2.0).alias_limit() / RPM == pytest.approx(30.0)


def test_photographs_know_half_a_turn_only():
    angles = np.array([-1e-20, 0.0, math.pi, -0.3, 7.0])
    seen = photograph(angles)
    assert np.all((seen >= 0.0) & (seen < math.pi))
    np.testing.assert_allclose(np.sin(seen - angles), 0.0, atol=1e-12)


def test_driftless_random_walk_has_a_squared_correlation_of_0_43():
    walks = np.cumsum(np.random.default_rng(5).normal(size=(900, 20_000)), axis=0)
    assert np.mean(squared_correlation(walks)) == pytest.approx(0.43, abs=0.01)


def test_squared_correlation_is_that_of_numpy():
    paths = np.random.default_rng(6).normal(size=(50, 3)) + np.arange(50.0)[:, None] * [0.0, 0.1, 1.0]
    expected = [np.corrcoef(np.arange(50.0), path)[0, 1] ** 2 for path in paths.T]
    np.testing.assert_allclose(squared_correlation(paths), expected, rtol=1e-12)


def test_rotation_of_known_paths():
    time = np.arange(61.0)
    steady, still = 2.0 * RPM * time, np.zeros(61)
    swinging = 0.5 * np.where(time % 2, 1.0, -1.0)  # velocity +-1 rad/s, no drift
    result = rotation(np.column_stack((steady, still, swinging)), 1.0)
    np.testing.assert_allclose(result.mean_velocity / RPM, [2.0, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(result.correlation, [1.0, 0.0, 0.0], atol=1e-3)
    np.testing.assert_allclose(result.adjusted_deviation, [0.0, 1.0, 1.0], atol=1e-9)
    assert result.mean_square() == pytest.approx(4.0 / 3.0)


def test_adjusted_deviation_is_p_3_1():
    angles = np.cumsum([0.0, 1.0, 2.0, 3.0, 6.0])[:, None]
    assert rotation(angles, 1.0).adjusted_deviation[0] == pytest.approx(
        np.std([1, 2, 3, 6]) / (3.0 + np.std([1, 2, 3, 6]))
    )


def test_regression_averages_the_nearest():
    x, y = np.array([0.0, 1.0, 2.0, 10.0]), np.array([1.0, 3.0, 5.0, 100.0])
    np.testing.assert_allclose(nearest_neighbours_regression(x, y, 2, np.array([0.4, 9.0])), [2.0, 52.5])
