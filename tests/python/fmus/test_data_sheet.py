"""The page inside of an FMU, as its reader uses it: the program on it runs, and does what the picture shows."""

import html
import re
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest


def page_of(fmu: Path) -> str:
    with ZipFile(fmu) as archive:
        return archive.read("documentation/index.html").decode()


def curve(page: str, name: str) -> np.ndarray:
    """Heights of the points of a curve in the picture, shape (points,), upwards and scaled from 0 to 1."""
    panel = page[page.index(f">{name}", page.index('<svg class="curves"')) :]
    points = re.search(r'points="([^"]*)"', panel)
    assert points is not None
    heights = -np.array([float(point.split(",")[1]) for point in points.group(1).split()])
    return (heights - heights.min()) / np.ptp(heights)


@pytest.fixture
def page(fmu: Path) -> str:
    return page_of(fmu)


def test_the_program_of_the_page_does_the_run_of_its_picture(fmu: Path, page: str) -> None:
    match = re.search(r"<pre>(.*?)</pre>", page, re.DOTALL)
    assert match is not None
    program = html.unescape(match.group(1)).replace("FILE.fmu", str(fmu))
    names: dict[str, np.ndarray] = {}
    exec(program, names)
    result, drawn = names["result"], curve(page, "base.reaction_force")
    assert len(result) == len(drawn)
    # The force depends on the last bits of sines only after a while; a pixel of the picture is 1 % of its height.
    force = result["base.reaction_force"][:40]
    scale = np.polyfit(drawn[1:40], force[1:], 1)
    assert np.abs(np.polyval(scale, drawn[1:40]) - force[1:]).max() < 0.01 * np.ptp(force)
    assert np.ptp(result["mean_angular_velocity"]) > 0.01


def test_the_diagram_names_inputs_and_outputs_with_units(page: str) -> None:
    diagram = html.unescape(re.sub(r"<[^>]*>", "", page[page.index('<div class="diagram">') : page.index("<nav>")]))
    for shown in ("base.displacement [m]", "base.velocity [m/s]", "base.reaction_force [N]", "disk.angle[1..60] [rad]"):
        assert shown in diagram


def test_the_page_is_light_and_needs_no_network(page: str) -> None:
    tables = page[page.index('<h3 id="parameters">') : page.index('<h2 id="fmi">')]
    assert len(page) - len(tables) < 150_000
    assert not re.search(r"<script|<link|<img|@import|\bsrc=", page)
