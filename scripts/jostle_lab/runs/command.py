"""`jostle-lab sweep`. What takes long to import is imported when it is needed."""

from collections import Counter
from pathlib import Path
from typing import Annotated, Any

import typer

from jostle_lab import locate, options
from jostle_lab.errors import LabError
from jostle_lab.runs.build import Build
from jostle_lab.runs.grid import ENGINES, make_grid, read_grid
from jostle_lab.runs.limits import Parameters, of_package, of_program, refuse_what_no_run_takes, without_needless_seeds


def sweep(
    file: Annotated[Path | None, typer.Argument(help="Grid in TOML; see below. Options go over what it says.")] = None,
    scene: Annotated[str | None, typer.Option(help=f"Scene: {', '.join(ENGINES)}.")] = None,
    engine: Annotated[str | None, typer.Option(help="Engine, if not the scene's first.")] = None,
    drive: Annotated[str | None, typer.Option(help="What moves the base, if not a sine.")] = None,
    seconds: Annotated[float | None, typer.Option(help="Simulated seconds of each run.")] = None,
    seeds: Annotated[int | None, typer.Option(min=1, help="Seeds of each combination, from 1 on.")] = None,
    fixed: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="The same in all runs; disks=20 is the number of disks."),
    ] = None,
    axes: Annotated[
        list[str] | None,
        typer.Option("--grid", metavar="NAME=VALUES", help="Axis: a,b,c or FROM:TO:COUNT, ends included; repeatable."),
    ] = None,
    results: Annotated[Path, typer.Option(help="Folder of the Parquet parts.")] = Path("results/sweep"),
    scheduler: options.SchedulerOption = None,
    processes: options.ProcessesOption = 2,
    program: Annotated[
        Path | None,
        typer.Option(help="A native command line, such as that of another build, instead of the package jostle."),
    ] = None,
    limit: Annotated[float | None, typer.Option(min=1e-3, help="Longest time on the clock of one run [s].")] = None,
    retry_failed: Annotated[bool, typer.Option("--retry-failed", help="Do failed runs again.")] = False,
    progress: options.ProgressOption = True,
) -> None:
    """Run every combination of a grid of parameters, into Parquet; it may be killed and repeated at any time.

    The file: scene, engine, drive, seconds, seeds (a number or a list), a table [set] and a table [grid] of lists or
    {from = , to = , count = }. A failed run is kept with its error. Read the results with any reader of Parquet.
    """
    from jostle_lab.runs.store import Store
    from jostle_lab.runs.sweep import Sweep, Workers
    from jostle_lab.runs.worker import DONE, FAILED

    changes: dict[str, Any] = {"scene": scene, "engine": engine, "drive": drive, "seconds": seconds, "seeds": seeds}
    changes["set"] = dict(options.parameters(fixed))
    named = [_axis(text) for text in axes or []]
    options.once("--grid", [name for name, _ in named])
    changes["grid"] = dict(named)
    grid = read_grid(file, changes) if file is not None else make_grid({}, changes, "sweep")
    build, known = _build(program, limit)
    runs = without_needless_seeds(known, grid.runs())
    refuse_what_no_run_takes(known, runs)
    rows = Sweep(Store(results), build, Workers(scheduler, processes), progress, retry_failed).run(runs)
    states = Counter(row["state"] for row in rows.values())
    typer.echo(f"{len(rows)} runs in {results}: {states[DONE]} done, {states[FAILED]} failed")
    for row in [row for row in rows.values() if row["state"] == FAILED][:3]:
        typer.echo(f"failed: {row['command']}\n  {row['error']}", err=True)
    if states[FAILED]:
        raise SystemExit(1)


def _build(program: Path | None, limit: float | None) -> tuple[Build, Parameters]:
    """The package `jostle`, or a program if one is named; and what tells its parameters."""
    if program is None:
        from jostle_lab.runs.package import Package, installed_version

        return Package(installed_version(), limit), of_package
    from jostle_lab.runs.native import Program

    native = locate.program(program).resolve()
    return Program(str(native), locate.fingerprint(native), limit), of_program(native)


def _split(option: str, text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals or not name.strip() or not value.strip():
        raise LabError(f"{option} {text} is not NAME=VALUE.")
    return name.strip(), value.strip()


def _number(option: str, text: str, word: str) -> float:
    try:
        return float(word)
    except ValueError:
        raise LabError(f"{option} {text}: {word} is not a number.") from None


def _axis(text: str) -> tuple[str, Any]:
    name, value = _split("--grid", text)
    if ":" not in value:
        return name, [_number("--grid", text, word) for word in value.split(",")]
    words = value.split(":")
    if len(words) != 3 or not words[2].isdigit():
        raise LabError(f"--grid {text}: a range is FROM:TO:COUNT, such as drive.frequency=15:40:26")
    low, high = (_number("--grid", text, word) for word in words[:2])
    return name, {"from": low, "to": high, "count": int(words[2])}
