"""CSV files: tables of rows, and arrays with a header."""

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray


def write_table(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """Write rows that share their keys; the keys are the header."""
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        for row in rows:
            writer.writerow({k: f"{v:.9g}" if isinstance(v, float) else v for k, v in row.items()})


def read_table(path: Path) -> list[dict[str, float]]:
    """Rows of a table of numbers."""
    with path.open(newline="") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def write_array(path: Path, blocks: Sequence[NDArray[np.float64]], header: list[str]) -> None:
    """Write blocks of equal width below one another, shape (rows, len(header)) together."""
    np.savetxt(path, np.concatenate(blocks), delimiter=",", header=",".join(header), comments="", fmt="%.7g")


def read_array(path: Path) -> NDArray[np.float64]:
    """What `write_array` wrote, header left out."""
    return np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
