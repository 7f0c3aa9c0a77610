"""The words of a film: title, what drives, slow motion."""

import math

from jostle_lab.film.pace import Pace
from jostle_lab.film.recording import Recording


def title(recording: Recording) -> str:
    """What is seen."""
    disks = "1 disk" if recording.disks == 1 else f"{recording.disks:,} disks"
    if recording.scene == "packing":
        bottom = "a vibrating bottom"
        if recording.base_is_at_rest():
            bottom = "a bottom that gives impacts its velocity"
        elif recording.drive == "random-bottom":
            bottom = "a bottom row that moves at random"
        elif recording.drive == "sine-fixed-bottom":
            bottom = "a vibrating bottom with a fixed row"
        return f"{disks} in a box on {bottom}"
    if recording.scene == "ratchet":
        return f"{disks} on vibrating teeth"
    if recording.scene == "wedge":
        tilt = math.degrees(recording.parameter("wedge.tilt"))
        what = "wedge that gives impacts its velocity" if recording.base_is_at_rest() else "vibrating wedge"
        return f"1 disk in a {what}, tilted by {tilt:.3g}°"
    moved = {"sine": "vibrating supports", "random-supports": "supports that move at random"}
    return f"1 disk on two {moved.get(recording.drive, 'supports, turned by a torque')}"


def driven(recording: Recording) -> str:
    """Frequency, amplitude, and acceleration of the drive; empty if it has none."""
    attributes = recording.data.attrs
    if recording.drive == "harmonic-torque":
        cycle = recording.parameter("torque.angular_frequency")
        return f"torque {recording.parameter('torque.amplitude'):.3g} N m, {cycle:.3g} rad/s"
    if "drive.frequency" not in attributes or "drive.amplitude" not in attributes:
        return {"input": "base moved by inputs"}.get(recording.drive, "") if recording.base is not None else ""
    frequency, amplitude = recording.parameter("drive.frequency"), recording.parameter("drive.amplitude")
    said = f"{frequency:.4g} Hz, amplitude {length(amplitude)}"
    gravity = recording.parameter("gravity")
    if gravity > 0.0:
        said += f", Gamma {amplitude * (math.tau * frequency) ** 2 / gravity:.2g}"
    return said


def slowness(pace: Pace, recording: Recording) -> str:
    """How many times slower than real, and whether only samples are shown."""
    factor = pace.slow
    said = f"{factor:.4g} × slower" if factor > 1.0 else f"{1.0 / factor:.4g} × faster" if factor < 1.0 else "real time"
    period = recording.period()
    if pace.stroboscopic and period is not None:
        said += f"\n{period / recording.interval:.2g} samples / period"
    return said


def length(metres: float) -> str:
    """With a unit that suits: 3 cm, 0.1 mm."""
    for unit, size in (("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("µm", 1e-6)):
        if metres >= size * 0.9999:
            return f"{metres / size:.3g} {unit}"
    return f"{metres:.3g} m"
