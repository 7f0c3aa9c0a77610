"""What a study keeps of its runs: the columns that it read, in one small file, found again by arguments.

A study that is evaluated from its record needs no run; so its page can be made anew, and compared, within seconds. The
record says by which build of the program its runs were made and what they cost.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from jostle_lab.tables import Table


def schema(single: bool) -> dict[str, pl.DataType]:
    """Columns of the file."""
    text = pl.String()
    number = pl.Float32() if single else pl.Float64()
    return {"run": text, "program": text, "seconds": pl.Float32(), "column": text, "values": pl.List(number)}


class Watched(dict[str, NDArray[np.float64]]):
    """A table that remembers which of its columns were read."""

    def __init__(self, table: Table) -> None:
        super().__init__(table)
        self.read: set[str] = set()

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """A column."""
        self.read.add(name)
        return super().__getitem__(name)

    def items(self) -> Any:
        """All columns, all of which count as read."""
        self.read.update(self)
        return super().items()


class Records:
    """The record of one study.

    Args:
        file: Parquet; need not exist.
        single: keep numbers in single precision, which is enough where chance is larger than 1e-7.

    """

    def __init__(self, file: Path, single: bool = True) -> None:
        self.file, self.single = file, single
        self._kept: dict[str, tuple[str, float, Table]] = {}
        self._new: dict[str, tuple[str, float, Watched]] = {}
        if file.exists():
            self._read()

    def _read(self) -> None:
        try:
            frame = pl.read_parquet(self.file)
            for run, program, seconds, column, values in frame.iter_rows():
                table = self._kept.setdefault(run, (program, seconds, {}))[2]
                table[column] = np.array(values, dtype=np.float64)
        except (pl.exceptions.PolarsError, ValueError) as error:
            raise LabError(f"{self.file} is no record of runs: {error}. Compute it anew.") from None

    def find(self, run: str) -> tuple[Table, float] | None:
        """Table of a run, of the columns that are kept, and its processor time [s]; None if it is not kept."""
        if run in self._new:
            _, seconds, watched = self._new[run]
            return watched, seconds
        if run not in self._kept:
            return None
        _, seconds, table = self._kept[run]
        return table, seconds

    def add(self, run: str, program: str, seconds: float, table: Table) -> Table:
        """Take a run in; return its table, whose columns are kept if they are read before `write`."""
        watched = Watched(table)
        self._new[run] = (program, seconds, watched)
        return watched

    def write(self, runs: Sequence[str] | None = None) -> None:
        """Write the file: what was kept and what is new, of `runs` if given, in the order of the runs."""
        chosen = sorted(set(self._kept) | set(self._new)) if runs is None else sorted(set(runs))
        rows = [row for run in chosen for row in self._rows(run)]
        self.file.parent.mkdir(parents=True, exist_ok=True)
        draft = self.file.with_name(f"_{self.file.name}.draft")
        frame = pl.DataFrame(rows, schema=schema(self.single), orient="row")
        frame.write_parquet(draft, compression="zstd", compression_level=19, statistics=False)
        draft.replace(self.file)

    def _rows(self, run: str) -> Iterator[tuple[str, str, float, str, list[float]]]:
        if run in self._new:
            program, seconds, watched = self._new[run]
            columns = {name: dict.__getitem__(watched, name) for name in sorted(watched.read)}
        elif run in self._kept:
            program, seconds, table = self._kept[run]
            columns = dict(sorted(table.items()))
        else:
            return
        for name, values in columns.items():
            yield run, program, seconds, name, values.tolist()
