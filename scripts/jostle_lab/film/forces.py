"""Forces between the disks at each sample of a run.

A dataset holds none, but for the disk on two supports. So the run is done again from the attributes of its dataset: the
same parameters give the same bits. Whether they do is checked at every sample; lines are drawn only if all agree.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from jostle_lab.film.recording import Numbers, Recording
from jostle_lab.film.scenery import slopes
from jostle_lab.film.sources import package

COLUMNS = ("first", "second", "x", "y", "normal_force")
"""Of the table of contacts that a film needs."""


class Replayable(Protocol):
    """What a film needs of a simulation."""

    def advance_to(self, time: float) -> None:
        """Advance to a time [s]."""

    def read(self, name: str) -> Numbers:
        """Values of `disk.x` and its kind, shape (disks,)."""

    def contacts(self) -> pd.DataFrame:
        """Table of the closed contacts: numbers `first` and `second` of the disks from 1 (0: wall or base), the point
        `x`, `y` [m], `normal_force` [N].
        """  # noqa: D205


@dataclass(frozen=True)
class Contacts:
    """The closed contacts at one sample."""

    disks: NDArray[np.intp]
    """Of both sides, from 1; 0 is a wall or the base, shape (contacts, 2)."""
    points: Numbers
    """[m], shape (contacts, 2)."""
    normal: Numbers
    """Normal force [N], shape (contacts,)."""


@dataclass(frozen=True)
class Forces:
    """Contacts at the samples that a film shows."""

    at: Mapping[int, Contacts]
    """By the number of the sample."""
    disks: int
    """Number of disks."""

    def on_disks(self, sample: int) -> Numbers:
        """Sum of the normal forces of its contacts on each disk [N], shape (disks,)."""
        contacts = self.at[sample]
        total = np.zeros(self.disks + 1)
        for side in (0, 1):
            np.add.at(total, contacts.disks[:, side], contacts.normal)
        return total[1:]

    def typical(self) -> float:
        """Normal force [N] that one contact in fifty is above; 0 without any."""
        every = [contacts.normal for contacts in self.at.values() if len(contacts.normal)]
        return float(np.quantile(np.concatenate(every), 0.98)) if every else 0.0


class NoForcesError(Exception):
    """Why there are none, as a sentence."""


def find(
    recording: Recording,
    samples: Iterator[int] | list[int],
    make: Callable[[Recording], Replayable] | None = None,
) -> Forces:
    """Contacts at these samples, in their order.

    Args:
        recording: of the run.
        samples: their numbers, increasing.
        make: a simulation at time 0 with the parameters of a run; None: that of the package `jostle`.

    Raises:
        NoForcesError: there are none; says why.

    """
    if {"contact.normal_force", "disk.x"} <= set(recording.data) and recording.scene == "three_disk":
        return Forces({at: _on_supports(recording, at) for at in samples}, 1)
    if recording.drive == "input":
        raise NoForcesError("the run followed inputs, which its dataset does not hold.")
    if recording.time[0] < 0.0:
        raise NoForcesError("the run began before time 0.")
    simulation, found = _made(recording, make or same_run), {}
    for at in samples:
        time = float(recording.time[at])
        with _refusals():
            if time > 0.0:
                simulation.advance_to(time)
            _compare(simulation, recording, at)
            found[at] = _contacts(simulation.contacts())
    return Forces(found, recording.disks)


def same_run(recording: Recording) -> Replayable:
    """A simulation at time 0 with the parameters of a run."""
    jostle, attributes = package(), recording.data.attrs
    names = {"engine": recording.engine, "drive": recording.drive, "disks": recording.disks}
    known = jostle.Simulation(recording.scene, **names).variables
    fixed = known.index[known["causality"] == "parameter"]
    values = {name: attributes[name] for name in fixed if name in attributes}
    made: Replayable = jostle.Simulation(recording.scene, **names, **values)
    return made


def _made(recording: Recording, make: Callable[[Recording], Replayable]) -> Replayable:
    with _refusals():
        simulation = make(recording)
    if not hasattr(simulation, "contacts"):
        raise NoForcesError("this version of the package jostle has no contacts().")
    return simulation


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


def _contacts(table: pd.DataFrame) -> Contacts:
    first, second, x, y, normal = (table[name].to_numpy() for name in COLUMNS)
    numbers = np.column_stack((first, second)).astype(np.intp)
    return Contacts(numbers, np.column_stack((x, y)).astype(np.float64), normal.astype(np.float64))


def _on_supports(recording: Recording, at: int) -> Contacts:
    """Those of the disk on two supports, which are recorded."""
    _, normals = slopes(recording.parameter("support.angle"), recording.parameter("tilt"))
    centre = np.array([recording.x[at, 0], recording.y[at, 0]])
    normal = np.asarray(recording.data["contact.normal_force"].values[at], dtype=np.float64)
    closed = normal > 0.0
    points = centre - recording.radius[0] * normals
    return Contacts(np.array([[1, 0], [1, 0]])[closed], points[closed], normal[closed])
