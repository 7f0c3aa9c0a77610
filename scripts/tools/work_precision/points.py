"""Rows of a work-precision diagram measured from Python, in the columns of `jostle-bench report`."""

import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

COLUMNS = (
    "case",
    "quantity",
    "method",
    "setting",
    "error",
    "error_bar",
    "cpu_seconds",
    "evaluations",
    "trouble",
)
CASE_COLUMNS = ("case", "quantity", "error", "setting", "reference", "problem")


@dataclass
class Work:
    """One point: `run` solves the problem once and returns (errors by quantity, CPU seconds, evaluations)."""

    case: str
    method: str
    setting: float
    run: Callable[[], tuple[dict[str, float], float, float]]
    times: list[float] = field(default_factory=list)
    errors: dict[str, float] = field(default_factory=dict)
    evaluations: float = 0.0


def measure(works: Sequence[Work], rounds: int, long_enough: float = 4.0) -> list[dict[str, str]]:
    """Measure all points in turn, round by round; CPU time is the median. Long runs are not repeated."""
    for _ in range(rounds):
        for work in works:
            if sum(work.times) < long_enough:
                work.errors, seconds, work.evaluations = work.run()
                work.times.append(seconds)
    return [row for work in works for row in _rows(work)]


def _rows(work: Work) -> list[dict[str, str]]:
    seconds = statistics.median(work.times)
    return [
        {
            "case": work.case,
            "quantity": quantity,
            "method": work.method,
            "setting": f"{work.setting:.5g}",
            "error": f"{error:.5g}",
            "error_bar": "0",
            "cpu_seconds": f"{seconds:.5g}",
            "evaluations": f"{work.evaluations:.5g}",
            "trouble": "",
        }
        for quantity, error in work.errors.items()
    ]


def trouble(case: str, quantities: Sequence[str], method: str, setting: float, why: str) -> list[dict[str, str]]:
    """Rows of a point that has no number."""
    empty = dict.fromkeys(COLUMNS, "")
    row = {"case": case, "method": method, "setting": f"{setting:.5g}", "trouble": " ".join(why.split())}
    return [{**empty, **row, "quantity": quantity} for quantity in quantities]
