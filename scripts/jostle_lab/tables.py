"""Tables: CSV files through polars, and tables in Markdown."""

from collections.abc import Iterable, Mapping, Sequence
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
from numpy.typing import NDArray

Table = dict[str, NDArray[np.float64]]
"""Columns by name."""
Row = dict[str, Any]


def write_table(path: Path, rows: Sequence[Mapping[str, Any]], columns: Sequence[str] | None = None) -> None:
    """Write rows with these columns, those of the first row unless given."""
    names = list(columns if columns is not None else rows[0])
    pl.DataFrame({name: [row[name] for row in rows] for name in names}, strict=False).write_csv(path)


def read_table(path: Path) -> pl.DataFrame:
    """A table of numbers."""
    return pl.read_csv(path, infer_schema_length=None)


def read_text_rows(paths: Iterable[Path]) -> list[dict[str, str]]:
    """All rows of several CSV files, one behind the other, every cell as it is written; an empty cell is ''."""
    frames = [pl.read_csv(path, infer_schema=False) for path in paths]
    return [{name: value or "" for name, value in row.items()} for frame in frames for row in frame.to_dicts()]


def parse_csv(text: str) -> Table:
    """A CSV table of numbers with a header, by columns."""
    frame = pl.read_csv(StringIO(text), infer_schema=False)
    return {name: frame[name].cast(pl.Float64).to_numpy().astype(np.float64) for name in frame.columns}


def markdown_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table with all columns but the first aligned right."""
    lines = ["| " + " | ".join(header) + " |", "|" + "|".join([":--", *["--:"] * (len(header) - 1)]) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines)
