"""The moving picture of the README is what its command makes."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from jostle_lab.film.stage import Stage
from tools.paths import README_FILM
from tools.readme_film import FPS, FREQUENCY, PERIODS, SLOW, readme_film, recorded, script_of

ALIKE = 4.0
"""Largest root mean square difference of pictures of the same frame, which WebP changes a little, in steps of 255; that
of two frames is 30."""
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
