"""The picture of the README is what `scripts/demo` draws."""

from pathlib import Path

from PIL import Image

from tools.paths import README_PICTURE
from tools.readme_picture import ALIKE, difference, make


def test_the_picture_is_what_the_demo_draws(fmu3: Path, tmp_path: Path) -> None:
    drawn = tmp_path / "packing.png"
    make(fmu3, drawn)
    assert difference(README_PICTURE, drawn) < ALIKE


def test_pictures_are_compared_by_what_they_show(tmp_path: Path) -> None:
    """Moved and scaled a little it is the same; with senses of rotation exchanged it is another."""
    with Image.open(README_PICTURE) as found:
        picture = found.convert("RGB")
    moved = Image.new("RGB", picture.size, "white")
    moved.paste(picture, (3, 2))
    scaled = picture.resize((picture.width + 16, picture.height + 8))
    exchanged = Image.merge("RGB", picture.split()[::-1])
    for name, other, alike in (("moved", moved, True), ("scaled", scaled, True), ("exchanged", exchanged, False)):
        path = tmp_path / f"{name}.png"
        other.save(path)
        assert (difference(README_PICTURE, path) < ALIKE) is alike, name
