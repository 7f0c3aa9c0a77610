"""What the program allows for the parameters of a scene, asked before thousands of runs are refused one by one."""

import re
from collections.abc import Sequence
from pathlib import Path

from jostle_lab.errors import LabError, did_you_mean
from jostle_lab.programs import output_of
from jostle_lab.runs.run import Run

Range = tuple[float, float]
ANY: Range = (-float("inf"), float("inf"))


def parameters(program: Path, run: Run, disks: int | None = None) -> dict[str, Range]:
    """Name and range of every parameter and input; raises LabError for a scene, engine or drive that there is not."""
    words: list[str | Path] = [program, "describe", run.scene, "--engine", run.engine, "--drive", run.drive]
    words += ["--disks", str(disks)] if disks is not None else []
    table = output_of(words).partition("\n\n")[2]
    found = {}
    for line in table.splitlines()[1:]:
        name, causality, _, allowed, *_ = re.split(r"\s{2,}", line.strip())
        if causality in {"parameter", "input"}:
            found[name] = _range(allowed)
    return found


def _range(text: str) -> Range:
    """`A to B`; the number of options of an enumeration, `1 this, 2 that`; anything else is any number."""
    low, to, high = text.partition(" to ")
    if to:
        return float(low), float(high)
    numbers = [int(number) for number in re.findall(r"(?:^|, )(\d+) \S", text)]
    return (min(numbers), max(numbers)) if numbers else ANY


def refuse_what_no_run_takes(program: Path, runs: Sequence[Run]) -> None:
    """Raise LabError for names that the scene does not have and for values and numbers of disks out of their range."""
    counts = {run.disks for run in runs if run.disks is not None}
    # Names and ranges are the same for any number of disks.
    for count in sorted({min(counts), max(counts)}) if counts else [None]:
        known = parameters(program, runs[0], count)
    values: dict[str, set[float]] = {}
    for run in runs:
        for name, value in run.settings:
            values.setdefault(name, set()).add(value)
    for name, given in values.items():
        if name not in known:
            names = f"{runs[0].scene} with the engine {runs[0].engine} and the drive {runs[0].drive}"
            listed = f"List them: {program} describe {runs[0].scene} --engine {runs[0].engine} --drive {runs[0].drive}"
            raise LabError(f"{name} is no parameter of {names}.{did_you_mean(name, known)} {listed}")
        low, high = known[name]
        wrong = sorted(value for value in given if not low <= value <= high)
        if wrong:
            raise LabError(f"{name} = {wrong[0]:g} is outside [{low:g}, {high:g}]. Give values in this range.")
