"""The disk on two supports through fmpy: events where they are asked for, inputs held and interpolated."""

import subprocess
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu

ROOT = Path(__file__).parents[2]
STATES = ["contact[1].state", "contact[2].state"]
MOTION = ["disk.angle[1]", "disk.angular_velocity[1]", "disk.x[1]", "disk.y[1]", "energy.lost"]


def bundle(folder: Path, version: int, drive: str) -> str:
    fmu = folder / f"{drive}{version}.fmu"
    command = [ROOT / "target/release/jostle", "fmu", "three_disk", "--drive", drive]
    subprocess.run([*command, "--fmi", str(version), "--out", fmu], check=True)
    return str(fmu)


def test_events_end_steps_where_the_importer_wants_it_and_change_nothing(tmp_path: Path) -> None:
    """Every change of a contact has a row of its own; the end is that of plain steps to the bit."""
    fmu = bundle(tmp_path, 3, "harmonic-torque")
    settings = {"tilt": 0.2, "torque.amplitude": 0.2, "torque.angular_frequency": 40.0, "contact.stiffness_ratio": 30.0}
    outputs = [*MOTION, *STATES, "slips"]
    common = {"stop_time": 0.25, "output_interval": 1 / 64, "start_values": settings, "output": outputs}
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


@pytest.mark.parametrize("version", [2, 3])
def test_a_torque_is_held_or_goes_on_at_its_rate(tmp_path: Path, version: int) -> None:
    """Without friction the disk is a flywheel: angular velocity is the integral of torque over I = 0.05 kg.m2."""
    fmu = bundle(tmp_path, version, "input")
    step, steps = 0.01, 20
    times = step * np.arange(steps + 1)
    signal = np.zeros(steps + 1, dtype=[("time", float), ("torque", float), ("torque.rate", float)])
    signal["time"], signal["torque"], signal["torque.rate"] = times, times**2, 2 * times
    ends = {}
    for rate in (True, False):
        given = signal if rate else signal[["time", "torque"]]
        result = simulate_fmu(
            fmu,
            stop_time=times[-1],
            output_interval=step,
            start_values={"contact.friction": 0.0},
            input=given,
            output=["disk.angular_velocity[1]"],
        )
        ends[rate] = result["disk.angular_velocity[1]"][-1]
    starts = times[:-1]
    held = np.sum(starts**2) * step / 0.05
    assert ends[False] == pytest.approx(held, rel=1e-9)
    assert ends[True] == pytest.approx(held + np.sum(starts) * step**2 / 0.05, rel=1e-9)
