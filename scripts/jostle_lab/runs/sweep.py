"""Runs onto workers, rows into the store as they come: joblib on this machine, Dask on others."""

import time
from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import Any

from joblib import Parallel, delayed

from jostle_lab.errors import LabError
from jostle_lab.progress import progress
from jostle_lab.runs.build import Build, key
from jostle_lab.runs.dask_backend import client, distributed
from jostle_lab.runs.package import CHILDREN
from jostle_lab.runs.run import Run
from jostle_lab.runs.store import Store
from jostle_lab.runs.worker import FAILED, failure, perform
from jostle_lab.stopping import telling
from jostle_lab.tables import Row

BETWEEN_PARTS = 1.0
"""Shortest time from part to part [s]: a kill loses the rows of this time and the runs that have not ended."""
AHEAD = 4
"""Runs that are with a scheduler for each that it performs."""


@dataclass(frozen=True)
class Workers:
    """Where the runs are performed."""

    scheduler: str | None = None
    """Address of a Dask scheduler, such as tcp://host:8786; None: this machine."""
    processes: int = 2
    """Runs at a time on this machine."""
    patience: float = 10.0
    """How long the scheduler may take to answer [s]."""

    def rows(self, build: Build, runs: Sequence[Run]) -> Generator[Row]:
        """Rows in the order in which the runs end. Raises LabError for a wrong program or a lost scheduler."""
        if self.scheduler is not None:
            with client(self.scheduler, self.patience) as connected:
                yield from self._remote_rows(connected, build, runs)
            return
        # Threads of this process: each waits for a process of its own.
        parallel = Parallel(self.processes, prefer="threads", return_as="generator_unordered")
        try:
            yield from parallel(delayed(perform)(build, run) for run in runs)
        finally:
            CHILDREN.end()

    def _remote_rows(self, connected: Any, build: Build, runs: Sequence[Run]) -> Generator[Row]:
        """Only so many runs are with the scheduler at a time."""
        left = iter(runs)
        of_future: dict[Any, Run] = {}

        def submit() -> Any:
            run = next(left, None)
            if run is None:
                return None
            future = connected.submit(perform, build, run, key=f"jostle-{key(build, run)}", pure=False)
            of_future[future.key] = run
            return future

        ahead = max(8, AHEAD * sum(connected.nthreads().values()))
        queue = distributed().as_completed([submit() for _ in range(min(ahead, len(runs)))])
        for future in queue:
            run = of_future.pop(future.key)
            if (another := submit()) is not None:
                queue.add(another)
            yield _row_of(future, build, run)


def _row_of(future: Any, build: Build, run: Run) -> Row:
    """Row of a future that is done. A run whose workers die fails; a wrong program or a lost scheduler ends all."""
    if future.status == "finished":
        row: Row = future.result()
        return row
    if future.status != "error":
        raise LabError(f"The scheduler gave up a run ({future.status}). Is it still there? Repeat to go on.")
    error = future.exception()
    if isinstance(error, LabError):
        raise error
    return failure(build, run, f"{type(error).__name__}: {error}")


@dataclass(frozen=True)
class Sweep:
    """What a sweep needs beside its runs."""

    store: Store
    build: Build
    workers: Workers = Workers()
    show_progress: bool = True
    retry_failed: bool = False

    def run(self, runs: Sequence[Run], title: str = "sweep") -> dict[Run, Row]:
        """Every run's row; what the store has already is not done again. Failed runs have rows that say so."""
        keys = {run: key(self.build, run) for run in dict.fromkeys(runs)}
        with self.store.writing():
            kept = self.store.rows()
            missing = [run for run, key in keys.items() if self._wanted(kept.get(key))]
            failed = sum(kept[key]["state"] == FAILED for key in keys.values() if not self._wanted(kept.get(key)))
            bar = progress(
                total=len(keys),
                done=len(keys) - len(missing),
                unit="runs",
                what=title,
                show=self.show_progress,
                postfix={"failed": failed},
            )
            with telling(lambda: self._kept(keys)), bar:
                if missing:
                    self._perform(missing, bar, failed)
                    kept = self.store.rows()
        return {run: kept[key] for run, key in keys.items()}

    def _kept(self, keys: Mapping[Run, str]) -> str:
        rows = self.store.rows()
        there = sum(key in rows for key in keys.values())
        return f"{there} of {len(keys)} runs are kept in {self.store.folder}. The same command does the others."

    def _wanted(self, row: Row | None) -> bool:
        return row is None or (self.retry_failed and row["state"] == FAILED)

    def _perform(self, missing: list[Run], bar: Any, failed: int) -> None:
        """Write rows once in a while, and at the end whatever ends it."""
        rows: list[Row] = []
        written = time.monotonic()
        try:
            with closing(self.workers.rows(self.build, missing)) as done:  # so that no run goes on when this ends
                for row in done:
                    rows.append(row)
                    failed += row["state"] == FAILED
                    bar.set_postfix(failed=failed, refresh=False)
                    bar.update()
                    if time.monotonic() - written >= BETWEEN_PARTS:
                        self.store.append(rows)
                        rows, written = [], time.monotonic()
        finally:
            self.store.append(rows)
