"""Forces between the disks at each sample of a run.

A dataset holds none, but for the disk on two supports. So the run is done again from the attributes of its dataset: the
same parameters give the same bits. Whether they do is checked at every sample; lines are drawn only if all agree. A
contact of hard grains is often shorter than a frame, so that a frame shows means over the samples until the next one.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from jostle_lab.film.pace import Pace
from jostle_lab.film.recording import Numbers, Recording
from jostle_lab.film.scenery import slopes
from jostle_lab.film.sources import package

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = ("first", "second", "wall", "x", "y", "normal_force")
"""Of the table of contacts that a film needs."""


class Replayable(Protocol):
    """What a film needs of a simulation."""

    def advance_to(self, time: float) -> None:
        """Advance to a time [s]."""

    def read(self, name: str) -> Numbers:
        """Values of `disk.x` and its kind, shape (disks,)."""

    def contacts(self) -> "pd.DataFrame":
        """Table of the closed contacts with the columns `COLUMNS`, as `jostle.Simulation.contacts` returns it."""


@dataclass(frozen=True)
class Contacts:
    """The closed contacts of one instant, or their means over the time of a frame."""

    disks: NDArray[np.intp]
    """Of both sides, from 1; 0 is a wall or the base, shape (contacts, 2)."""
    walls: NDArray[np.intp]
    """Number of the wall, from 1; 0 between disks, shape (contacts,)."""
    points: Numbers
    """[m], shape (contacts, 2)."""
    normal: Numbers
    """Normal force [N], shape (contacts,)."""


@dataclass(frozen=True)
class Forces:
    """Contacts in each frame: means over the samples from the frame to the next one."""

    frames: tuple[Contacts, ...]
    """Shape (frames,)."""
    disks: int
    """Number of disks."""
    window: float
    """Time that they are means over [s]; 0: of one sample."""

    def on_disks(self, frame: int) -> Numbers:
        """Sum of the normal forces of its contacts on each disk [N], shape (disks,)."""
        contacts = self.frames[frame]
        total = np.zeros(self.disks + 1)
        for side in (0, 1):
            np.add.at(total, contacts.disks[:, side], contacts.normal)
        return total[1:]

    @cached_property
    def typical(self) -> float:
        """Normal force [N] that one contact in fifty is above; 0 without any."""
        every = np.concatenate([contacts.normal for contacts in self.frames])
        return float(np.quantile(every, 0.98)) if len(every) else 0.0


class NoForcesError(Exception):
    """Why there are none, as a sentence."""


def find(
    recording: Recording,
    pace: Pace,
    make: Callable[[Recording], Replayable] | None = None,
    counted: Callable[[range], Iterable[int]] = iter,
) -> Forces:
    """Contacts in the frames of a film.

    Args:
        recording: of the run.
        pace: frames.
        make: a simulation at time 0 with the parameters of a run; None: that of the package `jostle`.
        counted: shows the progress of a loop over the samples.

    Raises:
        NoForcesError: there are none; says why.

    """
    ends = pace.exposures(len(recording.time))
    samples = counted(range(int(ends[0, 0]), int(ends[-1, 1])))
    if recording.scene == "three_disk" and "contact.normal_force" in recording.data:
        found = {at: _on_supports(recording, at) for at in samples}
    else:
        found = dict(_replayed(recording, samples, make or same_run))
    frames = tuple(mean([found[at] for at in range(first, last)]) for first, last in ends.tolist())
    several = float(np.median(np.diff(ends, axis=1)))
    return Forces(frames, recording.disks, several * recording.interval if several > 1.0 else 0.0)


def mean(contacts: Sequence[Contacts]) -> Contacts:
    """Means over instants: of the force, zero where a contact is open; of the point, weighted by the force."""
    keys = np.concatenate([np.column_stack((c.disks, c.walls)) for c in contacts])
    normal = np.concatenate([c.normal for c in contacts])
    points = np.concatenate([c.points for c in contacts])
    pairs, which = np.unique(keys, axis=0, return_inverse=True)
    total, weighted = np.zeros(len(pairs)), np.zeros((len(pairs), 2))
    np.add.at(total, which.ravel(), normal)
    np.add.at(weighted, which.ravel(), points * normal[:, None])
    kept = total > 0.0
    pairs, total = pairs[kept], total[kept]
    return Contacts(pairs[:, :2], pairs[:, 2], weighted[kept] / total[:, None], total / len(contacts))


def _replayed(
    recording: Recording, samples: Iterable[int], make: Callable[[Recording], Replayable]
) -> Iterator[tuple[int, Contacts]]:
    """Contacts at these samples of the run done again."""
    if recording.drive == "input":
        raise NoForcesError("the run followed inputs, which its dataset does not hold.")
    if recording.time[0] < 0.0:
        raise NoForcesError("the run began before time 0.")
    with _refusals():
        simulation = make(recording)
        for at in samples:
            time = float(recording.time[at])
            if time > 0.0:
                simulation.advance_to(time)
            _compare(simulation, recording, at)
            yield at, _contacts(simulation.contacts())


def same_run(recording: Recording) -> Replayable:
    """A simulation at time 0 with the parameters of a run."""
    jostle, attributes = package(), recording.data.attrs
    names = {"engine": recording.engine, "drive": recording.drive, "disks": recording.disks}
    known = jostle.Simulation(recording.scene, **names).variables
    fixed = known.index[known["causality"] == "parameter"]
    values = {name: attributes[name] for name in fixed if name in attributes}
    made: Replayable = jostle.Simulation(recording.scene, **names, **values)
    return made


@contextmanager
def _refusals() -> Iterator[None]:
    """What the package refuses is the reason."""
    jostle = package()
    try:
        yield
    except jostle.JostleError as error:
        raise NoForcesError(str(error)) from None


def _compare(simulation: Replayable, recording: Recording, at: int) -> None:
    for name, recorded in (("disk.x", recording.x), ("disk.y", recording.y), ("disk.angle", recording.angle)):
        if not np.array_equal(simulation.read(name), recorded[at]):
            raise NoForcesError(
                f"the run done again from its parameters has another {name} at {recording.time[at]:g} s: it did not "
                "begin at time 0, was changed on its way, or is of another version."
            )


def _contacts(table: "pd.DataFrame") -> Contacts:
    first, second, wall, x, y, normal = (table[name].to_numpy() for name in COLUMNS)
    numbers = np.column_stack((first, second)).astype(np.intp)
    points = np.column_stack((x, y)).astype(np.float64)
    return Contacts(numbers, wall.astype(np.intp), points, normal.astype(np.float64))


def _on_supports(recording: Recording, at: int) -> Contacts:
    """Those of the disk on two supports, which are recorded."""
    _, normals = slopes(recording.parameter("support.angle"), recording.parameter("tilt"))
    centre = np.array([recording.x[at, 0], recording.y[at, 0]])
    normal = np.asarray(recording.data["contact.normal_force"].values[at], dtype=np.float64)
    closed = normal > 0.0
    points = centre - recording.radius[0] * normals
    return Contacts(np.array([[1, 0], [1, 0]])[closed], np.array([1, 2])[closed], points[closed], normal[closed])
