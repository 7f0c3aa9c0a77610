"""Our engines beside other programs on the same case, in turn, as a ratio.

Event-driven: a C++ source that takes `N packing_fraction warm_up collisions` and prints `ns/col=...`. Molecular
dynamics: one that takes `state steps time_step` and prints `ns/particle-step=...`, beside our example
`peer_molecular_dynamics`.
"""

import re
import statistics
import subprocess
import tempfile
from pathlib import Path

from jostle_lab.errors import LabError

SIZES = (60, 1000, 10_000, 100_000)
PACKING_FRACTION = 0.6
COLLISIONS = 2_000_000
SHELL = 1.8
DISK_STEPS = 20_000_000
"""Disks times steps of one run of molecular dynamics."""
TIME_STEP = "1e-6"


def compare(source: Path, rounds: int) -> list[tuple[int, float, float, float]]:
    """Rows of (disks, ours [ns a collision], theirs, ratio), medians over `rounds` runs in turn.

    Ours is built for any x86-64, theirs with `-O3 -march=native -ffast-math` for this machine.
    """
    ours = _our_bench()
    with tempfile.TemporaryDirectory() as folder:
        theirs = Path(folder) / "peer"
        _run(["g++", "-O3", "-march=native", "-ffast-math", "-std=c++17", str(source), "-o", str(theirs)])
        return [_row(ours, theirs, size, rounds) for size in SIZES]


def _row(ours: Path, theirs: Path, size: int, rounds: int) -> tuple[int, float, float, float]:
    pairs = []
    for _ in range(rounds):
        own = _figure(_run([str(ours), str(size), str(SHELL), str(COLLISIONS)]), r"([\d.]+) ns a collision")
        arguments = [str(theirs), str(size), str(PACKING_FRACTION), str(20 * size), str(COLLISIONS)]
        pairs.append((own, _figure(_run(arguments), r"ns/col=([\d.]+)")))
    own_median, their_median = (statistics.median(column) for column in zip(*pairs, strict=True))
    ratio = statistics.median(own / their for own, their in pairs)
    return size, own_median, their_median, ratio


def compare_molecular_dynamics(
    source: Path, states: list[Path], copies: list[int], rounds: int
) -> list[tuple[str, float, float, float]]:
    """Rows of (case, ours [ns a disk and step], theirs, ratio), medians over `rounds` runs in turn.

    Ours is built for any x86-64, theirs with `-O3 -march=native -ffast-math` for this machine. Each state is taken so
    many times side by side in a box as much wider.
    """
    example = "peer_molecular_dynamics"
    _run(["cargo", "build", "--release", "--example", example])
    ours = Path("target/release/examples") / example
    with tempfile.TemporaryDirectory() as folder:
        theirs = Path(folder) / "peer"
        _run(["g++", "-O3", "-march=native", "-ffast-math", "-std=c++17", str(source), "-o", str(theirs)])
        rows = []
        for state in states:
            for count in copies:
                wide = Path(folder) / f"{count} x {state.name}"
                wide.write_text(side_by_side(state.read_text(), count))
                rows.append(_molecular_row(ours, theirs, wide, rounds))
        return rows


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


def _molecular_row(ours: Path, theirs: Path, state: Path, rounds: int) -> tuple[str, float, float, float]:
    with state.open() as lines:
        count = int(lines.readline().split()[0])
    arguments = [str(state), str(max(1, DISK_STEPS // count)), TIME_STEP]
    pairs = []
    for _ in range(rounds):
        own = _figure(_run([str(ours), *arguments]), r"ns/particle-step=([\d.]+)")
        pairs.append((own, _figure(_run([str(theirs), *arguments]), r"ns/particle-step=([\d.]+)")))
    own_median, their_median = (statistics.median(column) for column in zip(*pairs, strict=True))
    return f"{count} disks", own_median, their_median, statistics.median(own / their for own, their in pairs)


def _our_bench() -> Path:
    output = _run(["cargo", "bench", "--bench", "event_driven", "--no-run"])
    return Path(_text(output, r"\((target/release/deps/event_driven-[0-9a-f]+)\)"))


def _run(arguments: list[str]) -> str:
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise LabError(f"{arguments[0]} failed: {done.stderr.strip()[-400:]}. Check that it is installed.")
    return done.stdout + done.stderr


def _figure(output: str, pattern: str) -> float:
    return float(_text(output, pattern))


def _text(output: str, pattern: str) -> str:
    found = re.search(pattern, output)
    if found is None:
        raise LabError(f"no {pattern!r} in the output: {output.strip()[-400:]}")
    return found.group(1)
