"""One run in this process, by the Python package `jostle`. Of this folder only this file imports the package."""

import math
import warnings
from functools import lru_cache
from pathlib import Path

import jostle
from jostle import JostleError, _core
from jostle.variables import Variable, grouped
from jostle_lab.locate import fingerprint
from jostle_lab.runs.run import Run

__all__ = ["JostleError", "last_values", "variables", "version"]


@lru_cache
def version() -> str:
    """Fingerprint of the compiled module: the same bytes, the same numbers."""
    return fingerprint(Path(_core.__file__))


def last_values(run: Run) -> dict[str, float]:
    """Do a run; return the last values of the time and of all outputs that do not belong to a single disk.

    The steps are those of `jostle run`, from row to row, so that the numbers have the same bits. Raises JostleError for
    what is refused.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", jostle.JostleWarning)  # a grid may well go where parameters are doubtful
        values = dict(run.settings)
        simulation = jostle.Simulation(run.scene, engine=run.engine, drive=run.drive, disks=run.disks, **values)
    # A remainder below a billionth of a step is rounding, not a step.
    for step in range(1, max(math.ceil(run.seconds / run.sample - 1e-9), 1) + 1):
        simulation.advance_to(min(step * run.sample, run.seconds))
    names = _scalar_outputs(run.scene, run.engine, run.drive)
    return {"time": simulation.time, **{name: float(simulation[name]) for name in names}}


def variables(scene: str, engine: str, drive: str, disks: int | None = None) -> dict[str, Variable]:
    """The variables of a scene by name; raises JostleError for one that there is not. Nothing is built."""
    return grouped(_core.Core(scene, engine, drive, disks).variables())


@lru_cache
def _scalar_outputs(scene: str, engine: str, drive: str) -> list[str]:
    found = variables(scene, engine, drive).values()
    return [v.name for v in found if v.causality == "output" and not v.is_array and "[" not in v.name]
