"""What each scene runs and compiles, with and without its parts: instruction counts, library sizes, variables.

Instructions are those of `jostle run` under `valgrind --tool=callgrind`, of a long run less a short one, so that
start-up, files and the progress bar drop out. They depend on compiler, profile and the C library's mathematics, not on
load. The pinned counts (`paths.INSTRUCTION_COUNTS`) hold for the profile `shipped`:
`cargo build --profile shipped -p jostle-cli`, then `--program target/shipped/jostle`.
"""

import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated
from xml.etree import ElementTree

import typer

from jostle_lab import locate, options
from jostle_lab.errors import LabError
from jostle_lab.programs import completed
from jostle_lab.tables import markdown_table, read_text_rows, write_table
from tools.paths import INSTRUCTION_COUNTS, MODEL_DESCRIPTIONS

TOLERANCE = 0.005
"""Relative difference of a count from the pinned one that is a change."""
COLUMNS = ("workload", "what", "instructions", "seconds")
LIBRARY_COLUMNS = ("library", "bytes", "variables", "parameters", "inputs", "outputs")


@dataclass(frozen=True)
class Workload:
    """A run of a scene, whose instructions are counted from `short` to `long` simulated seconds."""

    name: str
    what: str
    arguments: str
    short: float
    long: float

    def command(self, program: Path, seconds: float, output: Path) -> list[str]:
        """The run under callgrind."""
        valgrind = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={output}.callgrind"]
        run = [str(program), "run", *self.arguments.split(), "--drive", "sine"]
        return [*valgrind, *run, "--seconds", repr(seconds), "--sample", repr(seconds), "--output", f"{output}.csv"]


SOFT = "packing --engine molecular-dynamics --set time_step=1e-5"
HARD = "packing --engine event-driven"
WEDGE = "wedge --engine"
WORKLOADS = (
    Workload("soft packing", "60 disks, all of it", SOFT, 0.3, 0.34),
    Workload("soft packing, no friction", "contact.friction = 0", f"{SOFT} --set contact.friction=0", 0.3, 0.34),
    Workload(
        "soft packing, no tangential spring",
        "stiffness_ratio = 0",
        f"{SOFT} --set contact.stiffness_ratio=0",
        0.3,
        0.34,
    ),
    Workload("soft packing, base at rest", "drive.amplitude = 0", f"{SOFT} --set drive.amplitude=0", 0.3, 0.34),
    Workload("soft packing, one disk", "--disks 1", f"{SOFT} --disks 1", 0.3, 0.6),
    Workload("located packing", "60 disks, located events", "packing --engine molecular-dynamics-located", 0.3, 0.32),
    Workload("hard packing", "60 disks on a moving bottom", HARD, 0.5, 0.7),
    Workload("hard packing, no friction", "contact.friction = 0", f"{HARD} --set contact.friction=0", 0.5, 0.7),
    Workload("hard packing, random phase", "bottom at rest", f"{HARD} --set base.model=random_phase", 0.5, 0.7),
    Workload("hard packing, one disk", "--disks 1", f"{HARD} --disks 1", 2.0, 12.0),
    Workload("wedge, map", "one disk, walls at rest, random phase", f"{WEDGE} map", 10.0, 60.0),
    Workload("wedge, event-driven", "one disk, moving walls", f"{WEDGE} event-driven", 10.0, 60.0),
    Workload("wedge, soft", "one disk, moving walls, lasting contacts", f"{WEDGE} molecular-dynamics", 0.5, 0.9),
    Workload("three disks", "one disk on two supports", "three_disk", 0.5, 1.5),
    Workload("ratchet", "20 disks in a periodic cell on teeth", "ratchet --disks 20", 1.0, 3.0),
    Workload(
        "ratchet, no friction", "collision.friction = 0", "ratchet --disks 20 --set collision.friction=0", 1.0, 3.0
    ),
)


def instructions(program: Path, workload: Workload) -> float:
    """Instructions of one simulated second."""
    with tempfile.TemporaryDirectory() as folder:
        counts = []
        for seconds in (workload.short, workload.long):
            command = workload.command(program, seconds, Path(folder) / "run")
            done = completed(command)
            found = re.search(r"Collected : (\d+)", done.stderr)
            if done.returncode != 0 or found is None:
                raise LabError(f"{workload.name}: {done.stderr.strip()[-400:]} Is valgrind installed?")
            counts.append(int(found.group(1)))
    return (counts[1] - counts[0]) / (workload.long - workload.short)


def count(program: Path) -> Iterator[dict[str, str]]:
    """A row for each workload."""
    for workload in WORKLOADS:
        number = instructions(program, workload)
        seconds = f"{workload.short:g} to {workload.long:g}"
        yield dict(zip(COLUMNS, (workload.name, workload.what, f"{number:.0f}", seconds), strict=True))


def changed(pinned: list[dict[str, str]], counted: list[dict[str, str]]) -> list[str]:
    """What differs from the pinned counts by more than the tolerance, in words."""
    known = {row["workload"]: float(row["instructions"]) for row in pinned}
    found = []
    for row in counted:
        now, before = float(row["instructions"]), known.get(row["workload"])
        if before is None:
            found.append(f"{row['workload']}: {now:.4g}, not pinned")
        elif abs(now / before - 1.0) > TOLERANCE:
            found.append(f"{row['workload']}: {now:.5g}, pinned {before:.5g} ({100.0 * (now / before - 1.0):+.2f} %)")
    return found


def libraries(folder: Path, descriptions: Path) -> list[dict[str, str]]:
    """Size of each FMU library in `folder` and the variables in its model description, FMI 3.0."""
    rows = []
    for library in sorted(folder.glob("libjostle_*.so")):
        description = descriptions / f"{library.stem.removeprefix('lib')}.fmi3.xml"
        if not description.is_file():
            continue
        variables = list(ElementTree.parse(description).getroot().find("ModelVariables") or [])
        kinds = [variable.get("causality", "local") for variable in variables]
        parameters = kinds.count("parameter") + kinds.count("calculatedParameter")
        numbers = (library.stat().st_size, len(variables), parameters, kinds.count("input"), kinds.count("output"))
        rows.append(dict(zip(LIBRARY_COLUMNS, (library.stem[3:], *(str(n) for n in numbers)), strict=True)))
    return rows


def section(folder: Path) -> str:
    """The part of the report page, from the files that were written."""
    rows = read_text_rows([folder / "instructions.csv"])
    base: dict[str, float] = {}
    table = []
    for row in rows:
        family, number = row["workload"].split(",")[0], float(row["instructions"])
        base.setdefault(family, number)
        share = "" if base[family] == number else f"{100.0 * number / base[family]:.1f} %"
        table.append([row["workload"], row["what"], f"{1e-6 * number:.3g}", share])
    parts = [
        "## What a scene leaves out",
        "Million instructions of a simulated second, and over the first of the same scene "
        "(`python -m tools instruction-counts`). `--check` compares with the committed counts to "
        f"{100 * TOLERANCE:g} %: what is added to one scene must not change another.",
        markdown_table(["run", "what", "M instructions", "share"], table),
    ]
    sizes = folder / "libraries.csv"
    if sizes.is_file():
        columns = [[row[name] for name in LIBRARY_COLUMNS] for row in read_text_rows([sizes])]
        parts += [
            "Libraries (stripped, default release profile) and the variables of their FMI 3.0 model descriptions at "
            "the default number of disks:",
            markdown_table(list(LIBRARY_COLUMNS), columns),
        ]
    return "\n\n".join(parts)


def instruction_counts(
    data: Annotated[Path, typer.Option(help="Folder of the counts.")] = INSTRUCTION_COUNTS,
    program: options.ProgramOption = None,
    check: Annotated[bool, typer.Option("--check", help="Compare with the committed counts; write nothing.")] = False,
    sizes: Annotated[Path | None, typer.Option(help="Folder of the FMU libraries, to measure them too.")] = None,
) -> None:
    """Count the instructions of every scene with and without its parts; needs valgrind. Half a minute.

    The program must be of the default release profile.
    """
    counted = []
    for row in count(locate.program(program)):
        typer.echo(f"{row['workload']:32} {1e-6 * float(row['instructions']):10.2f} M instructions a simulated second")
        counted.append(row)
    if check:
        changes = changed(read_text_rows([data / "instructions.csv"]), counted)
        if changes:
            raise LabError("instruction counts have changed:\n" + "\n".join(changes))
        return
    data.mkdir(parents=True, exist_ok=True)
    write_table(data / "instructions.csv", counted, COLUMNS)
    if sizes is not None:
        write_table(data / "libraries.csv", libraries(sizes, MODEL_DESCRIPTIONS), LIBRARY_COLUMNS)
