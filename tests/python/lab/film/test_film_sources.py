"""Files of a run, scenes that are run now, the page that plays: all show the same run."""

import base64
import json
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import polars as pl
import pytest
from film.made import decoded, turning

import jostle
from jostle_lab.errors import LabError
from jostle_lab.film import command, film
from jostle_lab.film.make import write_script
from jostle_lab.film.sources import dataset_of, read, run_scene

SHORT = {"drive.amplitude": 1e-3, "drive.frequency": 20.0}


def lab(*words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "jostle_lab", "film", *words, "--no-progress"]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("scene", ["packing", "ratchet", "wedge", "three_disk"])
def test_tables_of_jostle_run_are_the_dataset_of_python(scene: str, jostle: Path, tmp_path: Path) -> None:
    """With contacts: their run done again from the file has the same bits."""
    table = tmp_path / "run.csv"
    command = [str(jostle), "run", scene, "--seconds", "0.05", "--sample", "0.001", "--output", str(table)]
    subprocess.run(command, check=True, capture_output=True)
    data = jostle_run(scene)
    data.to_netcdf(tmp_path / "run.nc", engine="scipy")
    facts = pl.read_csv(tmp_path / "run.parameters.csv", infer_schema=False)
    metadata = dict(zip(facts["name"].to_list(), facts["value"].to_list(), strict=True)) | {"units/time": "s"}
    (tmp_path / "columns").mkdir()
    pl.read_csv(table).write_parquet(tmp_path / "columns" / "run.parquet", metadata=metadata)
    contacts = scene in ("packing", "three_disk")
    script = write_script(data, contacts=contacts, slow=20.0)
    for path in (table, tmp_path / "run.nc", tmp_path / "columns" / "run.parquet"):
        other = write_script(path, contacts=contacts, slow=20.0)
        for number in (0, 7, script.pace.frames - 1):
            first, second = script.frame(number), other.frame(number)
            for name in ("centres", "angles", "shades", "shifts", "segments", "widths"):
                assert np.array_equal(getattr(first, name), getattr(second, name)), (path.name, number, name)
        assert (script.layout, script.frame(1).clock) == (other.layout, other.frame(1).clock)


def jostle_run(scene: str) -> object:
    return jostle.Simulation(scene).run(0.05, every=0.001)


def test_a_run_that_is_joined_to_arrays_keeps_numbers_and_words(tmp_path: Path) -> None:
    pl.DataFrame({"time": [0.0, 1.0], "disk.x[1]": [1.0, 2.0], "disk.x[2]": [3.0, 4.0]}).write_csv(tmp_path / "r.csv")
    (tmp_path / "r.parameters.csv").write_text(
        "name,value,unit\nscene,packing,\nseed,7,1\ngravity,9.8,m/s2\ndisk.radius[1],0.1,m\ndisk.radius[2],0.2,m\n"
    )
    found = read(tmp_path / "r.csv")
    assert found["disk.x"].dims == ("time", "disk") and found["disk.x"].values.tolist() == [[1.0, 3.0], [2.0, 4.0]]
    assert found["disk.radius"].values.tolist() == [0.1, 0.2]
    assert found.attrs == {"scene": "packing", "seed": 7, "gravity": 9.8}


def test_a_scene_is_run_for_ten_periods_from_its_start_on() -> None:
    data = run_scene("ratchet", None, None, 0.1, None, None, 10, {"drive.frequency": 20.0})
    assert data["time"].values[0] == 0.1
    assert data["time"].values[-1] == pytest.approx(0.6)
    assert len(data["time"]) == 321
    assert data.sizes["disk"] == 10


def test_the_command_films_a_scene_and_a_file(tmp_path: Path) -> None:
    out = tmp_path / "wedge.mp4"
    words = ["--set", "drive.amplitude=1e-3", "--set", "drive.frequency=20", "--seconds", "0.1", "--height", "160"]
    done = lab("wedge", "--engine", "molecular-dynamics", *words, "--slow", "10", "--out", str(out))
    assert (done.returncode, done.stdout) == (0, f"{out}\n"), done.stderr
    assert len(decoded(out)) == 0.1 * 10 * 30 + 1


def test_the_command_films_a_part_of_a_file_and_says_what_is_missing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "wedge.mp4"
    turning().to_netcdf(tmp_path / "run.nc", engine="scipy")
    command.film(str(tmp_path / "run.nc"), out, slow=2.0, end=0.2, height=160, progress=False)
    assert "warning: No lines of force are drawn" in capsys.readouterr().err
    assert len(decoded(out)) == 0.2 * 2 * 30 + 1


def test_options_of_a_scene_are_not_for_a_file_and_the_other_way_round(tmp_path: Path) -> None:
    with pytest.raises(LabError, match=r"--disks is for a scene, but run\.csv is a file"):
        command.film("run.csv", tmp_path / "film.mp4", disks=10)
    with pytest.raises(LabError, match=r"--end is for a file\. A scene runs for --seconds"):
        command.film("packing", tmp_path / "film.mp4", end=1.0)


def test_the_page_holds_the_run_and_needs_no_network(tmp_path: Path) -> None:
    data = jostle.Simulation("ratchet", disks=20, **SHORT).run(0.1, every=0.002)
    film(data, tmp_path / "run.html", slow=10.0, contacts=False)
    text = (tmp_path / "run.html").read_text()
    program = re.sub(r'<script id="data".*?</script>', "", text, flags=re.DOTALL)
    assert re.findall(r"https?:|//\w|src=|href=|@import|url\(|fetch|import ", program) == []
    found = json.loads(re.search(r'<script id="data" type="application/json">(.*?)</script>', text, re.DOTALL)[1])  # type: ignore[index]
    script = write_script(data, slow=10.0, contacts=False)
    frames = script.pace.frames
    assert (found["frames"], len(found["clocks"])) == (frames, frames)

    def numbers(name: str, kind: str) -> np.ndarray:
        return np.frombuffer(base64.b64decode(found[name]), dtype=kind)

    centres = found["low"] + found["step"] * numbers("centres", "<u2").reshape(frames, 20, 2)
    angles = numbers("angles", "<u2").reshape(frames, 20) * math.tau / 65536
    for number in (0, frames // 2, frames - 1):
        frame = script.frame(number)
        assert centres[number] == pytest.approx(frame.centres, abs=0.02)
        turned = np.abs(np.exp(1j * angles[number]) - np.exp(1j * frame.angles))
        assert turned.max() < 1e-4
    assert numbers("shades", "u1").reshape(frames, 20).tolist() == script.colouring.shades.tolist()
    assert numbers("firsts", "<u4").tolist() == [0] * (frames + 1)


def test_a_table_names_elements_as_the_package_does() -> None:
    """Of the drive `random-supports` `support.angle` is a parameter and `support[1].angle` an output."""
    run = jostle.Simulation("three_disk", drive="random-supports").run(0.02, every=0.01)
    names = ["time", "support[1].angle", "support[2].angle", "support[1].x", "support[2].x"]
    found = dataset_of(pl.DataFrame({name: [0.0, 0.01, 0.02] for name in names}), run.attrs)
    assert set(found.data_vars) == {name for name in run.data_vars if name.endswith((".angle", ".x"))} - {
        "disk.angle",
        "disk.x",
    }
