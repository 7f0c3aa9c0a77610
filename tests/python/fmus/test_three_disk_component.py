"""The disk on two supports through fmpy: events where they are asked for, inputs held and interpolated."""

import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROGRAM
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi3 import FMU3Slave

STATES = ["contact[1].state", "contact[2].state"]
MOTION = ["disk.angle[1]", "disk.angular_velocity[1]", "disk.x[1]", "disk.y[1]", "energy.lost"]

SLIPPING = {"tilt": 0.2, "torque.amplitude": 0.2, "torque.angular_frequency": 40.0, "contact.stiffness_ratio": 30.0}


def bundle(folder: Path, version: int, drive: str) -> str:
    fmu = folder / f"{drive}{version}.fmu"
    command = [PROGRAM, "fmu", "three_disk", "--drive", drive]
    subprocess.run([*command, "--fmi", str(version), "--out", fmu], check=True)
    return str(fmu)


def test_events_end_steps_where_the_importer_wants_it_and_change_nothing(tmp_path: Path) -> None:
    """Every change of a contact has a row of its own; the end is that of plain steps to the bit."""
    fmu = bundle(tmp_path, 3, "harmonic-torque")
    outputs = [*MOTION, *STATES, "slips"]
    common = {"stop_time": 0.25, "output_interval": 1 / 64, "start_values": SLIPPING, "output": outputs}
    plain = simulate_fmu(fmu, **common)
    events = simulate_fmu(fmu, **common, use_event_mode=True, early_return_allowed=True)
    assert len(plain) == 17
    for name in MOTION:
        assert plain[name][-1] == events[name][-1], name
    between = np.setdiff1d(events["time"], plain["time"])
    assert len(between) >= plain["slips"][-1] > 3
    # A contact changes at an event only: seen between two rows, it changed where the second one is.
    changed = np.any([np.diff(events[name]) != 0 for name in STATES], axis=0)
    assert set(events["time"][1:][changed]) <= set(between)
    assert set(np.unique([events[name] for name in STATES])) <= {1, 2, 3, 4}


@contextmanager
def ready(
    fmu: str, folder: Path, settings: dict[str, float], *, event_mode: bool, update: Callable[..., None] | None = None
) -> Iterator[tuple[Any, dict[str, int]]]:
    """An initialised instance of FMI 3.0 by direct calls of fmpy, in event mode if that is used, and its references.

    With `update` it is called at intermediate updates and may return early.
    """
    description = read_model_description(fmu)
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    slave = FMU3Slave(
        guid=description.guid,
        unzipDirectory=extract(fmu, str(folder)),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="disk",
    )
    slave.instantiate(
        eventModeUsed=event_mode,
        earlyReturnAllowed=event_mode or update is not None,
        intermediateUpdate=update,
        requiredIntermediateVariables=[references[name] for name in STATES] if update else None,
    )
    slave.setFloat64([references[name] for name in settings], list(settings.values()))
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    yield slave, references
    slave.terminate()
    slave.freeInstance()


def handle_event(slave: Any) -> None:
    """One round of event mode is enough, and no event is known ahead."""
    assert slave.updateDiscreteStates()[:5] == (False,) * 5
    slave.enterStepMode()


def test_early_return_event_mode_and_on_by_direct_calls(tmp_path: Path) -> None:
    """Steps that end at events, with event mode at each, give the bits of one step to the same end."""
    fmu = bundle(tmp_path, 3, "harmonic-torque")
    with ready(fmu, tmp_path / "plain", SLIPPING, event_mode=False) as (slave, references):
        slave.doStep(0.0, 0.25)
        observed = [references[name] for name in MOTION]
        plain = slave.getFloat64(observed)
        slips = slave.getInt32([references["slips"]])
    with ready(fmu, tmp_path / "events", SLIPPING, event_mode=True) as (slave, references):
        states = [references[name] for name in STATES]
        handle_event(slave)
        time, early_returns, changes = 0.0, 0, 0
        while time < 0.25:
            before = slave.getInt64(states)
            end = min(time + 1 / 64, 0.25)
            event, terminate, early, reached = slave.doStep(time, end - time)
            assert not terminate
            assert early == (reached < time + (end - time))
            assert event or slave.getInt64(states) == before, "a contact changes at an event only"
            if event:
                changes += slave.getInt64(states) != before
                early_returns += early
                slave.enterEventMode()
                values = slave.getFloat64(observed)
                handle_event(slave)
                assert slave.getFloat64(observed) == values, "event mode changes nothing by itself"
            time = reached
        assert slave.getFloat64(observed) == plain
        assert slave.getInt32([references["slips"]]) == slips
    assert early_returns >= changes >= slips[0] > 3


def test_intermediate_updates_tell_the_events_of_one_long_step(tmp_path: Path) -> None:
    """Times and values are those at which event mode ends steps; the step ends early when that is asked for."""
    fmu = bundle(tmp_path, 3, "harmonic-torque")
    expected: list[tuple[float, list[float], list[int]]] = []
    with ready(fmu, tmp_path / "events", SLIPPING, event_mode=True) as (slave, references):
        observed, states = ([references[name] for name in names] for names in (MOTION, STATES))
        handle_event(slave)
        time = 0.0
        while time < 0.25:
            event, _, _, time = slave.doStep(time, 0.25 - time)
            if event:
                expected.append((time, slave.getFloat64(observed), slave.getInt64(states)))
                slave.enterEventMode()
                handle_event(slave)
        end = slave.getFloat64(observed)
    told: list[tuple[float, list[float], list[int]]] = []
    flags: set[tuple[bool, ...]] = set()
    stop_after = len(expected) // 2

    def update(_: Any, time: float, *rest: Any) -> None:
        flags.add(tuple(rest[:4]))
        told.append((time, instance.getFloat64(observed), instance.getInt64(states)))
        if len(told) == stop_after:
            wanted, until = rest[4:]
            wanted[0], until[0] = True, time

    with ready(fmu, tmp_path / "told", SLIPPING, event_mode=False, update=update) as (instance, _):
        event, terminate, early, reached = instance.doStep(0.0, 0.25)
        assert (event, terminate, early, reached) == (False, False, True, expected[stop_after - 1][0])
        assert instance.getFloat64(observed) == expected[stop_after - 1][1]
        assert instance.doStep(reached, 0.25 - reached) == (False, False, False, 0.25)
        assert instance.getFloat64(observed) == end
    assert told == expected
    assert len(told) > 6
    assert flags == {(False, True, True, True)}


def test_a_torque_goes_on_at_its_rate_through_intermediate_updates(tmp_path: Path) -> None:
    """Inputs are given at the beginning of the step: who is told of what happens inside gets the same end."""
    fmu = bundle(tmp_path, 3, "input")
    settings = {"tilt": 0.2, "contact.stiffness_ratio": 30.0, "disk.initial_angular_velocity": 1.0}
    inputs = {"torque": -0.14, "torque.rate": 1.5}
    observed = [*MOTION, "base.reaction_force"]
    told: list[float] = []
    ends = []
    for update in (None, lambda _, time, *_rest: told.append(time)):
        folder = tmp_path / f"told-{update is not None}"
        with ready(fmu, folder, settings, event_mode=False, update=update) as (slave, references):
            slave.setFloat64([references[name] for name in inputs], list(inputs.values()))
            for step in range(10):
                slave.doStep(step / 32, 1 / 32)
            ends.append(slave.getFloat64([references[name] for name in observed]))
    assert ends[0] == ends[1]
    assert len(told) > 2


@pytest.mark.parametrize("version", [2, 3])
def test_a_torque_is_extrapolated_held_or_goes_on_at_its_rate(tmp_path: Path, version: int) -> None:
    """Without friction the disk is a flywheel: angular velocity is the integral of torque over I = 0.05 kg.m2."""
    fmu = bundle(tmp_path, version, "input")
    step, steps = 0.01, 20
    times = step * np.arange(steps + 1)
    signal = np.zeros(steps + 1, dtype=[("time", float), ("torque", float), ("torque.rate", float)])
    signal["time"], signal["torque"], signal["torque.rate"] = times, times**2, 2 * times
    ends = {}
    for degree in (1, 0, -1):
        given = signal if degree == 1 else signal[["time", "torque"]]
        result = simulate_fmu(
            fmu,
            stop_time=times[-1],
            output_interval=step,
            start_values={"contact.friction": 0.0, "torque.extrapolation_degree": degree},
            input=given,
            output=["disk.angular_velocity[1]"],
        )
        ends[degree] = result["disk.angular_velocity[1]"][-1]
    starts = times[:-1]
    held = np.sum(starts**2) * step / 0.05
    assert ends[0] == pytest.approx(held, rel=1e-9)
    assert ends[-1] == pytest.approx(times[-1] ** 3 / 3.0 / 0.05, rel=2e-3)
    assert ends[1] == pytest.approx(held + np.sum(starts) * step**2 / 0.05, rel=1e-9)
