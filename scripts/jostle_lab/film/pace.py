"""Which instants a film shows: slow motion, density of the samples, and what lies between two samples.

A frame between two samples shows the straight line from one to the other. Where that would be invented it shows the
earlier sample: a disk that moved by more than its radius or turned by more than a quarter, or a gap in the times. Runs
that are sampled too coarsely for their drive are shown sample by sample, as a stroboscope does.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError, require
from jostle_lab.film.recording import Numbers, Recording

FEWEST_SAMPLES = 8
"""Of a period, with which its motion is resolved."""
PERIOD_SHOWN = 0.6
"""Time that a period of the drive takes in the film unless told [s]."""
FRAMES_SHOWN, FEWEST_FRAMES = 12, 8
"""Of a period, at least, in a film whose slow motion we choose; the fewer in long runs."""
LENGTH = 60.0
"""Longest film that we choose [s]."""
WITHOUT_PERIOD = 10.0
"""Length of the film of a run without a period [s]."""
MOST_FRAMES = 36_000
"""Of a film: 20 minutes. More is a slip of the keyboard."""
NICE = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)


@dataclass(frozen=True)
class Pace:
    """Frames and the samples that they lie between."""

    times: Numbers
    """Simulated time of each frame [s], shape (frames,)."""
    earlier: NDArray[np.intp]
    """Number of the sample at or before each frame."""
    share: Numbers
    """How far each frame is on the way to the next sample, in [0, 1)."""
    joined: NDArray[np.bool_]
    """Whether a disk moves on a line from a sample to the next, shape (samples - 1, disks)."""
    slow: float
    """How many times slower than real the film is."""
    stroboscopic: bool
    """Whether frames show samples alone."""
    fps: float
    """Frames a second."""

    @property
    def frames(self) -> int:
        """Number of frames."""
        return len(self.times)

    def exposures(self, samples: int) -> NDArray[np.intp]:
        """First sample of each frame, and the one after its last, of a run of `samples`, shape (frames, 2)."""
        stride = max(int(self.earlier[-1] - self.earlier[-2]), 1)
        after = np.append(self.earlier[1:], min(int(self.earlier[-1]) + stride, samples))
        return np.column_stack((self.earlier, np.maximum(after, self.earlier + 1)))

    def between(self, values: Numbers, frame: int, together: bool = False) -> Numbers:
        """Values of shape (samples, disks) at a frame; with `together` those of shape (samples, ...) of the base."""
        at, share = int(self.earlier[frame]), float(self.share[frame])
        if share == 0.0 or self.stroboscopic:
            return np.asarray(values[at])
        whole = bool(self.joined[at].any()) if together else self.joined[at]
        return np.asarray(values[at] + np.where(whole, share, 0.0) * (values[at + 1] - values[at]))


def pace(recording: Recording, slow: float | None, start: float | None, end: float | None, fps: float) -> Pace:
    """Choose the frames of a film.

    Args:
        recording: of the run.
        slow: times slower than real; None: chosen by the drive.
        start: simulated time of the first frame [s]; None: of the first sample.
        end: simulated time that no frame is after [s]; None: of the last sample.
        fps: frames a second.

    Raises:
        LabError: a value out of range.

    """
    first, last = float(recording.time[0]), float(recording.time[-1])
    remedy = "Choose a part of the run."
    begin = first if start is None else require("start [s]", start, first, last, remedy)
    finish = last if end is None else require("end [s]", end, begin, last, remedy)
    if finish <= begin:
        raise LabError(f"start = {begin:g} s and end = {finish:g} s leave nothing to show. {remedy}")
    if slow is not None:
        require("slow", slow, 1e-6, 1e9, "It says how many times slower than real the film is, such as 10.")
    stroboscopic = coarse(recording)
    factor = slow if slow is not None else chosen(recording, finish - begin, fps)
    count = math.floor((finish - begin) * fps * factor * (1.0 + 1e-12) + 1e-9) + 1
    if count > MOST_FRAMES:
        raise LabError(
            f"The film would have {count} frames, at most {MOST_FRAMES} are allowed. Show a part of the run (start, "
            f"end), or choose a smaller slow (now {factor:g}) or fps (now {fps:g})."
        )
    if count < 2:
        raise LabError(
            f"The film would have {count} frame, at least 2 are needed. Choose a larger slow (now {factor:g}), or show "
            "a longer part of the run."
        )
    times = np.minimum(begin + np.arange(count) / (fps * factor), finish)
    # An instant within a billionth of an interval of a sample is that sample: products round.
    slack = 1e-9 * recording.interval
    earlier = np.clip(np.searchsorted(recording.time, times + slack, side="right") - 1, 0, len(recording.time) - 1)
    gaps = np.append(np.diff(recording.time), np.inf)
    share = np.clip((times - recording.time[earlier]) / gaps[earlier], 0.0, 1.0)
    share[np.abs(times - recording.time[earlier]) <= slack] = 0.0
    return Pace(times, earlier, share, joined(recording), factor, stroboscopic, fps)


def joined(recording: Recording) -> NDArray[np.bool_]:
    """Whether a disk moves on a line from each sample to the next, shape (samples - 1, disks)."""
    moved = np.hypot(np.diff(recording.x, axis=0), np.diff(recording.y, axis=0))
    near = (moved <= recording.radius) & (np.abs(np.diff(recording.angle, axis=0)) <= 0.5 * math.pi)
    gap = np.diff(recording.time) > 1.5 * recording.interval
    return np.asarray(near & ~gap[:, None])


def coarse(recording: Recording) -> bool:
    """Whether there are fewer than `FEWEST_SAMPLES` samples in a period of the drive."""
    period = recording.period()
    return period is not None and not recording.base_is_at_rest() and period / recording.interval < FEWEST_SAMPLES - 0.5


def warning(recording: Recording) -> str | None:
    """What the reader should know of the density of the samples, with the remedy."""
    period = recording.period()
    if period is not None and coarse(recording):
        every = down_to_nice(period / 16.0)
        return (
            f"{period / recording.interval:.2g} samples a period of the drive ({1.0 / period:g} Hz) are too few to "
            f"show its motion: the film shows the samples alone, as a stroboscope does. Record with every={every:g}, "
            f"which gives {period / every:.0f} samples a period."
        )
    parted = float(np.mean(~joined(recording)))
    if parted > 0.01:
        return (
            f"{100.0 * parted:.0f} % of the disks' ways from sample to sample are longer than a radius or a quarter "
            f"turn, and are shown as jumps. Record with a smaller every (now {recording.interval:g} s)."
        )
    return None


def chosen(recording: Recording, span: float, fps: float) -> float:
    """Slow motion that shows `span` seconds of a run well: how many times slower than real."""
    period = recording.period()
    if coarse(recording):
        return max(down_to_nice(1.0 / (fps * recording.interval)), 1.0)
    if period is None or recording.base_is_at_rest():
        return max(down_to_nice(WITHOUT_PERIOD / span), 1.0)
    wanted = max(PERIOD_SHOWN, FRAMES_SHOWN / fps) / period
    if wanted * span > LENGTH:
        wanted = max(LENGTH / span, FEWEST_FRAMES / (fps * period))
    return max(down_to_nice(wanted), 1.0)


def down_to_nice(value: float, digits: tuple[float, ...] = NICE) -> float:
    """The largest of `digits` times a power of ten that is not above `value`."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(digit for digit in digits if digit <= value / power * (1.0 + 1e-9)) * power
