"""F Figs 2 and 3, experiments: how many balls a part of the ring holds, and verdicts on made-up curves."""

import numpy as np
import pytest

from jostle_lab.statements import Statement
from jostle_lab.verdicts import Verdict
from studies.ratchet import depth, experiment, ring
from studies.ratchet.cases import Case, Point
from studies.ratchet.study import Curve


def test_the_cell_holds_its_share_of_the_balls_on_the_ring() -> None:
    """200 balls on pi 10 cm are 7.6 a tooth of 12 mm; by F IV's count of four layers there were 148 on ten teeth."""
    assert experiment.DISKS == 76
    assert experiment.case(2.0).disks / experiment.TEETH == pytest.approx(
        200 * 12.0 / ring.CIRCUMFERENCE, abs=0.5 / experiment.TEETH
    )
    assert ring.balls_on(26, 12.0) == 199


def test_balls_of_3_3_mm_do_not_fit_in_the_gap_of_3_mm() -> None:
    count, gap = ring.layer_count()
    assert count.verdict is Verdict.DISAGREES and "50 balls" in count.cause
    assert gap.verdict is Verdict.DISAGREES
    assert ring.zigzag_spacing(5.0) == pytest.approx(2.828, abs=1e-3)


def made_up(threshold: float, exponent: float, noise: float) -> dict[Case, Point]:
    """Eight runs of each Gamma of Fig. 3."""
    generator = np.random.default_rng(3)
    points = {}
    for gamma in experiment.GAMMAS:
        mean = 2.5 * max(gamma / threshold - 1.0, 0.0) ** exponent
        points[experiment.case(gamma)] = Point(tuple(generator.normal(mean, noise if mean > 0.0 else 0.0, 8)))
    return points


def verdicts(threshold: float, exponent: float, noise: float) -> list[Statement]:
    return experiment.statements(made_up(threshold, exponent, noise))[:2]


def test_an_onset_as_printed_agrees() -> None:
    first, second = verdicts(1.7, 0.48, 0.02)
    assert (first.verdict, second.verdict) == (Verdict.AGREES, Verdict.AGREES)
    assert not first.cause and not second.cause


def test_another_threshold_and_another_exponent_disagree() -> None:
    first, second = verdicts(1.85, 0.9, 0.02)
    assert (first.verdict, second.verdict) == (Verdict.PARTLY, Verdict.DISAGREES), "no flow below 1.55 in either"
    assert second.cause


def test_the_slope_of_a_straight_line_is_that_of_the_power_law() -> None:
    curve = experiment.main_curve(made_up(1.7, 0.48, 0.0))
    found = experiment.slope(curve, 1.75, 4.0)
    assert found is not None and found.value == pytest.approx(0.48, abs=1e-9)
    assert experiment.slope(curve, 1.2, 1.6) is None


def test_a_straight_line_through_two_points_that_move_has_no_slope() -> None:
    curve = experiment.main_curve(made_up(1.7, 0.48, 0.0))
    assert len(curve.between(1.72, 1.81).moving().x) == 2
    assert experiment.slope(curve, 1.72, 1.81) is None


def curve(means: list[float], noise: float = 0.02) -> Curve:
    generator = np.random.default_rng(5)
    points = tuple(Point(tuple(generator.normal(mean, noise, 6))) for mean in means)
    return Curve(tuple(map(float, range(len(means)))), points)


def test_maxima_and_fading_flows_are_told_from_others() -> None:
    hill, slope, rise = curve([0.5, 1.0, 0.6, 0.2]), curve([1.0, 0.8, 0.5, 0.2]), curve([0.2, 0.4, 0.8, 1.0])
    assert depth.has_maximum(hill).verdict is Verdict.AGREES
    assert depth.has_maximum(slope).verdict is not Verdict.AGREES
    assert depth.has_maximum(rise).verdict is not Verdict.AGREES
    assert depth.fades(hill).verdict is Verdict.AGREES
    assert depth.fades(slope).verdict is Verdict.AGREES
    assert depth.fades(rise).verdict is not Verdict.AGREES
