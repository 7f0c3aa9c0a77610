"""Programs of this source tree that answer what no scene of the command line does."""

import time
from pathlib import Path

from jostle_lab.programs import output_of
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.tables import Table, parse_csv

ROOT = Path(__file__).resolve().parents[2]
GENERATED = ROOT / "docs" / "generated"
"""Generated pages and their data."""
CARGO = ("cargo", "run", "--release", "--quiet", "--package", "jostle-bench", "--example")
"""Builds and runs an example; its name and arguments follow."""


def example(laboratory: Laboratory, name: str, *arguments: str) -> Table:
    """What a Rust example prints as CSV."""

    def compute() -> tuple[Table, float]:
        begun = time.perf_counter()
        table = parse_csv(output_of([*CARGO, name, "--", *arguments], ROOT))
        return table, time.perf_counter() - begun

    return laboratory.computed(" ".join(["example", name, *arguments]), compute)
