"""One run of a sweep, on whatever machine: a run in, a row out."""

import socket
from datetime import UTC, datetime

from jostle_lab.runs.build import Build, key
from jostle_lab.runs.run import Run
from jostle_lab.tables import Row

FAILED, DONE = "failed", "done"


def identity(build: Build, run: Run) -> Row:
    """The columns that are known before a run."""
    settings = {f"set.{name}": float(value) for name, value in run.settings if name != "seed"}
    return {
        "key": key(build, run),
        "program": build.version,
        "scene": run.scene,
        "engine": run.engine,
        "drive": run.drive,
        "disks": run.disks,
        "seconds": float(run.seconds),
        "seed": run.seed,
        **settings,
        "command": " ".join(["jostle", *run.arguments()]),
    }


def failure(build: Build, run: Run, error: str) -> Row:
    """Row of a run that failed."""
    return {**identity(build, run), "state": FAILED, "error": error, "finished": _now()}


def perform(build: Build, run: Run) -> Row:
    """Run and return the row: the last values of all outputs that do not belong to a single disk.

    A run that is refused, given up or stopped gets a row that says so. Raises LabError if the build is not what the
    sweep was started with.
    """
    done = build.perform(run)
    measured = {
        "processor_seconds": done.processor_seconds,
        "clock_seconds": done.clock_seconds,
        "host": socket.gethostname(),
    }
    if done.error is not None:
        return {**failure(build, run, done.error), **measured}
    return {**identity(build, run), "state": DONE, "error": None, "finished": _now(), **measured, **done.outputs}


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="milliseconds")
