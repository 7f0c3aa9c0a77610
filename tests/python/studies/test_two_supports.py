"""Three disks in the laboratory: geometry of the region, statistics of the supports, one figure and the controller."""

import math
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import PROGRAM

from jostle_lab.demos.torque.controller import Controller, Plant, reference_at
from jostle_lab.demos.torque.demo import demonstrate
from jostle_lab.demos.torque.record import qualities, run
from jostle_lab.errors import LabError
from jostle_lab.fmu.disk_on_two_supports import DiskFmu
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Verdict, write
from studies.thesis.two_supports import path as three_disk_path
from studies.thesis.two_supports import runs as three_disk
from studies.thesis.two_supports.noise import correlation, hotelling
from studies.thesis.two_supports.random_runs import AS_DRAWN, MIRRORED, Effort, Place, measure
from studies.thesis.two_supports.region_statements import constant_normal_forces
from studies.thesis.two_supports.spring_region import Region, distance_to_path, region

SQUARE = Region({"S1": np.zeros(2), "T2": np.array([1.0, 0.0]), "S2": np.ones(2), "T1": np.array([0.0, 1.0])})


@pytest.fixture(scope="module")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[int, Path]:
    folder = tmp_path_factory.mktemp("three_disk")
    paths = {version: folder / f"three_disk_{version}.fmu" for version in (2, 3)}
    for version, path in paths.items():
        subprocess.run([PROGRAM, "fmu", "three_disk", "--fmi", str(version), "--out", path], check=True)
    return paths


def test_distances_of_a_square() -> None:
    points = np.array([[0.5, 0.5], [0.5, -0.25], [2.0, 1.0], [4.0, 5.0], [1.0, 1.0]])
    assert SQUARE.outside(points) == pytest.approx([0.0, 0.25, 1.0, 5.0, 0.0])
    assert distance_to_path(points, SQUARE.outline) == pytest.approx([0.5, 0.25, 1.0, 5.0, 0.0])


def test_region_of_the_theory(laboratory: Laboratory) -> None:
    """S1 and S2 from Amonton's condition by hand: tau_i = +-mu n_i and the balance of forces without tilt."""
    found = region(laboratory, 0.0)
    normal = 1.0 / (2.0 * math.cos(math.pi / 6.0) * (1.0 + 0.1 * 0.1))
    # Upright both forces have the size n (1 -+ mu tan theta_0 ...): the sum of 4.40 is what the torque sees.
    assert found.corners["S2"][0] == pytest.approx(0.1 * normal / 1e6, rel=1e-12)
    assert found.corners["S1"] == pytest.approx(found.corners["S2"] * (-1.0, 1.0), rel=1e-12)
    assert np.all(found.outside(found.outline) < 1e-20)
    with pytest.raises(LabError, match="rolls off"):
        region(laboratory, 0.6)


def test_constant_normal_forces_make_a_parallelogram() -> None:
    corners = constant_normal_forces(0.2)
    assert corners + np.roll(corners, 2, axis=0) == pytest.approx(np.zeros((4, 2)), abs=1e-20)


def test_hotelling_takes_the_right_mean_and_no_other() -> None:
    rows = np.random.default_rng(7).normal(size=(300, 4)) @ np.triu(np.ones((4, 4)))
    assert hotelling(rows, np.zeros(4)) > 1e-3
    assert hotelling(rows, np.array([0.0, 0.0, 0.0, 0.6])) < 1e-6


def test_correlation_solves_the_equation_of_the_oscillator() -> None:
    """It decays as the free oscillator does: q'' + 2 c omega q' + omega^2 q = 0, q(0) = 1, q'(0) = 0."""
    step, omega = 1e-4, 20.0 * math.pi
    for c in (0.2, 0.5):
        q = [correlation(n * step, c) for n in range(2000)]
        first, second = np.gradient(q, step), np.gradient(np.gradient(q, step), step)
        rest = second + 2.0 * c * omega * first + omega**2 * np.array(q)
        assert np.max(np.abs(rest[3:-3])) < 2e-4 * omega**2
        assert abs(first[1]) < 1e-2 * omega


def test_mirrored_pairs_cancel_without_tilt(laboratory: Laboratory) -> None:
    """Why they say nothing there: the sum of a run and of its mirror is zero to rounding."""
    place, effort = Place(0.0, 5e-5), Effort(0.3, 2)
    runs = [place.run(1, noise, effort) for noise in (AS_DRAWN, MIRRORED)]
    tables = laboratory.run(runs, "pairs")
    drawn, mirrored = (float(tables[run]["time_averaged_angular_velocity"][-1]) for run in runs)
    assert abs(drawn) > 1e-6
    assert drawn + mirrored == pytest.approx(0.0, abs=1e-15)
    assert measure(laboratory, "as drawn", [place], effort)[place].velocity.error > 1e-7


def test_figure_of_the_path_from_end_to_end(
    laboratory: Laboratory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(three_disk_path, "QUICK_SAMPLES", 300)
    product = three_disk_path.make(laboratory, True)
    data, picture, *_ = write(product, tmp_path / "figure-5.6", "command", "footer")
    assert len(data.read_text().splitlines()) == 1 + 2 * (300 * three_disk.PERIODS + 1)
    assert picture.stat().st_size > 10_000
    *agreed, edge = product.statements
    assert all(s.verdict is Verdict.AGREES for s in agreed), agreed
    assert (edge.verdict, edge.found.split(" slips")[0]) == (Verdict.DISAGREES, "contact 2")


def test_controller_does_not_wind_up_and_starts_where_friction_gives_way() -> None:
    controller = Controller(Plant(0.05, 0.2, 0.1), bound=1.0)
    for n in range(100):
        torque = controller.act(0.01 * n, 10.0, 0.0)
    assert torque == 1.0
    assert controller.stored < 1.0
    controller.start_from_stick(-0.1)
    assert controller.stored == -0.2
    controller.start_from_stick(0.1)
    assert controller.stored == 0.1
    controller.start_from_stick(0.0)
    assert controller.stored == 0.1
    assert [reference_at(t) for t in (0.0, 1.999, 2.0, 9.0)] == [0.5, 0.5, 0.02, 0.0]


def test_controller_holds_the_disk_in_every_coupling(fmus: dict[int, Path], tmp_path: Path) -> None:
    table, picture, page = demonstrate(fmus[2], fmus[3], tmp_path, 5e-3, {"tilt": 0.2})
    assert picture.stat().st_size > 10_000
    assert page.read_text().count("never") == 0
    couplings = {line.rsplit(",", 5)[0] for line in table.read_text().splitlines()[1:]}
    assert len(couplings) == 4


def test_events_stop_the_disk_where_a_contact_changes(fmus: dict[int, Path]) -> None:
    with DiskFmu(fmus[3], events=True) as fmu:
        observed = run(fmu, "events", 5e-3, 1e-3, unstick=True)
        assert observed.events > 10
        assert len(observed.time) == observed.events + 10_000
    with DiskFmu(fmus[2]) as fmu:
        plain = run(fmu, "plain", 5e-3, 1e-3)
        assert plain.events == 0
    # Stuck on the way from 0.02 to -0.02 rad/s the plain controller waits for its integral.
    assert qualities(observed)[2].settling < 0.5 * qualities(plain)[2].settling
    for quality in (*qualities(observed), *qualities(plain)):
        assert abs(quality.error) < 1e-6
    with pytest.raises(LabError, match="event mode"):
        DiskFmu(fmus[2], events=True)
    with pytest.raises(LabError, match="has no variable frction"):
        DiskFmu(fmus[2], {"frction": 1.0})
