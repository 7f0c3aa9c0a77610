"""The libraries that scripts/setup built: what they ask of the machine, and what is in them."""

import os
from pathlib import Path

import pytest
from conftest import RELEASE, ROOT

from jostle_lab.errors import LabError
from tools.release.binaries import INPUTS, MODULES, OLDEST_GLIBC, SYSTEM, components, needs, strangers
from tools.release.verify import in_a_child

LIBRARIES = sorted(RELEASE.glob("libjostle_*.so"))
WORDS = {
    "packing": b"box.width",
    "ratchet": b"tooth.width",
    "wedge": b"wedge.aperture",
    "three_disk": b"skin.departure",
}
SHIPPED = sorted((ROOT / "build" / "release" / "x86_64-linux").glob("libjostle_*.so"))


def test_every_scene_and_every_component_of_the_laboratory_has_its_library():
    names = (*components(), "jostle_c")
    assert {library.stem for library in LIBRARIES} == {f"lib{name}" for name in names}


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda path: path.stem)
def test_nothing_but_the_system_is_asked_for(library: Path):
    """Built here, a library needs this machine's glibc and the compiler's unwinder; scripts/release needs neither."""
    assert needs(library).libraries <= SYSTEM | {"libgcc_s.so.1"}


@pytest.mark.parametrize("library", LIBRARIES, ids=lambda path: path.stem)
def test_the_variables_of_other_scenes_are_not_in_it(library: Path):
    if library.stem == "libjostle_c":
        return
    bytes_of = library.read_bytes()
    held = {scene for scene, word in WORDS.items() if word in bytes_of}
    assert all(library.stem.startswith(f"libjostle_{scene}") for scene in held)


@pytest.mark.skipif(not SHIPPED, reason="scripts/release has not run here")
@pytest.mark.parametrize("library", SHIPPED, ids=lambda path: path.stem)
def test_what_ships_runs_on_an_old_system(library: Path):
    found = needs(library)
    assert found.glibc <= OLDEST_GLIBC
    assert found.libraries <= SYSTEM


def test_modules_and_types_that_no_library_of_another_scene_may_hold_exist():
    source = {path: path.read_text() for path in (ROOT / "src").rglob("*.rs")}
    for name in {*MODULES, INPUTS}:
        *modules, last = name.split("::")
        is_type = any(f"pub struct {last}<" in text or f"pub struct {last} " in text for text in source.values())
        place = ROOT.joinpath("src", *modules, last)
        assert is_type or place.is_dir() or place.with_suffix(".rs") in source, name


def test_a_stripped_library_is_reported():
    with pytest.raises(Exception, match="no symbol table"):
        strangers(RELEASE / "libjostle_packing.so")


def abort(_fmu: Path) -> None:
    os.abort()


def test_a_process_that_a_panic_ends_is_reported(tmp_path: Path):
    with pytest.raises(LabError, match="ended its process with exit code -6"):
        in_a_child(abort, tmp_path / "it.fmu")
