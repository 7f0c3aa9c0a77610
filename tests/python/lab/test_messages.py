"""What the laboratory says of files, programs and options that are wrong: no traceback, and what to do."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import PROGRAM, ROOT
from matplotlib.figure import Figure

from jostle_lab.demos.packing.command import _seeds
from jostle_lab.errors import LabError, describe_os_error, did_you_mean
from jostle_lab.options import parameters
from jostle_lab.plots.style import save
from jostle_lab.programs import completed, output_of
from jostle_lab.tables import parse_csv, read_table, read_text_rows, write_table

HEAVY = ("fmpy", "joblib", "matplotlib", "numpy", "polars", "scipy")


def run(*words: str | Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """`python -m ...` with a further environment."""
    command = [sys.executable, "-m", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})


def short_of_all(path: Path) -> Path:
    """A folder that cannot be made: it would be inside of a file."""
    path.write_text("a file")
    return path / "folder"


@pytest.mark.parametrize("command", ["demo", "torque-demo", "ratchet-demo", "sweep"])
def test_a_folder_that_cannot_be_made_is_no_traceback(command: str, fmu3: Path, tmp_path: Path) -> None:
    results = short_of_all(tmp_path / "taken")
    made = {name: tmp_path / f"{name}.fmu" for name in ("2", "3", "ratchet")}
    words: dict[str, list[str | Path]] = {
        "demo": ["--fmu", fmu3, "--no-progress"],
        "sweep": ["--scene", "ratchet", "--seconds", "0.001", "--program", PROGRAM, "--no-progress"],
        "torque-demo": ["--fmi2", made["2"], "--fmi3", made["3"], "--sample", "1"],
        "ratchet-demo": ["--fmu", made["ratchet"], "--seconds", "1", "--steps", "2", "--no-progress"],
    }
    for version in ("2", "3"):
        subprocess.run([PROGRAM, "fmu", "three_disk", "--fmi", version, "--out", made[version]], check=True)
    subprocess.run([PROGRAM, "fmu", "ratchet", "--drive", "input", "--out", made["ratchet"]], check=True)
    done = run("jostle_lab", command, *words[command], "--results", results)
    assert done.returncode == 1, done.stderr
    assert "Traceback" not in done.stderr
    assert done.stderr.splitlines()[-1].startswith(f"error: {results}"), done.stderr


def test_a_laboratory_without_the_studies_has_its_commands_all_the_same() -> None:
    """As a wheel installs it: the studies are in the source tree alone."""
    started = (
        "import sys; sys.modules['studies'] = None; sys.argv[1:] = ['--help']; import jostle_lab.cli as c; c.main()"
    )
    done = subprocess.run([sys.executable, "-c", started], capture_output=True, text=True, check=False)
    assert (done.returncode, "Traceback" in done.stderr) == (0, False), done.stderr
    assert "loudspeaker" in done.stdout and "claims" not in done.stdout
    assert "claims" in run("jostle_lab", "--help").stdout


def test_records_that_cannot_be_kept_are_refused_before_the_work(tmp_path: Path) -> None:
    docs, results = short_of_all(tmp_path / "taken"), tmp_path / "results"
    words = ["--compute", "5.6", "--docs", docs, "--results", results, "--program", PROGRAM, "--no-progress"]
    done = run("jostle_lab", "claims", *words)
    assert (done.returncode, "Traceback" in done.stderr) == (1, False), done.stderr
    assert done.stderr.splitlines()[-1].startswith(f"error: {docs}"), done.stderr
    assert not results.exists()


def test_a_tool_without_its_program_or_folder_says_so(tmp_path: Path) -> None:
    absent = run("tools", "binaries", tmp_path / "nothing")
    without_path = run("tools", "notices", "--out", tmp_path / "notices.txt", PATH="")
    for done, said in ((absent, "nothing does not exist"), (without_path, "cargo cannot be started")):
        assert done.returncode == 2, done.stderr
        assert said in done.stderr and "Traceback" not in done.stderr


def test_programs_that_cannot_be_started_are_named(tmp_path: Path) -> None:
    with pytest.raises(LabError, match=r"no-such-program cannot be started: .*Install it"):
        completed(["no-such-program"])
    with pytest.raises(LabError, match=r"The folder .*nowhere does not exist"):
        output_of([sys.executable, "--version"], tmp_path / "nowhere")
    with pytest.raises(LabError, match=r"failed:\nits own words"):
        output_of([sys.executable, "-c", "import sys; sys.exit('its own words')"])


def test_full_disks_and_wrong_tables_name_the_file(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No space left") as full:
        write_table(Path("/dev/full"), [{"a": 1}] * 100_000)
    assert describe_os_error(full.value).startswith("/dev/full: ")
    assert describe_os_error(full.value).endswith("Make room, or name a folder on another disk.")
    picture = tmp_path / "picture.png"
    picture.symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space left") as full:
        save(Figure(), picture)
    assert full.value.filename == str(picture)
    denied = PermissionError(13, "Permission denied", "results")
    assert describe_os_error(denied) == "results: Permission denied. Name a place that you may write to."
    (tmp_path / "empty.csv").touch()
    for read in (read_table, lambda path: read_text_rows([path])):
        with pytest.raises(LabError, match=r"empty\.csv is not a table"):
            read(tmp_path / "empty.csv")
    with pytest.raises(LabError, match="This is no table of numbers"):
        parse_csv("a,b\n1,words\n")


def test_a_table_without_its_columns_is_no_traceback(tmp_path: Path) -> None:
    packing = tmp_path / "packings/seed-0001"
    packing.mkdir(parents=True)
    (tmp_path / "run.json").write_text('{"setup": {}}')
    (packing / "packing.json").write_text('{"seed": 1}')
    (packing / "amplitudes.csv").write_text("a,b\n1,2\n")
    done = run("jostle_lab", "draw", "--results", tmp_path)
    assert (done.returncode, "Traceback" in done.stderr) == (2, False), done.stderr
    assert done.stderr.startswith("error: a table is not as it should be: "), done.stderr


def test_the_nearest_name_is_proposed() -> None:
    known = ("contact.friction", "contact.normal_stiffness", "drive.frequency", "seed")
    assert did_you_mean("contact.frictoin", known) == " Did you mean contact.friction?"
    assert did_you_mean("frequency", known) == " Did you mean drive.frequency?"
    assert did_you_mean("sed", known) == " Did you mean seed?"
    assert did_you_mean("zzz", known) == ""


def test_a_seed_and_a_second_value_are_refused() -> None:
    assert parameters(["seed=3"]) == (("seed", 3.0),)
    with pytest.raises(LabError, match="--set seed is not taken here, since --first-seed"):
        parameters(["seed=3"], seed="--first-seed")
    with pytest.raises(LabError, match="--set a is given more than once"):
        parameters(["a=1", "b=2", "a=1"])


def test_seeds_are_what_an_integer_of_fmi_2_holds() -> None:
    assert _seeds(2**31 - 2, 2) == (2**31 - 2, 2**31 - 1)
    with pytest.raises(LabError, match="gives 2 packings seeds up to 2147483648, the largest is 2147483647"):
        _seeds(2**31 - 1, 2)
    assert run("jostle_lab", "demo", "--first-seed", "2147483648").returncode == 2


def test_the_demo_refuses_grains_that_cannot_land_before_it_begins(fmu3: Path, tmp_path: Path) -> None:
    words = ["--exchange", "planned", "--set", "base.extrapolation_degree=1", "--results", tmp_path / "results"]
    done = run("jostle_lab", "demo", "--fmu", fmu3, "--no-progress", *words)
    assert (done.returncode, done.stdout) == (2, ""), done.stderr
    assert done.stderr.startswith("error: The planned exchange needs grains with base.extrapolation_degree = 2, not 1.")
    assert "Leave out --set base.extrapolation_degree" in done.stderr
    assert not (tmp_path / "results").exists()


def test_the_torque_demo_asks_for_both_versions_of_fmi(tmp_path: Path) -> None:
    three, broken = tmp_path / "three.fmu", tmp_path / "broken.fmu"
    subprocess.run([PROGRAM, "fmu", "three_disk", "--fmi", "3", "--out", three], check=True)
    broken.write_text("not a zip")
    for two, said in (
        (three, "is an FMU for FMI 3.0, not 2.0"),
        (broken, "is not a readable FMU"),
        (tmp_path / "none.fmu", "No FMU at"),
    ):
        done = run("jostle_lab", "torque-demo", "--fmi2", two, "--fmi3", three, "--results", tmp_path / "results")
        assert done.returncode == 2, done.stderr
        assert said in done.stderr and "jostle fmu three_disk --drive input --fmi 2 --out" in done.stderr
    assert not (tmp_path / "results").exists()


@pytest.mark.parametrize(
    ("package", "command", "what"),
    [
        ("jostle_lab", "ratchet-demo", "Hold Gamma of a shaken ratchet by feedback"),
        ("studies", "figure", "Compute figures of the papers anew"),
        ("tools", "import-circles", "Look for Rust files that import each other"),
    ],
)
def test_help_lists_the_commands_and_waits_for_nothing_heavy(package: str, command: str, what: str) -> None:
    program = f"""
import runpy, sys
sys.argv = [{package!r}, "--help"]
try:
    runpy.run_module({package!r}, run_name="__main__")
finally:
    print("loaded:", sorted(set({HEAVY!r}) & set(sys.modules)))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert command in done.stdout and what in done.stdout, done.stderr
    assert done.stdout.splitlines()[-1] == "loaded: []"


def test_a_command_that_is_imported_late_has_its_options() -> None:
    for words, option in (
        (["tools", "notices"], "--command-line"),
        (["studies", "figure"], "--quick"),
        (["jostle_lab", "claims"], "--compute"),
    ):
        done = run(*words, "--help")
        assert option in done.stdout, done.stderr
    assert run("tools", "notcies").returncode == 2


@pytest.mark.parametrize("package", ["jostle_lab", "studies", "tools"])
def test_an_interrupt_while_modules_are_loaded_is_no_traceback(package: str, tmp_path: Path) -> None:
    (tmp_path / "typer.py").write_text("raise KeyboardInterrupt")
    path = os.pathsep.join([str(tmp_path), str(ROOT / "scripts")])
    done = run(package, PYTHONPATH=path)
    assert (done.returncode, done.stderr) == (130, "")


def test_help_of_the_demo_installs_nothing(tmp_path: Path) -> None:
    """A checkout without anything but the script: the set-up is not even there."""
    scripts = tmp_path / "scripts"
    scripts.mkdir()
    for name in ("demo", "common.sh"):
        (scripts / name).write_bytes((ROOT / "scripts" / name).read_bytes())
    (tmp_path / "rust-toolchain.toml").touch()
    for option in ("--help", "-h"):
        done = subprocess.run(["bash", scripts / "demo", option], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert done.stdout.startswith("Usage: scripts/demo")
