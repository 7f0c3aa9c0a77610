"""Sweeps: grids, Parquet parts, a real kill in the middle, failures that are kept, a scheduler by its address."""

import os
import signal
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path

import pandas as pd
import polars as pl
import pytest
from distributed import LocalCluster
from typer.testing import CliRunner

from jostle_lab.cli import application
from jostle_lab.errors import LabError
from jostle_lab.locate import fingerprint
from jostle_lab.runs.build import Build
from jostle_lab.runs.child import Children
from jostle_lab.runs.command import _axis
from jostle_lab.runs.command import sweep as command_sweep
from jostle_lab.runs.grid import Grid, make_grid, read_grid
from jostle_lab.runs.limits import of_package, of_program, refuse_what_no_run_takes
from jostle_lab.runs.native import Program
from jostle_lab.runs.package import Package, installed_version
from jostle_lab.runs.run import Run
from jostle_lab.runs.store import DRAFT, MANY_PARTS, Store
from jostle_lab.runs.sweep import Sweep, Workers
from jostle_lab.runs.worker import DONE, FAILED

SPEC = """
scene = "ratchet"
seconds = 4.0
seeds = 3
[set]
tooth.height = 3e-3
"tooth.asymmetry" = 0.1
tooth.count = 12.0
[grid]
"drive.frequency" = {from = 15.0, to = 30.0, count = 4}
disks = [10, 20]
"""


@pytest.fixture(scope="module")
def package() -> Package:
    return Package(installed_version())


@pytest.fixture(scope="module")
def program(jostle: Path) -> Program:
    return Program(str(jostle), fingerprint(jostle))


@pytest.fixture(params=["package", "program"])
def build(request: pytest.FixtureRequest) -> Build:
    found: Build = request.getfixturevalue(request.param)
    return found


def sweep(folder: Path, build: Build, **others: object) -> Sweep:
    return Sweep(Store(folder), build, show_progress=False, **others)  # type: ignore[arg-type]


def numbers(row: dict[str, object]) -> dict[str, object]:
    """What two builds, or two machines, have in common."""
    others = ("key", "program", "host", "finished", "processor_seconds", "clock_seconds")
    return {name: value for name, value in row.items() if name not in others and value is not None}


def test_a_grid_is_every_combination_with_every_seed(tmp_path: Path) -> None:
    path = tmp_path / "grid.toml"
    path.write_text(SPEC)
    runs = read_grid(path).runs()
    assert len(set(runs)) == len(runs) == 4 * 2 * 3
    assert {run.disks for run in runs} == {10, 20}
    assert sorted({dict(run.settings)["drive.frequency"] for run in runs}) == [15.0, 20.0, 25.0, 30.0]
    assert all(dict(run.settings)["tooth.height"] == 3e-3 for run in runs)
    assert all("tooth.count=12" in run.arguments() for run in runs)  # an integer to the program
    narrowed = read_grid(path, {"set": {"drive.frequency": 20.0}, "seeds": 1}).runs()
    assert [run.disks for run in narrowed] == [10, 20]
    assert all(dict(run.settings) | {"drive.frequency": 20.0, "seed": 1} == dict(run.settings) for run in narrowed)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({"scene": "ratchet"}, "seconds is missing"),
        ({"scene": "rachet", "seconds": 1}, "none of packing, wedge, ratchet, three_disk"),
        ({"scene": "ratchet", "seconds": -1}, "not a time above 0"),
        ({"scene": "ratchet", "seconds": float("nan")}, "not a finite number"),
        ({"scene": "ratchet", "seconds": 1, "speed": 2}, "speed is not known"),
        ({"scene": "ratchet", "seconds": 1, "sceen": 2}, "Did you mean scene"),
        ({"scene": "ratchet", "seconds": 1, "set": {"seed": 3}}, "seed is neither set nor"),
        ({"scene": "ratchet", "seconds": 1, "grid": {"seed": [3]}}, "seed is neither set nor"),
        ({"scene": "ratchet", "seconds": 1, "seeds": 0}, "seeds has no values"),
        ({"scene": "ratchet", "seconds": 1, "seeds": [1.5]}, "seeds"),
        ({"scene": "ratchet", "seconds": 1, "grid": {"gravity": []}}, "gravity has no values"),
        ({"scene": "ratchet", "seconds": 1, "grid": {"gravity": "9.8"}}, "gravity = '9.8' is no axis"),
        ({"scene": "ratchet", "seconds": 1, "grid": {"disks": [10.5]}}, "disks = 10.5"),
        ({"scene": "ratchet", "seconds": 1, "grid": {"gravity": [9.8]}, "set": {"gravity": 1.0}}, "both fixed and"),
        ({"scene": "ratchet", "seconds": 1, "grid": {"gravity": {"from": 1, "to": 2, "count": 1}}}, "2 or more"),
        ({"scene": "ratchet", "seconds": 1, "seeds": 2_000_000}, "allowed are"),
    ],
)
def test_a_grid_that_cannot_be_run_is_refused_by_name(table: dict[str, object], message: str) -> None:
    with pytest.raises(LabError, match=message):
        make_grid(table, {}, "grid").runs()


def test_axes_of_the_command_line() -> None:
    assert _axis("disks=10,20") == ("disks", [10.0, 20.0])
    assert _axis("gravity=1:2:3") == ("gravity", {"from": 1.0, "to": 2.0, "count": 3})
    for wrong in ("gravity", "gravity=", "gravity=1,x", "gravity=1:2", "gravity=1:2:x"):
        with pytest.raises(LabError, match="--grid"):
            _axis(wrong)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--grid", "foo=1:2:3"], "foo is no parameter of ratchet with the engine event-driven and the drive sine"),
        (["--grid", "drive.frequncy=15,20"], "Did you mean drive.frequency?"),
        (["--set", "frequency=15"], "Did you mean drive.frequency?"),
        (["--grid", "drive.frequency=15,-1"], "drive.frequency = -1 is outside [0, 1e+06]"),
        (["--grid", "disks=10,9999999"], "disks = 9999999 is not allowed: 1 to"),
        (["--engine", "event-drvien"], "engine = event-drvien is not allowed: one of: event-driven"),
        (["--drive", "wind"], "one of: input, sine"),
        (["--grid", "seed=1,2"], "seed is neither set nor on the grid"),
        (["--set", "gravity=1", "--set", "gravity=2"], "--set gravity is given more than once"),
        (["--grid", "gravity=1", "--grid", "gravity=2"], "--grid gravity is given more than once"),
    ],
)
def test_a_grid_that_every_run_would_refuse_is_refused_once(options: list[str], message: str, tmp_path: Path) -> None:
    words = ["sweep", "--scene", "ratchet", "--seconds", "0.01", *options, "--results", str(tmp_path / "sweep")]
    refused = CliRunner().invoke(application("", command_sweep), words).exception
    assert isinstance(refused, LabError) and message in str(refused)
    assert not (tmp_path / "sweep").exists()  # nothing was run


@pytest.mark.parametrize(
    ("scene", "engine"), [("packing", "molecular-dynamics"), ("packing", "event-driven"), ("wedge", "map")]
)
def test_package_and_program_tell_the_same_ranges(scene: str, engine: str, jostle: Path) -> None:
    (run,) = Grid(scene, 1.0, engine=engine).runs()
    known, told = of_package(run), of_program(jostle)(run)
    assert known.keys() == told.keys()
    # The program prints six digits.
    assert all(known[name] == pytest.approx(told[name], rel=1e-4) for name in known if abs(told[name][1]) < 1e300)
    refuse_what_no_run_takes(of_package, [run])


def test_ranges_of_numbers_of_options_and_of_no_outputs() -> None:
    (run,) = Grid("packing", 1.0, engine="event-driven").runs()
    known = of_package(run)
    assert known["gravity"] == (0.0, 1e4)
    assert known["base.model"] == (1, 2)  # an enumeration, by number
    assert "disk.angle" not in known and "disk.angle[1]" not in known


def test_the_last_row_of_a_run_counts_and_columns_may_differ(tmp_path: Path) -> None:
    store = Store(tmp_path)
    assert store.rows() == {}
    store.append([{"key": "a", "x": 1.0, "error": None}, {"key": "b", "x": 2.0, "error": None}])
    store.append([{"key": "a", "error": "no", "y": 3.0}])
    expected = {
        "b": {"key": "b", "x": 2.0, "error": None, "y": None},
        "a": {"key": "a", "x": None, "error": "no", "y": 3.0},
    }
    assert store.rows() == expected
    store.join()
    assert len(list(tmp_path.glob("*.parquet"))) == 1
    assert store.rows() == expected


def test_many_parts_are_joined_and_one_sweep_writes_at_a_time(tmp_path: Path) -> None:
    store = Store(tmp_path)
    for number in range(MANY_PARTS + 1):
        store.append([{"key": str(number)}])
    (tmp_path / "lock").touch()  # of an earlier version
    with store.writing():
        assert len(list(tmp_path.glob("*.parquet"))) == 1
        others = {path.name for path in tmp_path.iterdir() if path.suffix != ".parquet"}
        assert others == {"_lock"}  # readers of Parquet pass over what begins with an underscore
        with pytest.raises(LabError, match="Another sweep"), Store(tmp_path).writing():
            pass
    assert len(store.rows()) == MANY_PARTS + 1


def test_a_full_disk_is_told_and_leaves_the_parts(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.append([{"key": "a"}])
    (tmp_path / DRAFT).symlink_to("/dev/full")
    with pytest.raises(LabError, match=r"No space left.*Make room"):
        store.append([{"key": "b"}])
    assert list(store.rows()) == ["a"]
    assert [path.name for path in tmp_path.iterdir()] == ["part-00000001.parquet"]


def test_another_failure_of_the_file_does_not_ask_for_room(tmp_path: Path) -> None:
    (tmp_path / DRAFT).symlink_to(tmp_path / "nowhere" / "part")
    with pytest.raises(LabError, match=r"No such file.*Is the path right\?") as told:
        Store(tmp_path).append([{"key": "a"}])
    assert "Make room" not in str(told.value)
    assert list(tmp_path.iterdir()) == []


def test_a_broken_part_is_named(tmp_path: Path) -> None:
    (tmp_path / "part-00000001.parquet").write_bytes(b"not Parquet")
    with pytest.raises(LabError, match="part-00000001"):
        Store(tmp_path).rows()


def command(folder: Path, *others: str) -> list[str]:
    words = [sys.executable, "-m", "jostle_lab", "sweep", "--scene", "ratchet", "--seconds", "60", "--seeds", "40"]
    words += ["--grid", "disks=10,20", "--set", "tooth.height=3e-3", "--results", str(folder), "--no-progress"]
    return [*words, "--processes", "1", *others]


def processes_for_runs() -> set[str]:
    """Numbers of all processes of this machine that do runs."""
    listed = subprocess.run(["ps", "-eo", "pid,args"], capture_output=True, text=True, check=True).stdout
    return {line.split()[0] for line in listed.splitlines() if "jostle_lab.runs.serve" in line}


def test_killed_in_the_middle_and_resumed(tmp_path: Path, package: Package) -> None:
    """SIGKILL after the first part: what is there stays as it is, the rest comes, and no run is there twice."""
    folder = tmp_path / "killed"
    process = subprocess.Popen(command(folder), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 60.0
    while not list(folder.glob("part-*.parquet")):
        assert process.poll() is None, "the sweep ended before it could be killed"
        assert time.monotonic() < deadline, "no part within a minute"
        time.sleep(0.01)
    os.kill(process.pid, signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL
    before = Store(folder).rows()
    assert 0 < len(before) < 80
    done = subprocess.run(command(folder), capture_output=True, text=True, check=True)
    assert "80 done, 0 failed" in done.stdout
    table = pl.read_parquet(folder / "part-*.parquet")
    assert len(table) == table["key"].n_unique() == 80
    after = Store(folder).rows()
    assert {key: after[key] for key in before} == before
    assert sorted({row["seed"] for row in after.values()}) == list(range(1, 41))
    whole = sweep(tmp_path / "whole", package).run(
        Grid("ratchet", 60.0, seeds=tuple(range(1, 6)), fixed={"tooth.height": 3e-3}, axes={"disks": (10,)}).runs()
    )
    for row in whole.values():
        assert row["transport_velocity"] == after[row["key"]]["transport_velocity"]


def test_package_and_program_give_the_same_bits_under_keys_of_their_own(
    tmp_path: Path, package: Package, program: Program
) -> None:
    runs = [
        *Grid("ratchet", 1.0, seeds=(1, 2), axes={"disks": (1, 10)}).runs(),
        *Grid("wedge", 3.0, fixed={"wedge.tilt": 0.2}).runs(),
        *Grid("three_disk", 0.3, drive="random-supports").runs(),
        Run("packing", "molecular-dynamics", 0.25, 0.1, (("drive.amplitude", 1e-4), ("seed", 3)), disks=12),
    ]
    ours, theirs = sweep(tmp_path, package).run(runs), sweep(tmp_path, program).run(runs)
    for run in runs:
        assert numbers(ours[run]) == numbers(theirs[run])
        assert ours[run]["state"] == DONE and ours[run]["time"] == run.seconds
        assert 0.0 < ours[run]["processor_seconds"] < 60.0
    assert len(Store(tmp_path).rows()) == 2 * len(runs)


def test_a_failed_run_is_kept_with_its_error_and_retried_if_asked(tmp_path: Path, build: Build) -> None:
    good, bad = (Run("ratchet", "event-driven", 1.0, 1.0, (("tooth.tip_radius", s), ("seed", 1))) for s in (4e-4, 0.1))
    first = sweep(tmp_path, build).run([good, bad, good])
    assert first[good]["state"] == DONE and first[good]["error"] is None
    assert first[bad]["state"] == FAILED and "tooth.tip_radius = 0.1 m is not allowed" in first[bad]["error"]
    assert first[bad]["command"].startswith("jostle run ratchet") and first[bad]["seed"] == 1
    assert sweep(tmp_path, build).run([good, bad]) == first
    again = sweep(tmp_path, build, retry_failed=True).run([good, bad])
    assert again[good] == first[good]
    assert again[bad]["finished"] > first[bad]["finished"]
    assert len(Store(tmp_path).rows()) == 2


def test_a_run_over_the_limit_is_a_failure(tmp_path: Path, build: Build) -> None:
    endless = Run("ratchet", "event-driven", 1e6, 1e6, (("seed", 1),))
    short = Run("ratchet", "event-driven", 0.1, 0.1, (("seed", 1),))
    limited = replace(build, limit=0.3)  # type: ignore[type-var]
    rows = sweep(tmp_path, limited, workers=Workers(processes=1)).run([short, endless, short])
    assert rows[short]["state"] == DONE
    assert rows[endless]["state"] == FAILED
    assert rows[endless]["error"].startswith("Stopped after 0.3 s.")
    assert 0.3 <= rows[endless]["clock_seconds"] < 10.0  # of 1e6 simulated seconds
    assert rows[endless]["processor_seconds"] > 0.0


def test_a_scene_without_chance_is_swept_without_seeds(tmp_path: Path) -> None:
    words = ["sweep", "--scene", "three_disk", "--seconds", "0.1", "--grid", "tilt=0.1,0.2", "--no-progress"]
    words += ["--results", str(tmp_path)]
    done = CliRunner().invoke(application("", command_sweep), words)
    assert "2 runs" in done.output and "2 done, 0 failed" in done.output, done
    assert {row["seed"] for row in Store(tmp_path).rows().values()} == {None}
    refused = CliRunner().invoke(application("", command_sweep), [*words, "--seeds", "2"]).exception
    assert isinstance(refused, LabError) and "all seeds give the same run" in str(refused)


def test_another_program_ends_the_sweep_and_records_nothing(tmp_path: Path, program: Program) -> None:
    run = Run("ratchet", "event-driven", 1.0, 1.0, (("seed", 1),))
    with pytest.raises(LabError, match="Put the same program there"):
        sweep(tmp_path, Program(program.path, "another")).run([run])
    assert Store(tmp_path).rows() == {}


def test_another_package_ends_the_sweep_and_records_nothing(tmp_path: Path) -> None:
    run = Run("ratchet", "event-driven", 1.0, 1.0, (("seed", 1),))
    with pytest.raises(LabError, match="Put the same package there"):
        sweep(tmp_path, Package("another")).run([run])
    assert Store(tmp_path).rows() == {}


def test_a_run_whose_process_dies_is_a_failure_and_the_next_run_has_another(package: Package) -> None:
    run = Run("ratchet", "event-driven", 0.1, 0.1, (("seed", 1),))
    endless = Run("ratchet", "event-driven", 1e6, 1e6, (("seed", 1),))
    children = Children()
    with children.lent() as child:
        assert child.perform(run, None).error is None
        threading.Timer(0.2, child.kill).start()
        died = child.perform(endless, None)
    assert died.error == f"Its process ended with code {-signal.SIGKILL}." and died.outputs == {}
    with children.lent() as another:
        assert another is not child and another.perform(run, None).error is None
    children.end()
    assert not another.alive


def test_no_process_for_runs_outlives_a_sweep(tmp_path: Path) -> None:
    """Ctrl-C in the middle of an endless step, and a kill."""
    for sent, code in ((signal.SIGINT, 130), (signal.SIGKILL, -signal.SIGKILL)):
        before = processes_for_runs()
        words = command(tmp_path / str(sent), "--seconds", "1e6")
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60.0
        while not (ours := processes_for_runs() - before):
            assert time.monotonic() < deadline and process.poll() is None
            time.sleep(0.05)
        time.sleep(0.7)  # into the step
        process.send_signal(sent)
        assert process.wait(30.0) == code
        while ours & processes_for_runs():
            assert time.monotonic() < deadline, "a process goes on"
            time.sleep(0.05)


def test_pandas_reads_the_folder(tmp_path: Path) -> None:
    done = subprocess.run(
        command(tmp_path, "--seconds", "0.1", "--seeds", "2"), capture_output=True, text=True, check=True
    )
    assert "4 done, 0 failed" in done.stdout
    table = pd.read_parquet(tmp_path)
    assert sorted(zip(table["disks"], table["seed"], strict=True)) == [(10, 1), (10, 2), (20, 1), (20, 2)]
    assert set(table["state"]) == {DONE} and table["transport_velocity"].dtype == float


def test_a_scheduler_by_its_address(tmp_path: Path, package: Package) -> None:
    """Workers in processes of their own, as on another machine; and an address where nobody answers."""
    endless = Run("ratchet", "event-driven", 1e6, 1e6, (("seed", 1),))
    runs = Grid("ratchet", 2.0, seeds=(1, 2, 3)).runs()
    with LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address="127.0.0.1:0") as cluster:
        workers = Workers(cluster.scheduler_address)
        remote = sweep(tmp_path / "remote", package, workers=workers).run(runs)
        (late,) = sweep(tmp_path / "late", replace(package, limit=0.3), workers=workers).run([endless]).values()
    assert late["state"] == FAILED and late["error"] == "Stopped after 0.3 s."
    here = sweep(tmp_path / "here", package).run(runs)
    assert [numbers(remote[run]) for run in runs] == [numbers(here[run]) for run in runs]
    with pytest.raises(LabError, match=r"No Dask scheduler answers at tcp://127\.0\.0\.1:9"):
        sweep(tmp_path / "nobody", package, workers=Workers("tcp://127.0.0.1:9", patience=0.5)).run(runs)
