"""What the scenes allow for their parameters, asked before thousands of runs are refused one by one."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from jostle_lab.errors import LabError, did_you_mean
from jostle_lab.programs import output_of
from jostle_lab.runs.run import Run

Range = tuple[float, float]
ANY: Range = (-float("inf"), float("inf"))
Parameters = Callable[[Run, int | None], dict[str, Range]]
"""Name and range of every parameter and input of the scene of a run with so many disks (None: its own).

Raises LabError for a scene, engine, drive or number of disks that there is not.
"""


def of_package(run: Run, disks: int | None = None) -> dict[str, Range]:
    """`Parameters` of the Python package `jostle`."""
    from jostle_lab.runs.simulated import JostleError, variables  # noqa: PLC0415 - not for sweeps by a program

    try:
        found = variables(run.scene, run.engine, run.drive, disks)
    except JostleError as refused:
        raise LabError(str(refused)) from None
    return {v.name: (v.minimum, v.maximum) for v in found.values() if v.causality in {"parameter", "input"}}


def of_program(program: Path) -> Parameters:
    """`Parameters` of a native command line."""

    def parameters(run: Run, disks: int | None = None) -> dict[str, Range]:
        words: list[str | Path] = [program, "describe", run.scene, "--engine", run.engine, "--drive", run.drive]
        words += ["--disks", str(disks)] if disks is not None else []
        table = output_of(words).partition("\n\n")[2]
        found = {}
        for line in table.splitlines()[1:]:
            name, causality, _, allowed, *_ = re.split(r"\s{2,}", line.strip())
            if causality in {"parameter", "tunable parameter", "input"}:
                found[name] = _range(allowed)
        return found

    return parameters


def _range(text: str) -> Range:
    """`A to B`; the number of options of an enumeration, `1 this, 2 that`; anything else is any number."""
    low, to, high = text.partition(" to ")
    if to:
        return float(low), float(high)
    numbers = [int(number) for number in re.findall(r"(?:^|, )(\d+) \S", text)]
    return (min(numbers), max(numbers)) if numbers else ANY


def without_needless_seeds(parameters: Parameters, runs: Sequence[Run]) -> Sequence[Run]:
    """The runs, without their seed if nothing in the scene is random; raises LabError for several seeds then."""
    if "seed" in parameters(runs[0], None):
        return runs
    if len({run.seed for run in runs}) > 1:
        raise LabError(
            f"Nothing in {runs[0].scene} with the drive {runs[0].drive} is random: all seeds give the same run. "
            "Take one seed, or another drive."
        )
    return [replace(run, settings=tuple(one for one in run.settings if one[0] != "seed")) for run in runs]


def refuse_what_no_run_takes(parameters: Parameters, runs: Sequence[Run]) -> None:
    """Raise LabError for names that the scene does not have and for values and numbers of disks out of their range."""
    counts = {run.disks for run in runs if run.disks is not None}
    # Names and ranges are the same for any number of disks.
    for count in sorted({min(counts), max(counts)}) if counts else [None]:
        known = parameters(runs[0], count)
    values: dict[str, set[float]] = {}
    for run in runs:
        for name, value in run.settings:
            values.setdefault(name, set()).add(value)
    for name, given in values.items():
        if name not in known:
            names = f"{runs[0].scene} with the engine {runs[0].engine} and the drive {runs[0].drive}"
            listed = f"List them: jostle describe {runs[0].scene} --engine {runs[0].engine} --drive {runs[0].drive}"
            raise LabError(f"{name} is no parameter of {names}.{did_you_mean(name, known)} {listed}")
        low, high = known[name]
        wrong = sorted(value for value in given if not low <= value <= high)
        if wrong:
            raise LabError(f"{name} = {wrong[0]:g} is outside [{low:g}, {high:g}]. Give values in this range.")
