"""The controlled disk as it runs in one coupling, and how well each segment of the reference is held."""

import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jostle_lab.demos.torque.controller import END, PROFILE, Controller, Plant, reference_at
from jostle_lab.fmu.disk_on_two_supports import DiskFmu

BAND = 0.02
"""A segment has settled when the velocity stays within this share of the step of its reference."""


@dataclass(frozen=True)
class Record:
    """A run, one row each millisecond and one at each event."""

    name: str
    time: NDArray[np.float64]
    velocity: NDArray[np.float64]
    torque: NDArray[np.float64]
    states: NDArray[np.int64]
    """Shape (rows, 2)."""
    events: int
    cost: float
    """[s]."""


def run(fmu: DiskFmu, name: str, sample: float, step: float, unstick: bool = False) -> Record:
    """Controller every `sample` [s] and, with event mode, at events too; a row each `step` [s] and at each event.

    With `unstick` the controller starts its integral at the torque that friction holds when a contact begins to stick.
    """
    controller, rows, events = Controller(Plant.of(fmu)), [], 0
    begun = time.perf_counter()
    steps, each = round(END / step), round(sample / step)
    torque = 0.0
    for index in range(steps):
        if index % each == 0:
            torque = controller.act(index * step, reference_at(index * step), fmu.velocity())
            fmu.apply(torque)
        rows.append((fmu.time, fmu.velocity(), torque, *fmu.contact_states()))
        while fmu.step_to((index + 1) * step):
            events += 1
            if unstick and 2 in fmu.contact_states():
                controller.start_from_stick(reference_at(fmu.time))
            torque = controller.act(fmu.time, reference_at(index * step), fmu.velocity())
            fmu.apply(torque)
            rows.append((fmu.time, fmu.velocity(), torque, *fmu.contact_states()))
            fmu.resume()
            if fmu.time >= (index + 1) * step:
                break
    table = np.array(rows)
    return Record(
        name, table[:, 0], table[:, 1], table[:, 2], table[:, 3:].astype(np.int64), events, time.perf_counter() - begun
    )


@dataclass(frozen=True)
class Quality:
    """How well a segment was held."""

    reference: float
    settling: float
    """Time until the velocity stays in the band [s]; NaN if never."""
    ripple: float
    """Peak to peak over the last half second [rad/s]."""
    error: float
    """Mean of velocity less reference over the last half second [rad/s]."""
    sticking: float
    """Share of the segment with both contacts sticking."""


def qualities(record: Record) -> list[Quality]:
    """Of every segment."""
    ends = [*(segment.begin for segment in PROFILE[1:]), END]
    before, found = 0.0, []
    for segment, end in zip(PROFILE, ends, strict=True):
        inside = (record.time >= segment.begin) & (record.time < end)
        at, velocity = record.time[inside], record.velocity[inside]
        band = BAND * abs(segment.reference - before)
        outside = np.flatnonzero(np.abs(velocity - segment.reference) > band)
        last = int(outside[-1]) + 1 if len(outside) else 0
        late = at >= end - 0.5
        found.append(
            Quality(
                segment.reference,
                float(at[last] - segment.begin) if last < len(at) else math.nan,
                float(np.ptp(velocity[late])),
                float(np.mean(velocity[late]) - segment.reference),
                float(np.mean((record.states[inside] == 2).all(axis=1))),
            )
        )
        before = segment.reference
    return found
