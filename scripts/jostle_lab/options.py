"""Options that several commands have."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab.errors import LabError, repeated

LARGEST_SEED = 2**31 - 1
"""What an integer of FMI 2.0 holds."""

ProgramOption = Annotated[
    Path | None, typer.Option(help="The native command line. Without it: JOSTLE_PROGRAM, beside Python, or PATH.")
]
FmuOption = Annotated[
    Path | None,
    typer.Option(help="FMU with inputs, FMI 2.0 or 3.0. Without it: the one in the folder JOSTLE_FMUS."),
]
ResultsOption = Annotated[Path, typer.Option(help="Folder for tables, pictures and pages.")]
ProcessesOption = Annotated[int, typer.Option(min=1, max=256, help="Runs at the same time on this machine.")]
ProgressOption = Annotated[bool, typer.Option(help="Show progress bars.")]
SchedulerOption = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Dask scheduler, such as tcp://host:8786. Without it: this machine."),
]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="FMU parameter, such as contact.friction=0.2; may be repeated."),
]


def parameters(assignments: list[str] | None, seed: str = "") -> tuple[tuple[str, float], ...]:
    """Names and numbers of `--set` options, each name once; not `seed`, if an option called `seed` decides it."""
    found = [assignment("--set", text, "--set contact.friction=0.2") for text in assignments or []]
    names = once("--set", [name for name, _ in found])
    if seed and "seed" in names:
        raise LabError(f"--set seed is not taken here, since {seed} says which seeds there are. Use {seed}.")
    return tuple(found)


def once(option: str, names: list[str]) -> list[str]:
    """The names; raises LabError if one is there twice, since only one of its values would count."""
    if twice := repeated(names):
        raise LabError(f"{option} {twice[0]} is given more than once. Leave one of them out.")
    return names


def assignment(option: str, text: str, example: str) -> tuple[str, float]:
    """Name and number of NAME=NUMBER."""
    name, equals, value = text.partition("=")
    try:
        if not (equals and name.strip()):
            raise ValueError
        return name.strip(), float(value)
    except ValueError:
        raise LabError(f"{option} {text} is not NAME=NUMBER. Write, say, {example}") from None
