"""Data, picture and checked statements of one figure, and the page that shows them."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from matplotlib.figure import Figure

from jostle_lab.plots.style import save
from jostle_lab.tables import write_table
from jostle_lab.verdicts import Judgement, Verdict, verdict

__all__ = ["Judgement", "Product", "Statement", "Verdict", "cell", "verdict", "write"]


@dataclass(frozen=True)
class Statement:
    """A printed statement beside what was found."""

    place: str
    """Where the paper says it."""
    printed: str
    found: str
    verdict: Verdict
    rule: str = ""
    """What the verdict was decided by."""
    cause: str = ""
    """Why ours differs, if it does; or what it would cost to decide, if that is open."""

    @classmethod
    def judged(cls, place: str, printed: str, found: str, judgement: Judgement, cause: str = "") -> Self:
        """A statement with the verdict and the rule of a judgement."""
        return cls(place, printed, found, judgement.verdict, judgement.rule, cause)


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
    """Write data.csv, figure.png, figure.svg and statements.md; return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    data, page = folder / "data.csv", folder / "statements.md"
    pictures = [folder / "figure.png", folder / "figure.svg"]
    write_table(data, product.rows)
    for picture in pictures:
        save(product.picture, picture)
    page.write_text(_page(product, command, footer))
    return [data, *pictures, page]


def _page(product: Product, command: str, footer: str) -> str:
    rows = [
        f"| {s.place} | {cell(s.printed)} | {cell(s.found)} | {s.verdict} | {cell(s.rule)} |"
        for s in product.statements
    ]
    notes = [f"- {note}" for note in product.notes]
    header = ["| where | printed | ours | | rule |", "|:--|:--|:--|:--|:--|"]
    tables = [line for table in product.tables for line in ("", *table.splitlines())]
    return "\n".join(
        [f"# {product.title}", "", f"`{command}`", "", *header, *rows, "", *notes, f"- {footer}", *tables, ""]
    )


def cell(text: str) -> str:
    """Text in a cell of a table."""
    return text.replace("|", "\\|")
