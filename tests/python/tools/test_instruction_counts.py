"""Changes of instruction counts are named; the counts are a benchmark: `python -m tools instruction-counts --check`."""

from tools.instruction_counts import changed


def test_changes_are_reported() -> None:
    pinned = [{"workload": "a", "instructions": "1000"}, {"workload": "b", "instructions": "1000"}]
    counted = [
        {"workload": "a", "instructions": "1004"},
        {"workload": "b", "instructions": "1010"},
        {"workload": "c", "instructions": "5"},
    ]
    assert changed(pinned, counted) == ["b: 1010, pinned 1000 (+1.00 %)", "c: 5, not pinned"]
