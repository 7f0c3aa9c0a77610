"""The page of claims: made anew from its records it is the same, every row has its rule, every difference its cause."""

from functools import cache
from pathlib import Path

from conftest import PROGRAM, built
from typer.testing import CliRunner

from jostle_lab.cli import application
from jostle_lab.errors import LabError
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.verdicts import Verdict
from studies.claims.command import PAGE, claims
from studies.claims.page import page
from studies.claims.sections import FOLDER, Section, kept, record_file
from studies.examples import GENERATED
from studies.registry import NUMBERS

LARGEST = 2**20
"""Bytes of all records together."""


@cache
def on_the_page() -> tuple[list[Section], list[str]]:
    laboratory = Laboratory(built(PROGRAM), Path("nowhere"), show_progress=False)
    return kept(laboratory, GENERATED)


def sections() -> list[Section]:
    return on_the_page()[0]


def test_the_page_is_what_its_records_say() -> None:
    assert (GENERATED / PAGE).read_text() == page(*on_the_page())


def test_every_figure_has_a_whole_record() -> None:
    assert on_the_page()[1] == []


def test_every_row_has_a_place_a_printed_statement_and_a_rule() -> None:
    bare = [
        name
        for section in sections()
        for name, s in zip(section.row_names(), section.statements, strict=True)
        if not (s.place and s.printed and s.found and s.rule)
    ]
    assert bare == []


def test_every_difference_has_its_cause_and_what_is_open_its_cost() -> None:
    unexplained = [
        f"{name} {s.verdict}: {s.printed}"
        for section in sections()
        for name, s in zip(section.row_names(), section.statements, strict=True)
        if s.verdict is not Verdict.AGREES and not s.cause
    ]
    assert unexplained == []


def test_the_records_are_small_and_each_belongs_to_a_figure() -> None:
    files = set((GENERATED / FOLDER).glob("*.parquet"))
    assert sum(file.stat().st_size for file in files) < LARGEST
    assert files <= {record_file(GENERATED, figure) for figure in NUMBERS}


def test_a_row_that_is_not_there_is_named_with_what_there_is(tmp_path: Path) -> None:
    result = CliRunner().invoke(application("claims", claims), ["claims", "--compute", "3.61", "--docs", str(tmp_path)])
    assert isinstance(result.exception, LabError)
    assert "No row or figure 3.61. Did you mean 3.6?" in str(result.exception)


def test_a_figure_is_computed_anew_and_then_kept(tmp_path: Path, jostle: Path) -> None:
    docs, results = tmp_path / "docs", tmp_path / "results"
    docs.mkdir()
    words = ["--docs", str(docs), "--results", str(results), "--program", str(jostle), "--no-progress"]
    first = CliRunner().invoke(application("claims", claims), ["claims", "--compute", "5.6-1", *words])
    assert first.exit_code == 0, first.output
    made = (docs / PAGE).read_text()
    assert "| 5.6-1 |" in made
    assert "3.6 has no whole record and is left out" in first.output
    (results / "runs").rename(results / "elsewhere")
    again = CliRunner().invoke(application("claims", claims), ["claims", *words])
    assert again.exit_code == 0, again.output
    assert (docs / PAGE).read_text() == made
