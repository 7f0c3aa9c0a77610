"""Records of runs: the columns that were read, and nothing else, come back; what is missing is fetched or refused."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from jostle_lab.errors import LabError
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.records import Records
from jostle_lab.runs.run import Run
from jostle_lab.tables import Table

RUN = Run("wedge", "event-driven", 1.0, 1.0, (("seed", 3),))


def table() -> Table:
    return {"time": np.array([0.0, 1.0]), "x": np.array([0.1, 1.0 / 3.0]), "y": np.array([2.0, 3.0])}


@pytest.mark.parametrize("single", [True, False])
def test_what_was_read_comes_back(tmp_path: Path, single: bool) -> None:
    records = Records(tmp_path / "a.parquet", single)
    found = records.add("run a", "abc", 2.5, table()).table
    assert found["x"][-1] == 1.0 / 3.0
    records.write()
    again = Records(tmp_path / "a.parquet", single).find("run a", None)
    assert again is not None
    assert set(again.table) == {"x"}
    assert again.seconds == 2.5
    assert abs(again.table["x"][-1] - 1.0 / 3.0) < (1e-7 if single else 1e-16)
    with pytest.raises(LabError, match=r"y is not kept of the run `run a`.*Compute"):
        again.table["y"]


def test_a_column_that_is_asked_for_later_is_fetched_and_kept(tmp_path: Path) -> None:
    file = tmp_path / "a.parquet"
    records = Records(file)
    records.add("run a", "abc", 1.0, table()).table["x"]
    records.write()
    later = Records(file)
    found = later.find("run a", table)
    assert found is not None
    assert found.table["y"].tolist() == [2.0, 3.0]
    with pytest.raises(LabError, match="no column z"):
        Records(file).find("run a", table).table["z"]  # type: ignore[union-attr]
    later.write()
    kept = Records(file).find("run a", None)
    assert kept is not None
    assert set(kept.table) == {"x", "y"}


def test_what_nobody_asks_for_is_forgotten(tmp_path: Path) -> None:
    records = Records(tmp_path / "a.parquet")
    for name in ("one", "two"):
        records.add(name, "abc", 1.0, table()).table["x"]
    records.write(only=["two", "three"])
    again = Records(tmp_path / "a.parquet")
    assert again.find("one", None) is None
    assert again.find("two", None) is not None


def test_a_damaged_record_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.parquet").write_text("nonsense")
    with pytest.raises(LabError, match=r"a\.parquet is no record"):
        Records(tmp_path / "a.parquet")


def test_a_full_disk_leaves_the_record_as_it_was(tmp_path: Path) -> None:
    records = Records(tmp_path / "a.parquet")
    records.add("one", "abc", 1.0, table()).table["x"]
    records.write()
    (tmp_path / "_a.parquet.draft").symlink_to("/dev/full")
    records.add("two", "abc", 1.0, table()).table["x"]
    with pytest.raises(LabError, match=r"No space left.*Make room.*what is there stays"):
        records.write()
    assert [path.name for path in tmp_path.iterdir()] == ["a.parquet"]
    assert Records(tmp_path / "a.parquet").find("one", None) is not None


def test_a_frozen_laboratory_runs_nothing(tmp_path: Path) -> None:
    records = Records(tmp_path / "a.parquet")
    laboratory = Laboratory(Path("no-program"), tmp_path, show_progress=False, records=records, frozen=True)
    with pytest.raises(LabError, match=r"1 runs of figure 9 are not kept in .*a\.parquet"):
        laboratory.run([RUN], "figure 9")
    records.add(RUN.key(), "abc", 4.0, table())
    laboratory = replace(laboratory)
    assert laboratory.run([RUN], "figure 9")[RUN]["time"].tolist() == [0.0, 1.0]
    laboratory.run([RUN], "figure 9")
    assert laboratory.spent == 4.0
    assert laboratory.asked == {RUN.key(): 3}
    with pytest.raises(LabError, match="made"):
        laboratory.computed("made", lambda: (table(), 1.0))


def test_a_run_costs_once_and_a_copy_of_the_laboratory_counts_anew(tmp_path: Path) -> None:
    """Figures that share runs each tell the whole cost; a study that asks twice for a run tells it once."""
    records = Records(tmp_path / "a.parquet")
    records.add(RUN.key(), "abc", 4.0, table())
    laboratory = Laboratory(Path("no-program"), tmp_path, show_progress=False, records=records, frozen=True)
    for counting in (laboratory, replace(laboratory)):
        counting.run([RUN], "first")
        counting.run([RUN], "again")
        assert counting.spent == 4.0
    records.add("made", "abc", 1.0, table())
    for _ in range(2):
        laboratory.computed("made", lambda: (table(), 9.0))
    assert laboratory.spent == 5.0


def test_a_table_that_is_computed_anew_is_kept_whole(tmp_path: Path) -> None:
    """Studies take it as a dictionary, which reads no column of a run's record."""
    file = tmp_path / "a.parquet"
    laboratory = Laboratory(Path(__file__), tmp_path, show_progress=False, records=Records(file))
    assert set(dict(laboratory.computed("made", lambda: (table(), 1.0)).items())) == {"time", "x", "y"}
    assert laboratory.records is not None
    laboratory.records.write()
    kept = Records(file).find("made", None)
    assert kept is not None and set(kept.table) == {"time", "x", "y"}
