"""Other programs, run to their end."""

import os
import subprocess
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from jostle_lab import stopping
from jostle_lab.errors import LabError


@dataclass(frozen=True)
class Ended:
    """How a program ended and what it cost."""

    code: int
    """Exit code; negative: the signal that ended it."""
    processor_seconds: float
    clock_seconds: float


def timed(words: Sequence[str | Path], messages: Path, limit: float | None = None) -> Ended:
    """Run a program, its messages into a file; `limit` [s] on the clock, after which it is killed.

    A command that is stopped kills it, from whatever thread it was started, and `stopping.Stopped` is raised.
    """
    begun = time.perf_counter()

    def start() -> subprocess.Popen[bytes]:
        with messages.open("wb") as file:
            return subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=file)

    with stopping.running(start) as process:
        timer = threading.Timer(limit, process.kill) if limit else None
        if timer:
            timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        finally:
            if timer:
                timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    stopping.check_ended_by(process.returncode)
    return Ended(process.returncode, usage.ru_utime + usage.ru_stime, time.perf_counter() - begun)


def completed(words: Sequence[str | Path], folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """A program that has ended, with what it printed; raises LabError if it cannot be started."""
    try:
        return subprocess.run(words, cwd=folder, capture_output=True, text=True, errors="replace", check=False)
    except OSError as error:
        if folder is not None and not folder.is_dir():
            raise LabError(f"The folder {folder} does not exist, where {words[0]} was to run. Name another.") from None
        raise LabError(f"{words[0]} cannot be started: {error.strerror}. Install it, or name another.") from None


def output_of(words: Sequence[str | Path], folder: Path | None = None) -> str:
    """What a program prints; raises LabError with its messages if it fails."""
    done = completed(words, folder)
    if done.returncode != 0:
        where = f" in {folder}" if folder else ""
        raise LabError(f"{' '.join(map(str, words))} failed{where}:\n{done.stderr.strip()}")
    return done.stdout
