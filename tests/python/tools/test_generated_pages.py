"""The page of work-precision diagrams is what its data say."""

import math
from pathlib import Path

import pytest

from jostle_lab.errors import LabError
from jostle_lab.tables import read_text_rows, write_table
from tools import base_on_inputs, real_time_page, stability_page
from tools.paths import (
    BASE_ON_INPUTS,
    BASE_ON_INPUTS_PAGE,
    BINARIES,
    BINARIES_PAGE,
    INSTRUCTION_COUNTS,
    REAL_TIME,
    REAL_TIME_PAGE,
    STABILITY,
    STABILITY_PAGE,
    WORK_PRECISION,
    WORK_PRECISION_PAGE,
)
from tools.release import page as binaries_page
from tools.work_precision import step_lengths
from tools.work_precision.page import (
    COMMUNICATION_STEP,
    Diagram,
    Point,
    _steps,
    diagrams,
    draw_all,
    order,
    page,
    time_at,
)


def curve(errors: list[float], times: list[float]) -> list[Point]:
    return [Point(1.0, error, 0.0, time, time) for error, time in zip(errors, times, strict=True)]


def test_committed_page_is_that_of_the_committed_data() -> None:
    written = page(WORK_PRECISION, WORK_PRECISION.name, INSTRUCTION_COUNTS)
    assert written == WORK_PRECISION_PAGE.read_text(), "write it anew: python -m tools work-precision"


def test_committed_stability_page_is_that_of_the_committed_data() -> None:
    written = stability_page.page(STABILITY)
    assert written == STABILITY_PAGE.read_text(), "write it anew: python -m tools stability"


def test_committed_page_of_the_time_of_a_step_is_that_of_the_committed_data() -> None:
    written = real_time_page.page(REAL_TIME)
    assert written == REAL_TIME_PAGE.read_text(), "write it anew: python -m tools real-time"


def test_committed_page_of_the_base_on_inputs_is_that_of_the_committed_data() -> None:
    written = base_on_inputs.page(BASE_ON_INPUTS)
    assert written == BASE_ON_INPUTS_PAGE.read_text(), "write it anew: python -m tools base-on-inputs"


def test_committed_page_of_binaries_is_that_of_the_committed_data() -> None:
    written = binaries_page.page(BINARIES)
    again = "write it anew: scripts/release, then python -m tools binaries --data docs/generated/binaries"
    assert written == BINARIES_PAGE.read_text(), again


def test_every_measured_case_has_a_small_picture(tmp_path: Path) -> None:
    found = diagrams(WORK_PRECISION)
    assert sum(bool(diagram.curves) for diagram in found) >= 10
    pictures = draw_all(found, tmp_path)
    assert {picture.name for picture in pictures} == {p.name for p in WORK_PRECISION.glob("*.png")}
    assert sum(picture.stat().st_size for picture in pictures) < 200_000


def test_order_is_the_slope() -> None:
    times = [1.0, 2.0, 4.0, 8.0]
    assert order(curve([t**-4 for t in times], times)) == pytest.approx(4.0)
    # A curve that ends at the error of its reference has the order of what lies above.
    longer = [2.0**n for n in range(7)]
    assert order(curve([t**-4 + 1e-5 for t in longer], longer)) == pytest.approx(4.0, abs=0.05)
    assert order(curve([1e-3, 1e-4], [1.0, 10.0])) is None
    assert order(curve([1e-15, 1e-16, 1e-15], times[:3])) is None


def test_time_at_an_error_lies_on_the_curve() -> None:
    falling = curve([1e-2, 1e-4], [1.0, 100.0])
    assert time_at(falling, 1e-3) == pytest.approx(10.0)
    assert time_at(falling, 1e-5) is None
    assert time_at(falling, 1.0) == 1.0
    rising_again = curve([1e-2, 1e-4, 1e-2, 1e-5], [1.0, 2.0, 4.0, 8.0])
    crossed = time_at(rising_again, 1e-3)
    assert crossed is not None and 4.0 < crossed < 8.0 and not math.isnan(crossed)


def test_longest_step_for_an_error_lies_on_the_curve() -> None:
    errors = [(1e-2, 1e-1), (1e-3, 1e-3), (1e-4, 1e-5)]
    assert step_lengths.step_at(errors, 1e-2) == pytest.approx(10.0**-2.5)
    assert step_lengths.step_at(errors, 1e-6) is None
    assert step_lengths.step_at(errors, 1.0) == 1e-2
    assert "| second | 2.00 | 1.00e-02 or more |" in step_lengths.section(
        [step_lengths.Curve("second", 2.0, [(1e-2, 1e-3)])]
    )


def test_steps_of_a_curve_with_an_error_of_zero_are_found() -> None:
    words = [COMMUNICATION_STEP, "", ""]
    curves = {"exact": [Point(1e-3, 0.0, 0.0, 1.0, 1.0), Point(1e-1, 1.0, 0.0, 1.0, 1.0)]}
    assert "| exact |  | 5.62e-02 |" in _steps(Diagram("loop", "base", "rms", *words, curves, ()))


def test_a_page_of_the_time_of_a_step_without_a_step_has_no_table(tmp_path: Path) -> None:
    rows = read_text_rows([REAL_TIME / "steps.csv"])
    only = dict.fromkeys(rows[0], "") | {"scene": "packing", "engine": "event-driven", "disks": "60", "rate": "1000"}
    write_table(tmp_path / "steps.csv", [only | {"refused": "no such step"}])
    (tmp_path / "machine.csv").write_bytes((REAL_TIME / "machine.csv").read_bytes())
    written = real_time_page.page(tmp_path)
    assert "- 60 disks, 1 kHz: no such step" in written
    assert "|" not in written and "## The other calls" not in written


def test_a_folder_without_data_is_reported(tmp_path: Path) -> None:
    with pytest.raises(LabError, match="jostle-bench report --out"):
        diagrams(tmp_path)
