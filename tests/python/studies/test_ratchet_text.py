"""F's text: jumps, ranges and order on made-up places, and that masses do not matter."""

import numpy as np
import pytest

from jostle_lab.runs.laboratory import Laboratory
from studies.ratchet.text import FORWARD, HEAVIER
from studies.ratchet.text_found import hexagonal, jumps, moved

DIAMETER = 2.15e-3


def lattice(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """A hexagonal one, periodic to the right."""
    row, column = np.mgrid[:rows, :columns]
    x = DIAMETER * (column + 0.5 * (row % 2))
    return x.ravel(), (0.5 * 3.0**0.5 * DIAMETER * row).ravel()


def test_a_lattice_is_a_crystal_and_disorder_is_none() -> None:
    x, y = lattice(6, 20)
    order, share = hexagonal(x, y, 20 * DIAMETER, DIAMETER)
    assert order == pytest.approx(1.0, abs=0.35)
    assert share == pytest.approx(4 / 6)
    generator = np.random.default_rng(1)
    loose = generator.uniform(0.0, 20 * DIAMETER, 120), generator.uniform(0.0, 6 * DIAMETER, 120)
    assert hexagonal(*loose, 20 * DIAMETER, DIAMETER)[1] < 0.05


def test_jumps_are_counted_by_side() -> None:
    places = np.array([[0.5, 0.5], [1.5, 0.4], [1.6, -0.5], [2.5, 0.5]])
    assert jumps(places, 1.0).tolist() == [3 / 6, 1 / 6]
    assert moved(np.array([[0.0, 1.0], [0.5, 1.0], [0.2, 1.1]])) == pytest.approx([0.5, 0.1])


def test_a_thousand_times_the_mass_changes_no_digit(laboratory: Laboratory) -> None:
    light = FORWARD.run(5)
    heavy = FORWARD.with_changes(disk__mass=1e-5 * HEAVIER).run(5)
    tables = laboratory.run([light, heavy], "test")
    assert tables[light]["transport_velocity"][-1] == tables[heavy]["transport_velocity"][-1]
    assert tables[heavy]["energy.kinetic"][-1] == HEAVIER * tables[light]["energy.kinetic"][-1]
