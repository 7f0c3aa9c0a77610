"""Positions and angles of a results folder in, what pictures of them give out: as P 2.4.3 works through its photos.

Needs `positions.csv` (`Setup.keep_positions`).
"""

import math
from dataclasses import dataclass, field

import numpy as np

from jostle_lab.protocol.results import Results
from jostle_lab.sensors.markings import Threshold
from jostle_lab.sensors.pictures import Seen, look
from jostle_lab.sensors.webcam import BackLight, Webcam
from jostle_lab.statistics.rotation import rotation
from jostle_lab.tables import Row, write_table

TABLE = "pictures.csv"
"""In the folder of a packing; one row for each amplitude."""


@dataclass(frozen=True)
class Processing:
    """Camera and threshold."""

    webcam: Webcam = field(default_factory=Webcam)
    threshold: Threshold = Threshold.ISODATA


def pictured(results: Results, seed: int, amplitude: float, processing: Processing) -> Seen:
    """Paths by pictures of one packing at one amplitude."""
    _, angles = results.angles(seed, amplitude)
    positions = results.positions(seed, amplitude)
    scene = BackLight(processing.webcam, results.box_width(), results.radii(seed))
    generator = np.random.default_rng([seed, round(1e6 * amplitude)])
    return look(scene, positions, angles, generator, processing.threshold)


def picture_row(seen: Seen, seed: int, amplitude: float, interval: float) -> Row:
    """Rotation by pictures `interval` [s] apart, and errors against the truth."""
    turned = rotation(seen.angles, interval)
    return {
        "seed": seed,
        "amplitude": amplitude,
        "mean_square_rpm_pictures": turned.mean_square(),
        "correlation_pictures": float(np.mean(turned.correlation)),
        "adjusted_deviation_pictures": float(np.mean(turned.adjusted_deviation)),
        "angle_error_degrees": math.degrees(seen.rms_angle_error()),
        "swapped": seen.swapped_share(),
        "lost": seen.lost,
        "found": len(seen.disks),
    }


def process(results: Results, processing: Processing) -> None:
    """Write the table of pictures of every packing."""
    interval = 1.0 / results.setup["camera"]["frame_rate"]
    for seed in results.seeds:
        rows = [
            picture_row(pictured(results, seed, a, processing), seed, a, interval)
            for a in (row["amplitude"] for row in results.amplitudes_of(seed))
        ]
        write_table(results.folder_of(seed) / TABLE, rows)
