"""Rows of a sweep in a folder of Parquet parts.

Guarantees: a part is whole or absent, whenever the process is killed; a run has one row, the last that was written;
one sweep writes at a time. Needs: a local file system that renames atomically and knows flock.
"""

import fcntl
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from jostle_lab.errors import LabError

Row = dict[str, Any]
"""Columns by name; `key` tells the run."""

MANY_PARTS = 50
"""Parts from which on they are joined when a sweep begins or ends."""


class Store:
    """The rows in `folder`; made if it is not there."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    def table(self) -> pa.Table:
        """Every row, one for each run; columns that a row does not have are null."""
        parts = self._parts()
        if not parts:
            return pa.table({"key": pa.array([], pa.string())})
        table = pa.concat_tables([self._read(part) for part in parts], promote_options="permissive")
        last = {key: index for index, key in enumerate(table["key"].to_pylist())}
        return table if len(last) == len(table) else table.take(sorted(last.values()))

    def rows(self) -> dict[str, Row]:
        """Every row by its key."""
        return {row["key"]: row for row in self.table().to_pylist()}

    def append(self, rows: Sequence[Row]) -> None:
        """Add rows as a new part."""
        if rows:
            names = list(dict.fromkeys(name for row in rows for name in row))
            self._write(pa.table({name: [row.get(name) for row in rows] for name in names}))

    def join(self) -> None:
        """All parts as one."""
        parts = self._parts()
        if len(parts) > 1:
            self._write(self.table())
            for part in parts:
                part.unlink()

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Hold the folder against other sweeps; the lock goes with the process, however it ends."""
        with (self.folder / "lock").open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise LabError(f"Another sweep writes to {self.folder}. Wait for it, or take another folder.") from None
            if len(self._parts()) > MANY_PARTS:
                self.join()
            yield
            if len(self._parts()) > MANY_PARTS:
                self.join()

    def _parts(self) -> list[Path]:
        return sorted(self.folder.glob("part-*.parquet"))

    def _read(self, part: Path) -> pa.Table:
        try:
            return pq.read_table(part)
        except (OSError, pa.ArrowInvalid) as error:
            raise LabError(f"{part} is not readable: {error}. Remove it: its runs will be done again.") from None

    def _write(self, table: pa.Table) -> None:
        parts = self._parts()
        number = int(parts[-1].stem.removeprefix("part-")) + 1 if parts else 1
        draft = self.folder / "part.draft"
        pq.write_table(table, draft)
        draft.replace(self.folder / f"part-{number:08d}.parquet")
