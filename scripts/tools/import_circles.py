"""`python -m tools import-circles`: no two Rust files of a crate import each other, directly or through others.

A module and the modules inside it are one family: only imports between families count. Tests are left out.
"""

import re
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab.errors import LabError
from tools.paths import ROOT

Module = tuple[str, ...]
"""Path of a module inside its crate."""


def circle(source: Path) -> list[Module]:
    """Modules of the crate under `source` that import each other in a circle, the first also last; empty if none do."""
    files = dict(_modules(source))
    graph = {module: set(_imports(module, path.read_text(), files)) for module, path in files.items()}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def _modules(source: Path) -> Iterator[tuple[Module, Path]]:
    for path in sorted(source.rglob("*.rs")):
        parts = path.relative_to(source).with_suffix("").parts
        if "tests" not in parts:
            yield (parts[:-1] if parts[-1] in {"mod", "lib", "main"} else parts), path


def _imports(module: Module, text: str, files: dict[Module, Path]) -> Iterator[Module]:
    """Modules of other families that the text of a module names."""
    text = re.sub(r"(?s)#\[cfg\(test\)\]\s*mod tests \{.*|//[^\n]*", "", text)
    named = re.findall(r"\buse\s+([\w:{},*\s]+);", text) + re.findall(r"\b((?:crate|super|self)(?:::\w+)+)", text)
    for statement in named:
        for path in _expand(re.sub(r"\s+", "", statement)):
            target = _resolve(module, path.split("::"), files)
            if target is not None and target[: len(module)] != module and module[: len(target)] != target:
                yield target


def _resolve(module: Module, path: list[str], files: dict[Module, Path]) -> Module | None:
    """The longest module that a path leads to."""
    base = module
    if path[0] == "crate":
        base, path = (), path[1:]
    while path and path[0] in {"super", "self"}:
        base, path = (base[:-1] if path[0] == "super" else base), path[1:]
    targets = (base + tuple(path[:length]) for length in range(len(path), 0, -1))
    return next((target for target in targets if target in files), None)


def _expand(path: str) -> Iterator[str]:
    """`a::{b, c::{d, e}}` as `a::b`, `a::c::d`, `a::c::e`."""
    head, brace, rest = path.partition("{")
    if not brace:
        yield path
        return
    depth, begun, inside = 0, 0, rest[: rest.rindex("}")] + ","
    for place, letter in enumerate(inside):
        depth += (letter == "{") - (letter == "}")
        if letter == "," and depth == 0:
            if place > begun:
                yield from _expand(head + inside[begun:place])
            begun = place + 1


def import_circles(
    root: Annotated[Path, typer.Argument(help="Folder with the crates.")] = ROOT,
) -> None:
    """Look for Rust files that import each other in a circle."""
    sources = [path for path in sorted(root.glob("**/src")) if not {"target", ".venv", "build"} & set(path.parts)]
    found = {source: circle(source) for source in sources}
    circles = [
        f"{source.relative_to(root)}: " + " -> ".join("::".join(module) for module in modules)
        for source, modules in found.items()
        if modules
    ]
    if circles:
        raise LabError("\n".join(["files import each other in circles:", *circles]))
    typer.echo(f"{len(sources)} crates, no circle of imports")
