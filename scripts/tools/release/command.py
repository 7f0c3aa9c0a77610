"""`python -m tools binaries` and `verify`: what `scripts/release` built, measured and run."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab.errors import LabError
from jostle_lab.tables import write_table
from tools.paths import BUILD, TARGET
from tools.release import page, systems
from tools.release.binaries import COLUMNS, bundle, release_rows, strangers, tools, unknown
from tools.release.verify import verify as verify_release

Folder = Annotated[Path, typer.Argument(help="Folder that scripts/release made.")]


def binaries(
    folder: Folder = BUILD / "release",
    symbols: Annotated[Path | None, typer.Option(help="Folder of the same libraries with their symbols.")] = None,
    native: Annotated[Path, typer.Option(help="Folder of a plain build, to compare.")] = TARGET / "release",
    data: Annotated[
        Path | None, typer.Option(help="Keep the rows in this folder and write the page beside it.")
    ] = None,
) -> None:
    """Print the size of each FMU and library, and what it needs; refuse what needs more than it may."""
    for given in (folder, symbols):
        if given is not None and not given.is_dir():
            raise LabError(f"The folder {given} does not exist. Make it with scripts/release, or name another.")
    if symbols is not None:
        if words := unknown(symbols):
            raise LabError(f"no symbol in {symbols} holds {words}. Was a module renamed? Correct binaries.py")
        for library in sorted(symbols.glob("libjostle_*.so")):
            if library.stem != "libjostle_c" and (found := strangers(library)):
                raise LabError(f"{library} holds {len(found)} symbols of other scenes, such as {found[0]}")
    rows = release_rows(folder, native)
    others = systems.system_rows(folder)
    typer.echo(page.table(rows))
    typer.echo(page.table_of_systems(others))
    if data is not None:
        data.mkdir(parents=True, exist_ok=True)
        write_table(data / "sizes.csv", rows, COLUMNS)
        write_table(data / "systems.csv", others, systems.COLUMNS)
        write_table(data / "tools.csv", tools())
        data.with_suffix(".md").write_text(page.page(data))


def bundle_release(
    folder: Folder,
    program: Annotated[Path, typer.Argument(help="The program jostle that writes them.")],
) -> None:
    """Write the FMUs of all libraries in a folder, and measure nothing."""
    bundle(folder, program)


def verify(
    folder: Folder = BUILD / "release",
    probe: Annotated[list[Path] | None, typer.Option(help="FMU that panics on demand; may be repeated.")] = None,
) -> None:
    """Replay and simulate each FMU in a folder, and see that a panic in the probe stays in its instance."""
    for line in verify_release(folder, probe or []):
        typer.echo(line)
