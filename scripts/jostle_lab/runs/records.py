"""What a study keeps of its runs: the columns that it read, in one small file, found again by arguments.

A study that is evaluated from its record needs no run; so its page can be made anew, and compared, within seconds. The
record says by which build of the program its runs were made and what they cost.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from jostle_lab.tables import Table, replace_parquet

Fetch = Callable[[], Table]


class NotKeptError(LabError):
    """A run or a column that a record lacks."""


def schema(single: bool) -> dict[str, pl.DataType]:
    """Columns of the file."""
    text = pl.String()
    number = pl.Float32() if single else pl.Float64()
    return {"run": text, "program": text, "seconds": pl.Float32(), "column": text, "values": pl.List(number)}


class Recorded(dict[str, NDArray[np.float64]]):
    """The table of a run, which remembers the columns that are read; one that is not there is fetched.

    Args:
        kept: columns that are kept already.
        fetch: makes the whole table; None: what is not kept is an error.
        name: what the message of that error names.

    """

    def __init__(self, kept: Table, fetch: Fetch | None, name: str) -> None:
        super().__init__(kept)
        self.read = set(kept)
        self._fetch, self._name = fetch, name

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """A column."""
        column = super().__getitem__(name)
        self.read.add(name)
        return column

    def __missing__(self, name: str) -> NDArray[np.float64]:
        """Fetch the table and take what is not there yet."""
        if self._fetch is None:
            raise NotKeptError(f"{name} is not kept of the run `{self._name}`. Compute its figure anew.")
        for other, column in self._fetch().items():
            self.setdefault(other, column)
        if name not in self:
            raise LabError(f"The run `{self._name}` has no column {name}. Is the program up to date?")
        return dict.__getitem__(self, name)


@dataclass
class Record:
    """A run as it is kept."""

    program: str
    """Fingerprint of the program that did it."""
    seconds: float
    """Processor time."""
    table: Recorded


class Records:
    """The record of one or more studies.

    Args:
        file: Parquet; need not exist.
        single: keep numbers in single precision, which is enough where chance is larger than 1e-7.

    """

    def __init__(self, file: Path, single: bool = True) -> None:
        self.file, self.single = file, single
        self._kept: dict[str, tuple[str, float, Table]] = {}
        self._asked: dict[str, Record] = {}
        if file.exists():
            self._read()

    def _read(self) -> None:
        try:
            for run, program, seconds, column, values in pl.read_parquet(self.file).iter_rows():
                table = self._kept.setdefault(run, (program, seconds, {}))[2]
                table[column] = np.array(values, dtype=np.float64)
        except (pl.exceptions.PolarsError, ValueError) as error:
            raise LabError(f"{self.file} is no record of runs: {error}. Compute it anew.") from None

    def find(self, run: str, fetch: Fetch | None) -> Record | None:
        """A run that is kept, whose further columns `fetch` makes; None if it is not kept."""
        if run not in self._asked and run in self._kept:
            program, seconds, table = self._kept[run]
            self._asked[run] = Record(program, seconds, Recorded(table, fetch, run))
        return self._asked.get(run)

    def add(self, run: str, program: str, seconds: float, table: Table) -> Record:
        """Take a run in; the columns of its table are kept that are read before `write`."""
        self._asked[run] = Record(program, seconds, Recorded({}, lambda: table, run))
        return self._asked[run]

    def write(self, only: Iterable[str] | None = None) -> None:
        """Write what was kept and what is new; `only` these runs, if given."""
        names = set(self._kept) | set(self._asked)
        chosen = sorted(names if only is None else names & set(only))
        rows = [row for run in chosen for row in self._rows(run)]
        frame = pl.DataFrame(rows, schema=schema(self.single), orient="row")
        self.file.parent.mkdir(parents=True, exist_ok=True)
        draft = self.file.with_name(f"_{self.file.name}.draft")
        replace_parquet(self.file, frame, draft, compression="zstd", compression_level=19, statistics=False)

    def _rows(self, run: str) -> list[tuple[Any, ...]]:
        if run in self._asked:
            record = self._asked[run]
            program, seconds = record.program, record.seconds
            columns = {name: dict.__getitem__(record.table, name) for name in record.table.read}
        else:
            program, seconds, columns = self._kept[run]
        return [(run, program, seconds, name, columns[name].tolist()) for name in sorted(columns)]
