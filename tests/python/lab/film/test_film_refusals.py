"""What makes no film is refused by its name, with what is allowed and what to do; no file is left."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from film.made import packing, turning

from jostle_lab.errors import LabError
from jostle_lab.film import film
from jostle_lab.film.sources import is_file, read, run_scene


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("film.avi", {}, r"ends with \.avi, allowed are \.mp4, \.gif, \.webp, \.html"),
        ("film", {}, r"has no ending"),
        ("no/film.mp4", {}, r"The folder .*no of .*film\.mp4 is not there\. Make it"),
        ("film.mp4", {"colour": "spn"}, r"colour = 'spn' is not allowed: one of spin, .*Did you mean spin\?"),
        ("film.mp4", {"height": 100}, r"height \[pixels\] = 100 is outside \[160, 2160\]"),
        ("film.mp4", {"height": 481}, r"height = 481 pixels is odd.*Take 482"),
        ("film.mp4", {"fps": 0.0}, r"fps = 0 is outside \[1, 60\]"),
        ("film.gif", {"fps": 30.0}, r"fps = 30 is not possible in a GIF.*Take 33\.33"),
        ("film.mp4", {"slow": 0.0}, r"slow = 0 is outside"),
        ("film.mp4", {"slow": float("nan")}, r"slow = nan is outside"),
        ("film.mp4", {"slow": 1e5}, r"The film would have 1200001 frames, at most 36000.*smaller slow \(now 100000\)"),
        ("film.mp4", {"slow": 0.01}, r"The film would have 1 frame, at least 2.*larger slow"),
        ("film.gif", {"slow": 1000.0}, r"4001 frames of \d+ by 480 pixels; at most 1\d\d\d of them fit into a GIF"),
        ("film.mp4", {"start": 2.0}, r"start \[s\] = 2 is outside \[0, 0\.4\]"),
        ("film.mp4", {"start": 0.3, "end": 0.2}, r"end \[s\] = 0\.2 is outside \[0\.3, 0\.4\]"),
        ("film.mp4", {"start": 0.4}, r"leave nothing to show"),
    ],
)
def test_arguments(name: str, options: dict[str, Any], said: str, tmp_path: Path) -> None:
    with pytest.raises(LabError, match=said):
        film(turning(), tmp_path / name, **({"contacts": False} | options))
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_may_not_be_written_to_is_found_before_anything_is_computed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(path: Path, *_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "touch", refused)
    with pytest.raises(LabError, match=r"film\.mp4: Permission denied\. Name a place that you may write to"):
        film(xr.Dataset(), tmp_path / "film.mp4")
    (tmp_path / "folder.mp4").mkdir()
    with pytest.raises(LabError, match=r"folder\.mp4 is a folder\. Name a file"):
        film(turning(), tmp_path / "folder.mp4")


def without(name: str) -> Callable[[xr.Dataset], xr.Dataset]:
    return lambda data: data.drop_vars(name)


def lost(name: str) -> Callable[[xr.Dataset], xr.Dataset]:
    return lambda data: data.assign_attrs({key: value for key, value in data.attrs.items() if key != name}).pipe(
        lambda d: xr.Dataset(d.data_vars, d.coords, {k: v for k, v in data.attrs.items() if k != name})
    )


def with_nan(data: xr.Dataset) -> xr.Dataset:
    data["disk.y"][3, 2] = np.nan
    return data


def joined_wrongly(data: xr.Dataset) -> xr.Dataset:
    return xr.concat([data, data.isel(time=slice(-1, None))], "time")


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (without("disk.angle"), r"has no disk\.angle: a film needs disk\.x, disk\.y, disk\.angle\. Record them"),
        (without("disk.radius"), r"does not say how large the disks are: disk\.radius has to be"),
        (without("base.position"), r"base\.position was not recorded"),
        (lost("scene"), r"attribute scene is None, which is not allowed: one of packing, ratchet, wedge, three_disk"),
        (lost("box.width"), r"box\.width is not among the parameters of this run \(found: None\)"),
        (lost("wall.motion"), r"wall\.motion = None is not allowed: one of 1 fixed, 2 with_base"),
        (with_nan, r"disk\.y\[3\] = nan at 0\.012 s .* finite number"),
        (joined_wrongly, r"after time = 0\.1 s comes 0\.1 s: times have to increase\. .* leave one out"),
        (lambda data: data.isel(time=slice(0, 1)), r"has 1 samples of 8 disks: at least 2 samples"),
        (lambda data: data.isel(time=slice(0, 0)), r"has 0 samples of 8 disks"),
        (lambda data: data.isel(disk=slice(0, 0)), r"of 0 disks"),
        (lambda data: data.isel(disk=0), r"disk\.x has the dimensions \('time',\)"),
    ],
)
def test_data(spoil: Callable[[xr.Dataset], xr.Dataset], said: str, tmp_path: Path) -> None:
    with pytest.raises(LabError, match=said):
        film(spoil(packing()), tmp_path / "film.mp4", contacts=False, slow=1.0)
    assert list(tmp_path.iterdir()) == []


def test_data_of_another_kind_and_forces_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(LabError, match=r"data is a list, not an xarray\.Dataset or the name of a file"):
        film([1, 2], tmp_path / "film.mp4")  # type: ignore[arg-type]


def test_files(tmp_path: Path) -> None:
    assert is_file("run.txt") and is_file("build/run.nc") and not is_file("packing")
    with pytest.raises(LabError, match=r"run\.csv is not there"):
        read(tmp_path / "run.csv")
    with pytest.raises(LabError, match=r"ends with \.txt, allowed are \.nc, \.csv, \.parquet"):
        read(tmp_path / "run.txt")
    (tmp_path / "run.nc").write_text("no NetCDF")
    with pytest.raises(LabError, match=r"run\.nc is not a NetCDF file as it should be"):
        read(tmp_path / "run.nc")
    (tmp_path / "run.csv").write_text("time,disk.x[1]\n0,1\n")
    with pytest.raises(LabError, match=r"does not say which scene it is, and .*run\.parameters\.csv is not there"):
        read(tmp_path / "run.csv")
    (tmp_path / "run.parquet").write_text("no Parquet")
    with pytest.raises(LabError, match=r"run\.parquet is not a table as it should be"):
        read(tmp_path / "run.parquet")


@pytest.mark.parametrize(
    ("scene", "drive", "values", "said"),
    [
        ("pakcing", None, {}, "scene = 'pakcing'|pakcing"),
        ("packing", "input", {}, "--drive input: packing follows inputs"),
        ("packing", None, {"drive.amplitude": -1.0}, r"drive\.amplitude = -1"),
        ("packing", None, {"drive.amplitud": 1.0}, r"drive\.amplitud.*Did you mean"),
    ],
)
def test_scenes(scene: str, drive: str | None, values: dict[str, float], said: str) -> None:
    with pytest.raises(LabError, match=said):
        run_scene(scene, 0.1, 0.01, 0.0, None, drive, 8, values)
