"""The page of the demo, read as a browser reads it; its schedules, its pictures while it runs, its progress."""

import io
import sys
from pathlib import Path

import numpy as np
import pytest
from fake_grains import make_turning_lump
from lxml import html

from jostle_lab.demos.packing import page
from jostle_lab.demos.packing.captions import CAPTIONS, NOW
from jostle_lab.demos.packing.command import _schedule, draw
from jostle_lab.demos.packing.live import Live, in_words
from jostle_lab.demos.packing.schedules import FULL, QUICK, STANDARD
from jostle_lab.errors import LabError
from jostle_lab.progress import progress
from jostle_lab.protocol import intervals
from jostle_lab.protocol.experiment import Setup
from jostle_lab.protocol.now import Now
from jostle_lab.protocol.packings import Plan, claim, run
from jostle_lab.protocol.results import Results


def plan(folder: Path, amplitudes: tuple[float, ...] = (1.0, 0.4)) -> Plan:
    setup = Setup(intervals.scaled_down(amplitudes, 8), steps_per_second=800)
    return Plan(folder, (1,), setup, show_progress=False, labels=(("contact.friction", "0.2 <b>"),))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("results")
    run(plan(made), make_turning_lump)
    draw(made)
    return made


@pytest.fixture
def read(folder: Path) -> html.HtmlElement:
    return html.fromstring((folder / page.PAGE).read_text())


def test_every_picture_has_words_and_nothing_comes_from_elsewhere(folder: Path, read: html.HtmlElement) -> None:
    pictures = read.xpath("//img")
    assert [image.get("src") for image in pictures] == [caption.file for caption in CAPTIONS]
    for image in pictures:
        assert (folder / image.get("src")).stat().st_size > 10_000
        assert len(image.get("alt")) > 40
        words = image.xpath("ancestor::figure/figcaption/p/em/text()")
        assert words == ["What you see.", "What to look at.", "What it means."]
    assert not read.xpath("//script | //link | //iframe | //meta[@http-equiv]")
    for href in read.xpath("//@href | //@src"):
        assert "://" not in href and not href.startswith("/")
        assert (folder / href).exists(), href


def test_every_quantity_of_the_tables_is_explained(read: html.HtmlElement) -> None:
    explained = " ".join(read.xpath("//dt/text()"))
    for symbol in ("A", "Γ", "ω", "⟨ω²⟩", "ρ²", "σₐ", "RPM", "side bands"):
        assert symbol in explained
    heads = " ".join(read.xpath("//th/text()"))
    assert "⟨ρ²⟩" in heads and "⟨σₐ⟩" in heads
    text = read.text_content()
    assert not {"nan", "rho^2", "omega^2", "Gamma/"} & set(text.replace("(", " ").split())
    assert "0.2 <b>" in text  # what a user wrote is text


def test_the_numbers_are_those_of_the_tables(folder: Path, read: html.HtmlElement) -> None:
    (drive, rotation, *_) = read.xpath("//table[not(@class)]")
    rows = Results(folder).amplitudes.group_by("amplitude").mean().sort("amplitude", descending=True).to_dicts()
    for table, column, name in ((drive, 2, "gamma_true"), (rotation, 3, "mean_square_rpm")):
        found = [float(row.xpath("td")[column - 1].text_content()) for row in table.xpath("tbody/tr")]
        np.testing.assert_allclose(found, [row[name] for row in rows], rtol=1e-3)


def test_the_page_says_which_run_it_is(tmp_path: Path) -> None:
    for name, schedule in (("quick", QUICK), ("standard", STANDARD), ("full", FULL)):
        folder = tmp_path / name
        folder.mkdir()
        claim(Plan(folder, (1, 2), Setup(schedule), show_progress=False))
        text = html.parse(page.write(folder, page.Status("running"))).getroot().text_content()
        assert ("This is the short run" in text) == (name == "quick")
        assert ("whole protocol of the thesis, --full" in text) == (name == "full")
    assert _schedule(True, False, None, None) == QUICK
    assert _schedule(False, False, None, None) == STANDARD
    assert _schedule(True, False, "1,0.5", 20) == intervals.scaled_down((1.0, 0.5), 20)
    with pytest.raises(LabError, match="--full is the whole protocol of the thesis and --quick changes it"):
        _schedule(True, True, None, None)
    assert QUICK.duration() * 4 < STANDARD.duration()


def test_pictures_come_before_anything_is_finished(tmp_path: Path) -> None:
    said: list[str] = []
    claim(plan(tmp_path))
    live = Live(tmp_path, 5.0, said.append, 0.0)
    live.begin(0.0)
    assert "index.html" in said[0] and "packing_now.png" not in (tmp_path / page.PAGE).read_text()
    places = np.array([[0.0, 0.02], [0.05, 0.02]])
    seen = Now(2, 0.7, "settling", 4, 0.2, np.array([0.02, 0.02]), places, np.array([1.0, -1.0]))
    live.now(seen)
    live.tick(0.25)
    read = html.fromstring((tmp_path / page.PAGE).read_text())
    (source,) = read.xpath("//img/@src")
    assert source.startswith(f"{NOW.file}?") and (tmp_path / NOW.file).stat().st_size > 5_000
    assert read.xpath("//meta[@http-equiv='refresh']/@content") == ["5"]
    assert "25 % done" in read.text_content()
    assert "first picture after" in said[1] and NOW.file in said[1]
    live.now(seen)
    live.tick(0.3)
    assert len(said) == 2  # told once
    live.ended("3 of 4 are kept.")
    ended = (tmp_path / page.PAGE).read_text()
    assert "3 of 4 are kept." in ended and "refresh" not in ended


def test_times_to_wait_are_rough() -> None:
    words = [in_words(seconds) for seconds in (1.0, 42.0, 100.0, 7_000.0, 300_000.0)]
    assert words == ["5 seconds", "40 seconds", "2 minutes", "2 hours", "3 days"]


class Terminal(io.StringIO):
    """A terminal, or not."""

    def __init__(self, terminal: bool) -> None:
        super().__init__()
        self.terminal = terminal

    def isatty(self) -> bool:
        return self.terminal


@pytest.mark.parametrize("terminal", [True, False])
def test_progress_is_a_bar_on_a_terminal_and_plain_lines_elsewhere(
    monkeypatch: pytest.MonkeyPatch, terminal: bool
) -> None:
    monkeypatch.setattr(sys, "stderr", Terminal(terminal))
    with progress(total=4, done=1, unit="runs", what="sweep", postfix={"failed": 0}) as bar:
        bar.update(3)
    text = sys.stderr.getvalue()
    assert "sweep: " in text and "4 of 4 runs" in text and "left" in text and "failed=0" in text
    assert ("\r" in text) == terminal
    lines = text.splitlines()
    assert terminal or (len(lines) == 2 and all(line.startswith("sweep: ") for line in lines))
