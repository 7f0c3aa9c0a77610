"""Data, picture and checked statements of one figure, and the page that shows them."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from jostle_lab.plots.style import save
from jostle_lab.tables import write_table


class Verdict(StrEnum):
    """Whether a printed statement holds."""

    AGREES = "agrees"
    PARTLY = "partly"
    DISAGREES = "disagrees"
    OPEN = "open"


def verdict(holds: bool) -> Verdict:
    """Agreement, yes or no."""
    return Verdict.AGREES if holds else Verdict.DISAGREES


@dataclass(frozen=True)
class Statement:
    """A printed statement beside what was found."""

    place: str
    """Where the paper says it."""
    printed: str
    found: str
    verdict: Verdict


@dataclass(frozen=True)
class Product:
    """Data, picture and statements of one figure."""

    title: str
    rows: Sequence[dict[str, Any]]
    picture: Figure
    statements: Sequence[Statement]
    notes: Sequence[str]
    """Parameters, seeds, durations; one line each."""
    tables: Sequence[str] = ()
    """In Markdown: what the answers depend on."""


def write(product: Product, folder: Path, command: str, footer: str) -> list[Path]:
    """Write data.csv, figure.png and statements.md; return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    data, picture, page = folder / "data.csv", folder / "figure.png", folder / "statements.md"
    write_table(data, product.rows)
    save(product.picture, picture)
    page.write_text(_page(product, command, footer))
    return [data, picture, page]


def _page(product: Product, command: str, footer: str) -> str:
    rows = [f"| {s.place} | {cell(s.printed)} | {cell(s.found)} | {s.verdict} |" for s in product.statements]
    notes = [f"- {note}" for note in product.notes]
    header = ["| where | printed | ours | |", "|:--|:--|:--|:--|"]
    tables = [line for table in product.tables for line in ("", *table.splitlines())]
    return "\n".join(
        [f"# {product.title}", "", f"`{command}`", "", *header, *rows, "", *notes, f"- {footer}", *tables, ""]
    )


def cell(text: str) -> str:
    """Text in a cell of a table."""
    return text.replace("|", "\\|")
