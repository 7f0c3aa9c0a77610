"""Runs of the native command line: many at a time, each kept on disk and never done twice.

A run is found again by its arguments and by the program itself: rebuild the program and everything is run anew.
"""

import hashlib
import json
import subprocess
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from jostle_lab.errors import LabError

Table = dict[str, NDArray[np.float64]]
"""Columns by name."""


@dataclass(frozen=True)
class Run:
    """One `jostle run`."""

    scene: str
    engine: str
    seconds: float
    sample: float
    """Time from row to row [s]."""
    settings: tuple[tuple[str, float], ...]
    """Parameters by name."""
    disks: int | None = None
    """Number of disks; None: the scene's own."""
    drive: str = field(default="sine", kw_only=True)

    def arguments(self) -> list[str]:
        """Arguments of `jostle`, without the output file."""
        words = ["run", self.scene, "--engine", self.engine, "--drive", self.drive]
        words += ["--disks", str(self.disks)] if self.disks is not None else []
        words += ["--seconds", repr(self.seconds), "--sample", repr(self.sample)]
        for name, value in self.settings:
            words += ["--set", f"{name}={value!r}"]
        return words


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

    def run(self, runs: Sequence[Run], title: str) -> dict[Run, Table]:
        """Every run's table; those that are on disk already are read only."""
        self.kept.mkdir(parents=True, exist_ok=True)
        wanted = list(dict.fromkeys(runs))
        missing = [run for run in wanted if not self._record(run).exists()]
        with (
            tqdm(
                total=len(wanted),
                initial=len(wanted) - len(missing),
                unit="run",
                desc=title,
                disable=not self.show_progress,
            ) as bar,
            ThreadPoolExecutor(self.processes) as pool,
        ):
            jobs = [pool.submit(self._do, run) for run in missing]
            try:
                for job in as_completed(jobs):
                    job.result()
                    bar.update()
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        return {run: self._read(run) for run in wanted}

    def example(self, name: str, *arguments: str) -> Table:
        """What a Rust example prints as CSV."""
        root = self.program.resolve().parents[2]
        words = ["cargo", "run", "--release", "--quiet", "--example", name, "--", *arguments]
        begun = time.perf_counter()
        done = subprocess.run(words, cwd=root, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise LabError(f"{' '.join(words)} failed in {root}:\n{done.stderr.strip()}")
        self.spent += time.perf_counter() - begun
        return parse_csv(done.stdout)

    def theory(self, scene: str, quantity: str, **settings: Sequence[float] | float) -> Table:
        """What `jostle theory` prints; `__` in a name stands for a dot. All combinations, the first name slowest."""
        words = [str(self.program), "theory", scene, quantity]
        for name, values in settings.items():
            numbers = [values] if isinstance(values, int | float) else values
            words += ["--set", name.replace("__", ".") + "=" + ",".join(repr(float(number)) for number in numbers)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise LabError(f"{' '.join(words)} failed:\n{done.stderr.strip()}")
        return parse_csv(done.stdout)

    def _path(self, run: Run) -> Path:
        key = hashlib.sha256("\n".join([self.version, *run.arguments()]).encode()).hexdigest()[:20]
        return self.kept / f"{key}.csv"

    def _record(self, run: Run) -> Path:
        return self._path(run).with_suffix(".json")

    def _do(self, run: Run) -> None:
        path = self._path(run)
        draft = path.with_suffix(".draft.csv")
        begun = time.perf_counter()
        words = [str(self.program), *run.arguments(), "--output", str(draft)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise LabError(f"{' '.join(words)} failed:\n{done.stderr.strip()}")
        draft.with_suffix(".parameters.csv").unlink(missing_ok=True)
        draft.replace(path)
        took = time.perf_counter() - begun
        record = {"program": self.version, "arguments": run.arguments(), "seconds": took}
        self._record(run).write_text(json.dumps(record) + "\n")  # last: its presence says that the run is whole

    def _read(self, run: Run) -> Table:
        self.spent += float(json.loads(self._record(run).read_text())["seconds"])
        return parse_csv(self._path(run).read_text())


def fingerprint(program: Path) -> str:
    """First digits of the checksum of a program: the same bytes, the same numbers."""
    if not program.is_file():
        raise LabError(f"{program} is not there. Build it: cargo build --release --bin jostle")
    return hashlib.sha256(program.read_bytes()).hexdigest()[:12]


def parse_csv(text: str) -> Table:
    """A CSV table of numbers with a header, by columns."""
    lines = text.strip().splitlines()
    names = lines[0].split(",")
    numbers = np.array([[float(word) for word in line.split(",")] for line in lines[1:]]).reshape(-1, len(names))
    return {name: numbers[:, column] for column, name in enumerate(names)}
