"""Pictures of recorded paths by cameras of several resolutions, noises and vignettings: errors and time."""

import math
from collections.abc import Sequence
from pathlib import Path
from time import process_time

import numpy as np
from joblib import Memory

from jostle_lab import locate
from jostle_lab.fmu.instance import fingerprint
from jostle_lab.protocol.results import Results
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.sensors.markings import Threshold, find_marks
from jostle_lab.sensors.pictures import look
from jostle_lab.sensors.webcam import BackLight, Webcam
from jostle_lab.statistics.rotation import rotation
from jostle_lab.tables import Table
from studies.thesis.laboratory.shaking import Effort, shake

RESOLUTIONS = (480.0, 960.0, 1920.0, 3840.0)
NOISES = (0.0, 2.0, 8.0, 20.0)
VIGNETTINGS = (0.0, 0.5, 0.7)
"""Beside the default one."""
FRAMES = 10
"""Pictures of each setting, at the strongest and at the weakest drive."""


def settings() -> list[tuple[Webcam, Threshold]]:
    """All cameras that are tried."""
    cameras = [Webcam(resolution=r, noise=n) for r in RESOLUTIONS for n in NOISES]
    cameras += [Webcam(vignetting=v) for v in VIGNETTINGS]
    return [*((camera, Threshold.ISODATA) for camera in cameras), (Webcam(), Threshold.OTSU)]


def trial(laboratory: Laboratory, effort: Effort) -> Table:
    """One row for each camera, drive and frame rate; kept like a run."""

    def compute() -> tuple[Table, float]:
        folder = laboratory.kept.parent / "laboratory" / effort.name
        fmu = locate.fmu("packing.fmu", "packing")
        results = shake(effort, fmu, folder, laboratory.processes, laboratory.show_progress)
        kept = Memory(laboratory.kept, verbose=0).cache(tried)
        table: tuple[Table, float] = kept(results.folder, fingerprint(fmu))
        return table

    return dict(laboratory.computed(f"cameras on {effort.key()}", compute).items())


def tried(folder: Path, version: str) -> tuple[Table, float]:
    """Table of all cameras and its processor time [s]; `version` of the FMU is there for joblib."""
    del version
    begun, results = process_time(), Results(folder)
    rows = [row for camera, method in settings() for row in _rows(results, camera, method)]
    table = {name: np.array([row[name] for row in rows]) for name in rows[0]} | _snapshot(results)
    return table, process_time() - begun


def _rows(results: Results, camera: Webcam, threshold: Threshold) -> Sequence[dict[str, float]]:
    rows = []
    seed = results.seeds[0]
    for amplitude in (row["amplitude"] for row in (results.amplitudes_of(seed)[0], results.amplitudes_of(seed)[-1])):
        _, angles = results.angles(seed, amplitude)
        positions = results.positions(seed, amplitude)
        angles, positions = angles[:FRAMES], positions[:FRAMES]
        scene = BackLight(camera, results.box_width(), results.radii(seed))
        begun = process_time()
        seen = look(scene, positions, angles, np.random.default_rng(seed), threshold)
        spent = (process_time() - begun) / len(angles)
        turned, true = rotation(seen.angles, 1.0), rotation(angles, 1.0)
        rows.append(
            {
                "resolution": camera.resolution,
                "noise": camera.noise,
                "vignetting": camera.vignetting,
                "otsu": float(threshold is Threshold.OTSU),
                "amplitude": amplitude,
                "angle_error": math.degrees(seen.rms_angle_error()),
                "swapped": seen.swapped_share(),
                "lost": float(seen.lost),
                "extra": float(seen.extra),
                "found": float(len(seen.disks)),
                "disks": float(angles.shape[1]),
                "frames": float(len(angles)),
                "correlation": float(np.mean(turned.correlation)),
                "correlation_true": float(np.mean(true.correlation)),
                "deviation": float(np.mean(turned.adjusted_deviation)),
                "deviation_true": float(np.mean(true.adjusted_deviation)),
                "seconds": spent,
            }
        )
    return rows


def _snapshot(results: Results) -> Table:
    """Disks and found marks of one picture, to draw it again."""
    seed, amplitude = results.seeds[0], results.amplitudes_of(results.seeds[0])[0]["amplitude"]
    _, angles = results.angles(seed, amplitude)
    positions, radii = results.positions(seed, amplitude), results.radii(seed)
    scene = BackLight(Webcam(), results.box_width(), radii)
    picture = scene.take(positions[0], angles[0], np.random.default_rng(seed))
    marks = find_marks(picture, Webcam().mark_area())
    return {
        "shown_x": positions[0, :, 0],
        "shown_y": positions[0, :, 1],
        "shown_angle": angles[0],
        "shown_radius": radii,
        "shown_width": np.array([results.box_width()]),
        "mark_column": marks.centres[:, 0],
        "mark_row": marks.centres[:, 1],
        "mark_angle": marks.angles,
    }
