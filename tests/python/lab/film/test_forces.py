"""Lines of force are those of the same run, to the bit, or there are none, with the reason."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
import pytest
from film.made import packing, turning

import jostle
from jostle_lab.errors import LabError
from jostle_lab.film import FilmWarning, forces
from jostle_lab.film.forces import Contacts, NoForcesError
from jostle_lab.film.make import write_script
from jostle_lab.film.pace import pace
from jostle_lab.film.recording import Recording, record


class Fake:
    """Plays a recording back; one contact with wall 1, whose force is the number of the sample."""

    def __init__(self, recording: Recording, error: float = 0.0) -> None:
        self.recording, self.error, self.at = recording, error, 0

    def advance_to(self, time: float) -> None:
        self.at = int(np.flatnonzero(self.recording.time == time)[0])

    def read(self, name: str) -> Any:
        return self.recording.data[name].values[self.at] + self.error

    def contacts(self) -> pd.DataFrame:
        row = {"first": 1, "second": 0, "wall": 1, "x": 0.0, "y": 0.01, "normal_force": float(self.at)}
        return pd.DataFrame([row])


def test_a_frame_shows_the_mean_over_its_samples() -> None:
    run = record(turning(samples=41))
    frames = pace(run, 1.0, None, 0.3, 25.0)  # a frame each 40 ms, a sample each 10 ms
    found = forces.find(run, frames, Fake)
    assert [contacts.normal[0] for contacts in found.frames] == [1.5, 5.5, 9.5, 13.5, 17.5, 21.5, 25.5, 29.5]
    assert found.window == pytest.approx(0.04)
    assert found.on_disks(3).tolist() == [13.5]


def test_means_count_open_contacts_and_weigh_points_by_force() -> None:
    def one(second: int, wall: int, x: float, force: float) -> Contacts:
        return Contacts(np.array([[1, second]]), np.array([wall]), np.array([[x, 0.0]]), np.array([force]))

    found = forces.mean([one(0, 1, 0.0, 3.0), one(0, 1, 1.0, 1.0), one(2, 0, 5.0, 8.0), one(0, 2, 7.0, 4.0)])
    assert found.disks.tolist() == [[1, 0], [1, 0], [1, 2]]
    assert found.walls.tolist() == [1, 2, 0]
    assert found.normal.tolist() == [1.0, 1.0, 2.0]
    assert found.points[:, 0].tolist() == [0.25, 7.0, 5.0]


def test_another_last_bit_is_another_run() -> None:
    run = record(turning())
    with pytest.raises(NoForcesError, match=r"another disk\.x at 0 s"):
        forces.find(run, pace(run, 1.0, None, None, 30.0), lambda r: Fake(r, error=1e-18 + 1e-300))
    assert forces.find(run, pace(run, 1.0, None, None, 30.0), Fake).frames


def test_forces_of_a_packing_are_those_of_its_contacts() -> None:
    data = packing(seconds=0.02, every=0.002)
    script = write_script(data, slow=500 / 25, fps=25.0, contacts=True)  # a frame for each sample
    assert script.forces is not None and len(script.forces.frames) == 11
    sim = jostle.Simulation(
        "packing", disks=8, **{k: data.attrs[k] for k in ("box.width", "drive.amplitude", "drive.frequency")}
    )
    for sample, contacts in enumerate(script.forces.frames):
        if sample:
            sim.advance_to(float(data["time"][sample]))
        table = sim.contacts()
        assert sorted(contacts.normal) == sorted(table["normal_force"][table["normal_force"] > 0.0])
        floor = (contacts.walls > 0) & (contacts.points[:, 1] < 0.005)
        assert contacts.normal[floor].sum() == pytest.approx(-sim["base.reaction_force_now"], rel=1e-5, abs=1e-12)


def test_lines_go_from_centre_to_centre_and_are_as_wide_as_the_force() -> None:
    script = write_script(packing(seconds=0.1, every=0.002), slow=20.0, contacts=True)
    assert script.forces is not None
    frame, contacts = script.frame(40), script.forces.frames[40]
    assert len(contacts.normal) > 3
    ratio = frame.widths / contacts.normal
    thin = contacts.normal < script.forces.typical
    assert ratio[thin] == pytest.approx(ratio[thin][0])
    for (first, second), segment in zip(contacts.disks, frame.segments, strict=True):
        assert segment[0].tolist() == frame.centres[first - 1].tolist()
        if second:
            assert segment[1].tolist() == frame.centres[second - 1].tolist()


def test_the_disk_on_two_supports_is_carried_by_its_two_contacts() -> None:
    data = jostle.Simulation("three_disk", **{"drive.amplitude": 0.0, "tilt": 0.0}).run(0.1, every=0.005)
    script = write_script(data, slow=10.0, contacts=True)
    assert script.forces is not None
    normal = script.forces.frames[3].normal
    assert normal * np.cos(data.attrs["support.angle"]) == pytest.approx(0.5 * 0.1 * 10.0, rel=1e-3)


def later() -> Any:
    """A run whose simulation did not begin at time 0."""
    data = packing(seconds=0.03, every=0.001)
    return data.assign_coords(time=data["time"] + 0.01)


def on_inputs() -> Any:
    return jostle.Simulation("packing", drive="input", disks=8, **{"box.width": 0.16}).run(0.02, every=0.001)


def hard() -> Any:
    return jostle.Simulation("packing", engine="event-driven", disks=8, **{"box.width": 0.16}).run(0.02, every=0.001)


@pytest.mark.parametrize(
    ("make", "reason"),
    [(later, "has another disk"), (on_inputs, "the run followed inputs"), (hard, "event-driven")],
)
def test_where_there_are_no_forces_the_film_says_why(make: Callable[[], Any], reason: str) -> None:
    data = make()
    with pytest.warns(FilmWarning, match=f"No lines of force are drawn: .*{reason}"):
        assert write_script(data).forces is None
    with pytest.raises(LabError, match=f"Lines of force are not possible: .*{reason}.*Leave contacts out"):
        write_script(data, contacts=True)
    with pytest.raises(LabError, match=f"colour = 'force' is not possible: .*{reason}.*Choose spin, speed or none"):
        write_script(data, colour="force")
