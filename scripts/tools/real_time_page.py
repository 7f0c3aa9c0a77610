"""`docs/generated/real-time.md` from the files of `jostle-bench real-time`: what a step takes."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab.errors import LabError
from jostle_lab.tables import markdown_table, read_text_rows
from tools.paths import REAL_TIME, REAL_TIME_PAGE

Row = dict[str, str]

HEAD = """# Real time

Written by `python -m tools real-time` from `docs/generated/real-time/*.csv`, which `jostle-bench real-time` measured:
how long `fmi3DoStep` takes at the rates at which controllers run. The library of each FMU is loaded as an importer does
it. The base is on inputs: before each step `base.displacement` and `base.velocity` of a sine of 80 Hz and Gamma = 2 are
set, after it four outputs are read. Everything else is at its start value.
"""
COLUMNS = """Times are of one call. Unless it says wall, a time is CPU time of the calling thread, which leaves out what
other programs take, but not what they push out of the caches, nor interrupts. Each case was run twice with the same
steps. A run ends after 100,000 steps or after its budget of CPU time, so that slow cases have fewer.

- **mean**, **99 %**, **99.99 %**, **worst**: of all steps of both runs. 99.99 % stands where both together have 20,000
  steps or more.
- **worst twice**: the longest of the shorter of both times of each step. Both runs do the same to the bit: what is long
  in one of them alone is not the work of the library.
- **wall 99.99 %**, **wall worst**: by the wall clock, with all that the operating system does meanwhile. On a machine
  that several programs share this is the scheduler; a system for real time gives the controller a core of its own.
- **factor**: communication step over mean CPU time, how many times faster than real time.
- **worst / step**: the share of the communication step that **worst twice** takes. More than 100 % misses a deadline.
"""
LONGEST = """## What makes a step long

- Velocity Verlet does as much in each time step, and a communication step has as many of these as fit, give or take
  one. The longest steps are those in which the list of all neighbours is made anew from the grid of cells: with 60
  disks at 5 kHz they take less than half more than others.
- Event-driven: the number of impacts in the step. They come together while the base goes up, and with many layers of
  disks one push runs through all of them; such packings come close to inelastic collapse, and time there is no bound.
- What is above that in **worst** is the machine: caches, interrupts, other programs.
"""
ALLOCATIONS = """## Memory

No step allocates or frees memory: set inputs, step, read outputs, in both versions of FMI, for every scene, engine and
drive. The test `tests/no_allocation` counts the calls of the allocator. Left are calls that no loop in real time makes:
a refused step with its message, saving a state, and steps that report events inside of them by an intermediate
update, which keep a state to go back to. Lists of neighbours have room for three contacts a disk, which equal disks
cannot exceed. Hard disks with more than 15 neighbours, such as a large one among small ones, make all lists wider once.
"""
TIMES = {
    "mean": "mean [us]",
    "percentile_99": "99 %",
    "percentile_9999": "99.99 %",
    "worst": "worst",
    "worst_twice": "worst twice",
    "wall_percentile_9999": "wall 99.99 %",
    "wall_worst": "wall worst",
}
"""Columns of the file and of the page."""
HEADER = ("disks", "rate [kHz]", "steps", *TIMES.values(), "factor", "worst / step")


def page(folder: Path) -> str:
    """The page as Markdown."""
    rows = read_text_rows([folder / "steps.csv"])
    parts = [HEAD.rstrip(), COLUMNS.rstrip(), _machine(folder)]
    for scene, engine in dict.fromkeys((row["scene"], row["engine"]) for row in rows):
        chosen = [row for row in rows if (row["scene"], row["engine"]) == (scene, engine)]
        measured = [row for row in chosen if not row["refused"]]
        parts.append(f"## {scene}, {engine}")
        parts.append(markdown_table(HEADER, [_cells(row) for row in measured]) if measured else "")
        parts += [_refusals([row for row in chosen if row["refused"]])]
    parts += [_others(rows), LONGEST.rstrip(), ALLOCATIONS.rstrip()]
    return "\n\n".join(part for part in parts if part) + "\n"


def _machine(folder: Path) -> str:
    machine = {row["name"]: row["value"] for row in read_text_rows([folder / "machine.csv"])}
    return (
        f"Machine: {machine['processor']}, {machine['cores']} cores, shared with other programs at work. Target: "
        f"{machine['target']}. Version {machine['version']}. The clock of CPU time adds "
        f"{_micro(machine['clock_cost'])} us to each reading; it is not taken off."
    )


def _cells(row: Row) -> list[str]:
    step = 1.0 / float(row["rate"])
    factor, share = step / float(row["mean"]), 100.0 * float(row["worst_twice"]) / step
    times = [_micro(row[name]) for name in TIMES]
    return [row["disks"], f"{float(row['rate']) / 1e3:g}", row["steps"], *times, _digits(factor), f"{_digits(share)} %"]


def _refusals(refused: list[Row]) -> str:
    lines = [f"- {row['disks']} disks, {float(row['rate']) / 1e3:g} kHz: {row['refused']}" for row in refused]
    return "Refused:\n" + "\n".join(lines) if lines else ""


def _others(rows: list[Row]) -> str:
    measured = [row for row in rows if not row["refused"]]
    if not measured:
        return ""
    exchange = sorted(float(row["set_and_get"]) for row in measured)
    faults = sum(int(row["page_faults"]) for row in measured)
    steps = 2 * sum(int(row["steps"]) for row in measured)
    return (
        f"## The other calls\n\nSetting two inputs and reading four outputs takes {_micro(exchange[0])} to "
        f"{_micro(exchange[-1])} us by the wall clock, in the mean of a case. In all {steps:,} steps there were "
        f"{faults} page faults."
    )


def _micro(seconds: str | float) -> str:
    return _digits(float(seconds) * 1e6) if seconds != "" else "-"


def _digits(number: float) -> str:
    """Three digits."""
    return f"{number:.3g}" if number < 1000 else f"{round(number):,}"


def real_time(
    data: Annotated[Path, typer.Option(help="Folder that `jostle-bench real-time --out` wrote.")] = REAL_TIME,
    out: Annotated[Path, typer.Option(help="Markdown page.")] = REAL_TIME_PAGE,
) -> None:
    """Write the page of the time of a step from the results of `jostle-bench real-time`."""
    if not (data / "steps.csv").is_file():
        raise LabError(f"{data} has no steps.csv. Measure first: jostle-bench real-time --out {data}")
    out.write_text(page(data))
    typer.echo(out)
