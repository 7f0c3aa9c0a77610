"""Datasets made by hand, and pictures read back."""

import math
from pathlib import Path
from typing import Any

import imageio_ffmpeg
import numpy as np
import xarray as xr
from numpy.typing import NDArray

import jostle

Picture = NDArray[np.uint8]
WEDGE = {"scene": "wedge", "engine": "event-driven", "drive": "sine", "gravity": 9.81, "wedge.aperture": 2.0944}
WEDGE |= {"wedge.tilt": 0.1745, "disk.radius": 0.02, "drive.amplitude": 1e-3, "drive.frequency": 10.0}
WEDGE |= {"drive.phase": 0.0}
RATCHET = {"scene": "ratchet", "engine": "event-driven", "drive": "sine", "gravity": 9.81, "cell.height": 0.6}
RATCHET |= {"tooth.width": 0.006, "tooth.height": 0.006, "tooth.asymmetry": 0.25, "tooth.tip_radius": 0.0004}
RATCHET |= {"tooth.count": 4, "drive.amplitude": 0.0, "drive.frequency": 25.0}


def run_of(attributes: dict[str, Any], time: Any, x: Any, y: Any, angle: Any, radius: Any, **more: Any) -> xr.Dataset:
    """A dataset with the layout of `jostle.Simulation.run`; x, y and angle of shape (times, disks)."""
    time, radius = np.asarray(time, dtype=float), np.asarray(radius, dtype=float)
    names = {"disk.x": x, "disk.y": y, "disk.angle": angle}
    data = {name: (("time", "disk"), np.asarray(values, dtype=float)) for name, values in names.items()}
    data["base.position"] = ("time", np.zeros(len(time)))  # type: ignore[assignment]
    data |= more
    coordinates = {"time": time, "disk": 1 + np.arange(len(radius)), "disk.radius": ("disk", radius)}
    return xr.Dataset(data, coordinates, attributes)


def turning(samples: int = 41, seconds: float = 0.4, rate: float = 5.0) -> xr.Dataset:
    """A disk in a wedge that turns evenly."""
    time = np.linspace(0.0, seconds, samples)
    here = np.ones((samples, 1))
    return run_of(WEDGE, time, 0.0 * here, 0.03 * here, rate * time[:, None], [0.02])


def packing(seconds: float = 0.1, every: float = 0.004, disks: int = 8, **values: Any) -> xr.Dataset:
    """A short run of a few disks."""
    shaken = {"box.width": 0.16, "drive.amplitude": 2e-3, "drive.frequency": 15.0} | values
    return jostle.Simulation("packing", disks=disks, **shaken).run(seconds, every=every)


def decoded(path: Path) -> list[Picture]:
    """Frames of a film, each of shape (height, width, 3)."""
    reader = imageio_ffmpeg.read_frames(str(path))
    width, height = next(reader)["size"]
    return [np.frombuffer(frame, np.uint8).reshape(height, width, 3) for frame in reader]


def marked_angle(picture: Picture, centre: tuple[float, float], radius: float) -> float:
    """Angle at which the darker half of a disk is, from its light alone; centre (column, row) and radius in pixels."""
    rows, columns = np.indices(picture.shape[:2], dtype=float)
    x, y = columns + 0.5 - centre[0], centre[1] - (rows + 0.5)
    inside = np.hypot(x, y) < 0.9 * radius
    light = picture.mean(axis=2)[inside]
    dark = light.mean() - light
    return math.atan2(float((dark * y[inside]).sum()), float((dark * x[inside]).sum()))


def difference(first: float, second: float) -> float:
    """Of two angles [rad], in [0, pi]."""
    return abs((first - second + math.pi) % math.tau - math.pi)
