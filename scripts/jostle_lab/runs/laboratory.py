"""Runs of the native command line: many at a time, each kept on disk by joblib and never done twice.

A run is found again by its arguments and by the program itself: rebuild the program and everything is run anew.
It is the program and not the Python package, as in sweeps: a study reads every row of every output, which the program
writes in the form that is kept, and asks the program for the theory, too. So one fingerprint names all of a record.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from joblib import Memory, Parallel, delayed

from jostle_lab.locate import fingerprint
from jostle_lab.programs import output_of
from jostle_lab.progress import progress
from jostle_lab.runs.dask_backend import dask_backend
from jostle_lab.runs.kept import perform
from jostle_lab.runs.records import NotKeptError, Record, Records
from jostle_lab.runs.run import Run
from jostle_lab.stopping import telling
from jostle_lab.tables import Table, parse_csv


@dataclass
class Laboratory:
    """Runs what figures ask for."""

    program: Path
    kept: Path
    """Folder of the finished runs."""
    processes: int = 2
    show_progress: bool = True
    scheduler: str | None = None
    """Address of a Dask scheduler; None: processes of this machine."""
    records: Records | None = None
    """What is kept of the runs of a study; asked first."""
    frozen: bool = False
    """Run nothing: everything must be in the records."""
    asked: dict[str, int | None] = field(default_factory=dict, init=False)
    """Arguments of all runs asked for so far, and their seeds; a copy by `dataclasses.replace` starts with none."""
    _seconds: dict[str, float] = field(default_factory=dict, init=False)
    """Processor time of each of them."""

    @property
    def spent(self) -> float:
        """Processor time of all runs asked for so far, each counted once, also of those found on disk [s]."""
        return sum(self._seconds.values())

    @cached_property
    def version(self) -> str:
        """Fingerprint of the program."""
        return fingerprint(self.program)

    @cached_property
    def _kept_run(self) -> Any:
        """`kept.perform`, kept by joblib: found again by version and arguments."""
        return Memory(self.kept, verbose=0).cache(perform, ignore=["program"])

    def run(self, runs: Sequence[Run], title: str) -> dict[Run, Table]:
        """Every run's table; those that are on disk already are read only."""
        wanted = list(dict.fromkeys(runs))
        tables: dict[Run, Table] = {}
        for run in wanted:
            self.asked[run.key()] = run.seed
            if (kept := self._recorded(run)) is not None:
                tables[run], self._seconds[run.key()] = kept.table, kept.seconds
        missing = [run for run in wanted if run not in tables]
        self._refuse_if_frozen(len(missing), title)
        with telling(lambda: f"Finished runs are kept in {self.kept}. The same command does the others."):
            for run, (table, seconds) in zip(missing, self._performed(missing, title), strict=True):
                tables[run], self._seconds[run.key()] = table, seconds
                if self.records is not None:
                    tables[run] = self.records.add(run.key(), self.version, seconds, table).table
        return {run: tables[run] for run in wanted}

    def _recorded(self, run: Run) -> Record | None:
        """What is kept of a run; further columns come from the run, done again if it must be."""
        if self.records is None:
            return None

        def fetch() -> Table:
            table: Table = self._kept_run(self.program, self.version, run.arguments())[0]
            return table

        return self.records.find(run.key(), None if self.frozen else fetch)

    def computed(self, key: str, compute: Callable[[], tuple[Table, float]]) -> Table:
        """A table that is not that of a run, with its processor time [s], by the name under which it is kept: whole."""
        self.asked[key] = None
        kept = None
        if self.records is not None:
            kept = self.records.find(key, None if self.frozen else lambda: compute()[0])
        if kept is not None:
            self._seconds[key] = kept.seconds
            return kept.table
        self._refuse_if_frozen(1, key)
        table, self._seconds[key] = compute()
        if self.records is None:
            return table
        recorded = self.records.add(key, self.version, self._seconds[key], table).table
        return {name: recorded[name] for name in table}

    def _refuse_if_frozen(self, missing: int, title: str) -> None:
        if self.frozen and missing:
            raise NotKeptError(f"{missing} runs of {title} are not kept in {self.records and self.records.file}.")

    def _performed(self, runs: Sequence[Run], title: str) -> Iterator[tuple[Table, float]]:
        """Tables and processor times in the order of the runs; here, or on the workers of the scheduler."""
        if not runs:
            return
        with dask_backend(self.scheduler):
            jobs = (delayed(self._kept_run)(self.program, self.version, run.arguments()) for run in runs)
            threads = None if self.scheduler else "threads"
            done = Parallel(self.processes, prefer=threads, return_as="generator")(jobs)
            yield from progress(done, total=len(runs), unit="runs", what=title, show=self.show_progress)

    def theory(self, scene: str, quantity: str, **settings: Sequence[float] | float) -> Table:
        """What `jostle theory` prints; `__` in a name stands for a dot. All combinations, the first name slowest."""
        words = [str(self.program), "theory", scene, quantity]
        for name, values in settings.items():
            numbers = [values] if isinstance(values, int | float) else values
            words += ["--set", name.replace("__", ".") + "=" + ",".join(repr(float(number)) for number in numbers)]
        return parse_csv(output_of(words))
