"""Verdicts on the laboratory half of P chapter 3, on made-up packings that are as P prints, and that are not."""

import math
from functools import cache

import numpy as np
import pytest

from jostle_lab.sensors.camera import photograph, unwrap
from jostle_lab.verdicts import Verdict
from studies.registry import MODULES, maker
from studies.thesis.laboratory import apparatus, histograms, paths, regression, steadiness
from studies.thesis.laboratory.data import EYES, Data, compact, unwrapped_as_printed
from studies.thesis.laboratory.shaking import LISTED, LONGER, QUICK, SCHEDULE

PACKINGS, DISKS = 25, 60
THRESHOLD = 1.6


def broken(gamma, low, high, place=THRESHOLD):
    return np.where(gamma < place, (gamma / place) ** low, (gamma / place) ** high)


def made(exponents=(3.94, 1.0), truth=None, level=(0.95, 0.4), seed=1, place=THRESHOLD, skew=0.0) -> Data:
    """25 packings at the listed amplitudes as P describes them, or with other exponents, levels or places."""
    generator = np.random.default_rng(seed)
    rows = PACKINGS * len(LISTED)
    amplitude = np.tile(LISTED, PACKINGS)
    seeds = np.repeat(np.arange(1.0, PACKINGS + 1), len(LISTED))
    gamma = 5.0 * amplitude * (1.0 + 0.004 * generator.normal(size=rows))
    packing = np.repeat(0.15 * generator.normal(size=PACKINGS), len(LISTED))
    measured = gamma * (1.0 + 0.002 * generator.normal(size=rows))

    def noise(scale):
        return scale * generator.normal(size=rows)

    squares = {
        "camera": 10.0 * broken(gamma, *exponents, place) * np.exp(packing + noise(0.1)),
        "true": 10.0 * broken(gamma, *(truth or exponents), place) * np.exp(packing + noise(0.1)),
    }
    squares["pictures"] = squares["camera"]
    rise = np.minimum(np.log(gamma / 0.25) / np.log(place / 0.25), 1.0)
    wide = np.where((gamma > 1.2) & (gamma < 2.1), 3.0, 1.0)
    spins = generator.normal(size=(rows, DISKS)) + skew
    low = generator.random((rows, DISKS)) < np.clip(1.0 - gamma / 1.2, 0.0, 0.5)[:, None]
    rho = np.where(low, 0.05 * generator.random((rows, DISKS)), 1.0 - 0.05 * generator.random((rows, DISKS)))
    table = {
        "seed": seeds,
        "amplitude": amplitude,
        "gamma_true": gamma,
        "gamma_measured": measured,
        "gamma_sensor_1": measured,
        "gamma_sensor_2": measured,
        "gamma_peak": 1.2 * gamma,
        "mean_reading_1": -1.0 + noise(0.001),
        "mean_reading_2": -1.0 + noise(0.001),
        "moved": np.zeros(rows),
        "aliased": np.zeros(rows),
        "wrong_as_printed": np.full(rows, 20.0),
        "fast": np.ones(rows),
        "fast_wrong": np.ones(rows),
        "slow": np.full(rows, 50.0),
        "slow_wrong": np.zeros(rows),
        "angle_error": np.full(rows, 0.2) + noise(0.01),
        "swapped": np.zeros(rows),
        "lost": np.zeros(rows),
        "extra": np.zeros(rows),
        "recording": np.array([9.0]),
        "cost": np.array([0.1]),
        "disk_velocity": (spins * np.sqrt(squares["camera"])[:, None]).ravel(),
        "disk_correlation": rho.ravel(),
        "disk_deviation": (level[1] + 0.05 * generator.normal(size=(rows, DISKS))).ravel(),
        **{f"square_{eye}": squares[eye] for eye in EYES},
        **{f"correlation_{eye}": 0.5 + (level[0] - 0.5) * rise + wide * noise(0.01) for eye in EYES},
        **{f"deviation_{eye}": 0.8 - (0.8 - level[1]) * rise + wide * noise(0.01) for eye in EYES},
        **{f"fastest_{eye}": 12.0 + noise(0.3) for eye in EYES},
    }
    return Data(table, SCHEDULE)


PRINTED = made()
OTHER = made((5.0, 0.5), (5.0, 1.3), (0.85, 0.25), place=1.0, skew=0.3)


def steadier(level):
    """Packings all of whose disks have rho^2 near a level."""
    rho = level + 0.04 * np.random.default_rng(2).normal(size=PRINTED["disk_correlation"].shape)
    return Data(dict(PRINTED.table) | {"disk_correlation": rho}, SCHEDULE)


def on_squares(data):
    return regression.statements(data, {eye: data.regression("square", eye) for eye in EYES})


def on_steadiness(data):
    found = {(q, eye): data.regression(q, eye) for q in steadiness.PRINTED for eye in EYES}
    longer = steadier(0.95 if data is PRINTED else 0.8)
    longer = Data(dict(longer.table) | {"disk_deviation": data["disk_deviation"]}, SCHEDULE)
    return steadiness.statements(data, longer, found)


@cache
def statements(check, printed):
    """All statements of one kind, on packings as P prints them or on others."""
    return check(PRINTED if printed else OTHER)


def by_words(statements, words):
    return next(s for s in statements if words in s.printed)


@pytest.mark.parametrize(
    ("words", "printed", "other"),
    [
        ("Gamma < 1", Verdict.AGREES, Verdict.DISAGREES),
        ("1.6 < Gamma < 4.5", Verdict.AGREES, Verdict.DISAGREES),
        ("the exponent changes", Verdict.AGREES, Verdict.DISAGREES),
        ("one picture a second lower", Verdict.OPEN, Verdict.AGREES),
        ("K = 25 packings is equivalent", Verdict.AGREES, Verdict.AGREES),
    ],
)
def test_verdicts_on_the_regression(words, printed, other):
    found = [by_words(statements(on_squares, as_printed), words).verdict for as_printed in (True, False)]
    assert found == [printed, other]


def test_the_regression_is_of_what_was_measured():
    """On the true Gamma and omega the exponent would be another one."""
    found = [s for s in on_squares(made(truth=(3.94, 1.6))) if s.printed.startswith("1.6 <")]
    assert [s.verdict for s in found] == [Verdict.AGREES, Verdict.DISAGREES]
    exponents = [float(s.found.split(" +- ")[0].split()[-1]) for s in found]
    assert exponents == pytest.approx([1.0, 1.6], abs=0.06)


def test_the_regression_is_against_the_gamma_that_was_measured():
    """Accelerometers that read a fifth too much move the break, and sensors with an exponent of their own the slope."""
    off = dict(PRINTED.table) | {"gamma_measured": 1.2 * PRINTED["gamma_true"]}
    breaks = [s.verdict for s in on_squares(Data(off, SCHEDULE)) if s.printed == "the exponent changes at Gamma = 1.6"]
    assert breaks == [Verdict.DISAGREES, Verdict.AGREES], "as measured, in truth"
    bent = dict(PRINTED.table) | {"gamma_measured": THRESHOLD * (PRINTED["gamma_true"] / THRESHOLD) ** 2}
    (measured, true) = (s for s in on_squares(Data(bent, SCHEDULE)) if s.printed.startswith("1.6 <"))
    assert (measured.verdict, true.verdict) == (Verdict.DISAGREES, Verdict.AGREES)


def test_slopes_called_ours_are_fitted_and_those_of_the_thesis_are_its_own():
    """Lines are drawn with the slopes that their labels say: on other data ours are others, and P's the same."""
    for data, expected in ((PRINTED, (3.94, 1.0)), (made((3.0, 0.5)), (3.0, 0.5))):
        figure = regression.draw({eye: data.regression("square", eye) for eye in EYES})
        slopes = {"ours": [], "P": []}
        for line in figure.axes[1].get_lines():
            name = str(line.get_label())
            if "slope" in name:
                x, y = np.log(line.get_xdata()), np.log(line.get_ydata())
                slopes[name.partition(",")[0]].append((y[-1] - y[0]) / (x[-1] - x[0]))
        assert slopes["P"] == pytest.approx([3.94, 1.0], abs=1e-9)
        assert slopes["ours"] == pytest.approx(expected, abs=0.15)


def test_packings_and_disks_give_the_same_regression_unless_gamma_is_shared():
    assert regression.equivalence(PRINTED).verdict is Verdict.AGREES
    table = dict(PRINTED.table) | {"gamma_measured": np.round(PRINTED["gamma_measured"], 1)}
    assert regression.equivalence(Data(table, SCHEDULE)).verdict is Verdict.AGREES  # whole packings are cut alike
    lonely = dict(PRINTED.table) | {"seed": np.where(PRINTED["seed"] > 24, 1.0, PRINTED["seed"])}
    assert Data(lonely, SCHEDULE).packings() == 24


@pytest.mark.parametrize(
    ("words", "printed", "other"),
    [
        ("<rho^2> stabilises", Verdict.AGREES, Verdict.DISAGREES),
        ("<sigma_a> stabilises", Verdict.AGREES, Verdict.DISAGREES),
        ("<rho^2> saturates", Verdict.AGREES, Verdict.DISAGREES),
        ("nearly constant", Verdict.AGREES, Verdict.AGREES),
        ("near the threshold both fluctuate", Verdict.AGREES, Verdict.AGREES),
        ("random walk", Verdict.DISAGREES, Verdict.DISAGREES),
    ],
)
def test_verdicts_on_the_steadiness(words, printed, other):
    found = [by_words(statements(on_steadiness, as_printed), words).verdict for as_printed in (True, False)]
    assert found == [printed, other]


def test_histograms_with_two_groups_and_with_one():
    weak, strong = (histograms.nearest(PRINTED, gamma) for gamma in (0.3, 4.0))
    assert weak.shape == (PACKINGS, DISKS)
    assert histograms.bimodal(weak, PRINTED).verdict is Verdict.AGREES
    assert histograms.bimodal(strong, PRINTED).verdict is not Verdict.AGREES
    assert histograms.nearly_all(strong, PRINTED, PRINTED).verdict is Verdict.AGREES
    assert histograms.nearly_all(strong, OTHER, steadier(0.5)).verdict is Verdict.DISAGREES


def test_a_density_integrates_to_one():
    rho = histograms.nearest(PRINTED, 1.0)
    total = sum(histograms.density(rho, a, b).mean * (b - a) for a, b in ((0.0, 0.3), (0.3, 0.9), (0.9, 1.0)))
    assert total == pytest.approx(1.0)


def test_symmetry_is_tested_on_packings_not_on_pairs():
    assert paths.symmetry(PRINTED).verdict is Verdict.AGREES
    assert paths.symmetry(OTHER).verdict is Verdict.DISAGREES


def test_saturation_of_the_fastest_disk():
    assert paths.saturation(PRINTED).verdict is Verdict.AGREES
    table = dict(PRINTED.table) | {"fastest_camera": 5.0 * PRINTED["gamma_true"]}
    assert paths.saturation(Data(table, SCHEDULE)).verdict is Verdict.PARTLY


def test_rare_and_frequent_reorganisations():
    moved = np.zeros(len(PRINTED["seed"]))
    moved[31] = 3.0  # the weakest drive of the first packing
    rare, few = paths.reorganisations(Data(dict(PRINTED.table) | {"moved": moved}, SCHEDULE), PRINTED)
    assert rare.verdict is Verdict.AGREES
    moved = np.full(len(PRINTED["seed"]), 12.0)
    often, many = paths.reorganisations(Data(dict(PRINTED.table) | {"moved": moved}, SCHEDULE), PRINTED)
    assert often.verdict is Verdict.PARTLY  # the longer records have none
    assert many.verdict is Verdict.DISAGREES
    assert "at most 3" in few.found


def test_the_schedule_has_32_amplitudes_where_37_are_printed():
    schedule = by_words(apparatus.drive_statements(PRINTED), "37 amplitudes")
    assert schedule.verdict is Verdict.DISAGREES
    assert "32" in schedule.found


def test_a_sensor_off_by_more_than_a_hundredth_g_is_seen():
    good = by_words(apparatus.drive_statements(PRINTED), "mean reading")
    table = dict(PRINTED.table) | {"mean_reading_2": PRINTED["mean_reading_2"] + 0.02}
    bad = by_words(apparatus.drive_statements(Data(table, SCHEDULE)), "mean reading")
    assert (good.verdict, bad.verdict) == (Verdict.AGREES, Verdict.DISAGREES)


def test_the_printed_rule_makes_each_crossing_a_whole_turn():
    angles = np.linspace(0.0, 4.0 * math.pi, 41)[:, None]
    right, printed = unwrap(photograph(angles)), unwrapped_as_printed(angles)
    assert right[-1] - right[0] == pytest.approx(4.0 * math.pi)
    loops = np.diff(printed, axis=0)
    assert np.count_nonzero(np.abs(loops) > math.pi) == 4  # each crossing of 180 degrees
    assert printed[-1, 0] - printed[0, 0] == pytest.approx(-4.0 * math.pi)  # and turns the wrong way
    assert by_words(apparatus.unwrapping(PRINTED), "-180 degrees").verdict is Verdict.DISAGREES


def test_the_printed_rule_is_the_pseudocode_of_the_thesis():
    angles = np.cumsum(np.random.default_rng(2).normal(scale=0.5, size=(60, 1)), axis=0)
    theta = np.degrees(photograph(angles))[:, 0]
    for i in range(1, len(theta)):
        difference = theta[i] - theta[i - 1]
        if difference > 90.0:
            theta[:i] -= 180.0
        elif difference < -90.0:
            theta[:i] += 180.0
    np.testing.assert_allclose(np.degrees(unwrapped_as_printed(angles))[:, 0], theta, atol=1e-9)


def test_what_is_kept_is_near_to_what_was_counted():
    kept = compact(PRINTED.table)
    for name, values in PRINTED.table.items():
        if name in {"disk_correlation", "disk_deviation"}:
            np.testing.assert_allclose(kept[name], values, atol=0.005 + 1e-12)
        else:
            np.testing.assert_allclose(kept[name], values, rtol=0.04 if name == "disk_velocity" else 3e-4)
    again = compact(kept)
    assert all(np.array_equal(again[name], kept[name]) for name in kept)


def test_the_figures_are_registered_in_order():
    numbers = list(MODULES)
    assert numbers[numbers.index("camera") : numbers.index("3.4") + 1] == ["camera", "3.1", "3.2", "3.3", "3.4"]
    for number in ("camera", "3.1", "3.2", "3.3", "3.4"):
        assert callable(maker(number))


def test_efforts_are_kept_under_names_of_their_own():
    assert len({effort.key() for effort in (SCHEDULE, LONGER, QUICK)}) == 3
    assert len(SCHEDULE.amplitudes) == 32
