"""`python -m tools live-page`: the page of `jostle view` in a browser without a window, its frames and its pictures.

A measurement and no test: how many frames a second are drawn depends on what else the machine does.
"""

import io
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Annotated, Any

import typer

from jostle_lab import locate, options
from jostle_lab.errors import LabError
from tools.processor import processor

CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
OPTIONS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
"""Of a browser that runs as any user, without a network."""
SCENES = ("packing", "ratchet", "wedge")
COUNT = """seconds => new Promise(done => {
    const app = window.jostle, first = app.frames, time = app.source.time, start = performance.now();
    setTimeout(() => {
        const passed = (performance.now() - start) / 1e3;
        done([(app.frames - first) / passed, (app.source.time - time) / passed]);
    }, 1e3 * seconds);
})"""
"""Frames and simulated seconds a second."""
LATER = """() => {
    const app = window.jostle;
    app.pause(true);
    for (let step = 0; step < 120; step++) {
        app.source.advance(app.source.time + 0.01, 1e9);
        app.look();
    }
}"""
"""More than a second later, so that something is seen in the plots."""
WIDTH, COLOURS = 960, 128


def chromium() -> str | None:
    """Path of a Chromium on this machine."""
    return next((found for name in CHROMIUM if (found := shutil.which(name))), None)


def live_page(
    seconds: Annotated[float, typer.Option(min=0.1, help="How long the frames of a scene are counted [s].")] = 5.0,
    disks: Annotated[int, typer.Option(min=1, help="Disks of packing and ratchet.")] = 60,
    pictures: Annotated[Path | None, typer.Option(help="Folder for a picture of each scene.")] = None,
    program: options.ProgramOption = None,
) -> None:
    """Count the frames a second of each scene of the page, in slow motion as it starts; needs Chromium."""
    browser = chromium()
    if browser is None:
        raise LabError(f"No browser: none of {', '.join(CHROMIUM)} is here. On Debian: apt-get install chromium")
    native = locate.program(program)
    with tempfile.TemporaryDirectory() as folder:
        html = Path(folder) / "jostle.html"
        subprocess.run([str(native), "view", "--output", str(html)], check=True, capture_output=True)
        for scene, (frames, speed) in _measured(browser, html, seconds, disks, pictures).items():
            typer.echo(f"{scene:8} {frames:5.1f} frames a second, {speed:.4f} simulated seconds a second")
    typer.echo(f"{disks} disks, {processor()}, {Path(browser).name} without a window")


def _small(screenshot: bytes, file: Path) -> None:
    """A picture for a page of the documents: less wide, few colours."""
    from PIL import Image  # noqa: PLC0415 - where pictures are asked for

    file.parent.mkdir(parents=True, exist_ok=True)
    picture = Image.open(io.BytesIO(screenshot)).convert("RGB")
    small = picture.resize((WIDTH, round(WIDTH * picture.height / picture.width)), Image.Resampling.LANCZOS)
    small.quantize(COLOURS).save(file, "PNG", optimize=True)


def _measured(
    browser: str, html: Path, seconds: float, disks: int, pictures: Path | None
) -> dict[str, tuple[float, float]]:
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - a package of the tests

    found: dict[str, tuple[float, float]] = {}
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=browser, args=list(OPTIONS))
        with running:
            page: Any = running.new_context(viewport={"width": 1280, "height": 900}, offline=True).new_page()
            for scene in SCENES:
                count = f"&disks={disks}" if scene != "wedge" else ""
                page.goto("about:blank")
                page.goto(f"{html.as_uri()}#scene={scene}{count}")
                page.wait_for_selector("body[data-ready]")
                page.wait_for_timeout(500)
                frames, speed = page.evaluate(COUNT, seconds)
                found[scene] = frames, speed
                if pictures is not None:
                    page.evaluate(LATER)
                    _small(page.screenshot(), pictures / f"live-{scene}.png")
    return found
