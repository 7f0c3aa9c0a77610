"""What users want to do, each in at most ten lines; the lines between the marks are counted."""

import inspect
import math
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import jostle


def closed_loop() -> None:
    sim = jostle.Simulation("packing", drive="input", disks=20, seed=3)
    position, velocity, given, weight, h = 0.0, 0.0, 0.0, 0.0914 * 9.8, 1 / 4096
    for n in range(4096):
        force = sim["base.reaction_force"]
        push = 40.0 * math.sin(2 * math.pi * 30.0 * n * h) + force + weight
        velocity += h * (push - 4000.0 * position - 20.0 * velocity) / 2.0
        sim.step(h, **{"base.displacement": position, "base.velocity": velocity})
        position, given = position + h * velocity, given - h * velocity * force
    assert given == pytest.approx(sim["energy.input"], rel=0.03)  # what the shaker lost is what the disks received
    assert sim["base.impulse"] == pytest.approx(-weight * sim.time, rel=0.1) and sim["energy.lost"] > 0.5 * given


def transport_against_frequency() -> None:
    speeds = {}
    for frequency in (15.0, 25.0):
        runs = [
            jostle.Simulation("ratchet", disks=50, seed=s, **{"drive.frequency": frequency}).run(2, every=1)
            for s in range(1, 5)
        ]
        speeds[frequency] = [run["transport_velocity"].values[-1] for run in runs]
        print(frequency, np.mean(speeds[frequency]), "+-", np.std(speeds[frequency], ddof=1) / len(runs) ** 0.5)
    assert len(set(speeds[25.0])) == 4 and np.mean(speeds[25.0]) < np.mean(
        speeds[15.0]
    )  # as F Fig. 8: ever more leftwards


def many_disks() -> None:
    sim = jostle.Simulation("packing", disks=2000, **{"box.width": 2.0, "drive.amplitude": 1e-4})
    data = sim.run(0.05, every=0.01, outputs=["disk.x", "disk.y", "disk.angle"])
    assert data["disk.angle"].shape == (6, 2000)


def arrays() -> None:
    data = jostle.Simulation("packing", disks=10, **{"drive.amplitude": 1e-4}).run(1, every=0.1)
    table = data[["disk.x", "disk.y", "disk.angle"]].to_dataframe()
    energy = data["energy.kinetic"].to_series()
    assert table.index.names == ["time", "disk"] and len(table) == 110 and len(energy) == 11
    assert data["disk.angle"].sel(disk=3).attrs["units"] == "rad"


def restart_in_another_process(folder: Path) -> None:
    sim = jostle.Simulation("packing", disks=10, seed=5, **{"drive.amplitude": 1e-4})
    sim.run(0.2)
    (folder / "state.pkl").write_bytes(pickle.dumps(sim))
    goes_on = (
        "import pickle, sys; sim = pickle.load(open(sys.argv[1], 'rb')); sim.run(0.3); print(sim['disk.angle[1]'])"
    )
    words = [sys.executable, "-c", goes_on, str(folder / "state.pkl")]
    there = subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip()
    sim.run(0.3)
    assert float(there) == sim["disk.angle[1]"]


@pytest.mark.parametrize("task", [closed_loop, transport_against_frequency, many_disks, arrays])
def test_task(task: Callable[[], None]) -> None:
    task()


def test_restart_in_another_process(tmp_path: Path) -> None:
    restart_in_another_process(tmp_path)


@pytest.mark.parametrize(
    "task", [closed_loop, transport_against_frequency, many_disks, arrays, restart_in_another_process]
)
def test_tasks_take_at_most_ten_lines(task: Callable[..., None]) -> None:
    lines = [line for line in inspect.getsource(task).splitlines()[1:] if line.strip()]
    assert len([line for line in lines if not line.strip().startswith("assert")]) <= 10
