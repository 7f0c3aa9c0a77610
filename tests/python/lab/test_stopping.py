"""Signals to real processes: whatever stops a command, nothing of it runs on, what is finished is kept and told."""

import os
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import psutil
import pytest
from conftest import PROGRAM, ROOT

from jostle_lab.demos.packing.command import demo as packing_demo
from jostle_lab.errors import LabError
from jostle_lab.locks import held
from jostle_lab.runs.store import Store
from jostle_lab.tables import read_table

PATIENCE = 60.0
"""For what must come, on a machine that does other things too [s]."""
AMPLITUDES = "0.35,0.3"


class Command:
    """A program in a process group of its own, and what it prints."""

    def __init__(self, *words: str | Path, **others: object) -> None:
        self.process = subprocess.Popen(  # type: ignore[call-overload]
            list(map(str, words)),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
            **others,
        )

    def until(self, there: Callable[[], bool]) -> None:
        deadline = time.monotonic() + PATIENCE
        while not there():
            assert self.process.poll() is None, self.process.communicate()[0]
            assert time.monotonic() < deadline, "it did not come"
            time.sleep(0.02)

    def descendants(self) -> list[psutil.Process]:
        return psutil.Process(self.process.pid).children(recursive=True)

    def stop(self, number: int, group: bool = False) -> str:
        """Send a signal; what was printed. All that it started must be gone soon."""
        started = self.descendants()
        assert started
        (os.killpg if group else os.kill)(self.process.pid, number)
        said = self.process.communicate(timeout=PATIENCE)[0] if number != signal.SIGKILL else ""
        assert self.process.wait() == (-number if number == signal.SIGKILL else 128 + number), said
        _, alive = psutil.wait_procs(started, timeout=10.0)
        assert alive == []
        return said


@pytest.fixture
def demo(fmu3: Path, tmp_path: Path) -> Iterator[Callable[..., Command]]:
    """The demo in miniature, in a folder of its own."""
    begun = []

    def begin(*words: str, **others: object) -> Command:
        small = ["--steps-per-second", "800", "--seconds-per-amplitude", "8", "--amplitudes", AMPLITUDES]
        command = [sys.executable, "-m", "jostle_lab", "demo", "--fmu", fmu3, "--results", tmp_path / "results"]
        begun.append(Command(*command, *small, *words, **others))
        return begun[-1]

    yield begin
    for command in begun:
        for process in [*command.descendants(), command.process] if command.process.poll() is None else []:
            process.kill()


def there_is(tmp_path: Path, pattern: str) -> Callable[[], bool]:
    return lambda: bool(list(tmp_path.glob(pattern)))


def test_sigterm_ends_the_demo_and_the_same_command_goes_on(tmp_path: Path, demo: Callable[..., Command]) -> None:
    command = demo()
    command.until(there_is(tmp_path, "results/packings/*/checkpoint.npz"))
    said = command.stop(signal.SIGTERM)
    assert "stopped by SIGTERM. " in said and "The same command goes on from there." in said
    assert "of 4 amplitudes (2 for each of 2 packings) are kept in" in said
    page = (tmp_path / "results/index.html").read_text()
    assert "ended before it was finished" in page and "refresh" not in page
    before = {file: file.read_bytes() for file in tmp_path.glob("results/packings/*/amplitudes.csv")}
    again = demo()
    said = again.process.communicate(timeout=PATIENCE)[0]
    assert again.process.returncode == 0, said
    assert not set(said) & {"\r", "\b", "\x1b"}  # a pipe gets plain lines
    assert "first picture after" in said and "left" in said
    for file, rows in before.items():
        assert file.read_bytes().startswith(rows)  # they were not computed anew
        assert len(read_table(file)) == 2
    page = (tmp_path / "results/index.html").read_text()
    assert "refresh" not in page and "What came out" in page
    assert not (tmp_path / "results/packing_now.png").exists()


def test_ctrl_c_in_a_terminal_is_one_message(tmp_path: Path, demo: Callable[..., Command]) -> None:
    command = demo()
    page = tmp_path / "results/index.html"
    command.until(lambda: page.exists() and "packing_now.png" in page.read_text())
    assert "refresh" in page.read_text()
    said = command.stop(signal.SIGINT, group=True)
    assert said.count("stopped by") == 1 and "Traceback" not in said and "Warning" not in said
    assert "are kept in" in said


def test_a_killed_demo_leaves_no_workers_and_no_lock(tmp_path: Path, demo: Callable[..., Command]) -> None:
    command = demo("--packings", "1")
    command.until(there_is(tmp_path, "results/packing_now.png"))
    command.stop(signal.SIGKILL)
    with held(tmp_path / "results", "test"):
        pass


def test_two_demos_in_a_folder_are_refused(tmp_path: Path, fmu3: Path) -> None:
    with held(tmp_path, "demo"), pytest.raises(LabError) as refused:
        packing_demo(fmu3, tmp_path)
    assert str(refused.value).startswith(f"Another demo writes to {tmp_path}: process {os.getpid()}. ")
    assert "--results" in str(refused.value)


def test_a_full_disk_ends_the_demo_and_loses_nothing(tmp_path: Path, demo: Callable[..., Command]) -> None:
    """A limit for the size of files stands for it, set when the first amplitude is kept."""
    command = demo("--packings", "1")
    command.until(there_is(tmp_path, "results/packings/*/checkpoint.npz"))
    for process in [*command.descendants(), psutil.Process(command.process.pid)]:
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (1000, 1000))
    said = command.process.communicate(timeout=PATIENCE)[0]
    assert command.process.returncode == 1, said
    assert "Traceback" not in said and "are kept in" in said
    last = said.splitlines()[-1]
    assert last.startswith(f"error: {tmp_path / 'results'}"), said
    assert last.endswith("Make room, or name a folder on another disk.")
    (table,) = tmp_path.glob("results/packings/*/amplitudes.csv")
    assert len(read_table(table)) == 1
    assert list(tmp_path.rglob("*.draft")) == []


def test_no_room_to_unpack_an_fmu_is_told_with_the_remedy(demo: Callable[..., Command]) -> None:
    command = demo(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
    said = command.process.communicate(timeout=PATIENCE)[0]
    assert command.process.returncode == 2
    assert "packing.fmu cannot be unpacked in" in said and "TMPDIR" in said and "Traceback" not in said


def has_a_run(command: Command) -> Callable[[], bool]:
    """Not only `jostle describe`, which comes first and is short."""

    def runs(process: psutil.Process) -> bool:
        try:
            return process.cmdline()[:2] == [str(PROGRAM), "run"]
        except (psutil.NoSuchProcess, psutil.ZombieProcess):
            return False

    return lambda: any(map(runs, command.descendants()))


@pytest.mark.parametrize("group", [False, True], ids=["to the sweep", "to all its processes"])
def test_sigterm_ends_the_runs_of_a_sweep_and_keeps_its_rows(tmp_path: Path, group: bool) -> None:
    words = ["--scene", "ratchet", "--set", "tooth.height=3e-3", "--program", PROGRAM, "--results", tmp_path]
    short, long = ["--seconds", "1", "--seeds", "2"], ["--seconds", "1e5", "--seeds", "2"]
    begin = [sys.executable, "-m", "jostle_lab", "sweep", *words]
    assert Command(*begin, *short).process.wait() == 0
    command = Command(*begin, *long)
    command.until(has_a_run(command))
    said = command.stop(signal.SIGTERM, group)
    assert "stopped by SIGTERM. 0 of 2 runs are kept in" in said and "Traceback" not in said
    assert [row["state"] for row in Store(tmp_path).rows().values()] == ["done", "done"]  # none that was ended failed


STUDY = """
import sys
from pathlib import Path
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.stopping import stoppable

program, kept, processes = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
runs = [Run("ratchet", "event-driven", 1e5, 1e5, (("tooth.height", 3e-3), ("seed", seed))) for seed in (1, 2)]
with stoppable():
    Laboratory(program, kept, processes).run(runs, "a study")
"""


@pytest.mark.parametrize("processes", [1, 2])
def test_sigterm_ends_the_runs_of_a_study(tmp_path: Path, processes: int) -> None:
    """One run at a time is waited for in the main thread, several in threads."""
    command = Command(sys.executable, "-c", STUDY, PROGRAM, tmp_path, str(processes))
    command.until(has_a_run(command))
    said = command.stop(signal.SIGTERM)
    assert f"stopped by SIGTERM. Finished runs are kept in {tmp_path}." in said and "Traceback" not in said


def test_a_helper_of_the_demo_script_does_not_run_on(tmp_path: Path) -> None:
    """SIGTERM to the script while the set-up compiles: a checkout with a set-up that only waits."""
    scripts = tmp_path / "scripts"
    scripts.mkdir()
    (tmp_path / "rust-toolchain.toml").touch()
    for name in ("demo", "common.sh"):
        (scripts / name).write_bytes((ROOT / "scripts" / name).read_bytes())
    (scripts / "setup").write_text("#!/bin/sh\nsleep 60 &\nsleep 60\n")
    (scripts / "setup").chmod(0o755)
    for number in (signal.SIGTERM, signal.SIGINT):
        command = Command("bash", scripts / "demo")
        command.until(lambda command=command: len(command.descendants()) == 3)
        said = command.stop(number)
        assert said.endswith("the same command goes on from there.\n")
