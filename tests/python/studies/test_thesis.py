"""Figures of the thesis: statistics on made-up data, reading and keeping of runs, one small figure from end to end."""

import math
import subprocess
from pathlib import Path

import numpy as np
import pytest

from jostle_lab.errors import LabError
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement, Verdict, write
from jostle_lab.statistics.estimates import (
    Estimate,
    bootstrap_mean,
    bootstrap_ratio,
    chi_square,
    pooled,
    zero_crossings,
)
from jostle_lab.tables import parse_csv
from studies.registry import MODULES, maker
from studies.thesis.wedge import collapse as wedge_collapse
from studies.thesis.wedge import curves as wedge
from studies.thesis.wedge.curves import Effort, Wedge, curves


def test_csv_by_columns() -> None:
    table = parse_csv("time,a b\n0,1e-3\n2,-4\n")
    assert table["time"].tolist() == [0.0, 2.0]
    assert table["a b"].tolist() == [1e-3, -4.0]


def test_pooled_error_shrinks_with_the_number_of_runs() -> None:
    estimate = pooled([1.0, 3.0, 1.0, 3.0], [0.2] * 4)
    assert estimate.mean == pytest.approx(2.0)
    assert estimate.error == pytest.approx(0.1)


def test_estimates_are_shown_to_the_first_digits_of_the_error() -> None:
    shown = [
        str(Estimate(*pair))
        for pair in ((1.0042, 0.052), (0.05, 0.103), (-0.31, 0.0021), (159.2, 23.0), (1.2345e-6, 2e-7))
    ]
    assert shown == ["1.00 +- 0.05", "0.05 +- 0.10", "-0.310 +- 0.002", "160 +- 20", "1.23e-06 +- 2e-07"]
    assert str(Estimate(2.0, 0.0)) == "2 +- 0"


def test_chi_square_of_noise_is_one_and_of_a_shift_is_not() -> None:
    noise = np.random.default_rng(3).normal(0.0, 0.1, 2000)
    ratio, p_value = chi_square(noise, [0.1] * 2000)
    assert ratio == pytest.approx(1.0, abs=0.1)
    assert p_value > 0.01
    assert chi_square(noise + 0.05, [0.1] * 2000)[1] < 1e-6


def test_bootstrap_error_is_that_of_the_mean() -> None:
    values = np.random.default_rng(4).normal(5.0, 2.0, 400)
    estimate = bootstrap_mean(values)
    assert estimate.error == pytest.approx(2.0 / math.sqrt(400), rel=0.15)


def test_ratio_of_pairs_knows_that_packings_are_the_same() -> None:
    packings = np.random.default_rng(5).lognormal(0.0, 1.0, 20)
    ratio = bootstrap_ratio(1.5 * packings, packings)
    assert ratio.mean == pytest.approx(1.5)
    assert ratio.error < 1e-12


def test_crossing_is_where_the_line_is_zero_and_noise_crosses_nothing() -> None:
    x = [0.0, 1.0, 2.0, 3.0, 4.0]
    (crossing,) = zero_crossings(x, [Estimate(2.5 - v, 0.01) for v in x])
    assert crossing.mean == pytest.approx(2.5)
    assert crossing.error == pytest.approx(0.01 / math.sqrt(2.0), rel=1e-6)
    assert zero_crossings(x, [Estimate((-1.0) ** v * 0.01, 0.01) for v in x]) == []


def test_statements_page_keeps_bars_in_their_cells(tmp_path: Path) -> None:
    figure = maker("6.4").__globals__["Figure"]()
    statement = Statement("1.1", "|x| small", "|x| = 0.1 +- 0.2", Verdict.AGREES)
    product = Product("Title", [{"x": 1.0}], figure, [statement], ["a note"])
    *_, page = write(product, tmp_path / "figure", "command", "footer")
    row = next(line for line in page.read_text().splitlines() if line.startswith("| 1.1"))
    assert row == r"| 1.1 | \|x\| small | \|x\| = 0.1 +- 0.2 | agrees |  |"


def test_every_figure_has_a_maker() -> None:
    assert all(callable(maker(number)) for number in MODULES)


def test_runs_are_kept_and_not_done_twice(laboratory: Laboratory, monkeypatch: pytest.MonkeyPatch) -> None:
    run = Wedge().run(5.0, 1, 1.0)
    first = laboratory.run([run, run], "first")[run]
    assert len(list(laboratory.kept.rglob("output.pkl"))) == 1
    again = Laboratory(laboratory.program, laboratory.kept, show_progress=False)
    monkeypatch.setattr(subprocess, "Popen", None)  # a run of the program would fail
    second = again.run([run], "again")[run]
    assert float(second["scaled_angular_velocity"][-1]) == float(first["scaled_angular_velocity"][-1])
    assert again.spent == laboratory.spent


def test_refused_parameter_is_reported_with_the_programs_own_words(laboratory: Laboratory) -> None:
    with pytest.raises(LabError, match=r"wedge\.tilt"):
        laboratory.run([Wedge().run(31.0, 1, 1.0)], "refused")
    with pytest.raises(LabError, match="cargo build"):
        Laboratory(Path("nowhere"), laboratory.kept, show_progress=False).run([Run("a", "b", 1.0, 1.0, ())], "none")


def test_wedge_turns_when_tilted_and_by_the_mirrored_amount(laboratory: Laboratory) -> None:
    upright = Wedge()
    curve = curves(laboratory, "mirror", {upright: (-8.0, 0.0, 8.0)}, Effort(2e5, 2))[upright]
    left, middle, right = curve.points
    assert right.mean > 10.0 * right.error
    assert abs(right.mean + left.mean) < 4.0 * math.hypot(right.error, left.error)
    assert abs(middle.mean) < 4.0 * middle.error


def test_small_figure_from_end_to_end(laboratory: Laboratory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wedge, "QUICK", Effort(1e5, 2))
    monkeypatch.setattr(wedge_collapse, "QUICK_TILTS", (0.0, 8.0, 20.0))
    product = wedge_collapse.make(laboratory, True)
    data, picture, _, page = write(product, tmp_path / "figure-6.4", "command", "footer")
    rows = [row for row in data.read_text().splitlines()[1:] if row]
    assert len(rows) == 9 * 3
    assert picture.stat().st_size > 10_000
    assert "| agrees |" in page.read_text()
    # So short a run leaves some open.
    assert not {s.verdict for s in product.statements} & {Verdict.DISAGREES, Verdict.PARTLY}, product.statements
