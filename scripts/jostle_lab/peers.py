"""The event-driven engine beside another program on the same gas, in turn, as a ratio.

The other program is a C++ source that takes `N packing_fraction warm_up collisions` and prints `ns/col=...`.
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
