"""One run of a sweep, on whatever machine: arguments in, a row out. Needs the program and this package there."""

import socket
import tempfile
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import lru_cache
from hashlib import sha256
from pathlib import Path

from jostle_lab.errors import LabError
from jostle_lab.locate import fingerprint
from jostle_lab.programs import timed
from jostle_lab.runs.run import Run
from jostle_lab.tables import Row, parse_csv

FAILED, DONE = "failed", "done"


@dataclass(frozen=True)
class Program:
    """The native command line, by its path and its bytes."""

    path: str
    version: str
    """`locate.fingerprint`."""
    limit: float | None = None
    """Longest time on the clock of one run [s]."""

    def key(self, run: Run) -> str:
        """Finds a run again: the program's bytes and the arguments."""
        return sha256("\n".join([self.version, *run.arguments()]).encode()).hexdigest()[:20]


@lru_cache
def _version_here(path: str) -> str:
    return fingerprint(Path(path))


def identity(program: Program, run: Run) -> Row:
    """The columns that are known before a run."""
    settings = {f"set.{name}": float(value) for name, value in run.settings if name != "seed"}
    seed = next((int(value) for name, value in run.settings if name == "seed"), None)
    return {
        "key": program.key(run),
        "program": program.version,
        "scene": run.scene,
        "engine": run.engine,
        "drive": run.drive,
        "disks": run.disks,
        "seconds": float(run.seconds),
        "seed": seed,
        **settings,
        "command": " ".join(["jostle", *run.arguments()]),
    }


def failure(program: Program, run: Run, error: str) -> Row:
    """Row of a run that failed."""
    return {**identity(program, run), "state": FAILED, "error": error, "finished": _now()}


def perform(program: Program, run: Run) -> Row:
    """Run and return the row: the last values of all outputs that do not belong to a single disk.

    A run that the program refuses or gives up gets a row that says so. Raises LabError if the program itself is not
    what the sweep was started with.
    """
    here = _version_here(program.path)
    if here != program.version:
        raise LabError(
            f"{socket.gethostname()}: {program.path} is build {here}, the sweep was started with {program.version}. "
            "Put the same program there, or give --program a path that is the same on every worker."
        )
    with tempfile.TemporaryDirectory(prefix="jostle-") as folder:
        output, messages = Path(folder) / "run.csv", Path(folder) / "messages"
        ended = timed([program.path, *run.arguments(), "--output", str(output)], messages, program.limit)
        spent, clock = ended.processor_seconds, ended.clock_seconds
        measured = {"processor_seconds": spent, "clock_seconds": clock, "host": socket.gethostname()}
        if ended.code != 0:
            late = f"Stopped after {program.limit:g} s. " if program.limit and clock >= program.limit else ""
            text = f"{late}Exit code {ended.code}. {messages.read_text(errors='replace').strip()}"
            return {**failure(program, run, text), **measured}
        outputs = {name: float(column[-1]) for name, column in parse_csv(output.read_text()).items() if "[" not in name}
    return {**identity(program, run), "state": DONE, "error": None, "finished": _now(), **measured, **outputs}


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="milliseconds")
