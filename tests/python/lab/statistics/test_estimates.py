"""Where a curve changes sign, and how that is said."""

import numpy as np
import pytest

from jostle_lab.statistics.estimates import Estimate, places, relative_error, sign_changes, zero_crossings


def points(*means: float, error: float = 0.1) -> list[Estimate]:
    return [Estimate(mean, error) for mean in means]


def test_relative_error_is_of_the_rms() -> None:
    assert relative_error(np.array([3.0, 5.0]), np.array([3.0, 4.0])) == pytest.approx(0.2)


def test_one_change_is_where_the_line_crosses() -> None:
    (crossing,) = zero_crossings([20.0, 30.0], points(-1.0, 1.0))
    assert crossing.mean == pytest.approx(25.0)
    assert crossing.error == pytest.approx(5.0 * 0.1 / 2.0**0.5)
    (passed,) = zero_crossings([20.0, 30.0, 40.0], points(-1.0, 0.05, 1.0))
    assert passed.mean == pytest.approx(30.0)
    assert passed.error < 1.0


def test_a_place_where_the_curve_goes_to_and_fro_has_an_error_that_covers_it() -> None:
    """At 30, 34 and 38 the curve is as good as zero, with changing sign."""
    x = [26.0, 30.0, 34.0, 38.0, 42.0]
    (crossing,) = zero_crossings(x, points(1.0, -0.1, 0.1, -0.1, -1.0))
    assert crossing.mean - crossing.error < 30.0
    assert crossing.mean + crossing.error > 36.0


def test_crossings_are_said_in_words_that_read_well() -> None:
    crossing = Estimate(20.0, 0.25)
    assert sign_changes([crossing], "Hz") == f"sign changes at {crossing} Hz"
    assert sign_changes([crossing], "mm", "h") == f"sign changes at h = {crossing} mm"
    assert sign_changes([], "Hz") == "no sign change"
    assert places([], "degrees") == "none"
    assert places([crossing, crossing], "degrees") == f"{crossing}, {crossing} degrees"
    assert places([crossing], "") == str(crossing)
