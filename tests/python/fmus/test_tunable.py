"""Tunable parameters in fmpy: set during a simulation, with the bits of the Python package, and rolled back."""

import math
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmu_client import getter, in_fmpy, setter

import jostle

AMPLITUDE, OMEGA, STEP, STEPS = 1e-3, 2.0 * math.pi * 20.0, 1.0 / 512.0, 96
INPUTS = ["base.displacement", "base.velocity"]
OUTPUTS = ["disk.angle[1]", "disk.angle[60]", "energy.lost", "energy.residual"]
CHANGES = {32: ("contact.friction", 0.6), 64: ("gravity", 3.0)}


def motion(time: float) -> list[float]:
    return [AMPLITUDE * (1.0 - math.cos(OMEGA * time)), AMPLITUDE * OMEGA * math.sin(OMEGA * time)]


@pytest.fixture(scope="module")
def expected() -> list[list[float]]:
    """What the Python package computes."""
    packing = jostle.Simulation("packing", drive="input", seed=1)
    rows = []
    for n in range(STEPS):
        if n in CHANGES:
            name, value = CHANGES[n]
            packing[name] = value
        packing.step(STEP, **dict(zip(INPUTS, motion(n * STEP), strict=True)))
        rows.append([packing[name] for name in OUTPUTS])
    return rows


def test_fmpy_changes_friction_and_gravity_and_goes_back(fmu: Path, expected: list[list[float]], tmp_path: Path):
    description = fmpy.read_model_description(str(fmu), validate=True)
    tunable = {v.name for v in description.modelVariables if v.variability == "tunable" and v.causality == "parameter"}
    assert tunable == {"contact.friction", "gravity"}
    with in_fmpy(fmu, tmp_path) as (slave, references):
        get, set_ = getter(slave), setter(slave)

        def run(first: int, last: int) -> list[list[float]]:
            rows = []
            for n in range(first, last):
                if n in CHANGES:
                    name, value = CHANGES[n]
                    set_([references[name]], [value])
                    assert list(get([references[name]])) == [value]
                set_([references[name] for name in INPUTS], motion(n * STEP))
                slave.doStep(n * STEP, STEP)
                rows.append(list(get([references[name] for name in OUTPUTS])))
            return rows

        rows = run(0, 20)
        state = slave.getFMUState() if hasattr(slave, "getFMUState") else slave.getFMUstate()
        back = slave.setFMUState if hasattr(slave, "setFMUState") else slave.setFMUstate
        rest = run(20, STEPS)
        assert rows + rest == expected
        back(state)
        assert list(get([references["contact.friction"], references["gravity"]])) == [0.1, 9.8]
        assert run(20, STEPS) == rest


def test_fmpy_takes_a_tunable_parameter_from_its_input_table(fmu: Path):
    columns = [("time", float), ("base.displacement", float), ("base.velocity", float), ("contact.friction", float)]
    table = [(n * STEP, *motion(n * STEP), 0.1 if n < STEPS // 2 else 0.6) for n in range(STEPS + 1)]
    result = fmpy.simulate_fmu(
        str(fmu),
        stop_time=STEPS * STEP,
        output_interval=STEP,
        input=np.array(table, dtype=columns),
        output=["contact.friction", "energy.residual", "energy.lost"],
    )
    assert result["contact.friction"][0] == 0.1 and result["contact.friction"][-1] == 0.6
    assert abs(result["energy.residual"]).max() < 0.05 * result["energy.lost"][-1]


def test_fixed_parameter_is_refused_during_a_run(fmu: Path, tmp_path: Path):
    with in_fmpy(fmu, tmp_path) as (slave, references):
        slave.doStep(0.0, STEP)
        with pytest.raises(Exception, match="status 3"):
            setter(slave)([references["contact.normal_stiffness"]], [2e4])
        slave.doStep(STEP, STEP)
