"""What colours the disks: spin, speed, force, or nothing; values, range, label."""

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.colors import Colormap, LinearSegmentedColormap
from numpy.typing import NDArray

from jostle_lab.errors import LabError, did_you_mean
from jostle_lab.film.forces import Forces
from jostle_lab.film.pace import Pace
from jostle_lab.film.recording import Numbers, Recording
from jostle_lab.plots.style import CLOCKWISE, COUNTER_CLOCKWISE

COLOURS = ("spin", "speed", "force", "none")
SHADES = 33
"""Of a colour map: few, so that GIF files are small; odd, so that there is one in the middle."""
TYPICAL = 0.98
"""Share of the values that the range of colours holds."""
ROUNDING = 1e-12
"""Values up to this [SI units] are rounding: their range of colours is that of 1."""
PLAIN = "#e3d9c6"
"""Of disks that show nothing."""
# Light enough at every value that a dark marking and black lines are seen on it.
SPIN = LinearSegmentedColormap.from_list("spin", [CLOCKWISE, "#e88a80", "#f7f4ee", "#7fb0dd", COUNTER_CLOCKWISE])
AMOUNT = LinearSegmentedColormap.from_list("amount", ["#fbf8ee", "#f9d57a", "#ee9a49", "#c75b4a", "#8f3a5e"])


@dataclass(frozen=True)
class Colouring:
    """Colours of all disks in all frames."""

    shades: NDArray[np.uint8]
    """Number of a colour, shape (frames, disks)."""
    palette: Numbers
    """Red, green, blue in [0, 1], shape (colours, 3)."""
    label: str
    """Two lines, the first with the unit; empty if nothing is shown."""
    low: float
    high: float
    """Values of the first and the last colour."""
    beyond: bool
    """Whether some values are outside."""


def check(colour: str) -> str:
    """Return a name of `COLOURS`.

    Raises:
        LabError: another name.

    """
    if colour not in COLOURS:
        hint = did_you_mean(str(colour), COLOURS)
        raise LabError(f"colour = {colour!r} is not allowed: one of {', '.join(COLOURS)}.{hint}")
    return colour


def colouring(recording: Recording, pace: Pace, colour: str, forces: Forces | None, why_not: str) -> Colouring:
    """Colours by `colour`; `why_not` says why there are no forces."""
    if check(colour) == "none":
        shades = np.zeros((pace.frames, recording.disks), dtype=np.uint8)
        return Colouring(shades, _rgb(LinearSegmentedColormap.from_list("plain", [PLAIN, PLAIN]), 1), "", 0, 1, False)
    if colour == "spin":
        values, label = _spin(recording, pace)
        high = _round_up(float(np.quantile(np.abs(values), TYPICAL)))
        return _scaled(values, SPIN, label, -high, high)
    if colour == "speed":
        values, label = _speed(recording, pace), "speed [m/s]\nof the centre"
    else:
        if forces is None:
            raise LabError(f"colour = 'force' is not possible: {why_not} Choose spin, speed or none.")
        values = np.array([forces.on_disks(frame) for frame in range(pace.frames)])
        label = "force [N]\nsum of normal forces"
    return _scaled(values, AMOUNT, label, 0.0, _round_up(float(np.quantile(values, TYPICAL))))


def _scaled(values: Numbers, colours: Colormap, label: str, low: float, high: float) -> Colouring:
    place = np.clip((values - low) / (high - low), 0.0, 1.0)
    beyond = bool(values.min() < low or values.max() > high)
    return Colouring(np.rint(place * (SHADES - 1)).astype(np.uint8), _rgb(colours, SHADES), label, low, high, beyond)


def _rgb(colours: Colormap, count: int) -> Numbers:
    return np.asarray(colours(np.linspace(0.0, 1.0, count)), dtype=np.float64)[:, :3]


def _round_up(value: float) -> float:
    """To 1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of ten; 1 for nothing but rounding."""
    if value <= ROUNDING:
        return 1.0
    power = 10.0 ** math.floor(math.log10(value))
    return next(
        digit * power
        for digit in (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
        if digit * power >= value * (1.0 - 1e-9)
    )


def _spin(recording: Recording, pace: Pace) -> tuple[Numbers, str]:
    """Angular velocity of each disk in each frame, and what it is a mean over.

    With a drive that has a period it is the angle turned in the period about the frame (at the ends of the run the
    nearest one), since what a disk does within a period is mostly to and fro.
    """
    period, time = recording.period(), recording.time
    if period is None:
        return np.array(
            [pace.between(_recorded(recording), k) for k in range(pace.frames)]
        ), "spin [rad/s]\nat the moment"
    window = max(period, recording.interval)
    if window >= time[-1] - time[0]:
        window = float(time[-1] - time[0])
    begin = np.clip(pace.times - 0.5 * window, time[0], time[-1] - window)
    turned = _at(recording, begin + window) - _at(recording, begin)
    over = "a period" if math.isclose(window, period) else f"{1e3 * window:.3g} ms"
    return turned / window, f"spin [rad/s]\nmean over {over}"


def _at(recording: Recording, times: Numbers) -> Numbers:
    """Angles between samples [rad], shape (times, disks)."""
    return np.column_stack([np.interp(times, recording.time, angle) for angle in recording.angle.T])


def _recorded(recording: Recording) -> Numbers:
    if "disk.angular_velocity" in recording.data:
        return np.asarray(recording.data["disk.angular_velocity"].values, dtype=np.float64)
    return np.gradient(recording.angle, recording.time, axis=0)


def _speed(recording: Recording, pace: Pace) -> Numbers:
    names = ("disk.velocity_x", "disk.velocity_y")
    if all(name in recording.data for name in names):
        across, up = (np.asarray(recording.data[name].values, dtype=np.float64) for name in names)
    else:
        across, up = (np.gradient(place, recording.time, axis=0) for place in (recording.x, recording.y))
    return np.hypot(across, up)[pace.earlier]
