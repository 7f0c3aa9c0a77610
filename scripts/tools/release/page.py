"""`docs/generated/binaries.md` from what `scripts/release` measured: a table of sizes and needs."""

from pathlib import Path

from jostle_lab.tables import markdown_table, read_text_rows
from tools.release.binaries import Row
from tools.release.systems import SYSTEMS

HEAD = """# Binaries

Written by `python -m tools binaries --data docs/generated/binaries` from `docs/generated/binaries/*.csv`.
The same command measured these after `scripts/release` and `scripts/setup`. `scripts/release` prints the table of its
own run.

## Linux on x86-64

What ships is linked against glibc 2.17, of 2012; the newest symbol that it asks for is of {glibc}. Besides it needs
nothing: zig puts the unwinder that catches panics and the mathematical functions inside. A plain `cargo build`, the
columns on the right, asks for the glibc of the machine that it ran on, and for the compiler's `libgcc_s`.
"""
TAIL = """An FMU holds the library, compressed, the model description, a documentation page, the licences, an icon and a
reference trajectory; these are without the libraries of other systems, each of which adds as much as the one for Linux.
A packing has {packing} variables at 60 disks, five for each disk. The C library holds all scenes.

Made with {tools}."""
OTHERS = ("C library", "command line")
"""What is no library of an FMU."""
SYSTEMS_HEAD = """## Other systems
The same script builds these; what it links for macOS was never run. `scripts/release --check` runs those for Windows by
wine and those for Linux on 64-bit Arm by qemu. Those for macOS cannot be run here. FMI 2.0 has no folder for 64-bit
Arm."""


def page(folder: Path) -> str:
    """The page as Markdown."""
    rows = read_text_rows([folder / "sizes.csv"])
    tools = ", ".join(f"{row['tool']} {row['version']}" for row in read_text_rows([folder / "tools.csv"]))
    newest = max((tuple(map(int, row["glibc"].split("."))) for row in rows), default=(0, 0))
    packing = next(row["variables"] for row in rows if row["name"].startswith("packing, molecular-dynamics, input"))
    parts = [HEAD.format(glibc=".".join(map(str, newest))).rstrip(), table(rows)]
    parts.append(TAIL.format(packing=packing, tools=tools))
    if (folder / "systems.csv").is_file():
        parts += [SYSTEMS_HEAD, table_of_systems(read_text_rows([folder / "systems.csv"]))]
    return "\n\n".join(parts) + "\n"


def table(rows: list[Row]) -> str:
    """Sizes in kB and needs, a line for each library."""
    head = ["FMU", "library [kB]", "FMI 2.0 [kB]", "FMI 3.0 [kB]", "variables", "glibc", "needs"]
    head += ["plain build: library [kB]", "glibc", "needs besides"]
    return markdown_table(head, [_line(row) for row in rows])


def table_of_systems(rows: list[Row]) -> str:
    """What the FMU libraries of each system need and how they were checked; below it all sizes in kB."""
    built = {name: system for name, system in SYSTEMS.items() if any(row["platform"] == name for row in rows)}
    sizes = {(row["platform"], row["name"]): row["bytes"] for row in rows}
    lines = []
    for platform, system in built.items():
        of_fmus = [row for row in rows if row["platform"] == platform and row["name"] not in OTHERS]
        needed = sorted({name for row in of_fmus for name in row["needs"].split()})
        lines.append([system.title, system.oldest, ", ".join(needed), system.checked])
    names = sorted({row["name"] for row in rows}, key=lambda name: (name in OTHERS, name))
    table = [[name, *(_kilobytes(sizes.get((platform, name), "")) for platform in built)] for name in names]
    head = ["system", "from", "FMU libraries need", "checked"]
    return "\n\n".join([markdown_table(head, lines), markdown_table(["[kB]", *built], table)])


def _line(row: Row) -> list[str]:
    besides = set(row["native_libraries"].split()) - set(row["libraries"].split())
    sizes = [_kilobytes(row[name]) for name in ("bytes", "fmi2_bytes", "fmi3_bytes")]
    needs = [row["glibc"], ", ".join(row["libraries"].split())]
    plain = [_kilobytes(row["native_bytes"]), row["native_glibc"] or "-", ", ".join(sorted(besides)) or "-"]
    return [row["name"], *sizes, row["variables"] or "-", *needs, *plain]


def _kilobytes(text: str) -> str:
    return f"{int(text) / 1000:.0f}" if text else "-"
