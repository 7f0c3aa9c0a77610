"""Tables: CSV files through polars, and tables in Markdown."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
from numpy.typing import NDArray

from jostle_lab.errors import LabError, about, describe_os_error
from jostle_lab.files import replacing

Table = dict[str, NDArray[np.float64]]
"""Columns by name."""
Row = dict[str, Any]


def write_table(path: Path, rows: Sequence[Mapping[str, Any]], columns: Sequence[str] | None = None) -> None:
    """Write rows with these columns, those of the first row unless given."""
    names = list(columns if columns is not None else rows[0])
    write_frame(path, pl.DataFrame({name: [row[name] for row in rows] for name in names}, strict=False))


def write_frame(path: Path, frame: pl.DataFrame) -> None:
    """Write a table of polars, whole or not at all."""
    with _named(path), replacing(path) as draft:
        frame.write_csv(draft)


def replace_parquet(path: Path, frame: pl.DataFrame, draft: Path, **options: Any) -> None:
    """Write Parquet as `draft`, in the same folder, and rename it: `path` is the old file or the new one, and whole."""
    try:
        frame.write_parquet(draft, **options)
    except (OSError, pl.exceptions.PolarsError) as error:
        draft.unlink(missing_ok=True)
        known = about(draft, error if isinstance(error, OSError) else OSError(str(error)))
        said = describe_os_error(known) if known.errno is not None else f"{draft} cannot be written: {error}."
        raise LabError(f"{said} Then repeat: what is there stays.") from None
    draft.replace(path)


def read_table(path: Path) -> pl.DataFrame:
    """A table of numbers."""
    with _named(path):
        return pl.read_csv(path, infer_schema_length=None)


def read_text_rows(paths: Iterable[Path]) -> list[dict[str, str]]:
    """All rows of several CSV files, one behind the other, every cell as it is written; an empty cell is ''."""
    return [{name: value or "" for name, value in row.items()} for path in paths for row in _read_text(path).to_dicts()]


def _read_text(path: Path) -> pl.DataFrame:
    with _named(path):
        return pl.read_csv(path, infer_schema=False)


@contextmanager
def _named(path: Path) -> Iterator[None]:
    """Errors of polars name the file."""
    try:
        yield
    except pl.exceptions.PolarsError as error:
        raise LabError(f"{path} is not a table as it should be: {error}. Make it again.") from None
    except OSError as error:
        raise about(path, error) from None


def parse_csv(text: str) -> Table:
    """A CSV table of numbers with a header, by columns."""
    try:
        frame = pl.read_csv(StringIO(text), infer_schema=False)
        return {name: frame[name].cast(pl.Float64).to_numpy().astype(np.float64) for name in frame.columns}
    except pl.exceptions.PolarsError as error:
        raise LabError(f"This is no table of numbers: {error}. It begins with {text[:80]!r}.") from None


def markdown_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table with all columns but the first aligned right."""
    lines = ["| " + " | ".join(header) + " |", "|" + "|".join([":--", *["--:"] * (len(header) - 1)]) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines)
