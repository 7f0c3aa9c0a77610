"""A packing that was stopped goes on to the bits of one that was not; a folder has one writer."""

from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from fake_grains import make_turning_lump

from jostle_lab.errors import LabError
from jostle_lab.fmu.packing import FmuFactory
from jostle_lab.locks import LOCK, held
from jostle_lab.protocol import checkpoint
from jostle_lab.protocol.experiment import Setup, run_packing
from jostle_lab.protocol.intervals import Interval, Protocol
from jostle_lab.protocol.packings import Plan, run

TABLES = ("amplitudes.csv", "disks.csv", "angles.csv", "accelerometers.csv", "positions.csv")
SCHEDULE = Protocol(1, tuple(Interval(amplitude, 1, 3) for amplitude in (0.6, 0.4, 0.2)))
SETUP = Setup(SCHEDULE, steps_per_second=800, keep_positions=True)


class StopError(Exception):
    """Stands for a signal."""


def stop_after(count: int):
    def progress(what: object) -> None:
        nonlocal count
        count -= what == 0
        if not count:
            raise StopError

    return progress


def nothing(_: object) -> None:
    pass


@pytest.mark.parametrize("stops", [1, 2], ids=["fmi2", "fmi3"])
def test_a_stopped_packing_ends_in_the_same_bits(tmp_path: Path, fmu2: Path, fmu3: Path, stops: int) -> None:
    """With the FMU, whose state is written as bytes and read by another instance; stopped once, and twice."""
    factory = FmuFactory(str({1: fmu2, 2: fmu3}[stops]))
    with closing(factory(1, SETUP.exchange.parameters)) as grains:
        run_packing(grains, SETUP, 1, tmp_path / "whole", nothing)
    for _ in range(stops):
        with closing(factory(1, SETUP.exchange.parameters)) as grains, pytest.raises(StopError):
            run_packing(grains, SETUP, 1, tmp_path / "stopped", stop_after(1))
    seconds: list[int] = []
    with closing(factory(1, SETUP.exchange.parameters)) as grains:
        run_packing(grains, SETUP, 1, tmp_path / "stopped", seconds.append)
    assert sum(s for s in seconds if isinstance(s, int)) == 4 * (3 - stops)  # what was done is not done again
    for table in TABLES:
        assert (tmp_path / "stopped" / table).read_bytes() == (tmp_path / "whole" / table).read_bytes(), table
    assert not (tmp_path / "stopped" / checkpoint.FILE).exists()


def test_grains_that_give_no_bytes_begin_anew(tmp_path: Path) -> None:
    grains = make_turning_lump(1)
    grains.can_serialise = False
    with pytest.raises(StopError):
        run_packing(grains, SETUP, 1, tmp_path, stop_after(2))
    assert not (tmp_path / checkpoint.FILE).exists()
    run_packing(make_turning_lump(1), SETUP, 1, tmp_path, nothing)
    assert (tmp_path / "packing.json").exists()


def test_a_damaged_checkpoint_is_named_with_the_remedy(tmp_path: Path) -> None:
    plan = Plan(tmp_path, (1,), SETUP, show_progress=False)
    folder = plan.packing_folder(1)
    folder.mkdir(parents=True)
    for content in (b"", b"not an archive", b"PK\x03\x04 cut off"):
        (folder / checkpoint.FILE).write_bytes(content)
        with pytest.raises(LabError, match=r"checkpoint\.npz is damaged: .* Remove .*seed-0001: that packing"):
            run(plan, make_turning_lump)
    np.savez(folder / checkpoint.FILE, other=np.zeros(1))
    with pytest.raises(LabError, match="is damaged"):
        run(plan, make_turning_lump)


def test_a_folder_has_one_writer_and_a_lock_that_was_left_blocks_nobody(tmp_path: Path) -> None:
    plan = Plan(tmp_path, (1,), SETUP, show_progress=False)
    with held(tmp_path, "demo"), pytest.raises(LabError) as refused:
        run(plan, make_turning_lump)
    number = str(refused.value).partition("process ")[2].partition(".")[0]
    assert str(tmp_path) in str(refused.value) and f"kill {number}" in str(refused.value)
    assert "--results" in str(refused.value)
    (tmp_path / LOCK).write_text("1 demo\n")  # of a process that was killed: the file stays, the lock does not
    with held(tmp_path, "demo"):
        pass
    assert (tmp_path / LOCK).read_text() == ""


def test_a_lock_that_cannot_be_made_names_the_file(tmp_path: Path) -> None:
    (tmp_path / LOCK).mkdir()
    with pytest.raises(IsADirectoryError) as refused, held(tmp_path, "demo"):
        pass
    assert refused.value.filename == str(tmp_path / LOCK)
