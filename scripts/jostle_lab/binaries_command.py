"""`python -m jostle_lab binaries` and `verify`: what `scripts/release` built, measured and run."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import binaries_page, points
from jostle_lab.binaries import COLUMNS, release_rows, strangers, tools
from jostle_lab.errors import LabError
from jostle_lab.verify import verify as verify_release

Folder = Annotated[Path, typer.Argument(help="Folder that scripts/release made.")]


def binaries(
    folder: Folder = Path("build/release"),
    symbols: Annotated[Path | None, typer.Option(help="Folder of the same libraries with their symbols.")] = None,
    native: Annotated[Path, typer.Option(help="Folder of a plain build, to compare.")] = Path("target/release"),
    data: Annotated[
        Path | None, typer.Option(help="Keep the rows in this folder and write the page beside it.")
    ] = None,
) -> None:
    """Print the size of each FMU and library, and what it needs; refuse what needs more than it may."""
    if symbols is not None:
        for library in sorted(symbols.glob("libjostle_*.so")):
            if library.stem != "libjostle_c" and (found := strangers(library)):
                raise LabError(f"{library} holds {len(found)} symbols of other scenes, such as {found[0]}")
    rows = release_rows(folder, native)
    typer.echo(binaries_page.table(rows))
    if data is not None:
        data.mkdir(parents=True, exist_ok=True)
        points.write(data / "sizes.csv", COLUMNS, rows)
        points.write(data / "tools.csv", ["tool", "version"], tools())
        data.with_suffix(".md").write_text(binaries_page.page(data))


def verify(
    folder: Folder = Path("build/release"),
    probe: Annotated[list[Path] | None, typer.Option(help="FMU that can be told to panic; may be repeated.")] = None,
) -> None:
    """Replay and simulate each FMU in a folder, and see that a panic in the probe stays in its instance."""
    for line in verify_release(folder, probe or []):
        typer.echo(line)
