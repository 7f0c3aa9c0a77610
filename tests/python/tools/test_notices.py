"""The notices of the software that is linked into what ships."""

import re
import subprocess
from pathlib import Path
from zipfile import ZipFile

import pytest
from conftest import RELEASE, ROOT

from jostle_lab.errors import LabError
from tools.notices import FILE, Crate, compose, linked, notices_of_command_line, notices_of_fmus, texts

KEPT = (ROOT / FILE).read_text(encoding="utf-8")
MIT = "Permission is hereby granted"


def crate(folder: Path, licence: str, **files: str) -> Crate:
    folder.mkdir()
    for name, text in files.items():
        (folder / name.replace("_", "-")).write_text(text)
    return Crate(folder.name, "1.2.3", licence, folder)


def test_the_file_is_what_the_command_writes():
    assert notices_of_fmus(ROOT) == KEPT, "write it again: python -m tools notices"


def test_what_is_linked_is_named_and_nothing_of_the_command_line_is():
    everywhere, library = KEPT.split("In the C library alone:")
    for name in ("bytemuck", "crc32fast", "postcard", "rand", "rand_pcg", "serde", "thiserror", "wide"):
        assert re.search(rf"^  {name} \d", everywhere, re.MULTILINE), name
    assert re.search(r"^  toml \d", library, re.MULTILINE)
    for name in ("clap", "zip", "serde_derive", "thiserror-impl", "proptest", "jostle"):
        assert not re.search(rf"^  {name} \d", KEPT, re.MULTILINE), name


def test_no_random_number_depends_on_the_c_library():
    """With num-traits/std, which any dependency can switch on, rand_distr takes exp and ln from the C library."""
    command = "cargo tree --workspace --edges normal --prefix none --locked --offline"
    tree = subprocess.run(command.split(), cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert re.search(r"^rand_pcg v", tree, re.MULTILINE)
    assert not re.search(r"^rand_distr v", tree, re.MULTILINE)
    sources = [path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.rs")]
    assert sources and not any("num_traits" in source for source in sources)


def test_the_command_line_has_its_own():
    text = notices_of_command_line(ROOT)
    for name in ("clap", "csv", "png", "serde", "zip"):
        assert re.search(rf"^  {name} \d", text, re.MULTILINE), name
    assert not re.search(r"^  (serde_derive|proptest|jostle|toml) \d", text, re.MULTILINE)


@pytest.mark.parametrize("library", sorted(RELEASE.glob("libjostle_*.so")), ids=lambda path: path.stem)
def test_the_crates_that_a_library_tells_of_are_named(library: Path):
    """Their panics carry the names of source files, of the crate's folder as cargo calls it: name-version."""
    told = set(re.findall(rb"([a-z_0-9-]+)-(\d+\.\d+\.\d+)[^/\0 ]*/src/", library.read_bytes()))
    assert told
    for name, version in sorted((name.decode(), version.decode()) for name, version in told):
        assert f"  {name} {version}" in KEPT or f"\n  {name} " in KEPT, f"{name} {version}"


def test_an_fmu_holds_them(fmu: Path):
    with ZipFile(fmu) as archive:
        assert archive.read(f"documentation/licenses/{FILE}").decode() == KEPT


def test_of_a_choice_the_preferred_licence_is_taken(tmp_path: Path):
    files = {"LICENSE_MIT": "mit  \n\n", "LICENSE_APACHE": "apache", "COPYRIGHT": "all of us", "README": "hello"}
    assert texts(crate(tmp_path / "a", "MIT OR Apache-2.0", **files)) == ["mit", "all of us"]
    assert texts(crate(tmp_path / "b", "MIT/Apache-2.0", **files)) == ["mit", "all of us"]
    assert texts(crate(tmp_path / "c", "MIT AND Apache-2.0", **files)) == ["apache", "mit", "all of us"]
    assert texts(crate(tmp_path / "d", "Zlib OR MIT", LICENSE="both")) == ["both"]


def test_a_crate_without_a_licence_file_is_reported(tmp_path: Path):
    with pytest.raises(LabError, match=r"a 1\.2\.3 has no licence file"):
        texts(crate(tmp_path / "a", "MIT", README="MIT"))


def test_equal_notices_are_written_once(tmp_path: Path):
    crates = [crate(tmp_path / name, "MIT", LICENSE=f"{MIT}\n") for name in ("a", "b", "c")]
    text = compose("it holds", {"Everywhere:": crates[:2], "In the C library alone:": crates[2:]}, "of Rust")
    assert text.startswith("Notices of the software that it holds besides jostle itself.")
    assert text.count(MIT) == 1
    assert "\na 1.2.3, b 1.2.3, c 1.2.3\n" in text
    assert text.index("  b 1.2.3") < text.index("C library alone") < text.index("  c 1.2.3")
    assert text.endswith("of Rust\n")


def test_the_answer_of_cargo_is_read():
    tree = "fmu-a v0.1.0 (/some/where)\nserde v1.0.229\nserde v1.0.229 (*)\ntoml v1.2.1+spec-1.1.0\n\nwide v1.7.1\n"
    wanted = {("fmu-a", "0.1.0"), ("serde", "1.0.229"), ("toml", "1.2.1+spec-1.1.0"), ("wide", "1.7.1")}
    assert linked(tree) == wanted
