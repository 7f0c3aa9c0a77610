"""Our engines beside other programs on the same case, in turn, as a ratio.

Event-driven: a C++ source that takes `N packing_fraction warm_up collisions` and prints `ns/col=...`. Soft disks: one
that takes `state steps time_step` and prints `ns/particle-step=...`, beside our example `EXAMPLE`. Ours is built for
any x86-64, theirs with `-O3 -march=native -ffast-math` for this machine.
"""

import re
import statistics
import tempfile
from itertools import product
from pathlib import Path
from typing import Annotated, NamedTuple

import typer

from jostle_lab.errors import LabError
from jostle_lab.programs import completed
from tools.paths import ROOT, TARGET

EXAMPLE = "peer_molecular_dynamics"
SIZES = (60, 1000, 10_000, 100_000)
PACKING_FRACTION = 0.6
COLLISIONS = 2_000_000
SHELL = 1.8
DISK_STEPS = 20_000_000
"""Disks times steps of one run of soft disks."""
TIME_STEP = "1e-6"

Measurement = tuple[list[str], str]
"""A command, and the pattern of the number in its output."""


class Comparison(NamedTuple):
    """Nanoseconds of both programs, and the median of their ratios."""

    case: str
    ours: float
    theirs: float
    ratio: float


def compare(source: Path, rounds: int) -> list[Comparison]:
    """Event-driven: nanoseconds a collision, in packings of `SIZES` disks."""
    built = _run(["cargo", "bench", "--bench", "event_driven", "--no-run"])
    ours = ROOT / _text(built, r"Executable.*\((\S+/event_driven-[0-9a-f]+)\)")
    with tempfile.TemporaryDirectory() as folder:
        theirs = _compile(source, Path(folder))
        comparisons = []
        for size in SIZES:
            own = ([str(ours), str(size), str(SHELL), str(COLLISIONS)], r"([\d.]+) ns a collision")
            arguments = [str(size), str(PACKING_FRACTION), str(20 * size), str(COLLISIONS)]
            other = ([str(theirs), *arguments], r"ns/col=([\d.]+)")
            comparisons.append(_in_turn(f"{size} disks", own, other, rounds))
        return comparisons


def compare_soft_disks(source: Path, states: list[Path], copies: list[int], rounds: int) -> list[Comparison]:
    """Soft disks: nanoseconds a disk and step; each state is taken `copies` times side by side in a wider box."""
    _run(["cargo", "build", "--release", "--package", "jostle-bench", "--example", EXAMPLE])
    ours, pattern = TARGET / "release/examples" / EXAMPLE, r"ns/particle-step=([\d.]+)"
    with tempfile.TemporaryDirectory() as folder:
        theirs = _compile(source, Path(folder))
        comparisons = []
        for state, count in product(states, copies):
            wide = Path(folder) / f"{count} x {state.name}"
            wide.write_text(side_by_side(state.read_text(), count))
            disks = int(wide.read_text().split(maxsplit=1)[0])
            arguments = [str(wide), str(max(1, DISK_STEPS // disks)), TIME_STEP]
            own, other = (([str(program), *arguments], pattern) for program in (ours, theirs))
            comparisons.append(_in_turn(f"{disks} disks", own, other, rounds))
        return comparisons


def _compile(source: Path, folder: Path) -> Path:
    program = folder / "peer"
    _run(["g++", "-O3", "-march=native", "-ffast-math", "-std=c++17", str(source), "-o", str(program)])
    return program


def _in_turn(case: str, own: Measurement, other: Measurement, rounds: int) -> Comparison:
    """Medians over `rounds` runs of each program, in turn."""
    pairs = [[float(_text(_run(command), pattern)) for command, pattern in (own, other)] for _ in range(rounds)]
    ours, theirs = (statistics.median(column) for column in zip(*pairs, strict=True))
    return Comparison(case, ours, theirs, statistics.median(a / b for a, b in pairs))


def side_by_side(state: str, copies: int) -> str:
    """A state whose box holds so many copies of another, each beside the one before it."""
    header, *rows = state.strip().splitlines()
    count, width, height = header.split()
    lines = [f"{copies * int(count)} {copies * float(width)!r} {height}"]
    for copy in range(copies):
        for row in rows:
            radius, x, *rest = row.split()
            lines.append(" ".join([radius, repr(float(x) + copy * float(width)), *rest]))
    return "\n".join(lines) + "\n"


def _run(arguments: list[str]) -> str:
    done = completed(arguments, ROOT)
    if done.returncode != 0:
        raise LabError(f"{arguments[0]} failed: {done.stderr.strip()[-400:]}. Check that it is installed.")
    return done.stdout + done.stderr


def _text(output: str, pattern: str) -> str:
    found = re.search(pattern, output)
    if found is None:
        raise LabError(f"no {pattern!r} in the output: {output.strip()[-400:]}")
    return found.group(1)


def peers(
    source: Annotated[Path, typer.Argument(help="C++ source, such as refed.cpp, or refdem.cpp with --state.")],
    rounds: Annotated[int, typer.Option(min=1, max=50, help="Runs of each program, in turn.")] = 5,
    state: Annotated[
        list[Path] | None, typer.Option(help="State of soft disks, such as s60.txt; may be repeated.")
    ] = None,
    copies: Annotated[
        list[int] | None, typer.Option(min=1, help="With --state: copies of it side by side; may be repeated.")
    ] = None,
) -> None:
    """Measure an engine beside another program: nanoseconds a collision, or with --state a disk and step."""
    typer.echo("case            ours [ns]  theirs [ns]  ratio")
    found = compare_soft_disks(source, state, copies or [1], rounds) if state else compare(source, rounds)
    for row in found:
        typer.echo(f"{row.case:14} {row.ours:10.2f} {row.theirs:12.2f} {row.ratio:6.2f}")
