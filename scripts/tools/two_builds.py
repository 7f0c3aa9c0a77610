"""Processor time of every engine by two builds of the program, side by side in one run: what a change costs."""

import tempfile
from pathlib import Path
from statistics import median
from typing import Annotated

import typer

from jostle_lab.errors import LabError
from jostle_lab.programs import timed
from jostle_lab.tables import markdown_table

RUNS = {
    "packing, molecular-dynamics": "packing --engine molecular-dynamics --set drive.amplitude=1e-4 --seconds 6",
    "packing, located": "packing --engine molecular-dynamics-located --set drive.amplitude=1e-4 --seconds 3",
    "packing, event-driven": "packing --engine event-driven --set drive.amplitude=2e-4 --seconds 60",
    "wedge, map": "wedge --engine map --seconds 20000",
    "wedge, event-driven": "wedge --engine event-driven --seconds 15000",
    "wedge, molecular-dynamics": "wedge --engine molecular-dynamics --seconds 20",
    "ratchet, event-driven": "ratchet --engine event-driven --disks 50 --seconds 100",
    "three_disk, sine": "three_disk --engine molecular-dynamics --drive sine --seconds 20",
    "three_disk, random-supports": "three_disk --engine molecular-dynamics --drive random-supports --seconds 20",
}
"""About a second each."""


def two_builds(
    before: Annotated[Path, typer.Argument(help="The program before the change.")],
    after: Annotated[Path, typer.Argument(help="The program after it.")],
    pairs: Annotated[int, typer.Option(min=1, max=100, help="Pairs of runs, in turn.")] = 7,
) -> None:
    """Print processor time AFTER over BEFORE for every engine: median, smallest and largest of the pairs."""
    rows = []
    for name, arguments in RUNS.items():
        times = [(_seconds(before, arguments), _seconds(after, arguments)) for _ in range(pairs)]
        ratios = [late / early for early, late in times]
        spread = f"{min(ratios):.2f} to {max(ratios):.2f}"
        rows.append([name, f"{median(early for early, _ in times):.2f}", f"{median(ratios):.3f}", spread])
    typer.echo(markdown_table(["engine", "before [s]", "after / before", "pairs"], rows))


def _seconds(program: Path, arguments: str) -> float:
    with tempfile.TemporaryDirectory(prefix="jostle-") as folder:
        output, messages = Path(folder) / "run.csv", Path(folder) / "messages"
        words = [str(program), "run", *arguments.split(), "--sample", "1e9", "--output", str(output), "--no-progress"]
        ended = timed(words, messages)
        if ended.code != 0:
            raise LabError(f"{' '.join(words)} failed:\n{messages.read_text(errors='replace').strip()}")
        return ended.processor_seconds
