"""Each of the two papers has one name, title and year in the whole repository."""

import html
import re
import subprocess
from pathlib import Path

import pytest
from conftest import ROOT

F = (
    "Z. Farkas, P. Tegzes, A. Vukics, T. Vicsek, Transitions in the horizontal transport of vertically vibrated "
    "granular layers, Phys. Rev. E 60, 7022 (1999)"
)
P = "G. G. Peraza Mues, Spontaneous rotation in vibrated disk packings, doctoral thesis, Cinvestav Mérida, 2018"
TRACES = re.compile(
    r"Tegzes|Vukics|horizontal transport of vertically|60, 7022|Peraza|vibrated disk packings|"
    r"Farkas\W.{0,40}?\b(?:19|20)\d\d\b",
    re.IGNORECASE,
)
ELSEWHERE = {"CITATION.cff", "docs/references.md", str(Path(__file__).relative_to(ROOT))}
"""Files whose form is another: fields, and the title in Spanish too. They are looked at below."""


def plain(text: str) -> str:
    """A text without markup, signs of comments and breaks of lines."""
    unmarked = re.sub(r"<[^>]*>|[*_\"]|^\s*(?://[/!]?|#)|\\$", "", html.unescape(text), flags=re.MULTILINE)
    return " ".join(unmarked.split())


def files() -> list[Path]:
    """Every text that is under version control or would be."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    suffixes = {".md", ".rs", ".py", ".toml", ".txt", ".xml", ".h", ".c", ".cff", ".yml", ""}
    return [path for name in listed.stdout.splitlines() if (path := ROOT / name).suffix in suffixes and path.is_file()]


def test_no_other_name_title_or_year_of_a_paper_stands_anywhere() -> None:
    wrong = []
    for path in files():
        name = str(path.relative_to(ROOT))
        if name in ELSEWHERE:
            continue
        rest = plain(path.read_text(errors="replace")).replace(F, "").replace(P, "")
        wrong += [f"{name}: {rest[max(0, m.start() - 40) : m.end() + 60]}" for m in TRACES.finditer(rest)]
    assert wrong == []


@pytest.mark.parametrize(
    "words",
    [
        "Farkas et al. (2002)",
        "Z. Farkas and others, 2002",
        "Farkas 1999",
        "Transitions in the horizontal transport of vertically vibrated granular layers (2002)",
        "Phys. Rev. E 60, 7022 (2002)",
        F.replace("1999", "2002"),
        P.replace("2018", "2019"),
        P.replace("G. G. Peraza Mues", "G. Peraza"),
    ],
)
def test_another_name_title_or_year_is_seen(words: str) -> None:
    assert TRACES.search(plain(words).replace(F, "").replace(P, ""))


def test_page_of_references_has_both() -> None:
    page = plain((ROOT / "docs/references.md").read_text())
    assert F in page
    assert P in page


def test_citation_file_has_both() -> None:
    text = (ROOT / "CITATION.cff").read_text()
    for title, year in ((F.split(", ")[4], 1999), (P.split(", ")[1], 2018)):
        entry = text.split(f"title: {title}\n")[1].split("  - type:")[0]
        assert f"year: {year}" in entry
