"""Chapter 3 of the thesis: paths, power laws, breaks and extrema on made-up data that should agree and should not."""

import math

import numpy as np
import pytest

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.limits import of_program
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.statistics.rotation import RPM, rotation
from jostle_lab.verdicts import Verdict, near
from studies.thesis.packing import comparison_statements, mean_square, path_statements, stiffness
from studies.thesis.packing.compared import QUICK_GAMMAS, Comparison
from studies.thesis.packing.comparison_statements import distance, statements
from studies.thesis.packing.ensemble import Ensemble, Point, hard, soft
from studies.thesis.packing.path_statements import event_driven_statements
from studies.thesis.packing.paths import Shaking
from studies.thesis.packing.paths_found import Paths, share_of
from studies.thesis.packing.runs import MOLECULAR, MOVING, RANDOM_PHASE, shaken
from studies.thesis.packing.scaling import break_point, critical_exponent, exponent, extremum
from studies.thesis.packing.steadiness import histogram_statements

PACKINGS = 25
GAMMAS = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 10.0, 14.0, 20.0, 29.0)


def packings(mean: float, generator: np.random.Generator, scatter: float = 0.2) -> Numbers:
    """Values of packings about a mean."""
    return mean * generator.lognormal(0.0, scatter, PACKINGS)


def paths(angles: Numbers, frame: float = 20.0, sigma: float = 0.1, steady: float = 1.0) -> Paths:
    """Paths of disks, shape (frames, disks)."""
    time = frame * np.arange(len(angles))
    velocity = (angles[-1] - angles[0]) / time[-1] / RPM
    return Paths(time, angles - angles[0], 0.99, sigma, steady, float(np.mean(velocity**2)))


def even(rpm: Numbers, frames: int = 31, frame: float = 20.0) -> Numbers:
    """Angles of disks that turn evenly."""
    return np.outer(np.arange(frames) * frame, rpm * RPM)


def test_parameters_choose_the_method_and_the_start_of_the_measurement() -> None:
    settings = dict(shaken(RANDOM_PHASE, 1e5, 2.0, 7, 10))
    assert settings["base.model"] == 1
    assert settings["seed"] == 7
    assert settings["measure.start"] == 10
    assert settings["drive.amplitude"] == pytest.approx(7.757e-5, rel=1e-3)
    assert "base.model" not in dict(shaken(MOLECULAR, 1e5, 2.0, 7, 10))


def test_hard_disks_are_measured_as_long_as_the_soft_ones_beside_them() -> None:
    for gamma in (2.0, 20.0):
        for k in (1e4, 1e6):
            assert hard(MOVING, k, gamma).observed == soft(k, gamma).observed


def test_random_walks_are_no_rearrangements() -> None:
    # The old count took 2 RPM of random walk between the halves for a rearrangement; any(changed) then agreed.
    walk = np.cumsum(np.random.default_rng(3).normal(0.0, 20.0, (31, 60)), axis=0)
    half = (walk[15] - walk[0]) / 300.0 / RPM, (walk[30] - walk[15]) / 300.0 / RPM
    assert np.count_nonzero(np.abs(half[0] - half[1]) > 1.0) > 3
    assert paths(walk).changed().mean == 0.0


def test_a_velocity_that_changes_for_good_is_a_rearrangement() -> None:
    turned = even(np.linspace(-5.0, 5.0, 60)) + np.random.default_rng(4).normal(0.0, 0.3, (31, 60))
    turned[15:, :4] += np.outer(np.arange(16) * 20.0, np.full(4, 3.0 * RPM))
    assert paths(turned).changed().mean == 4.0


def test_rearrangements_are_of_some_disks_and_of_fewer_than_ten() -> None:
    noise = np.random.default_rng(14).normal(0.0, 0.3, (31, 60))
    walk = np.cumsum(np.random.default_rng(3).normal(0.0, 20.0, (31, 60)), axis=0)

    def of_disks(count: int) -> Paths:
        turned = even(np.linspace(-5.0, 5.0, 60)) + noise
        turned[15:, :count] += np.outer(np.arange(16) * 20.0, np.full(count, 3.0 * RPM))
        return paths(turned)

    def judged(changing: Paths) -> Verdict:
        return path_statements._rearrangements("3.3", {2.0: paths(even(np.full(60, 3.0))), 8.0: changing}).verdict

    assert judged(of_disks(4)) is Verdict.AGREES
    assert judged(of_disks(12)) is Verdict.PARTLY, "not fewer than ten"
    assert judged(paths(walk)) is Verdict.PARTLY, "none at all"


def test_steadiness_is_that_of_angles_once_a_second_whatever_the_picture_shows(laboratory: Laboratory) -> None:
    """P defines sigma_a on 1 s. On the 2 s or 5 s from point to point of a picture it would be another number."""
    fine, coarse = Shaking(RANDOM_PHASE, 20.0, 5, 1, 40), Shaking(RANDOM_PHASE, 20.0, 5, 5, 8)
    tables = laboratory.run([fine.run(), coarse.run()], "frames")
    found, sparse = fine.paths(tables[fine.run()]), coarse.paths(tables[coarse.run()])
    once_a_second = float(np.mean(rotation(found.angles, 1.0).adjusted_deviation))
    every_fifth = float(np.mean(rotation(found.angles[::5], 5.0).adjusted_deviation))
    assert found.adjusted_deviation == pytest.approx(once_a_second, rel=1e-6)
    assert sparse.adjusted_deviation == pytest.approx(once_a_second, rel=1e-6)
    assert abs(every_fifth - once_a_second) > 0.05
    # No figure sets another interval than the program's own.
    assert "measure.interval" not in dict(fine.run().settings)
    assert of_program(laboratory.program)(fine.run(), None)["measure.interval"][0] < 1.0


def test_the_same_way_for_good_is_told_from_chance() -> None:
    assert paths(even(np.full(60, 3.0))).faithful().mean == 1.0
    walk = np.cumsum(np.random.default_rng(5).normal(0.0, 20.0, (401, 4000)), axis=0)
    assert paths(walk).faithful().mean == pytest.approx(1.0 / 8.0, abs=0.02)


def test_paths_that_are_random_walks_do_not_look_linear() -> None:
    gammas = (2.0, 3.0, 4.0, 6.0, 8.0, 12.0)
    steady = {g: paths(even(g * np.linspace(-1.0, 1.0, 60) + 0.5)) for g in gammas}
    verdicts = {s.printed[:20]: s.verdict for s in event_driven_statements(steady)}
    assert verdicts["for all Gamma all pa"] is Verdict.AGREES
    assert verdicts["disks turn the same "] is Verdict.AGREES
    walk = np.cumsum(np.random.default_rng(6).normal(0.0, 20.0, (31, 60)), axis=0)
    walking = {g: paths(walk, sigma=0.95, steady=0.1) for g in gammas}
    found = {s.printed[:20]: s.verdict for s in event_driven_statements(walking)}
    assert found["for all Gamma all pa"] is Verdict.DISAGREES
    assert found["velocity fluctuation"] is Verdict.DISAGREES
    assert found["disks turn the same "] is Verdict.DISAGREES


def test_an_exponent_comes_back_with_its_interval() -> None:
    generator = np.random.default_rng(7)
    gammas = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8)
    common = generator.lognormal(0.0, 0.4, PACKINGS)  # the same packings at every Gamma
    samples = [g**3.85 * common * generator.lognormal(0.0, 0.05, PACKINGS) for g in gammas]
    fit = exponent(gammas, samples)
    assert fit.value == pytest.approx(3.85, abs=0.1)
    assert fit.error < 0.05
    assert fit.low < 3.85 < fit.high
    assert near(fit.estimate, 3.85, 0.2).verdict is Verdict.AGREES
    assert near(fit.estimate, 2.0, 0.2).verdict is Verdict.DISAGREES


def test_a_line_through_two_points_has_no_error() -> None:
    with pytest.raises(ValueError, match="two points"):
        exponent((1.0, 2.0), [np.ones(3), 2.0 * np.ones(3)])
    with pytest.raises(ValueError, match="two points"):
        critical_exponent((2.0, 3.0), [2.0 * np.ones(3), 3.0 * np.ones(3)], np.ones(3), 1.0)


def test_a_law_beyond_a_critical_gamma_comes_back() -> None:
    generator = np.random.default_rng(8)
    gammas = (1.5, 2.0, 3.0, 5.0, 8.0, 10.0)
    samples = [packings(4.0 + 7.0 * (g - 1.0) ** 0.99, generator, 0.05) for g in gammas]
    fit = critical_exponent(gammas, samples, packings(4.0, generator, 0.05), 1.0)
    assert abs(fit.value - 0.99) < 3.0 * fit.error
    assert fit.error < 0.1


def test_the_break_between_two_laws_comes_back() -> None:
    generator = np.random.default_rng(9)
    samples = [packings(g**4 if g < 1.0 else g, generator, 0.1) for g in GAMMAS]
    place, before, after = break_point(GAMMAS, samples)
    assert place.value == pytest.approx(1.0, abs=0.1)
    assert before.value == pytest.approx(4.0, abs=0.2)
    assert after.value == pytest.approx(1.0, abs=0.1)


def test_the_last_point_of_a_rising_curve_is_no_maximum() -> None:
    generator = np.random.default_rng(10)
    rising = extremum(GAMMAS, [packings(g, generator) for g in GAMMAS], largest=True)
    assert math.isnan(rising.value)
    assert near(rising.estimate, 10.0, 5.0).verdict is Verdict.OPEN
    arch = extremum(GAMMAS, [packings(math.exp(-(math.log(g / 9.0) ** 2)), generator) for g in GAMMAS], largest=True)
    assert arch.value == pytest.approx(9.0, rel=0.3)
    assert arch.low < 9.0 < arch.high


def ensemble(point: Point, values: Numbers) -> Ensemble:
    """An ensemble of which only the mean squares matter."""
    return Ensemble(point, values, values, np.full(PACKINGS, 0.9), np.full(PACKINGS, 0.3))


def test_the_laws_of_figure_3_6_are_found_where_they_are_and_not_where_they_are_not() -> None:
    def curve(low: float) -> mean_square.Points:
        generator = np.random.default_rng(11)
        gammas = (0.1, 0.15, 0.2, *GAMMAS, 12.0, 25.0)

        def law(g: float) -> float:
            return 4.0 * g**low if g <= 1.0 else (4.0 + 7.0 * (g - 1.0)) * (1.0 if g <= 10.0 else (10.0 / g) ** 3)

        return {g: ensemble(soft(1e4, g), packings(law(g), generator, 0.05)) for g in sorted(gammas)}

    agreeing = {s.printed: s.verdict for s in mean_square.statements(curve(3.85))}
    assert agreeing["0 < Gamma < 0.8: <omega^2> goes with a power of Gamma, fitted exponent 3.85"] is Verdict.AGREES
    assert agreeing["beyond Gamma = 10 it decreases towards zero"] is Verdict.AGREES
    other = {s.printed: s.verdict for s in mean_square.statements(curve(2.0))}
    assert other["0 < Gamma < 0.8: <omega^2> goes with a power of Gamma, fitted exponent 3.85"] is Verdict.DISAGREES


def compared(
    factor: float, scatter: float, gammas: tuple[float, ...] = (2.0, 3.0, 5.0, 10.0, 20.0), spread: float = 0.2
) -> Comparison:
    """Event-driven dynamics that differ by a factor from molecular dynamics; `spread` of the packings."""
    generator = np.random.default_rng(12)
    found, cost = {}, {}
    for k in (1e4, 1e5, 1e6):
        for gamma in gammas:
            common = packings(math.exp(-(math.log(gamma / 9.0) ** 2)), generator, spread)
            for method in (MOLECULAR, RANDOM_PHASE, MOVING):
                own = factor if method is not MOLECULAR else 1.0
                values = own * common * generator.lognormal(0.0, scatter, PACKINGS)
                found[method, k, gamma] = ensemble(Point(method, k, gamma, 1, 1, PACKINGS), values)
                cost[method, k, gamma] = 1.0 if method is MOLECULAR else 0.1 / gamma
    disks = {key: generator.normal(0.0, 1.0, (PACKINGS, 60)) for key in found if key[2] == 2.0}
    return Comparison(found, disks, {}, cost)


def test_methods_coincide_only_beyond_the_errors() -> None:
    def coincidence(factor: float, scatter: float) -> Verdict:
        return statements(compared(factor, scatter))[0].verdict

    assert coincidence(1.05, 0.05) is Verdict.AGREES
    assert coincidence(2.0, 0.05) is Verdict.DISAGREES
    assert coincidence(1.05, 2.0) is Verdict.OPEN


def test_a_curve_that_still_rises_at_its_last_gamma_has_no_maximum_there() -> None:
    """The made-up curve has its top at 9. Cut off at 8 its largest value is near 10 and no maximum."""

    def maxima(gammas: tuple[float, ...]) -> list[Verdict]:
        stated = comparison_statements._maxima(compared(1.0, 0.0, gammas, 0.02))
        return [s.verdict for s in stated]

    assert maxima((2.0, 3.0, 5.0, 7.0, 9.0, 12.0, 20.0)) == [Verdict.AGREES] * 3
    assert maxima((2.0, 3.0, 5.0, 8.0)) == [Verdict.OPEN] * 3


def test_chance_is_no_distance_between_methods() -> None:
    near_by, far = distance(compared(1.0, 0.2), MOVING, 1e4), distance(compared(1.5, 0.2), MOVING, 1e4)
    assert near_by.mean < 2.5 * near_by.error
    assert far.mean == pytest.approx(math.log(1.5), abs=3.0 * far.error)


def test_the_anomaly_needs_one_gamma_at_which_the_middle_stiffness_leads() -> None:
    leads, follows, unknown = Estimate(1.5, 0.1), Estimate(0.5, 0.1), Estimate(1.0, 0.3)
    assert stiffness.anomaly([follows, leads], [follows, follows]).verdict is Verdict.AGREES
    assert stiffness.anomaly([follows, follows], [follows, follows]).verdict is not Verdict.AGREES
    assert stiffness.anomaly([follows, unknown], [follows, follows]).verdict is Verdict.OPEN


def test_groups_of_disks_are_seen_in_their_histograms() -> None:
    generator = np.random.default_rng(13)
    size = (PACKINGS, 60)
    two = np.where(generator.random(size) < 0.4, 0.05 * generator.random(size), 1.0 - 0.05 * generator.random(size))
    flat = generator.random(size)
    steady = 1.0 - 0.2 * generator.random(size)
    agreeing = histogram_statements({0.3: two, 4.0: steady, 29.0: two * 0.4})
    assert [s.verdict for s in agreeing] == [Verdict.AGREES, Verdict.AGREES, Verdict.AGREES]
    other = histogram_statements({0.3: steady, 4.0: flat, 29.0: steady})
    assert all(s.verdict is not Verdict.AGREES for s in other)


def test_shares_near_their_ends_have_errors() -> None:
    assert share_of(1.0, 60).error == pytest.approx(0.012, abs=0.001)
    assert share_of(0.5, 100).error == pytest.approx(0.05)


def test_the_few_gamma_of_a_quick_comparison_do() -> None:
    stated = statements(compared(1.05, 0.05, QUICK_GAMMAS))
    assert any("at Gamma = 10: " in s.found for s in stated)
