"""The ratchet's paper: the fit of an onset, curves, kept data, the generated page, one figure, the fields."""

import math
from pathlib import Path

import numpy as np
import pytest

from jostle_lab.errors import LabError
from jostle_lab.runs.laboratory import Laboratory
from studies.examples import GENERATED
from studies.figures import make_figure
from studies.ratchet import fields, frequency, page, quoted, shape
from studies.ratchet.cases import Case, Point, frequency_of, gamma_of
from studies.ratchet.observe import chosen, read_points, write_points
from studies.ratchet.onset import fit_onset
from studies.ratchet.study import Curve, curves
from studies.registry import STUDIES, maker

GAMMAS = (1.0, 1.1, 1.2, 1.25, 1.3, 1.35, 1.4, 1.5, 1.6, 1.8, 2.0, 2.4, 2.8, 3.2, 4.0)


def made_up(threshold: float, exponent: float, noise: float, seed: int) -> list[list[float]]:
    """Ten runs of each Gamma, with noise where there is flow."""
    generator = np.random.default_rng(seed)
    means = 3.0 * np.maximum(np.array(GAMMAS) / threshold - 1.0, 0.0) ** exponent
    return [list(generator.normal(mean, noise if mean > 0.0 else 0.0, 10)) for mean in means]


@pytest.mark.parametrize(("threshold", "exponent"), [(1.31, 0.27), (1.17, 0.5), (1.52, 1.0)])
def test_onset_without_noise_is_found_to_rounding(threshold: float, exponent: float) -> None:
    onset = fit_onset(GAMMAS, made_up(threshold, exponent, 0.0, 0))
    assert onset.threshold.value == pytest.approx(threshold, abs=1e-6)
    assert onset.exponent.value == pytest.approx(exponent, abs=1e-6)
    assert onset.scale == pytest.approx(3.0, abs=1e-5)
    assert onset.residual < 1e-6


def test_onset_intervals_cover_the_truth_as_often_as_they_say() -> None:
    """Ten made-up data sets; intervals of 68 % miss three on the average, and more than seven hardly ever."""
    fits = [fit_onset(GAMMAS, made_up(1.31, 0.27, 0.4, seed)) for seed in range(1, 11)]
    for parameter, truth in (("threshold", 1.31), ("exponent", 0.27)):
        found = [getattr(fit, parameter) for fit in fits]
        assert sum(not f.low <= truth <= f.high for f in found) <= 7, found
        assert abs(np.mean([f.value for f in found]) - truth) < 0.03
    assert all(0.01 < f.exponent.high - f.exponent.low < 0.2 for f in fits)


def test_onset_of_too_few_points_or_of_flow_everywhere_is_refused() -> None:
    with pytest.raises(LabError, match="too few"):
        fit_onset(GAMMAS[:5], made_up(1.31, 0.27, 0.1, 1)[:5])
    with pytest.raises(LabError, match="Add smaller values"):
        fit_onset(GAMMAS, [[2.0, 2.1]] * len(GAMMAS))


def curve(means: list[float], noise: float = 0.05) -> Curve:
    generator = np.random.default_rng(7)
    points = tuple(Point(tuple(generator.normal(mean, noise, 8))) for mean in means)
    return Curve(tuple(float(i) for i in range(len(means))), points)


def test_monotone_curves_are_distinguished_from_others() -> None:
    rising = curve([0.0, 0.1, 0.2, 0.2, 0.5, 0.9])
    assert rising.monotone(rising=True) > 0.01
    assert rising.monotone(rising=False) < 1e-6
    assert curve([1.0, 0.5, 0.1, 0.5, 1.0]).monotone(rising=False) < 1e-6


def test_extremum_is_the_vertex_of_a_parabola() -> None:
    found = curve([(i - 2.3) ** 2 for i in range(6)]).extremum()
    assert found.mean == pytest.approx(2.3, abs=4.0 * found.error)
    assert 0.0 < found.error < 0.05


def test_a_case_knows_its_layers_and_names_all_it_changes() -> None:
    assert Case(3.0, 0.1, 25.0, 20).layers == pytest.approx(0.7)
    assert gamma_of(25.0) == pytest.approx(5.0, abs=0.05)
    assert frequency_of(gamma_of(17.3)) == pytest.approx(17.3)
    words = Case(3.0, 0.1, 25.0, 20).with_changes(tooth__tip_radius=1e-4).run(7).arguments()
    for word in (
        "tooth.height=0.003",
        "tooth.asymmetry=0.1",
        "drive.frequency=25.0",
        "tooth.tip_radius=0.0001",
        "seed=7",
    ):
        assert word in words
    assert words[words.index("--disks") + 1] == "20"


def test_points_are_kept_as_they_are_and_missing_ones_are_reported(tmp_path: Path) -> None:
    first, second = Case(3.0, 0.1, 25.0, 20), Case(6.0, 0.25, frequency_of(1.31), 50).with_changes(drive__phase=1.5)
    points = {first: Point((4.123, -0.5, 0.0)), second: Point((1.0, 2.0))}
    write_points(tmp_path / "points.csv", points)
    again = read_points(tmp_path / "points.csv")
    assert again == points
    assert chosen(again, {first: 2})[first].velocities == (4.123, -0.5)
    with pytest.raises(LabError, match="ratchet-page"):
        chosen(again, {first: 4, Case(3.0, 0.1, 26.0, 20): 1})


def test_page_is_what_the_kept_data_say() -> None:
    """The page is generated: `python -m studies ratchet-page`."""
    docs = GENERATED
    made = page.page(read_points(docs / page.POINTS), page.read_flow(docs / page.FLOW))
    assert made == (docs / page.PAGE).read_text(), "the page differs: run python -m studies ratchet-page"
    assert (docs / page.POINTS).stat().st_size < 100_000


def test_kept_velocities_are_those_of_the_program(laboratory: Laboratory) -> None:
    """Fresh runs of other seeds against the kept ones: the same means within five joint standard errors."""
    kept = read_points(GENERATED / page.POINTS)
    for case, runs in ((quoted.POSITIVE, 10), (quoted.NEGATIVE, 10), (frequency.case(25.0, 30), 6)):
        fresh = [case.run(1000 + seed) for seed in range(runs)]
        tables = laboratory.run(fresh, "fresh")
        mean = 100.0 * float(np.mean([tables[run]["transport_velocity"][-1] for run in fresh]))
        scatter = max(kept[case].scatter, 0.3)
        assert abs(mean - kept[case].estimate.mean) < 5.0 * scatter * math.sqrt(1.0 / runs + 1.0 / kept[case].runs)


def test_every_study_has_a_maker() -> None:
    assert all(callable(maker(number)) for number in STUDIES)


def test_small_figure_from_end_to_end(laboratory: Laboratory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fig. 6 with few points and short runs: the signs of F, and the symmetric tooth, come out."""
    monkeypatch.setattr(shape, "ASYMMETRIES", (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5))
    monkeypatch.setattr(shape, "tooth", lambda h, a: Case(h, a, 25.0, 69, 24, 6.0))
    folder = tmp_path / "results"
    data, picture, statements = make_figure("F6", laboratory, folder, quick=True, seeds=3)
    assert len(data.read_text().splitlines()) == 1 + 3 * 5
    assert picture.stat().st_size > 10_000
    assert "IV A, Fig. 6" in statements.read_text()
    rows = [
        dict(zip(data.read_text().splitlines()[0].split(","), line.split(","), strict=True))
        for line in data.read_text().splitlines()[1:]
    ]
    velocity = {(float(r["height_mm"]), float(r["asymmetry"])): float(r["velocity_cm_per_s"]) for r in rows}
    assert velocity[3.0, 0.05] > 1.0 > -0.5 > velocity[9.0, 0.15]


def test_surface_is_that_of_a_tooth_with_a_round_tip() -> None:
    """Against the defining property: the tip's arc has its radius and meets both sides without a kink."""
    case = Case(6.0, 0.25, 30.0, 10)
    x = np.linspace(0.0, fields.TOOTH, 60001)
    y = fields.surface(case, x)
    assert y[0] == pytest.approx(0.0) and y[-1] == pytest.approx(0.0, abs=1e-9)
    slope = np.diff(y) / np.diff(x)
    assert np.max(np.abs(np.diff(slope))) < 0.02
    i = int(np.argmax(y))
    curvature = (y[i - 50] - 2.0 * y[i] + y[i + 50]) / (x[50] - x[0]) ** 2
    assert -1.0 / curvature == pytest.approx(fields.TIP, rel=1e-2)
    assert slope[100] == pytest.approx(6.0 / 1.5) and slope[-100] == pytest.approx(-6.0 / 4.5)


def test_fields_hold_all_mass_and_the_transport(laboratory: Laboratory) -> None:
    """In every window the whole mass; momenta averaged over the period are the transport velocity of the same run."""
    case = Case(3.0, 0.1, 25.0, 20, seconds=5.0)
    found = fields.observe(laboratory, case, 2, "fields")
    np.testing.assert_allclose(found.mass.sum(axis=(2, 3)), 1.0, rtol=1e-9)
    runs = [case.run(seed) for seed in (1, 2)]
    tables = laboratory.run(runs, "the same")
    whole = [100.0 * float(tables[run]["transport_velocity"][-1]) for run in runs]
    np.testing.assert_allclose(found.momentum[..., 0].sum(axis=(2, 3)).mean(axis=1), whole, rtol=1e-6)


def test_curves_are_sorted_families() -> None:
    points = {Case(h, a, 25.0, 20): Point((h, a)) for h in (5.0, 3.0) for a in (0.3, 0.1)}
    found = curves(points, lambda c: c.height, lambda c: c.asymmetry)
    assert list(found) == [3.0, 5.0]
    assert found[5.0].x == (0.1, 0.3)
    assert math.isclose(found[5.0].at(0.3).velocities[1], 0.3)
