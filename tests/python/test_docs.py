"""The programs and commands of the pages, run as they stand there: same motion, same bits."""

import math
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import fmpy
import pytest
from conftest import ROOT
from snippets import LANGUAGES, RELEASE, compiled, python, run, shell, snippet, snippets

BUILD = ROOT / "build"
WEIGHT = 3.57 * math.pi * 20 * (0.015**2 + 0.020**2 + 0.025**2) * 9.8
STATIC_LIBRARY = (str(RELEASE / "libjostle_c.a"), "-lm", "-lpthread", "-ldl")
CONTROL, PHYSICIST, PYTHON, C, RUST, FILES = (
    f"docs/{name}.md" for name in ("control-engineer", "physicist", "python", "c", "rust", "files")
)
RUN_ELSEWHERE = {
    (RUST, "rust", ""),  # src/lib.rs: tests of the documentation
    (RUST, "toml", ""),  # a line of a Cargo.toml
}


@dataclass(frozen=True)
class Printed:
    angle: float
    force: float


def printed(output: str) -> Printed:
    found = re.search(r"^angle of disk 1: (\S+) rad\nmean force on the base: (\S+) N$", output, re.MULTILINE)
    assert found, f"printed something else:\n{output}"
    return Printed(float(found[1]), float(found[2]))


def check(output: str, reference: Printed) -> None:
    """To the last bit; but each host adds the forces up in its own order."""
    seen = printed(output)
    assert seen.angle == reference.angle
    assert seen.force == pytest.approx(reference.force, rel=1e-12)


@pytest.fixture(scope="module")
def reference(fmu3: Path) -> Printed:
    """What fmpy prints with the FMI 3.0 FMU."""
    assert fmu3.is_file()
    return printed(python(snippet(CONTROL, "python", "fmpy")))


def test_every_snippet_is_run_by_a_test():
    source = Path(__file__).read_text()
    missing = []
    for found in snippets():
        if found.language not in LANGUAGES or (found.page, found.language, found.name) in RUN_ELSEWHERE:
            continue
        if f'"{found.language}", "{found.name}")' not in source or not found.name:
            missing.append(f"{found.page}: ```{found.language} {found.name}")
    assert missing == []


def test_force_is_minus_the_weight_and_disks_turn(reference: Printed):
    assert reference.force == pytest.approx(-WEIGHT, rel=0.01)
    assert f"weight of the disks, {WEIGHT:.3f} N," in (ROOT / "README.md").read_text().replace("\n", " ")
    assert 0.01 < abs(reference.angle) < 100.0


def test_first_fmu_of_the_readme_prints_the_same(reference: Printed):
    program = snippet("README.md", "python", "first-fmu")
    check(python(program), reference)
    assert len(program.splitlines()) <= 11


def test_fmpy_prints_the_same_with_the_other_version(fmu2: Path, reference: Printed):
    program = snippet(CONTROL, "python", "fmpy").replace('"build/packing.fmu"', f'"build/{fmu2.name}"')
    assert program != snippet(CONTROL, "python", "fmpy")
    check(python(program), reference)


def test_libcosim(fmu2: Path, reference: Printed):
    assert f"build/{fmu2.name}" in snippet(CONTROL, "python", "libcosim")
    check(python(snippet(CONTROL, "python", "libcosim")), reference)


def test_controller_holds_gamma_of_a_loaded_shaker_and_its_cpp_twin_to_the_last_digit(fmu3: Path):
    assert fmu3.is_file()
    output = python(snippet(CONTROL, "python", "gamma"))
    found = re.search(r"^Gamma (\S+) in the mean, off by (\S+) at most, with \S+ N$", output)
    assert found, output
    assert float(found[1]) == pytest.approx(2.0, abs=0.005)
    assert float(found[2]) < 0.15
    (BUILD / "gamma.cpp").write_text(snippet(CONTROL, "cpp", "gamma"))
    assert shell(snippet(CONTROL, "sh", "gamma-cpp")) == output


def test_master_chooses_its_steps(fmu3: Path):
    assert str(fmu3.relative_to(ROOT)) in snippet(CONTROL, "python", "step-control")
    found = re.fullmatch(r"(\d+) steps of (.*) to (.*) ms\n", python(snippet(CONTROL, "python", "step-control")))
    assert found is not None
    assert 20 < int(found[1]) < 1000
    assert 0.01 < float(found[2]) < float(found[3]) < 10.0


def test_whole_steps_are_taken_back_and_done_in_halves(fmu3: Path):
    assert fmu3.is_file()
    output = python(snippet(CONTROL, "python", "states"))
    found = re.search(r"differ by (\S+) N in the mean force", output)
    assert found and 0.0 < float(found[1]) < 0.5, output


def test_friction_changes_during_a_run_and_the_balance_stays_closed(fmu3: Path):
    assert fmu3.is_file()
    output = python(snippet(CONTROL, "python", "tune"))
    found = re.search(r"friction at the end: (\S+)\nlost between 0.2 s and 0.3 s: (\S+) J, residual (\S+) J", output)
    assert found, output
    assert float(found[1]) == 0.05
    assert 0.0 < float(found[3]) < 0.05 * float(found[2]), output


def test_two_packings_and_a_disk_on_threads_are_those_of_one_thread(jostle: Path, fmu3: Path):
    assert fmu3.is_file()
    run(str(jostle), "fmu", "three_disk", "--fmi", "3", "--out", str(BUILD / "three_disk.fmu"))
    output = python(snippet(CONTROL, "python", "two"))
    found = re.search(r"^mean load (\S+) N, angle (\S+) rad; the same bits without threads: True$", output)
    assert found, output
    assert float(found[1]) == pytest.approx(-2 * WEIGHT, rel=0.02)


def test_discarded_step_leaves_an_instance_that_goes_on(fmu3: Path):
    assert fmu3.is_file()
    output = python(snippet(CONTROL, "python", "discard"))
    assert "refused with status 2" in output
    assert "the next step went through" in output


def test_fmus_are_made_as_the_guide_says(reference: Printed):
    shell(snippet(CONTROL, "sh", "make-fmus"))
    assert (BUILD / "packing_200.fmu").stat().st_size > 100_000
    check(python(snippet(CONTROL, "python", "fmpy")), reference)


def test_shaker_of_the_system_file_holds_gamma():
    shell(snippet(CONTROL, "sh", "shaker-system"))
    output = python(snippet(CONTROL, "python", "shaker-system"))
    found = re.fullmatch(r"Gamma (\S+) at \S+ V\namplitude by the accelerometer (\S+) g\n", output)
    assert found, output
    assert float(found[1]) == pytest.approx(2.0, abs=0.1)
    assert float(found[2]) == pytest.approx(2.0, abs=0.02)


def test_torque_demo_holds_the_disk():
    output = shell(snippet(CONTROL, "sh", "torque-demo"))
    assert "event mode" in output


@pytest.mark.parametrize("language", ["c", "c++"])
def test_c_fmu(language: str, fmu3: Path, reference: Printed):
    assert fmu3.is_file()
    (BUILD / "shake.c").write_text(snippet(C, "c", "fmu"))
    check(shell(snippet(C, "sh", "c-fmu")), reference)
    headers = Path(fmpy.__path__[0]) / "c-code"
    check(compiled(BUILD / "shake.c", language, "-I", str(headers), "-ldl", "-lm"), reference)


def test_c_library(reference: Printed):
    example = ROOT / "capi" / "examples" / "shaken_packing.c"
    assert example.read_text() == snippet(C, "c", "library")
    check(shell(snippet(C, "sh", "c-library")), reference)
    copy = BUILD / "shaken_packing_as_cpp.c"
    copy.write_text(example.read_text())
    check(compiled(copy, "c++", "-I", "include", *STATIC_LIBRARY), reference)


@pytest.mark.parametrize("language", ["c", "c++"])
def test_c_library_from_toml_goes_back_to_a_state(language: str):
    source = BUILD / "states.c"
    source.write_text(snippet(C, "c", "states"))
    output = compiled(source, language, "-I", "include", *STATIC_LIBRARY)
    first, again = re.findall(r"(-?[\d.]+) rad", output)
    assert first == again
    assert float(first) != 0.0


def test_rust(reference: Printed):
    assert (ROOT / "examples" / "shaken_packing.rs").read_text() == snippet(RUST, "rust", "no_run program")
    check(shell(snippet(RUST, "sh", "run-example")), reference)


def test_runs_of_the_command_line_become_arrays():
    output = shell(snippet(PHYSICIST, "sh", "runs"))
    assert "drive.amplitude" in output
    assert len((BUILD / "run.csv").read_text().splitlines()) == 1002
    seen = python(snippet(PHYSICIST, "python", "run-csv"))
    force = re.search(r"mean force on the base: (\S+) N", seen)
    assert force and float(force[1]) == pytest.approx(-WEIGHT, rel=0.05), seen


def test_a_page_is_written():
    shell(snippet("docs/live.md", "sh", "view"))
    assert "jostle/app" in (BUILD / "ratchet.html").read_text()


def test_films_of_a_dataset_a_file_and_a_scene_are_made(tmp_path: Path):
    python(snippet("docs/film.md", "python", "film"), tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["packing.mp4"]
    shell(snippet("docs/film.md", "sh", "film"))
    assert (BUILD / "film.gif").read_bytes().startswith(b"GIF89a")
    assert (BUILD / "film.html").read_text().startswith("<!doctype html>")


def test_files_of_the_command_line_are_read_in_python():
    lines = shell(snippet(FILES, "sh", "formats")).splitlines()
    assert "time,mean_velocity,transport_velocity" in lines
    seen = python(snippet(FILES, "python", "files"))
    assert "unit: m/s\nTrue 25.0\n" in seen


def test_a_large_packing_has_the_same_bits_on_two_threads_as_on_one():
    command = snippet(PHYSICIST, "sh", "threads")
    shell(command)
    two = (BUILD / "large.csv").read_text()
    shell(command.replace("threads=2", "threads=1"))
    assert len(two.splitlines()) == 4
    assert (BUILD / "large.csv").read_text() == two


def test_stopped_run_goes_on_with_the_same_bits():
    assert shell(snippet(FILES, "sh", "resume")).endswith("the same\n")


def test_sweep_writes_parquet_that_pandas_reads():
    run("rm", "-rf", str(BUILD / "sweep"))
    shell(snippet(PHYSICIST, "sh", "sweep"))
    assert list((BUILD / "sweep").glob("part-*.parquet"))
    rows = python(snippet(PHYSICIST, "python", "sweep")).splitlines()[2:]
    assert [float(row.split()[0]) for row in rows] == [20.0, 30.0]
    assert all(len(row.split()) == 3 for row in rows)


def test_grid_of_the_page_of_figures_is_read():
    (BUILD / "page.toml").write_text(snippet("docs/figures.md", "toml", "grid"))
    small = ["--seconds", "0.02", "--seeds", "1", "--grid", "drive.frequency=15", "--grid", "disks=5"]
    places = ["--results", str(BUILD / "sweep-page")]
    run(sys.executable, "-m", "jostle_lab", "sweep", str(BUILD / "page.toml"), *small, *places)
    assert list((BUILD / "sweep-page").glob("part-*.parquet"))


def test_peers_are_built_and_run():
    output = shell("exec 2>&1\n" + snippet("benches/peers/README.md", "sh", "peers"))
    assert "refed N=" in output


@pytest.mark.parametrize(
    "program",
    [
        (PYTHON, "python", "dataset"),
        (PYTHON, "python", "rotation"),
        (PYTHON, "python", "pandas"),
        (PYTHON, "python", "error bars"),
        (PYTHON, "python", "loop"),
        (PYTHON, "python", "installed"),
        (PYTHON, "python", "contacts"),
        (PYTHON, "python", "states"),
        (PYTHON, "python", "tunable"),
        (PYTHON, "python", "refusal"),
        ("python/README.md", "python", "package"),
        ("README.md", "python", "first-run"),
    ],
)
def test_guide_for_python(program: tuple[str, str, str], tmp_path: Path) -> None:
    assert python(snippet(*program), tmp_path) or program[2] == "states"  # one of them writes a file
