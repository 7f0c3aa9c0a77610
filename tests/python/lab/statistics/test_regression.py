"""Nearest-neighbours regression with its error, power laws and breaks, on made-up packings."""

import math

import numpy as np
import pytest

from jostle_lab.statistics.regression import HIGH, LOW, BrokenLine, Regression, slope
from jostle_lab.statistics.rotation import nearest_neighbours_regression, nearest_neighbours_resampled


def packings(exponents=(3.94, 1.0), break_=1.6, scatter=0.2, count=25, seed=1):
    """<omega^2> of `count` packings at 32 Gamma: two power laws, and a factor for each packing and amplitude."""
    generator = np.random.default_rng(seed)
    gamma = np.tile(np.geomspace(0.25, 5.0, 32), count) * np.exp(0.003 * generator.normal(size=32 * count))
    low, high = exponents
    law = np.where(gamma < break_, (gamma / break_) ** low, (gamma / break_) ** high)
    factor = np.exp(scatter * generator.normal(size=gamma.size) + 0.2 * np.repeat(generator.normal(size=count), 32))
    return Regression(gamma, 8.0 * law * factor, np.repeat(np.arange(count, dtype=np.float64), 32))


def test_exponents_come_back_within_their_errors():
    found = [packings(seed=seed).slope(range_).mean for seed in range(12) for range_ in (LOW, HIGH)]
    errors = [packings().slope(range_).error for range_ in (LOW, HIGH)]
    for low_or_high, printed in ((0, 3.94), (1, 1.0)):
        values = found[low_or_high::2]
        assert np.mean(values) == pytest.approx(printed, abs=0.05)
        assert np.std(values) == pytest.approx(errors[low_or_high], rel=0.7)


def test_a_break_is_found_where_it_is_and_its_interval_holds_it():
    place = packings().power_break((0.0, 4.5))
    assert abs(place.mean - 1.6) < 2.5 * place.error + 0.02
    assert place.error < 0.15
    assert packings(break_=1.0).power_break((0.0, 4.5)).mean == pytest.approx(1.0, abs=0.1)


def test_a_level_and_a_rise_break_where_they_meet():
    x = np.geomspace(0.25, 4.5, 40)
    y = np.minimum(np.log(x), math.log(1.6))
    assert BrokenLine(x, (0.0, 9.0)).place(y) == pytest.approx(1.6, rel=0.02)
    assert math.isnan(BrokenLine(x[:5], (0.0, 9.0)).place(y[:5]))


def test_a_single_packing_has_no_error_and_few_points_no_slope():
    one = packings(count=1)
    assert math.isnan(one.slope(LOW).error)
    assert np.all(np.isnan(one.error))
    assert math.isnan(slope(np.array([0.5]), np.array([1.0]), LOW))


def test_packings_are_drawn_whole():
    """With packings that differ only by a factor the error is that of the factor, however many amplitudes there are."""
    generator = np.random.default_rng(3)
    factor = 1.0 + 0.1 * generator.normal(size=16)
    gamma = np.tile(np.geomspace(0.25, 5.0, 20), 16) * np.exp(1e-6 * generator.normal(size=320))
    found = Regression(gamma, np.repeat(factor, 20), np.repeat(np.arange(16.0), 20))
    np.testing.assert_allclose(found.error, factor.std(ddof=1) / 4.0, rtol=0.15)


def test_resampled_curves_scatter_about_the_curve():
    data = packings()
    at = np.array([0.5, 2.0])
    curves = nearest_neighbours_resampled(data.gamma, data.values, data.packing, 25, at, resamples=300)
    assert curves.shape == (300, 2)
    direct = nearest_neighbours_regression(data.gamma, data.values, 25, at)
    assert np.all(np.abs(curves.mean(axis=0) - direct) < curves.std(axis=0))
    again = nearest_neighbours_resampled(data.gamma, data.values, data.packing, 25, at, resamples=300)
    np.testing.assert_array_equal(curves, again)
