"""The page of `jostle view` in a browser: it moves, sliders change the physics, the bits are the program's."""

import csv
import gzip
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import PROGRAM, ROOT
from playwright.sync_api import Browser, Page, sync_playwright

from tools.live_page import OPTIONS, chromium

CHROMIUM = chromium()
MODULE = ROOT / "crates/jostle-cli/page/jostle.wasm.gz"
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here: apt-get install chromium")


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(OPTIONS))
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def html(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page in a folder whose name is no plain ASCII."""
    file = tmp_path_factory.mktemp("Seite für alle") / "jostle.html"
    subprocess.run([str(PROGRAM), "view", "--output", file], check=True, capture_output=True)
    return file


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1280, "height": 900}, accept_downloads=True, offline=True)
    page = context.new_page()
    page.faults = []  # type: ignore[attr-defined]
    page.on("pageerror", lambda error: page.faults.append(str(error)))  # type: ignore[attr-defined]
    page.on("console", lambda line: page.faults.append(line.text) if line.type == "error" else None)  # type: ignore[attr-defined]
    yield page
    assert page.faults == []  # type: ignore[attr-defined]
    context.close()


def opened(page: Page, html: Path, link: str = "") -> Page:
    page.goto(html.as_uri() + link)
    page.wait_for_selector("body[data-ready]", timeout=20_000)
    return page


def numbers(page: Page, expression: str) -> np.ndarray:
    return np.array(page.evaluate(f"Array.from({expression})"))


def pixels(page: Page) -> int:
    """A checksum of what is on the canvas."""
    script = """() => {
        const c = document.getElementById('stage');
        const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
        let h = 0;
        for (let i = 0; i < d.length; i += 4) h = (h * 31 + d[i] * 3 + d[i + 1] * 5 + d[i + 2]) | 0;
        return h;
    }"""
    return int(page.evaluate(script))


def set_number(page: Page, name: str, value: float) -> None:
    field = page.locator(f"#sliders input[type=number][data-name='{name}']")
    field.fill(str(value))
    field.dispatch_event("change")


@pytest.mark.parametrize("scene", ["packing", "ratchet", "wedge"])
def test_it_moves(page: Page, html: Path, scene: str) -> None:
    opened(page, html, f"#scene={scene}")
    before, time = pixels(page), page.evaluate("window.jostle.source.time")
    page.wait_for_timeout(400)
    assert page.evaluate("window.jostle.source.time") > time
    assert pixels(page) != before
    page.click("#pause")
    still, time = pixels(page), page.evaluate("window.jostle.source.time")
    page.wait_for_timeout(200)
    assert (pixels(page), page.evaluate("window.jostle.source.time")) == (still, time)
    page.click("#step")
    assert page.evaluate("window.jostle.source.time") > time


def test_a_slider_changes_the_physics(page: Page, html: Path) -> None:
    opened(page, html)

    def after(gamma: float) -> np.ndarray:
        set_number(page, "gamma", gamma)
        page.evaluate("window.jostle.pause(true); window.jostle.source.advance(0.5, 1e9)")
        return numbers(page, "window.jostle.source.frame(false).y")

    calm, wild, again = after(0.5), after(4.0), after(0.5)
    assert np.abs(wild - calm).max() > 1e-3  # disks leave the base
    assert (again == calm).all()
    set_number(page, "disks", 20)
    assert page.evaluate("window.jostle.source.radius.length") == 20


def test_the_exported_run_has_the_bits_of_the_program(page: Page, html: Path, tmp_path: Path) -> None:
    opened(page, html, "#scene=packing&disks=25&drive.amplitude=1.3e-4&contact.friction=0.37&seed=5")
    page.evaluate("window.jostle.pause(true); window.jostle.source.advance(0.237, 1e9)")
    names = ("run.csv", "run.parameters.csv")
    got: list[Path] = []
    page.on("download", lambda download: got.append(_saved(download, tmp_path)))
    page.click("#export")
    page.wait_for_function("document.getElementById('message').textContent.startsWith('Saved')")
    for _ in range(50):
        if len(got) == len(names):
            break
        page.wait_for_timeout(50)
    assert sorted(file.name for file in got) == sorted(names)
    told = page.text_content("#message") or ""
    command = told.split("The same run: jostle ")[1].split()
    subprocess.run(
        [str(PROGRAM), *command, "--output", tmp_path / "native.csv", "--no-progress"], check=True, capture_output=True
    )

    here, there = (table(tmp_path / name) for name in ("run.csv", "native.csv"))
    assert here[0] == there[0]
    assert here[1].shape == there[1].shape == (25, len(here[0]))
    assert np.array_equal(here[1].view(np.int64), there[1].view(np.int64))
    ours, theirs = (parameters(tmp_path / name) for name in ("run.parameters.csv", "native.parameters.csv"))
    for each in (ours, theirs):
        each.pop("threads", None)  # says how a run is computed: no result depends on it, and a page has one
    assert ours == theirs


def _saved(download: object, folder: Path) -> Path:
    file = folder / download.suggested_filename  # type: ignore[attr-defined]
    download.save_as(file)  # type: ignore[attr-defined]
    return file


def table(file: Path) -> tuple[list[str], np.ndarray]:
    with file.open() as lines:
        header, *rows = list(csv.reader(lines))
    return header, np.array(rows, dtype=float)


def parameters(file: Path) -> dict[str, float | str]:
    def number(text: str) -> float | str:
        try:
            return float(text)
        except ValueError:
            return text

    with file.open() as lines:
        return {row["name"]: number(row["value"]) for row in csv.DictReader(lines)}


def test_a_link_brings_back_the_scene(page: Page, html: Path) -> None:
    opened(page, html, "#scene=ratchet&disks=12")
    set_number(page, "tooth.height", 4.5)
    page.select_option("#colour", "speed")
    link = page.evaluate("location.hash")
    assert "tooth.height=0.0045" in link and "colour=speed" in link
    page.goto("about:blank")
    opened(page, html, link)
    assert page.evaluate("window.jostle.source.value('tooth.height')") == 0.0045
    assert page.evaluate("window.jostle.source.radius.length") == 12
    assert page.input_value("#colour") == "speed"


def test_what_is_wrong_is_said_and_nothing_changes(page: Page, html: Path) -> None:
    opened(page, html, "#scene=packing&disks=10")
    before = page.evaluate("window.jostle.source.value('contact.friction')")
    for name, value, text in [
        ("contact.friction", -1, "contact.friction = -1"),
        ("disks", 0, "number of disks = 0"),
        ("drive.frequency", 1e9, "drive.frequency = 1e9"),
    ]:
        set_number(page, name, value)
        assert text in (page.text_content("#message") or "")
        assert page.evaluate("window.jostle.source.value('contact.friction')") == before
        assert page.evaluate("window.jostle.source.radius.length") == 10
    for link, text in [("#scene=sandpile", "a scene sandpile"), ("#scene=packing&glue=1", "no variable glue")]:
        page.goto("about:blank")
        opened(page, html, link)
        assert text in (page.text_content("#message") or "")
        assert page.evaluate("window.jostle.source.radius.length") == 60


def test_too_much_for_a_page_is_said_and_the_page_goes_on(page: Page, html: Path) -> None:
    for link in ("#scene=packing&contact.normal_stiffness=1e15", "#scene=packing&contact.normal_damping=1e6"):
        page.goto("about:blank")
        opened(page, html, link)
        page.wait_for_function("document.getElementById('message').textContent.includes('too many time steps')")
    opened(page, html)
    set_number(page, "disks", 100_000)
    assert "at most 2000" in (page.text_content("#message") or "")
    page.evaluate("window.jostle.source.advance(0.1, 1e9)")
    page.fill("#sample", "1e-9")
    page.click("#export")
    page.wait_for_function("document.getElementById('message').textContent.includes('the page saves at most')")


def test_a_recorded_run_starts_again(page: Page, html: Path, fmu3: Path) -> None:
    opened(page, html)
    page.set_input_files("#files", [fmu3])
    page.wait_for_selector("body.replay")
    assert page.input_value("#scene") == ""
    page.evaluate("window.jostle.source.advance(1e9); window.jostle.advance(0)")
    assert page.text_content("#pause") == "Run"
    end = page.evaluate("window.jostle.source.time")
    page.click("#pause")
    assert page.evaluate("window.jostle.source.time") < end
    page.click("#restart")
    assert page.evaluate("document.body.classList.contains('replay')")
    page.select_option("#scene", "packing")
    assert not page.evaluate("document.body.classList.contains('replay') || window.jostle.paused")


def test_recorded_runs_are_played(page: Page, html: Path, tmp_path: Path) -> None:
    run = tmp_path / "run.csv"
    arguments = ["run", "packing", "--disks", "15", "--seconds", "0.3", "--output", run, "--no-progress"]
    subprocess.run([str(PROGRAM), *arguments], check=True, capture_output=True)
    header, rows = table(run)
    x = rows[:, [header.index(f"disk.x[{disk}]") for disk in range(1, 16)]]

    played = tmp_path / "played.html"
    subprocess.run([str(PROGRAM), "view", "--replay", run, "--output", played], check=True, capture_output=True)
    opened(page, played)
    page.wait_for_selector("body.replay")
    page.evaluate("window.jostle.pause(true); window.jostle.source.advance(0.2)")
    assert np.array_equal(numbers(page, "window.jostle.source.frame(false).x"), x[20])
    # The same by the user's hand, from the files.
    opened(page, html)
    page.set_input_files("#files", [run, tmp_path / "run.parameters.csv"])
    page.wait_for_selector("body.replay")
    page.evaluate("window.jostle.pause(true); window.jostle.source.advance(0.1)")
    assert np.array_equal(numbers(page, "window.jostle.source.frame(false).x"), x[10])
    page.set_input_files("#files", [run])
    page.wait_for_function("document.getElementById('message').textContent.includes('two files at once')")


def test_the_reference_of_an_fmu_is_played(page: Page, html: Path, fmu3: Path) -> None:
    opened(page, html)
    page.set_input_files("#files", [fmu3])
    page.wait_for_selector("body.replay")
    assert page.evaluate("window.jostle.source.radius.length") == 60
    assert page.evaluate("window.jostle.source.recording.time.length") > 10


@pytest.mark.skipif(
    not (ROOT / "build/cross/bin/cargo").exists() or "JOSTLE_WEB" not in os.environ,
    reason="compiles for minutes: with JOSTLE_WEB=1, after scripts/web has fetched its compiler",
)
def test_the_module_is_what_its_source_gives(tmp_path: Path) -> None:
    subprocess.run([str(ROOT / "scripts/web"), str(tmp_path / "module.gz")], check=True)
    made, kept = (gzip.decompress(file.read_bytes()) for file in (tmp_path / "module.gz", MODULE))
    assert made == kept, "run scripts/web"


def test_the_module_is_small() -> None:
    assert MODULE.stat().st_size < 300_000
