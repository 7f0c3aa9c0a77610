"""A webcam's pictures of disks whose places and angles are known: marks, angles, identities."""

import math
from time import process_time

import numpy as np
import pytest

from jostle_lab.errors import LabError
from jostle_lab.sensors.markings import Threshold, find_marks
from jostle_lab.sensors.pictures import look
from jostle_lab.sensors.tracking import follow
from jostle_lab.sensors.webcam import BLACK, DISK, BackLight, Webcam
from jostle_lab.statistics.rotation import RPM, rotation

RADII = np.resize([0.015, 0.02, 0.025], 60)


def places():
    """60 disks that do not touch, on a grid of 8 columns."""
    numbers = np.arange(60)
    return np.column_stack((-0.178 + 0.0505 * (numbers % 8), 0.03 + 0.052 * (numbers // 8)))


def angles():
    return np.random.default_rng(1).uniform(-10.0, 10.0, 60)


def scene(**changes):
    return BackLight(Webcam(**changes), 0.4, RADII)


def test_a_snapshot_has_the_light_of_each_part():
    still = scene(noise=0.0, vignetting=0.0)
    picture = still.take(places(), np.zeros(60), np.random.default_rng(1))
    assert picture.dtype == np.uint8
    assert picture.shape == (still.rows, still.columns)
    column, row = np.rint(still.to_pixels(places())[5]).astype(int)
    assert picture[row, column] == round(255 * BLACK)
    beside = round(0.012 * 1920)
    assert picture[row + beside, column] == round(255 * DISK)  # across the mark, on the disk
    assert picture[-1, 400] == round(255 * BLACK)  # the bottom


def test_edges_are_shared_between_pixels():
    still = scene(noise=0.0, vignetting=0.0)
    dark = [
        np.sum(
            DISK * 255.0
            - still.take(places() + np.array([shift, 0.0]), angles(), np.random.default_rng(1))[300:700, 100:700]
        )
        for shift in (0.0, 0.25 / 1920, 0.5 / 1920)
    ]
    np.testing.assert_allclose(dark, dark[0], rtol=2e-3)


@pytest.mark.parametrize("threshold", list(Threshold))
@pytest.mark.parametrize("resolution", [960.0, 1920.0])
def test_all_marks_are_found_where_they_are(threshold, resolution):
    still = scene(resolution=resolution)
    marks = find_marks(still.take(places(), angles(), np.random.default_rng(1)), still.webcam.mark_area(), threshold)
    assert len(marks.angles) == 60
    found = still.to_metres(marks.centres)
    distance = np.linalg.norm(found[:, None] - places()[None], axis=2)
    nearest = distance.argmin(axis=1)
    assert sorted(nearest) == list(range(60))
    assert distance.min(axis=1).max() < 1.0 / resolution  # a row and a column of pixels more or less
    wrong = np.mod(marks.angles - angles()[nearest] + math.pi / 2, math.pi) - math.pi / 2
    assert np.degrees(np.sqrt(np.mean(wrong**2))) < (0.8 if resolution < 1000 else 0.3)
    assert np.all((marks.angles >= 0.0) & (marks.angles < math.pi))


def test_errors_of_the_angle_fall_with_the_resolution():
    still = np.zeros((4, 60))
    turned = angles() + 0.03 * np.arange(4)[:, None] + still
    where = np.broadcast_to(places(), (4, 60, 2))
    rms = [
        look(scene(resolution=r), where, turned, np.random.default_rng(1)).rms_angle_error() for r in (600, 1200, 2400)
    ]
    assert rms[0] > 2.0 * rms[1] > 4.0 * rms[2]


def test_paths_by_pictures_are_the_true_ones_below_15_rpm():
    velocity = np.linspace(-14.0, 14.0, 60) * RPM
    turned = angles() + velocity * np.arange(12.0)[:, None]
    seen = look(scene(), np.broadcast_to(places(), (12, 60, 2)), turned, np.random.default_rng(1))
    assert seen.lost == seen.extra == 0
    assert seen.swapped_share() == 0.0
    found = rotation(seen.angles, 1.0).mean_velocity
    np.testing.assert_allclose(found, velocity[seen.disks], atol=0.03 * RPM * 60 / 11)


def test_above_15_rpm_pictures_show_another_velocity():
    velocity = np.full(60, 18.0) * RPM
    turned = angles() + velocity * np.arange(12.0)[:, None]
    seen = look(scene(), np.broadcast_to(places(), (12, 60, 2)), turned, np.random.default_rng(1))
    np.testing.assert_allclose(rotation(seen.angles, 1.0).mean_velocity / RPM, -12.0, atol=0.3)


def test_a_jump_to_the_place_of_another_disk_swaps_identities():
    where = np.repeat(places()[None], 3, axis=0)
    where[1:, [10, 13]] = where[1:, [13, 10]]  # same radius
    seen = look(scene(), where, np.repeat(angles()[None], 3, axis=0), np.random.default_rng(1))
    assert seen.swapped_share() == pytest.approx(2.0 / 60.0)
    assert not seen.swapped[0].any()


def test_a_mark_that_is_not_found_is_taken_for_its_neighbour_for_good():
    still = scene()
    pictures = [still.take(places(), angles(), np.random.default_rng(1)) for _ in range(3)]
    column, row = np.rint(still.to_pixels(places())[20]).astype(int)
    pictures[1][row - 25 : row + 25, column - 25 : column + 25] = 200
    tracks = follow([find_marks(picture, still.webcam.mark_area()) for picture in pictures])
    moved = np.linalg.norm(tracks.centres[2] - tracks.centres[0], axis=1)
    assert np.count_nonzero(moved > 20.0) == 1


def test_a_picture_of_one_shade_and_cameras_that_show_nothing_are_refused():
    with pytest.raises(LabError, match="one shade of grey"):
        find_marks(np.full((50, 50), 7, dtype=np.uint8), 100.0)
    with pytest.raises(LabError, match=r"resolution \[pixels/m\] = 10"):
        Webcam(resolution=10.0)
    with pytest.raises(LabError, match="no rectangle with a long side"):
        Webcam(mark_length=0.005, mark_width=0.005)
    with pytest.raises(LabError, match=r"does not fit on a disk of radius 0\.015"):
        scene(mark_length=0.031)


def test_without_scikit_image_the_remedy_is_named(monkeypatch):
    def without(name, *rest):
        raise ImportError(name)

    monkeypatch.setattr("jostle_lab.sensors.markings.import_module", without)
    with pytest.raises(LabError, match=r"pip install 'jostle-lab\[pictures\]'"):
        find_marks(np.eye(5, dtype=np.uint8), 1.0)


def test_a_picture_takes_well_below_a_tenth_of_a_second():
    still, generator = scene(), np.random.default_rng(1)
    spent = []
    for _ in range(4):
        begun = process_time()
        find_marks(still.take(places(), angles(), generator), still.webcam.mark_area())
        spent.append(process_time() - begun)
    assert min(spent) < 0.1
