"""One packing through the whole protocol: grains and protocol in, a folder of CSV files out.

A folder whose `packing.json` exists is complete; until then its tables grow with each interval, and what was stopped
goes on after the last of them, to the same bits.
"""

import json
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np
import polars as pl
from numpy.typing import NDArray

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling
from jostle_lab.errors import LabError, require
from jostle_lab.files import replace_text
from jostle_lab.fmu.grains import Grains
from jostle_lab.loudspeaker.model import Loudspeaker, Mark
from jostle_lab.protocol import checkpoint
from jostle_lab.protocol.checkpoint import Checkpoint
from jostle_lab.protocol.intervals import Interval, Protocol
from jostle_lab.protocol.now import Now, Observer
from jostle_lab.sensors.accelerometer import STANDARD_GRAVITY, Accelerometer
from jostle_lab.sensors.camera import Camera, aliasing, photograph, unwrap
from jostle_lab.sensors.spectral_amplitude import spectral_amplitude, true_amplitude
from jostle_lab.statistics.rotation import rotation
from jostle_lab.tables import Row, write_frame, write_table

SENSORS = 2
KEPT_SECONDS = 60
"""Length [s] of the accelerometer record kept as CSV for each amplitude; the estimate uses the whole record."""

FINISHED, UNFINISHED = "packing.json", "unfinished.json"
"""Summary of a packing, and of one whose protocol goes on."""

Progress = Callable[[int | Now], None]
"""Called with the simulated seconds that have passed since the last call; 0: the tables have been written. And now and
then with what the disks do."""


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
    keep_positions: bool = False
    """Keep the centres of the disks at each picture in `positions.csv`: what pictures are drawn of."""

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
    """Centres at each frame [m], shape (frames, disks, 2)."""
    moved: NDArray[np.float64]
    """Distance from start to end of the recording [m], shape (disks,)."""
    work_by_plate: float
    """[J]."""
    work_received: float
    """[J]."""


class PackingRun:
    """One packing on the loudspeaker, and the tables that grow with each interval."""

    def __init__(self, grains: Grains, setup: Setup, seed: int, folder: Path) -> None:
        self.grains, self.setup, self.seed, self.folder = grains, setup, seed, folder
        self.loudspeaker = Loudspeaker(1.0 / setup.steps_per_second, setup.drive_frequency, grains.weight)
        self.full_voltage = self.loudspeaker.voltage_for_acceleration(setup.full_drive_gamma * grains.gravity)
        self.coupling = Coupling(self.loudspeaker, grains, setup.exchange)
        self.sensor_cost, self._started, self._spent = 0.0, perf_counter(), process_time()
        self._amplitudes: list[Row] = []
        self._disks: list[Row] = []
        self._blocks: dict[str, list[NDArray[np.float64]]] = {"angles": [], "accelerometers": [], "positions": []}
        self._observer = Observer(grains, seed)

    @property
    def recorded(self) -> int:
        """Number of intervals that are done."""
        return len(self._amplitudes)

    def shake(self, amplitude: float, seconds: int, progress: Progress, doing: str = "settling") -> None:
        """Shake at a fraction of the full drive, unobserved."""
        self.loudspeaker.voltage_amplitude = amplitude * self.full_voltage
        self._observer.begin(amplitude, doing)
        for _ in range(seconds):
            self.coupling.run(self.setup.steps_per_second)
            self._report(1, progress)

    def _report(self, seconds: int, progress: Progress) -> None:
        progress(seconds)
        if (now := self._observer.look(seconds)) is not None:
            progress(now)

    def record(self, interval: Interval, progress: Progress) -> None:
        """Go through the next interval."""
        number = self.recorded
        self.shake(interval.amplitude, interval.relaxation, progress, "relaxing")
        self._observer.begin(interval.amplitude, "recording")
        record = _record(self.coupling, self.setup, interval, lambda seconds: self._report(seconds, progress))
        measuring = perf_counter()
        sensors = _read_sensors(record, self.setup, (self.seed, number))
        self._amplitudes.append(_amplitude_row(record, sensors, self.setup, self.grains, self.seed))
        self._disks.extend(_disk_rows(record, self.setup, self.grains, self.seed))
        self._blocks["angles"].append(_frame_rows(record, self.setup, record.angles))
        if self.setup.keep_positions:
            places = record.positions.reshape(len(record.angles), -1)
            self._blocks["positions"].append(_frame_rows(record, self.setup, places))
        self._blocks["accelerometers"].append(_sensor_rows(interval, sensors, self.setup))
        self.sensor_cost += perf_counter() - measuring

    def write(self) -> None:
        """Write the tables of the intervals so far, the summary as `UNFINISHED`, and the checkpoint to go on from."""
        self.folder.mkdir(parents=True, exist_ok=True)
        write_table(self.folder / "amplitudes.csv", self._amplitudes)
        write_table(self.folder / "disks.csv", self._disks)
        centres = [f"{axis}_{i}" for i in range(1, self.grains.radii.size + 1) for axis in "xy"]
        for file, blocks in self._blocks.items():
            if blocks:
                rows = np.concatenate(blocks)
                kind = {"angles": "disk", "accelerometers": "sensor"}.get(file)
                columns = [f"{kind}_{i}" for i in range(1, rows.shape[1] - 1)] if kind else centres
                write_frame(self.folder / f"{file}.csv", pl.DataFrame(rows, schema=["amplitude", "time", *columns]))
        replace_text(self.folder / UNFINISHED, json.dumps(self._summary(), indent=2) + "\n")
        if self.grains.can_serialise:
            checkpoint.save(self.folder, self._state())

    def finish(self) -> None:
        """All is written: nothing is to go on from."""
        (self.folder / UNFINISHED).replace(self.folder / FINISHED)
        (self.folder / checkpoint.FILE).unlink(missing_ok=True)

    def _state(self) -> Checkpoint:
        state, steps, step_size, mark = self.loudspeaker.save()
        plain = {
            "seconds": round(self.loudspeaker.time),
            "amplitudes": self._amplitudes,
            "disks": self._disks,
            "loudspeaker": [steps, step_size, list(mark)],
            "coupling": [self.coupling.reaction_force, self.coupling.work_by_plate],
            "spent": [perf_counter() - self._started, process_time() - self._spent],
            "costs": [self.coupling.loudspeaker_cost, self.sensor_cost, self.grains.costs],
        }
        grains = np.frombuffer(self.grains.to_bytes(), np.uint8)
        blocks = {name: np.concatenate(blocks) for name, blocks in self._blocks.items() if blocks}
        return Checkpoint(plain, {"grains": grains, "speaker": state, **blocks})

    def resume(self) -> bool:
        """Go back to where a process that was stopped wrote last; False if there is nothing to go back to."""
        found = checkpoint.load(self.folder)
        if found is None:
            return False
        plain, arrays = found.plain, dict(found.arrays)
        self.grains.from_bytes(arrays.pop("grains").tobytes())
        steps, step_size, mark = plain["loudspeaker"]
        self.loudspeaker.restore((arrays.pop("speaker"), steps, step_size, Mark(*mark)))
        self.coupling.reaction_force, self.coupling.work_by_plate = plain["coupling"]
        self._amplitudes, self._disks = plain["amplitudes"], plain["disks"]
        for name, rows in arrays.items():
            self._blocks[name] = [rows]
        clock, processor = plain["spent"]
        self._started, self._spent = self._started - clock, self._spent - processor
        self.coupling.loudspeaker_cost, self.sensor_cost, costs = plain["costs"]
        self.grains.costs.update(costs)
        return True

    def _summary(self) -> dict[str, Any]:
        costs = {"loudspeaker": self.coupling.loudspeaker_cost, "sensors and analysis": self.sensor_cost}
        return {
            "seed": self.seed,
            "simulated_seconds": round(self.loudspeaker.time),
            "wall_seconds": perf_counter() - self._started,
            "processor_seconds": process_time() - self._spent,
            "communication_steps": self.loudspeaker.steps_taken,
            "costs": {**self.grains.costs, **costs},
            "full_drive_voltage": self.full_voltage,
            "grains_weight": self.grains.weight,
            "box_width": self.grains.box_width,
            "moving_mass": self.loudspeaker.mass,
            "driver": asdict(self.loudspeaker.driver),
        }


def run_packing(grains: Grains, setup: Setup, seed: int, folder: Path, progress: Progress) -> None:
    """Take `grains` through the protocol and write its folder, its tables after each interval; go on if it was begun.

    Grains that cannot be written as bytes begin anew.
    """
    run = PackingRun(grains, setup, seed, folder)
    if not (grains.can_serialise and run.resume()):
        run.shake(1.0, setup.protocol.settling, progress)
    for interval in setup.protocol.intervals[run.recorded :]:
        run.record(interval, progress)
        run.write()
        progress(0)
    run.finish()


def _record(coupling: Coupling, setup: Setup, interval: Interval, progress: Callable[[int], None]) -> Record:
    grains, steps = coupling.grains, setup.steps_per_frame()
    work, received = coupling.work_by_plate, grains.energy_input()
    angles, positions, accelerations = [grains.angles()], [grains.positions()], []
    for _ in range(round(interval.recording * setup.camera.frame_rate)):
        accelerations.append(coupling.run(steps))
        angles.append(grains.angles())
        positions.append(grains.positions())
        progress(1)
    return Record(
        interval,
        np.concatenate(accelerations),
        np.array(angles),
        np.array(positions),
        np.hypot(*(positions[-1] - positions[0]).T),
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
    by_camera = rotation(unwrap(photograph(record.angles)), 1.0 / setup.camera.frame_rate)
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
        **{f"gamma_sensor_{i}": e.amplitude * in_gamma for i, e in enumerate(estimates, 1)},
        **{f"mean_reading_{i}": float(np.mean(s)) for i, s in enumerate(sensors, 1)},
        "clipped_readings": sum(int(np.sum(np.abs(s) >= setup.accelerometer.measuring_range)) for s in sensors),
        "work_by_plate": record.work_by_plate,
        "work_received": record.work_received,
        "coupling_error": difference / record.work_received if record.work_received else math.nan,
        "mean_square_rpm": turned.mean_square(),
        "mean_square_rpm_camera": by_camera.mean_square(),
        "correlation": float(np.mean(turned.correlation)),
        "adjusted_deviation": float(np.mean(turned.adjusted_deviation)),
        "correlation_camera": float(np.mean(by_camera.correlation)),
        "adjusted_deviation_camera": float(np.mean(by_camera.adjusted_deviation)),
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
            "x": record.positions[-1, i, 0],
            "y": record.positions[-1, i, 1],
            "moved": record.moved[i],
            "mean_velocity": turned.mean_velocity[i],
            "camera_velocity": compared.camera_velocity[i],
            "aliased": int(compared.differs[i]),
            "correlation": turned.correlation[i],
            "adjusted_deviation": turned.adjusted_deviation[i],
        }
        for i in range(grains.radii.size)
    ]


def _frame_rows(record: Record, setup: Setup, seen: NDArray[np.float64]) -> NDArray[np.float64]:
    """Amplitude, time and what is `seen` at each frame, shape (frames, any)."""
    frames = len(seen)
    time = np.arange(frames) / setup.camera.frame_rate
    return np.column_stack((np.full(frames, record.interval.amplitude), time, seen))


def _sensor_rows(interval: Interval, sensors: list[NDArray[np.float64]], setup: Setup) -> NDArray[np.float64]:
    rate = setup.accelerometer.data_rate
    kept = np.column_stack(sensors)[: round(KEPT_SECONDS * rate)]
    time = np.arange(kept.shape[0]) / rate
    return np.column_stack((np.full(kept.shape[0], interval.amplitude), time, kept))
