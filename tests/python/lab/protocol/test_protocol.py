"""The protocol, the runner and everything it writes, with grains that need no FMU."""

import json
from functools import partial

import numpy as np
import pytest
from fake_grains import make_turning_lump

from jostle_lab.coupling.compare import compare_exchanges
from jostle_lab.coupling.exchange import Exchange
from jostle_lab.demos.packing.figures import draw, draw_all
from jostle_lab.demos.packing.numbers import write_report
from jostle_lab.errors import LabError
from jostle_lab.files import replace_text
from jostle_lab.protocol import intervals as protocol
from jostle_lab.protocol.experiment import Setup
from jostle_lab.protocol.packings import Plan, Watcher, run
from jostle_lab.protocol.pictures import Processing, process
from jostle_lab.protocol.results import Results
from jostle_lab.tables import read_table


def plan(folder, **changes):
    setup = Setup(protocol.scaled_down((1.0, 0.4), 8), steps_per_second=800)
    return Plan(folder, **{"seeds": (1, 2), "setup": setup, "show_progress": False} | changes)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    folder = tmp_path_factory.mktemp("results")
    run(plan(folder), make_turning_lump)
    return folder


def test_protocol_of_the_thesis():
    schedule = protocol.thesis()
    amplitudes = [interval.amplitude for interval in schedule.intervals]
    assert len(amplitudes) == 32
    assert amplitudes[:2] == [1.0, 0.95]
    assert amplitudes[15:18] == [0.25, 0.2, 0.19]
    assert amplitudes[-1] == 0.05
    assert schedule.duration() == 300 + 32 * 1200


def test_protocol_refuses_what_cannot_be():
    with pytest.raises(LabError, match=r"amplitude = 1.5 is outside \[0.001, 1\]"):
        protocol.scaled_down((1.5,), 20)
    with pytest.raises(LabError, match="No amplitudes"):
        protocol.scaled_down((), 20)
    with pytest.raises(LabError, match=r"amplitude 0\.5 is given twice"):
        protocol.scaled_down((1.0, 0.5, 0.5), 20)


def test_setup_refuses_rates_that_do_not_fit():
    with pytest.raises(LabError, match=r"1000 is not a multiple of the drive frequency, 80 Hz\. .*4800"):
        Setup(protocol.thesis(), steps_per_second=1000)


def test_tables_hold_what_was_done(finished):
    results = Results(finished)
    assert results.seeds == [1, 2]
    assert len(results.amplitudes) == 4
    strong, weak = results.amplitudes_of(1)
    assert strong["gamma_true"] == pytest.approx(5.0, rel=0.25)  # the lump loads the base
    assert weak["gamma_true"] == pytest.approx(0.4 * strong["gamma_true"], rel=1e-3)
    assert strong["gamma_measured"] == pytest.approx(strong["gamma_true"], rel=2e-3)
    assert abs(strong["coupling_error"]) < 0.6
    time, angles = results.angles(1, 1.0)
    assert time.tolist() == [0, 1, 2, 3, 4, 5, 6]
    velocities = [disk["mean_velocity"] for disk in results.disks_of(1, 1.0)]
    np.testing.assert_allclose((angles[-1] - angles[0]) / 6.0, velocities, rtol=1e-4, atol=1e-6)
    assert results.readings(2, 0.4).shape == (6 * 200, 2)


def test_turning_rates_are_recovered(finished):
    disks = Results(finished).disks_of(1, 1.0)
    rates = np.random.default_rng(1).normal(size=60)
    velocities = np.array([disk["mean_velocity"] for disk in disks])
    assert np.corrcoef(rates, velocities)[0, 1] > 1.0 - 1e-9


def test_pictures_and_page_are_written(finished):
    results = Results(finished)
    assert [path.name for path in draw_all(results)] == [
        "angular_paths.png",
        "packing.png",
        "accelerometer_spectrum.png",
        "rotation_against_gamma.png",
    ]
    page = write_report(results).read_text()
    assert page.count("\n| 1.00 |") == 2
    assert "| loudspeaker |" in page
    assert "nan" not in page


def test_pictures_of_the_packing_give_what_the_camera_gives(tmp_path):
    setup = Setup(protocol.scaled_down((1.0, 0.4), 8), steps_per_second=800, keep_positions=True)
    run(plan(tmp_path, seeds=(1,), setup=setup, processes=1), make_turning_lump)
    results = Results(tmp_path)
    assert results.positions(1, 1.0).shape == (7, 60, 2)
    assert results.radii(1).tolist() == np.resize([0.015, 0.02, 0.025], 60).tolist()
    process(results, Processing())
    strong, weak = read_table(results.folder_of(1) / "pictures.csv").to_dicts()
    for row, amplitudes in zip((strong, weak), results.amplitudes_of(1), strict=True):
        assert row["lost"] == row["swapped"] == 0
        assert row["mean_square_rpm_pictures"] == pytest.approx(amplitudes["mean_square_rpm_camera"], rel=0.1, abs=0.01)
        assert 0.0 < row["angle_error_degrees"] < 0.5
    assert "## By pictures" in write_report(results).read_text()


def test_both_sensors_are_in_the_table(finished):
    row = Results(finished).amplitudes_of(1)[0]
    assert row["gamma_measured"] == pytest.approx(0.5 * (row["gamma_sensor_1"] + row["gamma_sensor_2"]))
    assert row["mean_reading_1"] == pytest.approx(-1.0, abs=0.05)
    assert Results(finished).summaries[0]["processor_seconds"] > 0.0


class DrawsOnce(Watcher):
    def __init__(self, folder):
        self.folder, self.pictures, self.intervals, self.seen = folder, [], [], []

    def interval_done(self):
        self.intervals.append(len(list(self.folder.glob("packings/*/packing.json"))))
        if not self.pictures:
            self.pictures.append(draw("packing.png", Results(self.folder, unfinished=True)))

    def now(self, now):
        self.seen.append(now)


def test_a_picture_can_be_drawn_after_the_first_interval(tmp_path):
    watcher = DrawsOnce(tmp_path)
    run(plan(tmp_path, processes=1), make_turning_lump, watcher)
    assert len(watcher.intervals) == 2 * 2
    assert watcher.intervals[0] == 0  # no packing was finished when the picture was drawn
    assert watcher.pictures[0].stat().st_size > 10_000
    for left in ("unfinished.json", "checkpoint.npz", "*.draft"):
        assert list(tmp_path.rglob(left)) == []


def test_finished_packings_are_not_run_again(finished):
    file = finished / "packings" / "seed-0001" / "packing.json"
    before = file.stat().st_mtime_ns
    run(plan(finished), None)  # no factory: any packing to run would fail
    assert file.stat().st_mtime_ns == before


def test_folder_of_other_settings_is_refused(finished):
    with pytest.raises(LabError, match=r"holds results of other settings.*remove this one"):
        run(plan(finished, labels=(("contact.friction", "0.2"),)), make_turning_lump)


def test_a_damaged_description_is_named_with_the_remedy(tmp_path):
    (tmp_path / "run.json").write_text('{"setup": ')
    with pytest.raises(LabError, match=r"run.json is damaged: .* Remove .* to start afresh"):
        run(plan(tmp_path), make_turning_lump)
    (tmp_path / "packings/seed-0001").mkdir(parents=True)
    (tmp_path / "packings/seed-0001/packing.json").write_text("{}")
    with pytest.raises(LabError, match=r"run.json is damaged: .* Remove it and run `jostle-lab demo"):
        Results(tmp_path)


def test_a_file_is_replaced_whole_or_not_at_all(tmp_path):
    path = tmp_path / "run.json"
    replace_text(path, "first")
    (tmp_path / "_run.json.draft").symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space left"):
        replace_text(path, "second")
    assert path.read_text() == "first"
    assert [file.name for file in tmp_path.iterdir()] == ["run.json"]


def test_same_seed_gives_the_same_files(finished, tmp_path):
    run(plan(tmp_path, seeds=(2,), processes=1), make_turning_lump)
    for name in ("amplitudes.csv", "disks.csv", "angles.csv", "accelerometers.csv"):
        assert (tmp_path / "packings/seed-0002" / name).read_bytes() == (
            finished / "packings/seed-0002" / name
        ).read_bytes()


def fail_to_make(message, seed, _extra):
    raise LabError(f"{message} {seed}")


def test_error_in_a_worker_reaches_the_user(tmp_path):
    with pytest.raises(LabError, match="no grains 1"):
        run(plan(tmp_path, seeds=(1,)), partial(fail_to_make, "no grains"))
    assert json.loads((tmp_path / "run.json").read_text())["setup"]["steps_per_second"] == 800


def test_empty_folder_is_reported(tmp_path):
    with pytest.raises(LabError, match="no finished packing"):
        Results(tmp_path)


def test_comparison_of_exchanges_is_a_table(monkeypatch):
    monkeypatch.setattr("jostle_lab.coupling.compare.STEP_RATES", (800,))
    table = compare_exchanges(make_turning_lump, 1, 0.5)
    assert [line.split("|")[2].strip() for line in table.splitlines()[2:]] == [exchange.value for exchange in Exchange]
