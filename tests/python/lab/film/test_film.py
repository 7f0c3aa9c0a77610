"""Films are what the data say: number of frames, places, angles, colours; and the file is whole or not there."""

import inspect
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from film.made import decoded, difference, marked_angle, packing, run_of, turning
from PIL import Image

import jostle
from jostle_lab.film import FilmWarning, film, words
from jostle_lab.film.make import write, write_script
from jostle_lab.film.script import Script
from jostle_lab.film.stage import Stage


def film_of_a_run(folder: Path) -> None:
    sim = jostle.Simulation("packing", disks=10, **{"drive.amplitude": 4e-4})
    data = sim.run(0.02, every=5e-4)
    film(data, folder / "packing.mp4", colour="spin")


def test_a_user_needs_at_most_ten_lines(tmp_path: Path) -> None:
    film_of_a_run(tmp_path)
    assert len(inspect.getsource(film_of_a_run).splitlines()) - 1 <= 8  # and two imports
    frames = decoded(tmp_path / "packing.mp4")
    assert len(frames) == 0.02 * 40 * 30 + 1  # 80 Hz: 40 times slower than real, 30 frames a second
    assert list(tmp_path.iterdir()) == [tmp_path / "packing.mp4"]


def middle(script: Script, frame: int) -> tuple[float, float]:
    """(column, row) of the first disk."""
    x, y = script.frame(frame).centres[0]
    return float(x), script.layout.height - float(y)


def test_frames_of_an_mp4_differ_and_the_marking_turns_by_the_angle_of_the_data(tmp_path: Path) -> None:
    data = turning()
    script = write_script(data, slow=1.0, height=240, contacts=False)
    write(script, tmp_path / "wedge.mp4", False)
    frames = decoded(tmp_path / "wedge.mp4")
    assert len(frames) == script.pace.frames == 13
    assert frames[0].shape == (240, script.layout.width, 3)
    for number, picture in enumerate(frames):
        seen = marked_angle(picture, middle(script, number), float(script.radii[0]))
        assert difference(seen, 5.0 * number / 30.0) < 0.02, number
    for before, after in pairwise(frames):
        assert np.abs(after.astype(int) - before).max() > 60


def test_every_disk_of_a_packing_is_drawn_at_its_place_and_angle() -> None:
    data = packing()
    script = write_script(data, height=480, colour="none", contacts=False, slow=10.0)
    stage = Stage(script)
    for frame in (0, 17):
        picture = np.array(stage.draw(script.frame(frame)))[:, :, :3]
        at = script.pace.times[frame]
        x, y, angle = (data[f"disk.{name}"].interp(time=at).values for name in ("x", "y", "angle"))
        # A ruler from the picture alone: the box is 0.16 m wide between its walls, its floor is where the base is.
        air = picture[int(0.5 * script.layout.height)].astype(int)
        walls = np.flatnonzero(np.abs(air - [0x8F, 0x8A, 0x83]).sum(axis=1) < 12)
        gap = int(np.argmax(np.diff(walls)))
        left, right = walls[gap] + 1, walls[gap + 1]
        scale = (right - left) / 0.16
        column = np.abs(picture[:, (left + right) // 2].astype(int) - [0x8F, 0x8A, 0x83]).sum(axis=1) < 12
        floor = int(np.flatnonzero(column)[0]) + float(data["base.position"].interp(time=at)) * scale
        for i, radius in enumerate(data["disk.radius"].values):
            centre = (0.5 * (left + right) + x[i] * scale, floor - y[i] * scale)
            assert difference(marked_angle(picture, centre, radius * scale), angle[i]) < 0.06, (frame, i)


def test_gif_of_three_seconds_of_sixty_disks_is_below_one_mebibyte(tmp_path: Path) -> None:
    sim = jostle.Simulation("packing", **{"drive.amplitude": 3e-3, "drive.frequency": 12.0})
    data = sim.run(0.5, every=0.002, outputs=["disk.x", "disk.y", "disk.angle", "base.position"])
    film(data, tmp_path / "film.gif", slow=6.0, contacts=True)
    with Image.open(tmp_path / "film.gif") as made:
        assert (made.height, made.n_frames, made.info["duration"]) == (480, 31, 100)  # type: ignore[attr-defined]
    assert (tmp_path / "film.gif").stat().st_size < 2**20


def test_a_gif_keeps_the_colour_of_one_fast_disk_among_many(tmp_path: Path) -> None:
    data = packing(seconds=0.3)
    data["disk.angle"][:, 2] = -30.0 * data["time"]
    film(data, tmp_path / "film.gif", slow=2.0, contacts=False)
    script = write_script(data, ".gif", slow=2.0, contacts=False)
    number = int(np.argmin(script.colouring.shades[:, 2]))
    assert script.colouring.shades[number, 2] == 0
    frame = script.frame(number)
    to_left = frame.angles[2] + math.pi
    x, y = frame.centres[2] + 0.5 * script.radii[2] * np.array([math.cos(to_left), math.sin(to_left)])
    with Image.open(tmp_path / "film.gif") as made:
        made.seek(number)
        seen = made.convert("RGB").getpixel((round(x), round(script.layout.height - y)))
    assert seen == pytest.approx(255.0 * script.colouring.palette[0], abs=2)


def test_webp_has_all_frames_and_lasts_as_long_as_told(tmp_path: Path) -> None:
    film(turning(), tmp_path / "film.webp", slow=1.0, height=160, fps=30.0, contacts=False)
    with Image.open(tmp_path / "film.webp") as made:
        lasting = []
        for frame in range(made.n_frames):  # type: ignore[attr-defined]
            made.seek(frame)
            made.load()
            lasting.append(made.info["duration"])
    assert len(lasting) == 13
    assert sum(lasting) == round(13 / 30 * 1000)


def test_colour_by_spin_is_the_angle_turned_in_a_period() -> None:
    script = write_script(turning(rate=5.0), slow=5.0, contacts=False)
    colours = script.colouring
    assert colours.high == -colours.low >= 5.0
    place = colours.low + (colours.high - colours.low) * script.colouring.shades / (len(colours.palette) - 1)
    assert np.abs(place - 5.0).max() <= 0.5 * (colours.high - colours.low) / (len(colours.palette) - 1)
    assert "rad/s" in colours.label and "a period" in colours.label


def test_colour_by_speed_is_that_of_the_centre() -> None:
    data = turning()
    data["disk.x"] = data["disk.x"] + 0.3 * data["time"]
    colours = write_script(data, colour="speed", slow=5.0, contacts=False).colouring
    assert colours.low == 0.0 and colours.high == pytest.approx(0.3)
    assert np.all(colours.shades >= len(colours.palette) - 2)


def test_ctrl_c_leaves_the_old_film_and_no_other_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = Script.frame

    def interrupted(script: Script, number: int) -> object:
        if number == 3:
            raise KeyboardInterrupt
        return whole(script, number)

    monkeypatch.setattr(Script, "frame", interrupted)
    for ending in ("mp4", "gif", "webp", "html"):
        out = tmp_path / f"film.{ending}"
        out.write_text("old")
        with pytest.raises(KeyboardInterrupt):
            film(turning(), out, slow=1.0, height=160, contacts=False)
        assert out.read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 4


def test_title_drive_and_slow_motion_are_words_of_the_run() -> None:
    data = packing()
    script = write_script(data, slow=10.0, contacts=False)
    gamma = 2e-3 * (math.tau * 15.0) ** 2 / 9.8
    assert words.title(script.recording) == "8 disks in a box on a vibrating bottom"
    assert words.driven(script.recording) == f"15 Hz, amplitude 2 mm, Gamma {gamma:.2g}"
    assert words.slowness(script.pace, script.recording) == "10 × slower"


def test_two_thousand_disks_can_be_drawn() -> None:
    places = np.arange(2000)
    x, y = 0.0021 * (places % 80) - 0.083, 0.0011 + 0.0021 * (places // 80)
    here = np.ones((3, 1))
    box = {"scene": "packing", "engine": "molecular-dynamics", "drive": "random-bottom", "box.width": 0.17}
    data = run_of(
        box | {"wall.motion": "fixed"}, [0.0, 0.1, 0.2], x * here, y * here, 0 * x * here, np.full(2000, 1e-3)
    )
    with pytest.warns(FilmWarning, match="No lines of force"):
        script = write_script(data, slow=10.0)
    picture = np.array(Stage(script).draw(script.frame(5)))
    assert len(np.unique(picture.reshape(-1, 4), axis=0)) > 10
