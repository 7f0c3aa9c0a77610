"""F: the fit of an onset, curves, kept records, one figure, the fields."""

import math
from pathlib import Path

import numpy as np
import pytest

from jostle_lab.errors import LabError
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.records import Records
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Verdict
from studies.claims.sections import record_file, section
from studies.examples import GENERATED
from studies.figures import make_figure
from studies.ratchet import fields, quoted, shape
from studies.ratchet.cases import Case, Point, frequency_of, gamma_of
from studies.ratchet.observe import observe_runs
from studies.ratchet.onset import fit_onset
from studies.ratchet.study import Curve, curves, reverses, signed
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


def test_a_reversal_needs_one_sign_change_and_a_last_sign() -> None:
    assert reverses(curve([1.0, 0.5, -0.5, -1.0])).verdict is Verdict.AGREES
    assert reverses(curve([1.0, 0.8, 0.6, 0.4])).verdict is Verdict.DISAGREES
    assert reverses(curve([1.0, -1.0, 1.0, 2.0])).verdict is Verdict.DISAGREES
    assert reverses(curve([1.0, 0.5, 0.2, 0.0], noise=0.3)).verdict is Verdict.OPEN


def test_signs_of_all_points_are_judged_with_their_errors() -> None:
    assert signed([Estimate(1.0, 0.1), Estimate(0.3, 0.1)], 1).verdict is Verdict.AGREES
    assert signed([Estimate(1.0, 0.1), Estimate(0.1, 0.1)], 1).verdict is Verdict.OPEN
    assert signed([Estimate(-1.0, 0.1), Estimate(0.5, 0.1)], -1).verdict is Verdict.PARTLY
    assert signed([Estimate(1.0, 0.1), Estimate(0.5, 0.1)], -1).verdict is Verdict.DISAGREES


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


def test_kept_velocities_are_those_of_the_program(laboratory: Laboratory) -> None:
    """Fresh runs of other seeds against the kept ones: the same means within five joint standard errors."""
    for figure, case, runs in (("F13", quoted.POSITIVE, 10), ("F14", quoted.NEGATIVE, 10)):
        records = Records(record_file(GENERATED, figure))
        found = [records.find(case.run(seed).key(), None) for seed in range(1, 31)]
        kept = Point(tuple(100.0 * record.table["transport_velocity"][-1] for record in found if record is not None))
        assert kept.runs == 30
        fresh = [case.run(1000 + seed) for seed in range(runs)]
        tables = laboratory.run(fresh, "fresh")
        mean = 100.0 * float(np.mean([tables[run]["transport_velocity"][-1] for run in fresh]))
        assert abs(mean - kept.estimate.mean) < 5.0 * kept.scatter * math.sqrt(1.0 / runs + 1.0 / kept.runs)


@pytest.mark.parametrize("figure", STUDIES)
def test_every_figure_is_evaluated_from_its_record_alone(figure: str, jostle: Path, tmp_path: Path) -> None:
    """All planned runs are kept, every statement has a rule, and what does not agree has a cause."""
    laboratory = Laboratory(jostle, tmp_path, show_progress=False)
    found, product = section(figure, laboratory, GENERATED, compute=False)
    assert found.statements
    for statement in found.statements:
        assert statement.rule, statement
        assert statement.cause or statement.verdict is Verdict.AGREES, statement
    assert record_file(GENERATED, figure).stat().st_size < 100_000
    assert product.picture.axes


def test_every_study_has_a_maker() -> None:
    assert all(callable(maker(number)) for number in STUDIES)


def test_small_figure_from_end_to_end(laboratory: Laboratory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fig. 6 with few points and short runs: the signs of F, and the symmetric tooth, come out."""
    monkeypatch.setattr(shape, "ASYMMETRIES", (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5))
    monkeypatch.setattr(shape, "tooth", lambda h, a: Case(h, a, 25.0, 69, 24, 6.0))
    folder = tmp_path / "results"
    data, picture, _, statements = make_figure("F6", laboratory, folder, quick=True, seeds=3)
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
    runs = [fields.field_run(case, seed) for seed in (1, 2)]
    found = fields.gather(list(laboratory.run(runs, "fields").values()))
    np.testing.assert_allclose(found.mass.sum(axis=(2, 3)), 1.0, rtol=1e-9)
    whole = 100.0 * observe_runs(laboratory, {case: 2}, "the same").values(case, "transport_velocity")
    np.testing.assert_allclose(found.momentum[..., 0].sum(axis=(2, 3)).mean(axis=1), whole, rtol=1e-6)


def test_curves_are_sorted_families() -> None:
    points = {Case(h, a, 25.0, 20): Point((h, a)) for h in (5.0, 3.0) for a in (0.3, 0.1)}
    found = curves(points, lambda c: c.height, lambda c: c.asymmetry)
    assert list(found) == [3.0, 5.0]
    assert found[5.0].x == (0.1, 0.3)
    assert math.isclose(found[5.0].at(0.3).velocities[1], 0.3)
