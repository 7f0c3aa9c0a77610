"""Runs by the native command line, a process for each: for another build than that of the Python package."""

import socket
import tempfile
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from jostle_lab.errors import LabError
from jostle_lab.locate import fingerprint
from jostle_lab.programs import timed
from jostle_lab.runs.build import Performed, too_long
from jostle_lab.runs.run import Run
from jostle_lab.tables import parse_csv


@dataclass(frozen=True)
class Program:
    """The native command line, by its path and its bytes."""

    path: str
    version: str
    limit: float | None = None
    """Longest time on the clock of one run [s]."""

    def perform(self, run: Run) -> Performed:
        """See `Build.perform`."""
        here = _version_here(self.path)
        if here != self.version:
            raise LabError(
                f"{socket.gethostname()}: {self.path} is build {here}, the sweep was started with {self.version}. "
                "Put the same program there, or give --program a path that is the same on every worker."
            )
        with tempfile.TemporaryDirectory(prefix="jostle-") as folder:
            output, messages = Path(folder) / "run.csv", Path(folder) / "messages"
            ended = timed([self.path, *run.arguments(), "--output", str(output)], messages, self.limit)
            if ended.code != 0:
                late = f"{too_long(self.limit)} " if self.limit and ended.clock_seconds >= self.limit else ""
                error = f"{late}Exit code {ended.code}. {messages.read_text(errors='replace').strip()}"
                return Performed({}, error, ended.processor_seconds, ended.clock_seconds)
            table = parse_csv(output.read_text())
        outputs = {name: float(column[-1]) for name, column in table.items() if "[" not in name}
        return Performed(outputs, None, ended.processor_seconds, ended.clock_seconds)


@lru_cache
def _version_here(path: str) -> str:
    return fingerprint(Path(path))
