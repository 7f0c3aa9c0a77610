"""Runs of the native command line: many at a time, each kept on disk by joblib and never done twice.

A run is found again by its arguments and by the program itself: rebuild the program and everything is run anew.
"""

import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from joblib import Memory, Parallel, delayed
from tqdm import tqdm

from jostle_lab.locate import fingerprint
from jostle_lab.programs import output_of
from jostle_lab.runs.run import Run
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
    """Address of a Dask scheduler for the runs that are swept; None: processes of this machine."""
    spent: float = field(default=0.0, init=False)
    """Processor time of all runs asked for so far, also of those found on disk [s]."""

    @cached_property
    def version(self) -> str:
        """Fingerprint of the program."""
        return fingerprint(self.program)

    @cached_property
    def _kept_run(self) -> Any:
        """`_perform`, kept by joblib: found again by version and arguments."""
        return Memory(self.kept, verbose=0).cache(_perform, ignore=["program"])

    def run(self, runs: Sequence[Run], title: str) -> dict[Run, Table]:
        """Every run's table; those that are on disk already are read only."""
        wanted = list(dict.fromkeys(runs))
        jobs = (delayed(self._kept_run)(self.program, self.version, run.arguments()) for run in wanted)
        done = Parallel(self.processes, prefer="threads", return_as="generator")(jobs)
        bar = tqdm(done, total=len(wanted), unit="run", desc=title, disable=not self.show_progress)
        tables = {}
        for run, (table, seconds) in zip(wanted, bar, strict=True):
            tables[run] = table
            self.spent += seconds
        return tables

    def theory(self, scene: str, quantity: str, **settings: Sequence[float] | float) -> Table:
        """What `jostle theory` prints; `__` in a name stands for a dot. All combinations, the first name slowest."""
        words = [str(self.program), "theory", scene, quantity]
        for name, values in settings.items():
            numbers = [values] if isinstance(values, int | float) else values
            words += ["--set", name.replace("__", ".") + "=" + ",".join(repr(float(number)) for number in numbers)]
        return parse_csv(output_of(words))


def _perform(program: Path, version: str, arguments: list[str]) -> tuple[Table, float]:
    """Table of a run and the seconds that it took; `version` is there for joblib: another program, another run."""
    del version
    begun = time.perf_counter()
    with tempfile.TemporaryDirectory(prefix="jostle-") as folder:
        output = Path(folder) / "run.csv"
        output_of([str(program), *arguments, "--output", str(output)])
        return parse_csv(output.read_text()), time.perf_counter() - begun
