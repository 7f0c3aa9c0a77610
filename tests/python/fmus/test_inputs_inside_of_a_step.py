"""A packing FMU that asks its importer for inputs inside of a step, through fmpy."""

import math
import shutil
from pathlib import Path
from typing import Any

import pytest
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave

AMPLITUDE, OMEGA = 7.757e-5, 2 * math.pi * 80.0
STEP = 1.0 / 1024
INPUTS = ["base.displacement", "base.velocity"]


def motion(time: float) -> list[float]:
    """Displacement and velocity of a sine of 80 Hz at Gamma = 2: 13 samples a period of `STEP`."""
    return [AMPLITUDE * math.sin(OMEGA * time), AMPLITUDE * OMEGA * math.cos(OMEGA * time)]


def error_of_position(fmu: Path, folder: Path, inside: bool) -> tuple[float, list[float], set[tuple[bool, ...]]]:
    """Largest error of the base over its amplitude after three periods, the times of all updates, their flags."""
    description = read_model_description(str(fmu))
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    inputs = [references[name] for name in INPUTS]
    told: list[float] = []
    flags: set[tuple[bool, ...]] = set()

    def update(_: Any, time: float, *rest: Any) -> None:
        told.append(time)
        flags.add(tuple(rest[:4]))
        slave.setFloat64(inputs, motion(time))

    slave: Any = FMU3Slave(
        guid=description.guid,
        unzipDirectory=extract(str(fmu), str(folder)),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="packing",
    )
    offered = {"intermediateUpdate": update, "requiredIntermediateVariables": inputs} if inside else {}
    slave.instantiate(**offered)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    worst = 0.0
    for number in range(100):
        slave.setFloat64(inputs, motion(number * STEP))
        slave.doStep(number * STEP, STEP)
        (position,) = slave.getFloat64([references["base.position"]])
        if number > 40:
            worst = max(worst, abs(position - motion((number + 1) * STEP)[0]) / AMPLITUDE)
    slave.terminate()
    slave.freeInstance()
    shutil.rmtree(folder)
    return worst, told, flags


def test_inputs_inside_of_steps_make_the_base_follow_as_in_steps_of_a_quarter(fmu3: Path, tmp_path: Path) -> None:
    plain, none, _ = error_of_position(fmu3, tmp_path / "plain", inside=False)
    offered, told, flags = error_of_position(fmu3, tmp_path / "inside", inside=True)
    assert none == []
    assert told[:4] == pytest.approx([STEP / 4, STEP / 2, 3 * STEP / 4, 5 * STEP / 4])
    assert len(told) == 300
    assert flags == {(True, True, True, False)}
    assert offered < 0.01 * plain
