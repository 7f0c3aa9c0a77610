"""Walls, teeth and supports are drawn where the disks of the engines meet them."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from film.made import RATCHET, run_of
from numpy.typing import NDArray

import jostle
from jostle_lab.film.make import write_script
from jostle_lab.film.recording import Recording, record
from jostle_lab.film.scenery import Solid, scenery, tooth
from jostle_lab.film.stage import Stage, with_copies
from studies.ratchet import fields


def gaps(recording: Recording, solid: Solid) -> NDArray[np.float64]:
    """Least distance of the outline from each disk's surface over the disks, at each sample [m]."""
    cell = (
        recording.parameter("tooth.width") * recording.parameter("tooth.count") if recording.scene == "ratchet" else 0
    )
    found = []
    for at in range(len(recording.time)):
        shift = np.zeros(2) if solid.shift is None else solid.shift[at]
        begin = solid.outline + shift
        along = np.roll(begin, -1, axis=0) - begin
        points = np.column_stack((recording.x[at], recording.y[at]))
        if cell:
            points[:, 0] %= cell
        off = points[:, None, :] - begin
        share = np.clip((off * along).sum(axis=2) / (along**2).sum(axis=1), 0.0, 1.0)
        distance = np.linalg.norm(off - share[:, :, None] * along, axis=2).min(axis=1)
        found.append(float((distance - recording.radius).min()))
    return np.array(found)


@pytest.mark.parametrize(
    ("scene", "engine", "seconds", "values"),
    [
        ("packing", "molecular-dynamics", 0.2, {"drive.amplitude": 5e-4, "contact.normal_stiffness": 1e5}),
        ("wedge", "event-driven", 0.5, {"drive.amplitude": 3e-3, "drive.frequency": 15.0}),
        ("wedge", "molecular-dynamics", 0.5, {"wedge.tilt": -0.3, "drive.amplitude": 3e-3, "drive.frequency": 15.0}),
        ("ratchet", "event-driven", 0.5, {"tooth.asymmetry": 0.1, "tooth.tip_radius": 3e-4}),
        ("three_disk", "molecular-dynamics", 0.2, {"tilt": 0.2, "drive.amplitude": 0.05, "drive.frequency": 2.0}),
        (
            "three_disk",
            "molecular-dynamics",
            0.2,
            {"tilt": -0.1, "support.shape": "walls", "drive.amplitude": 0.05, "drive.frequency": 1.0},
        ),
    ],
)
def test_disks_touch_what_is_drawn_and_are_never_inside(
    scene: str, engine: str, seconds: float, values: dict[str, float]
) -> None:
    run = record(jostle.Simulation(scene, engine=engine, **values).run(seconds, every=seconds / 400))
    radius = float(run.radius.mean())
    solids = scenery(run, slice(0, None)).solids
    least = np.array([gaps(run, solid) for solid in solids if not beyond(run, solid)])
    assert least.min() > -0.01 * radius
    assert np.all(least.min(axis=1) < 0.02 * radius)


def beyond(run: Recording, solid: Solid) -> bool:
    """Whether it is the ceiling of the ratchet, which no disk reaches."""
    return run.scene == "ratchet" and solid.shift is None


@pytest.mark.parametrize("asymmetry", [0.0, 0.1, 0.25, 0.5])
def test_a_tooth_is_that_of_the_pictures_of_the_fields(asymmetry: float) -> None:
    """Computed there as a height over x, here as an outline."""
    outline = 1e3 * tooth(1e-3 * fields.TOOTH, 5e-3, asymmetry, 1e-3 * fields.TIP)
    case: Any = SimpleNamespace(asymmetry=asymmetry, height=5.0)
    x = np.linspace(0.01, 5.99, 300)
    drawn = np.interp(x, [*outline[:, 0], fields.TOOTH], [*outline[:, 1], 0.0])
    away = x > 0.1 if asymmetry == 0.0 else x > 0.0  # at 0 the side is vertical
    assert fields.surface(case, x)[away] == pytest.approx(drawn[away], abs=1e-2)


def test_a_disk_on_the_edge_of_the_cell_is_drawn_on_both_sides() -> None:
    here = np.ones((3, 1))
    time, radius = [0.0, 0.1, 0.2], [0.001, 0.001]
    x = np.array([0.0, 0.0125]) + 3 * 0.024  # far to the right in a cell of 24 mm
    data = run_of(RATCHET, time, x * here, 0.01 * here * [1, 1], 0 * x * here, radius)
    script = write_script(data, contacts=False, slow=10.0, colour="none")
    panel = script.layout.panel
    assert panel.width == pytest.approx(0.024 * script.layout.scale)
    centres, which = with_copies(script.frame(0).centres, script.radii, script.cell, panel.left)
    assert which.tolist() == [0, 1, 0] or which.tolist() == [0, 1, 0, 0]
    picture = np.array(Stage(script).draw(script.frame(0)))[:, :, :3].astype(int)
    row = round(script.layout.height - centres[0, 1])
    left, right = round(panel.left), round(panel.left + panel.width)
    inside = round(0.5 * float(script.radii[0]))
    disk = np.array([0xE3, 0xD9, 0xC6])
    assert np.abs(picture[row, right - inside] - disk).max() < 6  # lit half is at the left
    assert np.abs(picture[row, left + inside] - disk).max() > 20  # the darker one at the right
    assert np.abs(picture[row, left + 3 * inside] - [0x26, 0x28, 0x2D]).max() < 6


def test_walls_of_a_box_move_with_its_floor_if_told() -> None:
    sim = jostle.Simulation(
        "packing", disks=5, **{"wall.motion": "with_base", "box.width": 0.2, "drive.amplitude": 1e-3}
    )
    run = record(sim.run(0.02, every=0.002))
    shifts = [solid.shift for solid in scenery(run, slice(0, None)).solids]
    assert all(shift is not None and np.array_equal(shift[:, 1], run.base) for shift in shifts)
