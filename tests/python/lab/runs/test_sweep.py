"""Sweeps: grids, Parquet parts, a real kill in the middle, failures that are kept, a scheduler by its address."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import polars as pl
import pytest
from conftest import PROGRAM
from distributed import LocalCluster

from jostle_lab.errors import LabError
from jostle_lab.locate import fingerprint
from jostle_lab.runs.command import _axis
from jostle_lab.runs.grid import Grid, make_grid, read_grid
from jostle_lab.runs.limits import parameters, refuse_what_no_run_takes
from jostle_lab.runs.run import Run
from jostle_lab.runs.store import DRAFT, MANY_PARTS, Store
from jostle_lab.runs.sweep import Sweep, Workers
from jostle_lab.runs.worker import DONE, FAILED, Program

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
def program(jostle: Path) -> Program:
    return Program(str(jostle), fingerprint(jostle))


def sweep(folder: Path, program: Program, **others: object) -> Sweep:
    return Sweep(Store(folder), program, show_progress=False, **others)  # type: ignore[arg-type]


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
        (["--grid", "disks=10,9999999"], "--disks = 9999999 is not allowed: from 1 to"),
        (["--engine", "event-drvien"], "Did you mean event-driven?"),
        (["--drive", "wind"], "one of: input, sine"),
        (["--grid", "seed=1,2"], "seed is neither set nor on the grid"),
        (["--set", "gravity=1", "--set", "gravity=2"], "--set gravity is given more than once"),
        (["--grid", "gravity=1", "--grid", "gravity=2"], "--grid gravity is given more than once"),
    ],
)
def test_a_grid_that_every_run_would_refuse_is_refused_once(
    options: list[str], message: str, jostle: Path, tmp_path: Path
) -> None:
    words = [sys.executable, "-m", "jostle_lab", "sweep", "--scene", "ratchet", "--seconds", "0.01", *options]
    words += ["--program", str(jostle), "--results", str(tmp_path / "sweep"), "--no-progress"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 2, done.stderr
    assert done.stderr.count(message) == 1, done.stderr
    assert not (tmp_path / "sweep").exists()  # nothing was run


def test_ranges_are_those_of_the_program(jostle: Path) -> None:
    (run,) = Grid("packing", 1.0).runs()
    known = parameters(jostle, run)
    assert known["contact.friction"] == (0.0, 1e6)
    assert "disk.angle[1]" not in known
    refuse_what_no_run_takes(jostle, [run])
    (hard,) = Grid("packing", 1.0, engine="event-driven").runs()
    assert parameters(jostle, hard)["base.model"] == (1, 2)  # an enumeration, by number


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
    words = [sys.executable, "-m", "jostle_lab", "sweep", "--scene", "ratchet", "--seconds", "30", "--seeds", "40"]
    words += ["--grid", "disks=10,20", "--set", "tooth.height=3e-3", "--results", str(folder), "--no-progress"]
    return [*words, "--program", str(PROGRAM), "--processes", "1", *others]


def test_killed_in_the_middle_and_resumed(tmp_path: Path, program: Program) -> None:
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
    whole = sweep(tmp_path / "whole", program).run(
        Grid("ratchet", 30.0, seeds=tuple(range(1, 6)), fixed={"tooth.height": 3e-3}, axes={"disks": (10,)}).runs()
    )
    for row in whole.values():
        assert row["transport_velocity"] == after[row["key"]]["transport_velocity"]


def test_a_failed_run_is_kept_with_its_error_and_retried_if_asked(tmp_path: Path, program: Program) -> None:
    good, bad = (Run("ratchet", "event-driven", 1.0, 1.0, (("tooth.tip_radius", s), ("seed", 1))) for s in (4e-4, 0.1))
    first = sweep(tmp_path, program).run([good, bad, good])
    assert first[good]["state"] == DONE and first[good]["error"] is None
    assert first[bad]["state"] == FAILED and "tooth.tip_radius = 0.1 m is not allowed" in first[bad]["error"]
    assert first[bad]["command"].startswith("jostle run ratchet") and first[bad]["seed"] == 1
    assert sweep(tmp_path, program).run([good, bad]) == first
    again = sweep(tmp_path, program, retry_failed=True).run([good, bad])
    assert again[good] == first[good]
    assert again[bad]["finished"] > first[bad]["finished"]
    assert len(Store(tmp_path).rows()) == 2


def test_a_run_over_the_limit_is_a_failure(tmp_path: Path, program: Program) -> None:
    endless = Run("ratchet", "event-driven", 1e6, 1e6, (("seed", 1),))
    limited = Program(program.path, program.version, limit=0.3)
    (row,) = sweep(tmp_path, limited).run([endless]).values()
    assert row["state"] == FAILED
    assert row["error"].startswith("Stopped after 0.3 s.")


def test_another_program_ends_the_sweep_and_records_nothing(tmp_path: Path, program: Program) -> None:
    run = Run("ratchet", "event-driven", 1.0, 1.0, (("seed", 1),))
    with pytest.raises(LabError, match="Put the same program there"):
        sweep(tmp_path, Program(program.path, "another")).run([run])
    assert Store(tmp_path).rows() == {}


def test_a_scheduler_by_its_address(tmp_path: Path, program: Program) -> None:
    """Workers in processes of their own, as on another machine; and an address where nobody answers."""
    runs = Grid("ratchet", 2.0, seeds=(1, 2, 3)).runs()
    with LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address="127.0.0.1:0") as cluster:
        remote = sweep(tmp_path / "remote", program, workers=Workers(cluster.scheduler_address)).run(runs)
    here = sweep(tmp_path / "here", program).run(runs)
    assert [remote[run]["transport_velocity"] for run in runs] == [here[run]["transport_velocity"] for run in runs]
    with pytest.raises(LabError, match=r"No Dask scheduler answers at tcp://127\.0\.0\.1:9"):
        sweep(tmp_path / "nobody", program, workers=Workers("tcp://127.0.0.1:9", patience=0.5)).run(runs)
