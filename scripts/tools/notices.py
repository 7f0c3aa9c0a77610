"""`python -m tools notices`: whose code is linked into what ships, and the notices that must go with it."""

import itertools
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab.errors import LabError
from jostle_lab.programs import completed
from tools.paths import NOTICES, ROOT

FILE = NOTICES.name
"""In the root of the repository, in each FMU, and beside the C library."""

STANDARD_LIBRARY = Path(__file__).with_name("notices_of_rust.txt")
"""Kept by hand: the Rust standard library is no package of cargo's."""

SHIPPED = "x86_64-unknown-linux-gnu"
"""Platform of the command line that `scripts/release` makes."""

PREFERRED = "MIT"
"""Where a crate leaves the choice, this licence is taken: short, and the one that most of them offer."""

HEAD = f"""Notices of the software that {{what}} besides jostle itself.

Written by `python -m tools notices` from Cargo.lock and the licence files of each crate; not to be edited by
hand. Where a crate may be had under one of several licences, jostle takes it under {PREFERRED}.
"""

LICENCE_FILE = re.compile(r"(LICEN[CS]E|COPYING|UNLICENSE)", re.IGNORECASE)
ALWAYS = re.compile(r"(COPYRIGHT|NOTICE)", re.IGNORECASE)


@dataclass(frozen=True)
class Crate:
    """A package that is linked."""

    name: str
    version: str
    licence: str
    folder: Path

    @property
    def title(self) -> str:
        """Name and version."""
        return f"{self.name} {self.version}"


def notices_of_fmus(root: Path = ROOT) -> str:
    """The whole text for the workspace at `root`; it needs the sources that `cargo fetch` puts on this machine."""
    packages, own = _packages(root)
    fmus = [name for name, version in own if Path(packages[name, version]["manifest_path"]).parts[-3] == "fmu"]
    in_fmus = linked(_tree(root, fmus)) - own
    in_library = linked(_tree(root, ["jostle-c"])) - own
    lists = {
        "In the FMUs and in the C library:": [_crate(packages[key]) for key in sorted(in_fmus)],
        "In the C library alone:": [_crate(packages[key]) for key in sorted(in_library - in_fmus)],
    }
    return compose("jostle's FMUs and its C library hold", lists, STANDARD_LIBRARY.read_text(encoding="utf-8"))


def notices_of_command_line(root: Path = ROOT) -> str:
    """The same for the program `jostle`, which is shipped beside the FMUs and holds more than they do."""
    packages, own = _packages(root)
    crates = [_crate(packages[key]) for key in sorted(linked(_tree(root, ["jostle-cli"], SHIPPED)) - own)]
    lists = {"In the command line:": crates}
    return compose("jostle's command line holds", lists, STANDARD_LIBRARY.read_text(encoding="utf-8"))


def linked(tree: str) -> set[tuple[str, str]]:
    """Name and version of each package in the answer of `cargo tree --prefix none --format {p}`."""
    return {(name, version) for name, version in re.findall(r"^(\S+) v(\S+)", tree, re.MULTILINE)}


def compose(what: str, lists: dict[str, list[Crate]], standard_library: str) -> str:
    """The text: lists of crates under their headings, then each notice once with the crates that it belongs to."""
    owners: dict[str, list[str]] = {}
    for crate in itertools.chain.from_iterable(lists.values()):
        for text in texts(crate):
            owners.setdefault(text, []).append(crate.title)
    rule = "-" * 80
    blocks = [f"{rule}\n{', '.join(titles)}\n{rule}\n\n{text}\n" for text, titles in owners.items()]
    tables = [_list(heading, crates) for heading, crates in lists.items()]
    return "\n".join([HEAD.format(what=what), *tables, *blocks, f"{rule}\n{_clean(standard_library)}\n"])


def texts(crate: Crate) -> list[str]:
    """The notices of a crate, each without blanks at the ends of its lines.

    Of several licences to choose from only the preferred one; copyright and notice files always.
    """
    files = sorted(path for path in crate.folder.iterdir() if path.is_file())
    licences = [path for path in files if LICENCE_FILE.match(path.name)]
    if PREFERRED in re.split(r"\s+OR\s+|/", crate.licence):
        licences = [path for path in licences if PREFERRED in path.name.upper()] or licences
    if not licences:
        raise LabError(f"{crate.title} has no licence file in {crate.folder}. Use a crate that brings its licence")
    extra = [path for path in files if ALWAYS.match(path.name)]
    return [_clean(path.read_text(encoding="utf-8")) for path in [*licences, *extra]]


def notices(
    out: Annotated[Path, typer.Option(help="File to write.")] = NOTICES,
    command_line: Annotated[bool, typer.Option("--command-line", help="Those of the program jostle instead.")] = False,
) -> None:
    """Write the notices of all crates that are linked into the FMUs and the C library."""
    out.write_text(notices_of_command_line() if command_line else notices_of_fmus(), encoding="utf-8")
    typer.echo(out)


def _packages(root: Path) -> tuple[dict[tuple[str, str], dict[str, str]], set[tuple[str, str]]]:
    """All packages by name and version, and which of them are this workspace's."""
    metadata = json.loads(_cargo(root, "metadata", "--format-version", "1"))
    packages = {(found["name"], found["version"]): found for found in metadata["packages"]}
    return packages, {key for key, found in packages.items() if found["source"] is None}


def _list(heading: str, crates: Sequence[Crate]) -> str:
    width = max((len(crate.title) for crate in crates), default=0)
    return "\n".join([heading, *(f"  {crate.title:{width}}  {crate.licence}" for crate in crates), ""])


def _crate(package: dict[str, str]) -> Crate:
    return Crate(package["name"], package["version"], package["license"] or "", Path(package["manifest_path"]).parent)


def _clean(text: str) -> str:
    return "\n".join(line.rstrip() for line in text.strip("\n").splitlines())


def _tree(root: Path, packages: Sequence[str], platform: str = "all") -> str:
    """What is linked on a platform: neither build dependencies nor macros that run in the compiler."""
    chosen = [argument for package in sorted(packages) for argument in ("--package", package)]
    shown = ["--edges", "normal,no-proc-macro", "--target", platform, "--prefix", "none", "--format", "{p}"]
    return _cargo(root, "tree", *chosen, *shown)


def _cargo(root: Path, *arguments: str) -> str:
    command = ["cargo", *arguments, "--locked", "--offline"]
    done = completed(command, root)
    if done.returncode != 0:
        raise LabError(f"cargo {arguments[0]} failed: {done.stderr.strip()[-400:]}. Try: cargo fetch --locked")
    return done.stdout
