"""Runs onto Dask, rows into the store as they come."""

import logging
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from tqdm import tqdm

from jostle_lab.errors import LabError
from jostle_lab.sweep.store import Row, Store
from jostle_lab.sweep.worker import FAILED, Program, failure, perform
from jostle_lab.thesis.runs import Run

BETWEEN_PARTS = 1.0
"""Shortest time from part to part [s]: what a kill can cost beside the runs that are under way."""
ANY_PORT = "127.0.0.1:0"
"""Of the pages that Dask serves on itself."""
WAITING = 4
"""Runs handed to the scheduler for each that is under way."""


def _distributed() -> Any:
    """Dask, when it is needed: its import takes longer than most commands."""
    return import_module("distributed")


@dataclass(frozen=True)
class Workers:
    """Who does the runs."""

    scheduler: str | None = None
    """Address of a Dask scheduler, such as tcp://host:8786; None: a cluster of this process."""
    processes: int = 2
    """Runs at a time on the cluster of this process."""
    patience: float = 10.0
    """How long the scheduler may take to answer [s]."""

    @contextmanager
    def client(self) -> Iterator[Any]:
        """A client, closed at the end; the cluster too if it is ours."""
        dask = _distributed()
        logging.getLogger("distributed").setLevel(logging.ERROR)
        if self.scheduler is not None:
            try:
                client = dask.Client(self.scheduler, timeout=self.patience)
            except (OSError, ValueError) as error:
                raise LabError(
                    f"No Dask scheduler answers at {self.scheduler}: {error}. Start one: dask scheduler"
                ) from None
            with client:
                if not client.nthreads():
                    raise LabError(f"{self.scheduler} has no workers. Start one: dask worker {self.scheduler}")
                yield client
            return
        # Threads of this process: each waits for a program of its own, so processes would only cost time and memory.
        with (
            dask.LocalCluster(
                n_workers=1,
                threads_per_worker=self.processes,
                processes=False,
                dashboard_address=ANY_PORT,
                memory_limit=0,
            ) as cluster,
            dask.Client(cluster) as client,
        ):
            yield client


@dataclass(frozen=True)
class Sweep:
    """What a sweep needs beside its runs."""

    store: Store
    program: Program
    workers: Workers = Workers()
    show_progress: bool = True
    retry_failed: bool = False

    def run(self, runs: Sequence[Run], title: str = "sweep") -> dict[Run, Row]:
        """Every run's row; what the store has already is not done again. Failed runs have rows that say so."""
        keys = {run: self.program.key(run) for run in dict.fromkeys(runs)}
        with self.store.writing():
            kept = self.store.rows()
            missing = [run for run, key in keys.items() if self._wanted(kept.get(key))]
            failed = sum(kept[key]["state"] == FAILED for key in keys.values() if not self._wanted(kept.get(key)))
            with tqdm(
                total=len(keys),
                initial=len(keys) - len(missing),
                unit="run",
                desc=title,
                disable=not self.show_progress,
                postfix={"failed": failed},
            ) as bar:
                if missing:
                    self._conduct(missing, bar, failed)
                    kept = self.store.rows()
        return {run: kept[key] for run, key in keys.items()}

    def _wanted(self, row: Row | None) -> bool:
        return row is None or (self.retry_failed and row["state"] == FAILED)

    def _conduct(self, missing: list[Run], bar: Any, failed: int) -> None:
        with self.workers.client() as client, _Parts(self.store) as parts:
            for row in self._rows(client, missing):
                parts.add(row)
                failed += row["state"] == FAILED
                bar.set_postfix(failed=failed, refresh=False)
                bar.update()

    def _rows(self, client: Any, missing: list[Run]) -> Iterator[Row]:
        """Rows in the order in which they are finished; only so many runs are with the scheduler at a time."""
        waiting = iter(missing)
        of_future: dict[Any, Run] = {}

        def submit() -> Any:
            run = next(waiting, None)
            if run is None:
                return None
            future = client.submit(perform, self.program, run, key=f"jostle-{self.program.key(run)}", pure=False)
            of_future[future.key] = run
            return future

        ahead = max(8, WAITING * sum(client.nthreads().values()))
        queue = _distributed().as_completed([submit() for _ in range(min(ahead, len(missing)))])
        for future in queue:
            run = of_future.pop(future.key)
            if (another := submit()) is not None:
                queue.add(another)
            yield self._row(future, run)

    def _row(self, future: Any, run: Run) -> Row:
        """Row of a future that is done. A run whose workers die fails; a wrong program or a lost scheduler ends all."""
        if future.status == "finished":
            row: Row = future.result()
            return row
        if future.status != "error":
            raise LabError(f"The scheduler gave up a run ({future.status}). Is it still there? Repeat to go on.")
        error = future.exception()
        if isinstance(error, LabError):
            raise error
        return failure(self.program, run, f"{type(error).__name__}: {error}")


class _Parts:
    """Gathers rows and writes them once in a while, and at the end whatever ends it."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._rows: list[Row] = []
        self._written = time.monotonic()

    def __enter__(self) -> "_Parts":
        return self

    def __exit__(self, *_: object) -> None:
        self._write()

    def add(self, row: Row) -> None:
        """Take a row."""
        self._rows.append(row)
        if time.monotonic() - self._written >= BETWEEN_PARTS:
            self._write()

    def _write(self) -> None:
        self._store.append(self._rows)
        self._rows, self._written = [], time.monotonic()
