"""The Python package: the same bits as the command line and the FMU, datasets, states, loops."""

import copy
import csv
import multiprocessing
import os
import pickle
import re
import signal
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
import xarray as xr

import jostle
from jostle._core import Core
from jostle.variables import find, grouped

LONG = 160.0
"""A step of two seconds of processor time, so that other threads come to their turn meanwhile [s]."""
SHAKEN = {"drive.amplitude": 1e-4, "drive.frequency": 60.0}


def packing(**values: float) -> jostle.Simulation:
    return jostle.Simulation("packing", disks=10, seed=7, **{**SHAKEN, **values})


ENGINES = list(jostle.scenes()[["scene", "engine"]].drop_duplicates().itertuples(index=False, name=None))


@pytest.mark.parametrize(("scene", "engine"), ENGINES)
def test_the_bits_are_those_of_the_command_line(
    scene: str, engine: str, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    program: Path = request.getfixturevalue("jostle")
    words = [
        program,
        "run",
        scene,
        "--engine",
        engine,
        "--seconds",
        "0.305",
        "--no-progress",
        "--output",
        tmp_path / "run.csv",
    ]
    subprocess.run(list(map(str, words)), check=True, capture_output=True)
    with (tmp_path / "run.csv").open() as file:
        rows = list(csv.DictReader(file))
    data = jostle.Simulation(scene, engine=engine).run(0.305)
    assert len(rows) == data.sizes["time"]
    for name in rows[0]:
        base, number = re.sub(r"\[\d+\]", "", name), re.search(r"\[(\d+)\]", name)
        column = data[base] if number is None else data[base][:, int(number[1]) - 1]
        assert [float(row[name]) for row in rows] == column.values.tolist(), name


def test_the_bits_are_those_of_the_fmu(fmu3: Path) -> None:
    description = fmpy.read_model_description(str(fmu3))
    disks = sum(v.name.startswith("disk.angle[") for v in description.modelVariables)
    step, steps = 1.0 / 512.0, 128
    time_, size = np.arange(steps + 1) * step, 1e-4
    displacement = size * (1.0 - np.cos(300.0 * time_))
    velocity = size * 300.0 * np.sin(300.0 * time_)
    sim = jostle.Simulation("packing", drive="input", disks=disks, **{"base.displacement": displacement[0]})
    for n in range(steps):
        sim["base.displacement"], sim["base.velocity"] = displacement[n], velocity[n]
        sim.advance_to((n + 1) * step)
    folder = fmpy.extract(str(fmu3))
    fmu = fmpy.instantiate_fmu(folder, description, "CoSimulation")
    references = {v.name: v.valueReference for v in description.modelVariables}
    inputs = [references["base.displacement"], references["base.velocity"]]
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    for n in range(steps):
        fmu.setFloat64(inputs, [displacement[n], velocity[n]])
        fmu.doStep(n * step, step)
    angles = [references[f"disk.angle[{disk}]"] for disk in range(1, disks + 1)]
    assert fmu.getFloat64(angles) == sim["disk.angle"].tolist()
    fmu.freeInstance()


def test_dataset_has_units_descriptions_and_parameters(tmp_path: Path) -> None:
    data = packing().run(0.1, every=0.03)
    assert data["time"].values.tolist() == [0.0, 0.03, 0.06, 0.09, 0.1]
    assert data["disk.angle"].dims == ("time", "disk") and data["disk.angle"].attrs["units"] == "rad"
    assert data["contacts"].dtype == np.int64
    assert "of each disk" in data["disk.x"].attrs["long_name"] and data.attrs["wall.motion"] == "fixed"
    assert all(variable.attrs["long_name"] for variable in data.variables.values())
    assert data.attrs["drive.frequency"] == 60.0 and data.attrs["seed"] == 7 and data.attrs["scene"] == "packing"
    assert data["disk.radius"].dims == ("disk",)
    data.to_netcdf(tmp_path / "run.nc", engine="scipy")
    assert xr.load_dataset(tmp_path / "run.nc", engine="scipy")["disk.x"].equals(data["disk.x"])


def test_a_run_goes_on_where_the_last_one_ended() -> None:
    whole, parts = packing().run(0.4, every=0.1), packing()
    first, second = parts.run(0.2, every=0.1), parts.run(0.2, every=0.1)
    assert second["time"].values[0] == first["time"].values[-1] == 0.2
    assert second["disk.angle"].values[-1].tolist() == whole["disk.angle"].values[-1].tolist()


def test_chosen_outputs() -> None:
    data = packing().run(0.02, outputs=["disk.angle", "base.position", "disk.angle"])
    assert list(data.data_vars) == ["disk.angle", "base.position"]
    assert list(packing().run(0.02, outputs="contacts").data_vars) == ["contacts"]
    assert list(packing().run(0.02, outputs=["disk.radius", "gravity"]).data_vars) == ["gravity"]
    assert packing().run(0.02, outputs=[]).sizes["time"] == 3


def test_values_by_name() -> None:
    sim = packing()
    assert sim["gravity"] == 9.8 and sim["seed"] == 7 and sim["disk.angle"].shape == (10,)
    assert sim["disk.radius[3]"] == sim["disk.radius"][2]
    assert jostle.Simulation("packing", disks=3, **{"wall.motion": "with_base"})["wall.motion"] == 2
    assert sim.variables.loc["disk.angle", "size"] == 10
    assert "disk.angle" in sim and "disk.angle[10]" in sim and "disk.angel" not in sim and 3 not in sim
    assert set(jostle.scenes()["scene"]) == {"packing", "ratchet", "wedge", "three_disk"}
    assert repr(sim) == "<jostle.Simulation: packing, molecular-dynamics, drive sine, 10 disks, t = 0 s>"


def test_views_follow_and_cannot_be_written() -> None:
    sim = packing()
    angle = sim.view("disk.angle")
    start = sim.save()
    before = angle.copy()
    sim.step(0.1)
    assert (angle != before).any() and angle.tolist() == sim["disk.angle"].tolist()
    sim.restore(start)
    assert angle.tolist() == before.tolist() and sim.view("disk.angle") is angle
    with pytest.raises(ValueError, match="read-only"):
        angle[0] = 1.0
    with pytest.raises(ValueError, match="WRITEABLE"):
        angle.flags.writeable = True
    kept = np.empty(10)
    assert sim.read("disk.x", kept) is kept and kept.tolist() == sim["disk.x"].tolist()


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda sim: pickle.loads(pickle.dumps(sim))])
def test_copies_go_their_own_way_with_the_same_bits(again: object) -> None:
    sim = packing()
    sim.run(0.2)
    other = again(sim)  # type: ignore[operator]
    angle = other["disk.angle"].tolist()
    sim.run(0.1)
    assert other["disk.angle"].tolist() == angle and other.time == 0.2
    other.run(0.1)
    assert other["disk.angle"].tolist() == sim["disk.angle"].tolist()


def test_states_in_memory_and_as_bytes() -> None:
    sim = packing()
    state, written = sim.save(), sim.to_bytes()
    first = sim.run(0.1)["disk.angle"].values
    for kept in (state, written):
        sim.restore(kept)
        assert (sim.run(0.1)["disk.angle"].values == first).all()


def test_other_threads_run_while_a_step_is_done() -> None:
    sims = [packing() for _ in range(2)]
    with ThreadPoolExecutor(2) as pool:
        both = list(pool.map(lambda sim: sim.run(0.5)["disk.angle"].values, sims))
    assert (both[0] == both[1]).all()
    counted = 0
    worker_sim = packing()
    worker = threading.Thread(target=worker_sim.run, args=(LONG,), kwargs={"every": LONG})
    worker.start()
    while worker.is_alive():
        counted += worker_sim.time < LONG
        time.sleep(0.0)
    assert counted > 10


def test_two_threads_in_one_simulation_are_refused() -> None:
    sim = packing()
    worker = threading.Thread(target=sim.run, args=(LONG,), kwargs={"every": LONG})
    worker.start()
    time.sleep(0.3)  # until its step has begun: else it may be the worker that is refused
    refused = 0
    while worker.is_alive():
        try:
            sim["disk.angle"]
        except jostle.CallError as error:
            assert "another thread" in str(error)
            refused += 1
    assert refused > 0 and sim.time == LONG


def test_processes_take_simulations() -> None:
    sims = [packing() for _ in range(2)]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        ended = pool.map(_advanced, sims)
    assert ended[0] == ended[1] == _advanced(packing())


def _advanced(sim: jostle.Simulation) -> list[float]:
    sim.step(0.1)
    return list(sim["disk.angle"])


def test_contacts_carry_the_weight() -> None:
    simulation = jostle.Simulation("packing", disks=20, **{"box.width": 0.15, "drive.amplitude": 0.0})
    simulation.run(1.0, every=1.0, outputs=[])  # at rest
    table = simulation.contacts()
    assert len(table) == simulation["contacts"]
    mass = simulation["disk.surface_density"] * np.pi * (simulation["disk.radius"] ** 2).sum()
    on_base = table[table.wall == 1]
    assert on_base.normal_y.to_numpy() == pytest.approx(1.0)
    sides = table[table.wall > 1]
    # The tangent of the left wall's normal (1, 0) points down, that of the right wall's up.
    friction = (np.where(sides.wall == 2, -1.0, 1.0) * sides.tangential_force).sum()
    assert on_base.normal_force.sum() + friction == pytest.approx(9.8 * mass, rel=1e-3)
    assert table.attrs["units"]["tangential_force"] == "N"
    assert table[["first", "second", "wall"]].dtypes.eq(int).all()


def test_impacts_are_no_contacts() -> None:
    with pytest.raises(jostle.CallError, match=r"packing, engine event-driven.*no list contacts"):
        jostle.Simulation("packing", engine="event-driven").contacts()


def test_a_parameter_beside_outputs_with_numbers_of_the_same_name_keeps_its_name() -> None:
    sim = jostle.Simulation("three_disk", drive="random-supports", **{"support.angle": 0.6})
    assert sim["support.angle"] == 0.6 and sim.variables.loc["support.angle", "size"] == 1
    data = sim.run(0.01, every=0.01)
    assert data.attrs["support.angle"] == 0.6
    assert data["support[1].angle"].dims == ("time",) and data["support[1].angle"].values[-1] == sim["support[1].angle"]


SCENES = list(jostle.scenes()[["scene", "engine", "drive"]].itertuples(index=False))


@pytest.mark.parametrize("row", SCENES, ids="-".join)
def test_every_element_of_every_scene_is_found_by_its_name(row: Any) -> None:
    names = [known[0] for known in Core(row.scene, row.engine, row.drive, None).variables()]
    variables = grouped(Core(row.scene, row.engine, row.drive, None).variables())
    found = [find(variables, name, row.scene) for name in names]
    assert [variable.positions[element or 0] for variable, element in found] == list(range(len(names)))


@pytest.mark.parametrize(
    ("scene", "engine"),
    [("packing", None), ("packing", "molecular-dynamics-located"), ("ratchet", None), ("wedge", "map")],
)
def test_ctrl_c_ends_a_long_step_as_if_it_had_not_begun(scene: str, engine: str | None) -> None:
    simulation = jostle.Simulation(scene, engine=engine, **{"work.limit": 1e15})
    simulation.limit_work(10**15)
    simulation.run(0.02, every=0.01, outputs=[])
    before, twin = simulation.to_bytes(), copy.copy(simulation)
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            simulation.step(1e6)  # minutes at least
    finally:
        timer.cancel()
    assert simulation.to_bytes() == before
    for one in (simulation, twin):
        one.step(0.1)
    assert simulation.to_bytes() == twin.to_bytes()
