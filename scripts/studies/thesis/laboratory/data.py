"""What is kept of packings on the loudspeaker: numbers of each packing and amplitude, of the disks, and some paths.

A packing is seen by three eyes: `true` has the angles themselves, `camera` has them modulo 180 degrees once a second,
and `pictures` has what a webcam's pictures give (P 2.4.3).
"""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from joblib import Memory
from numpy.typing import NDArray

from jostle_lab import locate
from jostle_lab.fmu.instance import fingerprint
from jostle_lab.protocol.intervals import thesis
from jostle_lab.protocol.pictures import Processing, pictured
from jostle_lab.protocol.results import Results
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.sensors.camera import Camera, aliasing, photograph, unwrap
from jostle_lab.statistics.regression import Regression
from jostle_lab.statistics.rotation import RPM, Rotation, rotation
from jostle_lab.tables import Table
from studies.thesis.laboratory.shaking import Effort, shake

EYES = ("true", "camera", "pictures")
MOVED = 1e-3
"""Way of a disk's centre over a record that counts as a change of place [m]: a twentieth of the mean radius."""
BITS, DISK_BITS = 12, 5
"""Of the mantissa of what is kept, and of the disks' velocities: that makes the record small."""
STEPS = 100
"""In which the disks' rho^2 and sigma_a are kept, from 0 to 1."""
PATH_SAMPLE = 3
"""Frames from one kept point of a path to the next."""
PATH_STEPS = 200
"""Kept steps of a revolution."""
LENGTHS = (9, 30, 90)
"""Pieces [s] into which the longer records are cut, to see what the length of a record does."""


@dataclass(frozen=True)
class Data:
    """Columns of one value for each packing and amplitude unless said otherwise; read by name."""

    table: Table
    effort: Effort

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """A column, such as `gamma_measured`; velocities in RPM."""
        return self.table[name]

    def by_disk(self, name: str) -> NDArray[np.float64]:
        """`disk_velocity` [RPM] or `disk_correlation` by camera, shape (packings x amplitudes, disks).

        Longer records have `disk_deviation` (sigma_a), too.
        """
        return self.table[name].reshape(len(self.table["seed"]), -1)

    def regression(self, quantity: str, eye: str) -> Regression:
        """A quantity by an eye; against the true Gamma for `true`, else against the measured one."""
        gamma = self["gamma_true" if eye == "true" else "gamma_measured"]
        return Regression(gamma, self[f"{quantity}_{eye}"], self["seed"])

    def packings(self) -> int:
        """Number of packings, and of neighbours in a regression (P 3.1)."""
        return len(np.unique(self.table["seed"]))

    def hours_of_the_thesis(self) -> float:
        """Processor time of P's protocol at its length [h], by what this one took for each simulated second."""
        return float(self.table["cost"][0]) * 25 * thesis().duration() / 3600.0

    def recording(self) -> float:
        """Seconds of each record."""
        return float(self.table["recording"][0])

    def rows_at(self, amplitude: float) -> NDArray[np.intp]:
        """Rows of all packings at an amplitude."""
        return np.flatnonzero(np.isclose(self.table["amplitude"], amplitude, atol=1e-4))

    def amplitudes(self) -> list[float]:
        """From strong to weak."""
        return sorted({round(float(a), 4) for a in self.table["amplitude"]}, reverse=True)


def data(laboratory: Laboratory, effort: Effort) -> Data:
    """What is kept of an effort; shaken, photographed and counted if nothing is."""

    def compute() -> tuple[Table, float]:
        folder = laboratory.kept.parent / "laboratory" / effort.name
        fmu = locate.fmu("packing.fmu", "packing")
        results = shake(effort, fmu, folder, laboratory.processes, laboratory.show_progress)
        # Pictures take minutes, and figures share them.
        kept = Memory(laboratory.kept, verbose=0).cache(counted_folder)
        table: Table = kept(folder, effort, fingerprint(fmu))
        return compact(table), sum(summary["processor_seconds"] for summary in results.summaries)

    table = laboratory.computed(effort.key(), compute)
    return Data(dict(table.items()), effort)


def counted_folder(folder: Path, effort: Effort, version: str) -> Table:
    """Table of a folder; `version` of the FMU is there for joblib: another FMU, other packings."""
    del version
    return counted(Results(folder), effort)


def counted(results: Results, effort: Effort) -> Table:
    """Table of an effort's results folder."""
    interval = 1.0 / results.setup["camera"]["frame_rate"]
    columns: dict[str, list[float]] = {}
    velocities, correlations, deviations = [], [], []
    for seed in results.seeds:
        for row in results.amplitudes_of(seed):
            _, angles = results.angles(seed, row["amplitude"])
            seen = pictured(results, seed, row["amplitude"], Processing())
            by_eye = {
                "true": rotation(angles, interval),
                "camera": rotation(unwrap(photograph(angles)), interval),
                "pictures": rotation(seen.angles, interval),
            }
            moved = np.array([disk["moved"] for disk in results.disks_of(seed, row["amplitude"])])
            numbers = {
                **{name: float(row[name]) for name in KEPT},
                "moved": float(np.count_nonzero(moved > MOVED)),
                "aliased": float(aliasing(angles, interval).count()),
                "mean_velocity": float(np.mean(by_eye["true"].mean_velocity)) / RPM,
                "angle_error": math.degrees(seen.rms_angle_error()),
                "swapped": seen.swapped_share(),
                "lost": float(seen.lost),
                "extra": float(seen.extra),
                "wrong_as_printed": float(np.count_nonzero(_wrong(unwrapped_as_printed(angles), angles))),
                **_fast_and_slow(angles, interval),
            }
            for eye, turned in by_eye.items():
                numbers |= {f"{name}_{eye}": value for name, value in _steadiness(turned).items()}
            for name, value in numbers.items():
                columns.setdefault(name, []).append(value)
            velocities.append(by_eye["camera"].mean_velocity / RPM)
            correlations.append(by_eye["camera"].correlation)
            deviations.append(by_eye["camera"].adjusted_deviation)
    frames = _frames(results, effort)
    table = {name: np.array(values) for name, values in columns.items()}
    table["disk_velocity"], table["disk_correlation"] = np.concatenate(velocities), np.concatenate(correlations)
    spent, simulated = (sum(s[name] for s in results.summaries) for name in ("processor_seconds", "simulated_seconds"))
    table["cost"] = np.array([spent / simulated])
    table["recording"] = np.array([(frames - 1) * interval])
    if not effort.paths:
        return table
    table["disk_deviation"] = np.concatenate(deviations)
    return {**table, **_paths(results), **_pieces(results, interval)}


KEPT = (
    "seed",
    "amplitude",
    "gamma_true",
    "gamma_peak",
    "gamma_measured",
    "gamma_sensor_1",
    "gamma_sensor_2",
    "mean_reading_1",
    "mean_reading_2",
)
"""Columns of the protocol's own table."""


def unwrapped_as_printed(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Paths by the rule as P 2.4.3 prints it: a jump above +90 degrees shifts the past by -180; shape as `angles`."""
    marks = photograph(angles)
    jumps = np.diff(marks, axis=0)
    shifts = np.where(jumps > 0.5 * math.pi, -math.pi, np.where(jumps < -0.5 * math.pi, math.pi, 0.0))
    past = np.cumsum(shifts[::-1], axis=0)[::-1]
    return np.asarray(marks + np.concatenate((past, np.zeros((1, marks.shape[1])))))


def _wrong(paths: NDArray[np.float64], angles: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Disks whose excursion is off by a half turn or more."""
    return np.asarray(np.abs((paths[-1] - paths[0]) - (angles[-1] - angles[0])) > 0.5 * math.pi)


def _fast_and_slow(angles: NDArray[np.float64], interval: float) -> dict[str, float]:
    """Disks above 15 RPM and below 10, and how many of each an ideal camera has wrong."""
    speed = np.abs(angles[-1] - angles[0]) / ((len(angles) - 1) * interval) / RPM
    wrong = _wrong(unwrap(photograph(angles)), angles)
    groups = {"fast": speed > Camera().alias_limit() / RPM, "slow": speed < 10.0}
    counts = {name: float(np.count_nonzero(group)) for name, group in groups.items()}
    return {**counts, **{f"{name}_wrong": float(np.count_nonzero(group & wrong)) for name, group in groups.items()}}


def _steadiness(turned: Rotation) -> dict[str, float]:
    return {
        "square": turned.mean_square(),
        "correlation": float(np.mean(turned.correlation)),
        "deviation": float(np.mean(turned.adjusted_deviation)),
        "fastest": float(np.max(np.abs(turned.mean_velocity))) / RPM,
    }


def compact(table: Table) -> Table:
    """What is kept of a table: fewer digits."""
    return {name: _fewer_digits(name, values) for name, values in table.items()}


def _fewer_digits(name: str, values: NDArray[np.float64]) -> NDArray[np.float64]:
    if name in {"disk_correlation", "disk_deviation"}:
        return np.asarray(np.round(values * STEPS) / STEPS)
    mantissa, exponent = np.frexp(values)
    bits = DISK_BITS if name == "disk_velocity" else BITS
    return np.asarray(np.ldexp(np.round(np.ldexp(mantissa, bits)), exponent - bits))


def _frames(results: Results, effort: Effort) -> int:
    return len(results.angles(results.seeds[0], effort.amplitudes[0])[0])


def _paths(results: Results) -> Table:
    """Angles of the first packing's disks [revolutions] at all amplitudes, one point in `PATH_SAMPLE` frames."""
    seed = results.seeds[0]
    kept = []
    for row in results.amplitudes_of(seed):
        _, angles = results.angles(seed, row["amplitude"])
        turns = unwrap(photograph(angles))[::PATH_SAMPLE] / math.tau
        kept.append(np.round((turns - turns[0]) * PATH_STEPS) / PATH_STEPS)
    return {"paths": np.array(kept).ravel(), "path_frames": np.array([float(kept[0].shape[0])])}


def _pieces(results: Results, interval: float) -> Table:
    """Rotation by camera in pieces of the records, mean over packings and pieces, shape (amplitudes, lengths)."""
    found: dict[str, list[float]] = {"square": [], "correlation": [], "deviation": []}
    lengths: list[int] = []
    for row in results.amplitudes_of(results.seeds[0]):
        paths = []
        for seed in results.seeds:
            _, angles = results.angles(seed, row["amplitude"])
            paths.append(unwrap(photograph(angles)))
        whole = round((len(paths[0]) - 1) * interval)
        lengths = sorted({min(length, whole) for length in LENGTHS})
        for length in lengths:
            frames = round(length / interval)
            pieces = [
                _steadiness(rotation(path[start : start + frames + 1], interval))
                for path in paths
                for start in range(0, len(path) - frames, frames)
            ]
            for name, values in found.items():
                values.append(float(np.mean([piece[name] for piece in pieces])))
    table = {f"piece_{name}": np.array(values) for name, values in found.items()}
    return {**table, "piece_seconds": np.array(lengths, dtype=np.float64)}
