"""The claims of one figure: what its study says, from the record of its runs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from jostle_lab.plots.style import house_style
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.records import NotKeptError, Records
from jostle_lab.statements import Product, Statement
from studies.registry import MODULES, NUMBERS, ON_THE_PAGE, PRECISE, RECORDS, STUDIES, maker

FOLDER = "claims"
"""Folder of the records, beside the page."""


@dataclass(frozen=True)
class Section:
    """A figure or a part of a paper, with its claims."""

    figure: str
    title: str
    statements: Sequence[Statement]
    notes: Sequence[str]
    runs: Sequence[str]
    """What they are found by."""
    seeds: str
    """Such as `1 to 25`."""
    seconds: float
    """Processor time of the runs."""
    tables: Sequence[str] = ()
    """In Markdown: what the answers depend on."""

    def row_names(self) -> list[str]:
        """Names of the rows, such as 3.6-1."""
        return [f"{self.figure}-{number}" for number, _ in enumerate(self.statements, 1)]


def record_file(docs: Path, figure: str) -> Path:
    """Where the record of a figure is kept; figures of one module share it."""
    module = f"ratchet.{STUDIES[figure]}" if figure in STUDIES else MODULES[figure]
    name = RECORDS.get(figure, module.partition(":")[0])
    return docs / FOLDER / f"{name}.parquet"


def section(figure: str, laboratory: Laboratory, docs: Path, compute: bool) -> tuple[Section, Product]:
    """Claims of a figure; with `compute` the runs that its record lacks are done and kept."""
    records = Records(record_file(docs, figure), single=figure not in PRECISE)
    recording = replace(laboratory, records=records, frozen=not compute)
    try:
        with house_style():
            product = maker(figure)(recording, False, None)
    finally:
        if compute:
            records.write()
    seeds = [seed for seed in recording.asked.values() if seed is not None]
    found = Section(
        figure,
        product.title,
        product.statements,
        product.notes,
        tuple(recording.asked),
        _range(seeds),
        recording.spent,
        product.tables,
    )
    return found, product


def kept(
    laboratory: Laboratory, docs: Path, computed: Mapping[str, Section] = MappingProxyType({})
) -> tuple[list[Section], list[str]]:
    """Sections of the page, those `computed` and those whose records are whole; and the figures that have neither."""
    found, missing = [], []
    for figure in ON_THE_PAGE:
        try:
            found.append(computed.get(figure) or section(figure, laboratory, docs, compute=False)[0])
        except NotKeptError:
            missing.append(figure)
    return found, missing


def forget_others(sections: Sequence[Section], docs: Path) -> None:
    """Take out of the records what no figure asks for."""
    asked: dict[Path, set[str]] = {}
    for found in sections:
        asked.setdefault(record_file(docs, found.figure), set()).update(found.runs)
    figures = {found.figure for found in sections}
    for file, runs in asked.items():
        of_file = {figure for figure in NUMBERS if record_file(docs, figure) == file}
        if of_file <= figures:
            Records(file, single=not of_file & PRECISE).write(runs)


def _range(seeds: Sequence[int]) -> str:
    if not seeds:
        return "none"
    return f"{min(seeds)} to {max(seeds)}" if len(set(seeds)) > 1 else str(seeds[0])
