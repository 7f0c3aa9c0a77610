"""The moving picture of the README and the frames of the page of films are what their commands make."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from jostle_lab.film.stage import Stage
from tools import film_frames
from tools.paths import README_FILM, ROOT
from tools.readme_film import FPS, FREQUENCY, PERIODS, SLOW, readme_film, recorded, script_of
from tools.readme_picture import difference

ALIKE = 12.0
"""Largest root mean square difference of pictures of the same frame in steps of 255. WebP makes it 6; the next frame
differs by 44."""
COMPARED = (0, 1, 9)


def test_frames_of_the_film_are_those_of_the_run() -> None:
    script = script_of(recorded(), False)
    stage = Stage(script)
    with Image.open(README_FILM) as film:
        for number in COMPARED:
            film.seek(number)
            kept = np.asarray(film.convert("RGB"), dtype=float)
            made = np.asarray(stage.draw(script.frame(number)), dtype=float)[:, :, :3]
            assert kept.shape == made.shape
            panel = (slice(60, None), slice(12, 400))  # letters depend on the fonts
            other = np.asarray(stage.draw(script.frame(number + 1)), dtype=float)[:, :, :3]
            assert np.sqrt(np.mean((kept - made)[panel] ** 2)) < ALIKE < np.sqrt(np.mean((kept - other)[panel] ** 2))


def test_film_is_small_and_a_loop_of_whole_periods() -> None:
    with Image.open(README_FILM) as film:
        assert film.n_frames == round(PERIODS / FREQUENCY * SLOW * FPS)  # type: ignore[attr-defined]
        assert film.info["loop"] == 0
    assert README_FILM.stat().st_size < 800_000


def test_the_command_writes_a_film(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tools.readme_film.PERIODS", 0.25)
    readme_film(tmp_path / "film.webp", progress=False)
    with Image.open(tmp_path / "film.webp") as film:
        assert film.n_frames == 3  # type: ignore[attr-defined]


def test_frames_of_the_page_of_films_are_drawn_anew(tmp_path: Path) -> None:
    for path in film_frames.draw(tmp_path):
        assert difference(ROOT / "docs" / path.name, path) < 3.0
        assert (ROOT / "docs" / path.name).stat().st_size < 60_000
    assert len(list(tmp_path.iterdir())) == len(film_frames.STILLS) == 3
