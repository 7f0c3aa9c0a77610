"""Rows of a sweep in a folder of Parquet parts.

Guarantees: a part is whole or absent, whenever the process is killed; a run has one row, the last that was written;
one sweep writes at a time. Needs: a local file system that renames atomically and knows flock. What is no part begins
with an underscore: readers of a folder of Parquet pass such files over.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import polars as pl

from jostle_lab.errors import LabError
from jostle_lab.locks import held
from jostle_lab.tables import Row, replace_parquet

MANY_PARTS = 50
"""Parts from which on they are joined when a sweep begins or ends."""

DRAFT = "_part.draft"


class Store:
    """The rows in `folder`; made if it is not there. The column `key` identifies a run."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    def table(self) -> pl.DataFrame:
        """Every row, one for each run; columns that a row does not have are null."""
        parts = [self._read(part) for part in self._parts()] or [pl.DataFrame(schema={"key": pl.String})]
        return pl.concat(parts, how="diagonal_relaxed").unique("key", keep="last", maintain_order=True)

    def rows(self) -> dict[str, Row]:
        """Every row by its key."""
        return {row["key"]: row for row in self.table().to_dicts()}

    def append(self, rows: Sequence[Row]) -> None:
        """Add rows as a new part."""
        if rows:
            self._write(pl.from_dicts(rows, infer_schema_length=None))

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
        with held(self.folder, "sweep"):
            self._remove_names_of_before()
            self._join_many()
            yield
            self._join_many()

    def _join_many(self) -> None:
        if len(self._parts()) > MANY_PARTS:
            self.join()

    def _remove_names_of_before(self) -> None:
        """Remove the lock and the draft as sweeps of earlier versions called them."""
        lock = self.folder / "lock"
        if lock.is_file() and lock.stat().st_size == 0:
            lock.unlink()
        (self.folder / "part.draft").unlink(missing_ok=True)

    def _parts(self) -> list[Path]:
        return sorted(self.folder.glob("part-*.parquet"))

    def _read(self, part: Path) -> pl.DataFrame:
        try:
            return pl.read_parquet(part)
        except (OSError, pl.exceptions.PolarsError) as error:
            raise LabError(f"{part} is not readable: {error}. Remove it: its runs will be done again.") from None

    def _write(self, table: pl.DataFrame) -> None:
        parts = self._parts()
        number = int(parts[-1].stem.removeprefix("part-")) + 1 if parts else 1
        replace_parquet(self.folder / f"part-{number:08d}.parquet", table, self.folder / DRAFT)
