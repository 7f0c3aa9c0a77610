"""`docs/generated/stability.md` from the files of `jostle-bench stability`: a table a scene and engine, refusals."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab.errors import LabError
from jostle_lab.tables import markdown_table, read_text_rows
from tools.paths import STABILITY, STABILITY_PAGE

Row = dict[str, str]

HEAD = """# Stability

Written by `python -m tools stability` from `docs/generated/stability/*.csv`, which `jostle-bench stability` measured:
every scene and engine, one dimension at a time from tame to extreme, everything else at its start value. `holds`: every
criterion that applies holds for the simulated time, which a budget of CPU seconds may have cut short. `refused`: the
scene said no, with a reason and a remedy, below. `violated`: a defect.
"""
CRITERIA = {
    "finite": "every variable is a finite number at every sample",
    "time": "time goes forward, counts do not fall",
    "lost": "no disk reaches beyond its walls, by half of the smallest radius (soft) or by rounding (hard)",
    "overlap": "no two disks overlap by more than that (packings up to 1000 disks)",
    "energy": "change less work of the base plus losses: created at most 1 %, off at most 2 % of the throughput (soft, "
    "errors of first order in the step), 1e-9 (hard)",
    "shrinks": "where that is above 1e-4: at an eighth of the time step at most half of it, over an eighth of the time",
    "momentum": "its change is weight and force on the base, within what the kinetic energy allows; where no other "
    "wall takes vertical force",
    "memory": "the process grows by less than 2 MB over the run",
    "same bits": "on a sine, one long communication step gives the same angle to the last bit",
    "tame neighbour": "mean kinetic energy of 8 seeds within 5 standard errors of the case before it",
}
TAIL = "Below, `energy` is the largest error of the balance over the throughput, `overlap` the deepest over the radius."


def page(folder: Path) -> str:
    """The page as Markdown."""
    rows = read_text_rows([folder / "cases.csv"])
    parts = [HEAD.rstrip(), markdown_table(["criterion", "what"], list(CRITERIA.items())), TAIL, _count(rows)]
    violated = [row for row in rows if row["result"] == "violated"]
    parts.append("## Violated\n\n" + ("\n".join(_reason(row) for row in violated) or "None."))
    for scene, engine in dict.fromkeys((row["scene"], row["engine"]) for row in rows):
        chosen = [row for row in rows if (row["scene"], row["engine"]) == (scene, engine)]
        parts.append(f"## {scene}, {engine}\n\n{_table(chosen)}")
        refused = [row for row in chosen if row["result"] == "refused"]
        if refused:
            parts.append("Refused:\n" + "\n".join(_reason(row) for row in refused))
    long = folder / "long.csv"
    if long.is_file():
        heading = "## Long runs\n\nOne disk; `jostle-bench stability --long`."
        parts += [heading, _long_table(read_text_rows([long]))]
    return "\n\n".join(parts) + "\n"


def _count(rows: list[Row]) -> str:
    counts = {result: sum(row["result"] == result for row in rows) for result in ("holds", "refused", "violated")}
    return ", ".join(f"{count} {result}" for result, count in counts.items()) + f", of {len(rows)} cases."


def _reason(row: Row) -> str:
    drive = "" if row["drive"] == "sine" else f", {row['drive']}"
    return f"- {row['scene']}, {row['engine']}{drive}, {row['dimension']} {row['value']}: {row['why']}"


def _table(rows: list[Row]) -> str:
    """One row a dimension: its values with their results, and the largest errors among them."""
    lines = []
    for dimension in dict.fromkeys(row["dimension"] for row in rows):
        chosen = [row for row in rows if row["dimension"] == dimension]
        held = [row for row in chosen if row["result"] != "refused"]
        criteria = dict.fromkeys(criterion for row in held for criterion in _criteria(row))
        values = "; ".join(
            row["value"] + ("" if row["result"] == "holds" else f" **{row['result']}**") for row in chosen
        )
        worst = [max((float(row[name]) for row in held), default=0.0) for name in ("energy_error", "overlap")]
        further = ", ".join(c for c in criteria if c not in {"finite", "time", "energy", "lost"})
        lines.append([dimension, values, *(f"{number:.0e}" for number in worst), further])
    return markdown_table(["dimension", "values", "energy", "overlap", "criteria beyond the four"], lines)


def _long_table(rows: list[Row]) -> str:
    names = ("scene", "engine", "value", "result", "simulated_seconds", "energy_error", "criteria")
    return markdown_table([name.replace("_", " ") for name in names], [[row[name] for name in names] for row in rows])


def _criteria(row: Row) -> list[str]:
    text = row["criteria"].replace("same bits", "same_bits").replace("tame neighbour", "tame_neighbour")
    return [word.replace("_", " ") for word in text.split()]


def stability(
    data: Annotated[Path, typer.Option(help="Folder that `jostle-bench stability --out` wrote.")] = STABILITY,
    out: Annotated[Path, typer.Option(help="Markdown page.")] = STABILITY_PAGE,
) -> None:
    """Write the page of stiff and extreme cases from the results of `jostle-bench stability`."""
    if not (data / "cases.csv").is_file():
        raise LabError(f"{data} has no cases.csv. Measure first: jostle-bench stability --out {data}")
    out.write_text(page(data))
    typer.echo(out)
