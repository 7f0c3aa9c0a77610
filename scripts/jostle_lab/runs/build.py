"""What does the runs of a sweep, whatever build of jostle it is: named by its bytes, asked for one run at a time."""

from dataclasses import dataclass
from hashlib import sha256
from typing import Protocol

from jostle_lab.runs.run import Run


@dataclass(frozen=True)
class Performed:
    """What a run gave and what it cost."""

    outputs: dict[str, float]
    """Last values of the time and of all outputs that do not belong to a single disk; empty if it failed."""
    error: str | None
    """Why it failed."""
    processor_seconds: float
    clock_seconds: float


class Build(Protocol):
    """A build of jostle; goes to other machines by pickle."""

    @property
    def version(self) -> str:
        """`locate.fingerprint` of the program, or of the compiled module."""

    def perform(self, run: Run) -> Performed:
        """Do a run. A run that is refused, given up or too long is told in `error`.

        Raises LabError if the build on this machine is not the one of this version.
        """


def key(build: Build, run: Run) -> str:
    """Finds a run again: by the bytes of the build and by the arguments, so that another build is another run."""
    return sha256("\n".join([build.version, *run.arguments()]).encode()).hexdigest()[:20]


def too_long(limit: float) -> str:
    """Error of a run that was stopped after `limit` [s]."""
    return f"Stopped after {limit:g} s."
