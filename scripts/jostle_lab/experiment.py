"""One packing through the whole protocol: grains and protocol in, a folder of CSV files out.

A folder whose `packing.json` exists is complete; it is written last.
"""

import json
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jostle_lab.accelerometer import STANDARD_GRAVITY, Accelerometer
from jostle_lab.analysis import rotation
from jostle_lab.camera import Camera, aliasing, photograph, unwrap
from jostle_lab.coupling import Coupling, Exchange
from jostle_lab.errors import LabError, require
from jostle_lab.grains import Grains
from jostle_lab.loudspeaker import Loudspeaker
from jostle_lab.protocol import Interval, Protocol
from jostle_lab.spectral_amplitude import spectral_amplitude, true_amplitude
from jostle_lab.tables import write_array, write_table

SENSORS = 2
KEPT_SECONDS = 60
"""Length [s] of the accelerometer record kept as CSV for each amplitude; the estimate uses the whole record."""

Progress = Callable[[int], None]
"""Called with the simulated seconds that have passed since the last call."""


@dataclass(frozen=True)
class Setup:
    """Everything that decides the outcome besides the grains and the seed."""

    protocol: Protocol
    steps_per_second: int = 4800
    """Communication rate [Hz]: a multiple of the drive, of the data rate and of the frame rate."""
    exchange: Exchange = Exchange.GRAINS_FIRST
    drive_frequency: float = 80.0
    """[Hz]."""
    full_drive_gamma: float = 5.0
    """Gamma of the unloaded base at A = 1."""
    accelerometer: Accelerometer = field(default_factory=Accelerometer)
    camera: Camera = field(default_factory=Camera)

    def __post_init__(self) -> None:
        """Refuse rates that do not fit together, before anything runs."""
        require("steps per second", self.steps_per_second, 400, 1e5, "4800 suits the thesis' packing.")
        require("Gamma at full drive", self.full_drive_gamma, 0.01, 8.0, "The thesis goes to about 5.")
        for name, rate in (
            ("drive frequency", self.drive_frequency),
            ("accelerometers' data rate", self.accelerometer.data_rate),
            ("camera's frame rate", self.camera.frame_rate),
        ):
            ratio = self.steps_per_second / rate
            if not math.isclose(ratio, round(ratio), rel_tol=1e-9):
                raise LabError(
                    f"steps per second = {self.steps_per_second} is not a multiple of the {name}, {rate:g} Hz. "
                    "Choose a multiple of all rates, such as 4800."
                )

    def steps_per_frame(self) -> int:
        """Communication steps between two pictures."""
        return round(self.steps_per_second / self.camera.frame_rate)


@dataclass
class Record:
    """What one interval gives."""

    interval: Interval
    acceleration: NDArray[np.float64]
    """Of the base at the end of each step [m/s2], shape (steps,)."""
    angles: NDArray[np.float64]
    """[rad, unwrapped], shape (frames, disks), first frame at the start of the recording."""
    positions: NDArray[np.float64]
    """At the end [m], shape (disks, 2)."""
    moved: NDArray[np.float64]
    """Distance from start to end of the recording [m], shape (disks,)."""
    work_by_plate: float
    """[J]."""
    work_received: float
    """[J]."""


def run_packing(grains: Grains, setup: Setup, seed: int, folder: Path, progress: Progress) -> None:
    """Take `grains` through the protocol and write its folder."""
    started = perf_counter()
    loudspeaker = Loudspeaker(1.0 / setup.steps_per_second, setup.drive_frequency, grains.weight)
    full_voltage = loudspeaker.voltage_for_acceleration(setup.full_drive_gamma * grains.gravity)
    coupling = Coupling(loudspeaker, grains, setup.exchange)
    loudspeaker.voltage_amplitude = full_voltage
    _shake(coupling, setup, setup.protocol.settling, progress)
    folder.mkdir(parents=True, exist_ok=True)
    amplitudes: list[dict[str, Any]] = []
    disks: list[dict[str, Any]] = []
    angles: list[NDArray[np.float64]] = []
    readings: list[NDArray[np.float64]] = []
    sensor_cost = 0.0
    for number, interval in enumerate(setup.protocol.intervals):
        loudspeaker.voltage_amplitude = interval.amplitude * full_voltage
        _shake(coupling, setup, interval.relaxation, progress)
        record = _record(coupling, setup, interval, progress)
        measuring = perf_counter()
        sensors = _read_sensors(record, setup, (seed, number))
        amplitudes.append(_amplitude_row(record, sensors, setup, grains, seed))
        disks.extend(_disk_rows(record, setup, grains, seed))
        angles.append(_angle_rows(record, setup))
        readings.append(_sensor_rows(interval, sensors, setup))
        sensor_cost += perf_counter() - measuring
    write_table(folder / "amplitudes.csv", amplitudes)
    write_table(folder / "disks.csv", disks)
    count = grains.radii.size
    write_array(folder / "angles.csv", angles, ["amplitude", "time", *(f"disk_{i + 1}" for i in range(count))])
    write_array(
        folder / "accelerometers.csv", readings, ["amplitude", "time", *(f"sensor_{i + 1}" for i in range(SENSORS))]
    )
    summary = {
        "seed": seed,
        "simulated_seconds": setup.protocol.duration(),
        "wall_seconds": perf_counter() - started,
        "communication_steps": loudspeaker.steps_taken,
        "costs": {**grains.costs, "loudspeaker": coupling.loudspeaker_cost, "sensors and analysis": sensor_cost},
        "full_drive_voltage": full_voltage,
        "grains_weight": grains.weight,
        "box_width": grains.box_width,
        "moving_mass": loudspeaker.mass,
        "driver": asdict(loudspeaker.driver),
    }
    (folder / "packing.json").write_text(json.dumps(summary, indent=2) + "\n")


def _shake(coupling: Coupling, setup: Setup, seconds: int, progress: Progress) -> None:
    for _ in range(seconds):
        coupling.run(setup.steps_per_second)
        progress(1)


def _record(coupling: Coupling, setup: Setup, interval: Interval, progress: Progress) -> Record:
    grains, steps = coupling.grains, setup.steps_per_frame()
    work, received = coupling.work_by_plate, grains.energy_input()
    start = grains.positions()
    angles, accelerations = [grains.angles()], []
    for _ in range(round(interval.recording * setup.camera.frame_rate)):
        accelerations.append(coupling.run(steps))
        angles.append(grains.angles())
        progress(1)
    positions = grains.positions()
    return Record(
        interval,
        np.concatenate(accelerations),
        np.array(angles),
        positions,
        np.hypot(*(positions - start).T),
        coupling.work_by_plate - work,
        grains.energy_input() - received,
    )


def _read_sensors(record: Record, setup: Setup, seed: tuple[int, int]) -> list[NDArray[np.float64]]:
    return [
        setup.accelerometer.read(
            record.acceleration, setup.steps_per_second, np.random.default_rng([*seed, sensor_number])
        )
        for sensor_number in range(SENSORS)
    ]


def _amplitude_row(
    record: Record, sensors: list[NDArray[np.float64]], setup: Setup, grains: Grains, seed: int
) -> dict[str, Any]:
    rate, frequency = setup.accelerometer.data_rate, setup.drive_frequency
    estimates = [spectral_amplitude(sensor, rate, frequency) for sensor in sensors]
    in_gamma = STANDARD_GRAVITY / grains.gravity
    measured = float(np.mean([e.amplitude for e in estimates])) * in_gamma
    corrected = float(np.mean([e.amplitude_corrected for e in estimates])) * in_gamma
    true = true_amplitude(record.acceleration, setup.steps_per_second, frequency) / grains.gravity
    turned = rotation(record.angles, 1.0 / setup.camera.frame_rate)
    seen = rotation(unwrap(photograph(record.angles)), 1.0 / setup.camera.frame_rate)
    difference = record.work_by_plate - record.work_received
    return {
        "seed": seed,
        "amplitude": record.interval.amplitude,
        "gamma_true": true,
        "gamma_peak": float(np.max(np.abs(record.acceleration))) / grains.gravity,
        "gamma_measured": measured,
        "gamma_corrected": corrected,
        "bias": measured / true - 1.0,
        "bias_corrected": corrected / true - 1.0,
        "clipped_readings": sum(int(np.sum(np.abs(s) >= setup.accelerometer.measuring_range)) for s in sensors),
        "work_by_plate": record.work_by_plate,
        "work_received": record.work_received,
        "coupling_error": difference / record.work_received if record.work_received else math.nan,
        "mean_square_rpm": turned.mean_square(),
        "mean_square_rpm_camera": seen.mean_square(),
        "correlation": float(np.mean(turned.correlation)),
        "adjusted_deviation": float(np.mean(turned.adjusted_deviation)),
        "correlation_camera": float(np.mean(seen.correlation)),
        "adjusted_deviation_camera": float(np.mean(seen.adjusted_deviation)),
        "aliased_disks": aliasing(record.angles, 1.0 / setup.camera.frame_rate).count(),
        "largest_move": float(np.max(record.moved)),
    }


def _disk_rows(record: Record, setup: Setup, grains: Grains, seed: int) -> list[dict[str, Any]]:
    interval = 1.0 / setup.camera.frame_rate
    turned, compared = rotation(record.angles, interval), aliasing(record.angles, interval)
    return [
        {
            "seed": seed,
            "amplitude": record.interval.amplitude,
            "disk": i + 1,
            "radius": grains.radii[i],
            "x": record.positions[i, 0],
            "y": record.positions[i, 1],
            "moved": record.moved[i],
            "mean_velocity": turned.mean_velocity[i],
            "camera_velocity": compared.camera_velocity[i],
            "aliased": int(compared.differs[i]),
            "correlation": turned.correlation[i],
            "adjusted_deviation": turned.adjusted_deviation[i],
        }
        for i in range(grains.radii.size)
    ]


def _angle_rows(record: Record, setup: Setup) -> NDArray[np.float64]:
    frames = record.angles.shape[0]
    time = np.arange(frames) / setup.camera.frame_rate
    return np.column_stack((np.full(frames, record.interval.amplitude), time, record.angles))


def _sensor_rows(interval: Interval, sensors: list[NDArray[np.float64]], setup: Setup) -> NDArray[np.float64]:
    rate = setup.accelerometer.data_rate
    kept = np.column_stack(sensors)[: round(KEPT_SECONDS * rate)]
    time = np.arange(kept.shape[0]) / rate
    return np.column_stack((np.full(kept.shape[0], interval.amplitude), time, kept))
