"""What `scripts/release` built, run on Linux, by wine for Windows and by qemu for 64-bit Arm: the same bits everywhere.

Skipped, by the name of the system, where that was not built. `scripts/release --check` runs these tests, and `.ci/run`
does on two scenes.
"""

import functools
import shutil
import subprocess
import zipfile
from collections.abc import Iterator
from pathlib import Path

import fmpy
import numpy as np
import pytest
from conftest import ROOT
from systems import HEADERS, HERE, IS_TRIAL, PROBES, RELEASE, SYSTEMS, System, system

OTHERS = [name for name in SYSTEMS if name != "x86_64-linux"]
CYCLES = 200
ODD_NAMES = Path("Körner und Sand") / "ein 振動 folder"
LONGEST = 250
"""Characters of a path; Windows alone stops at 260 where a program does not ask for more."""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("systems")


@pytest.fixture(scope="module")
def linux(made: Path) -> System:
    """What the others are compared with."""
    return prepared("x86_64-linux", made)


@pytest.fixture(scope="module", params=OTHERS)
def other(request: pytest.FixtureRequest, made: Path) -> System:
    return prepared(request.param, made)


@pytest.fixture(scope="module", params=SYSTEMS)
def each(request: pytest.FixtureRequest, made: Path) -> System:
    return prepared(request.param, made)


@functools.cache
def prepared(name: str, made: Path) -> System:
    folder = made / name
    folder.mkdir(exist_ok=True)
    return system(name, folder)


def fmus(version: int) -> list[Path]:
    """The two smallest; all of them are replayed."""
    return sorted((RELEASE / "fmu").glob(f"*.fmi{version}.fmu"), key=lambda fmu: fmu.stat().st_size)[:2]


def host(system: System) -> Path:
    return system.compiled(HERE / "host.c", f"-I{HEADERS}")


def reference(fmu: Path, name: str) -> str:
    variables = fmpy.read_model_description(str(fmu)).modelVariables
    return str(next(variable.valueReference for variable in variables if variable.name == name))


def unpacked(system: System, fmu: Path, folder: Path) -> tuple[Path, str]:
    """The library of a system out of an FMU of FMI 3.0, in `folder`, and the token."""
    description = fmpy.read_model_description(str(fmu))
    suffix = ".dll" if system.is_windows else ".so"
    member = f"binaries/{system.name}/{description.coSimulation.modelIdentifier}{suffix}"
    folder.mkdir(parents=True, exist_ok=True)
    library = folder / Path(member).name
    with zipfile.ZipFile(fmu) as archive:
        library.write_bytes(archive.read(member))
    return library, description.guid


def three_disk() -> Path:
    found = RELEASE / "fmu" / "three_disk-molecular-dynamics-input.fmi3.fmu"
    return found if found.is_file() else fmus(3)[0]


def test_an_fmu_of_all_systems_runs_in_fmpy_on_linux(linux: System) -> None:
    assert linux.jostle.is_file()
    for fmu in (*fmus(2), *fmus(3)):
        names = zipfile.ZipFile(fmu).namelist()
        held = sorted(name.split("/")[1] for name in names if name.startswith("binaries/"))
        built = sorted(folder.name for folder in RELEASE.iterdir() if "-" in folder.name and folder.is_dir())
        old_names = {"x86_64-linux": "linux64", "x86_64-windows": "win64", "x86_64-darwin": "darwin64"}
        in_two = sorted(old_names[name] for name in built if name in old_names)
        assert held == (in_two if ".fmi2." in fmu.name else built)
        result = fmpy.simulate_fmu(str(fmu), stop_time=0.1, output_interval=0.01)
        assert len(result) == 11
        assert all(np.isfinite(result[name]).all() for name in result.dtype.names)


def test_every_fmu_follows_its_reference_to_the_bit(each: System) -> None:
    version = "" if each.name.startswith("x86_64") else ".fmi3"
    found = sorted((RELEASE / "fmu").glob(f"*{version}.fmu"))
    assert found
    for fmu in found:
        assert ", 0 differ in some bit" in each.output(each.jostle, "replay", "--exact", fmu), fmu


def test_fmi_2_has_no_library_for_arm(made: Path) -> None:
    arm = prepared("aarch64-linux", made)
    done = arm.run(arm.jostle, "replay", fmus(2)[0])
    assert done.returncode != 0
    assert "FMI 2.0 has no folder for the library of this system, aarch64-linux. Name the FMU of FMI 3.0" in done.stderr


def all_scenes(system: System) -> str:
    link = system.library("jostle_c")
    if system.is_windows:
        shutil.copy(link, system.made)  # where Windows looks first
        options = [str(system.folder / "libjostle_c.dll.a")]
    else:
        options = [str(link), f"-Wl,-rpath,{system.folder}"]
    return system.output(system.compiled(HERE / "all_scenes.c", f"-I{RELEASE / 'include'}", *options))


@pytest.mark.skipif(IS_TRIAL, reason="without optimisation all scenes take minutes")
def test_every_scene_of_the_c_library_has_the_same_bits(linux: System, other: System) -> None:
    expected = all_scenes(linux)
    assert len(expected.splitlines()) >= 17
    assert all_scenes(other).splitlines() == expected.splitlines()


@pytest.mark.skipif(IS_TRIAL, reason="it has no C library")
def test_the_example_in_c_runs(each: System) -> None:
    """Its sine is that of the system's C library, so that the angle may differ after two seconds."""
    program = system_program(each, ROOT / "capi" / "examples" / "shaken_packing.c")
    angle, force = (float(line.split()[-2]) for line in each.output(program).splitlines())
    assert 0.01 < abs(angle) < 100.0
    assert force == pytest.approx(-2.748, rel=0.01)


def system_program(system: System, source: Path) -> Path:
    all_scenes(system)  # puts the library beside the program
    link = [str(system.folder / "libjostle_c.dll.a")] if system.is_windows else [str(system.library("jostle_c"))]
    rpath = [] if system.is_windows else [f"-Wl,-rpath,{system.folder}"]
    return system.compiled(source, f"-I{RELEASE / 'include'}", *link, *rpath)


def test_a_panic_stays_in_its_instance(linux: System, other: System) -> None:
    fmu = PROBES / "probe.fmi3.fmu"
    words = [reference(fmu, "fault.panic_time"), reference(fmu, "body.position[1]")]
    seen = []
    for one in (linux, other):
        library, token = unpacked(one, fmu, one.made / "probe")
        seen.append(one.output(host(one), library, token, "panic", "-", *words).splitlines())
    assert seen[0] == seen[1]
    steps = [line.split() for line in seen[0][:8]]
    assert [step[0] for step in steps] == ["done"] * 5 + ["refused"] * 3
    assert seen[0][8] == steps[7][1], "after a reset it is as its neighbour"


@pytest.mark.parametrize("kind", ["odd names", "a long path"])
def test_a_library_is_loaded_and_unloaded_from_any_folder(other: System, tmp_path: Path, kind: str) -> None:
    fmu = three_disk()
    folder = tmp_path / ODD_NAMES
    if kind == "a long path":
        library, _ = unpacked(other, fmu, tmp_path / "elsewhere")
        left = LONGEST - len(f"/{library.name}") - len(other.path(tmp_path))
        folder = tmp_path / ("y" * (left // 2 - 1)) / ("z" * (left - left // 2 - 1))
    library, token = unpacked(other, fmu, folder)
    variable = reference(fmu, "disk.angle[1]")
    printed = other.output(host(other), library, token, "cycles", str(CYCLES), "-", variable).splitlines()
    assert len(printed) == 2
    assert printed[0] == printed[1]
    if kind == "a long path":
        assert len(other.path(library)) == LONGEST
    # jostle takes the library out of the FMU into the folder of temporary files; wine has one of its own.
    copy = Path(shutil.copy(fmu, folder / "it.fmu"))
    assert ", 0 differ" in other.output(
        other.jostle, "replay", "--exact", copy, **({} if other.is_windows else {"TMPDIR": str(folder)})
    )
    assert sorted(path.name for path in folder.iterdir()) == sorted([library.name, "it.fmu"]), "nothing is left behind"
    assert list(other.made.glob("wine/drive_c/users/*/Temp/fmu-*")) == []


@pytest.fixture(scope="module")
def saved(linux: System) -> Iterator[tuple[Path, list[str]]]:
    yield state_of(linux)


def state_of(system: System) -> tuple[Path, list[str]]:
    """A file with the state of the middle of a run, and what comes after it."""
    library, token = unpacked(system, three_disk(), system.made / "state")
    file = system.made / "state.bin"
    printed = system.output(host(system), library, token, "save", file, *inputs()).splitlines()
    return file, printed[printed.index("on") + 1 :]


def inputs() -> list[str]:
    fmu = three_disk()
    names = {variable.name for variable in fmpy.read_model_description(str(fmu)).modelVariables}
    return [reference(fmu, "torque") if "torque" in names else "-", reference(fmu, "disk.angle[1]")]


def test_a_state_of_one_system_goes_on_in_another(saved: tuple[Path, list[str]], linux: System, other: System) -> None:
    file, expected = saved
    theirs, after = state_of(other)
    assert len(set(expected)) > 4, "the disk turns"
    assert after == expected
    assert theirs.read_bytes() == file.read_bytes(), "the same bytes"
    for reader, state in ((other, file), (linux, theirs)):
        library, token = unpacked(reader, three_disk(), reader.made / "state")
        printed = reader.output(host(reader), library, token, "restore", state, *inputs()).splitlines()
        assert printed[1:] == expected


@pytest.mark.skipif(IS_TRIAL, reason="a plain build has no version in its name")
def test_other_libraries_are_found_under_the_name_of_their_interface(linux: System, made: Path) -> None:
    """A program that was linked with pkg-config looks for the version that it was made for."""
    version = fmpy.read_model_description(str(fmus(3)[0])).version
    words = ["objdump", "-p", str(linux.library("jostle_c"))]
    said = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    assert f"SONAME               libjostle_c.so.{version.rpartition('.')[0]}\n" in said
    assert f"Version: {version}\n" in (linux.folder / "jostle.pc").read_text()
    if shutil.which("pkg-config"):
        words = ["pkg-config", "--cflags", "--libs", str(linux.folder / "jostle.pc")]
        flags = subprocess.run(words, check=True, capture_output=True, text=True).stdout.split()
        program = made / "by-pkg-config"
        source = str(ROOT / "capi/examples/shaken_packing.c")
        subprocess.run(["c++", "-x", "c++", source, "-o", str(program), *flags, "-lm"], check=True)
        done = subprocess.run([program], env={"LD_LIBRARY_PATH": str(linux.folder)}, capture_output=True, check=True)
        assert done.stdout.startswith(b"angle of disk 1: ")


@pytest.mark.skipif(IS_TRIAL, reason="a plain build may hold paths")
def test_windows_and_linux_libraries_hold_no_path_of_the_build(each: System) -> None:
    for file in each.folder.iterdir():
        content = file.read_bytes()
        if file.suffix in {".so", ".dll", ".exe"} or file.name == "jostle":
            assert str(ROOT).encode() not in content, file
            assert str(Path.home() / ".cargo").encode() not in content, file
