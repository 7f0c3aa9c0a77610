"""What one scene gains must cost the others nothing: instruction counts against the pinned ones."""

import shutil
from pathlib import Path

import pytest
from jostle_lab.leave_out import changed, count
from jostle_lab.points import read_rows

ROOT = Path(__file__).resolve().parents[2]
PINNED = ROOT / "docs" / "generated" / "instruction_counts" / "instructions.csv"


def test_changes_are_told() -> None:
    pinned = [{"workload": "a", "instructions": "1000"}, {"workload": "b", "instructions": "1000"}]
    counted = [
        {"workload": "a", "instructions": "1004"},
        {"workload": "b", "instructions": "1010"},
        {"workload": "c", "instructions": "5"},
    ]
    assert changed(pinned, counted) == ["b: 1010, pinned 1000 (+1.00 %)", "c: 5, not pinned"]


@pytest.mark.skipif(shutil.which("valgrind") is None, reason="valgrind is not installed")
def test_no_scene_runs_more_instructions_than_before() -> None:
    """A regression test. After a change that is meant: `python -m jostle_lab leave-out`, and why in the CHANGELOG."""
    assert changed(read_rows([PINNED]), list(count(ROOT / "target" / "release" / "jostle"))) == []
