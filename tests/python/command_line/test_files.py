"""What `jostle run` writes, read by the programs of others: xarray, polars, ASE."""

import subprocess
import sys
from pathlib import Path

import ase.io
import numpy as np
import pandas as pd
import polars as pl
import pytest
import xarray as xr

import jostle as package


def run(program: Path, scene: list[str], *words: str | Path) -> None:
    subprocess.run([program, "run", *scene, *words, "--no-progress"], check=True, capture_output=True)


def bits(array: xr.DataArray) -> bytes:
    return array.values.astype("<f8").tobytes()


SCENES = {
    "packing": (["packing", "--disks", "5", "--set", "seed=5"], {"disks": 5, "seed": 5}),
    "ratchet": (["ratchet", "--disks", "4"], {"disks": 4}),
    "three_disk": (["three_disk", "--drive", "sine"], {"drive": "sine"}),
    "wedge": (["wedge", "--engine", "map"], {"engine": "map"}),
}


@pytest.mark.parametrize("scene", SCENES)
def test_netcdf_is_the_dataset_of_the_package(jostle: Path, tmp_path: Path, scene: str) -> None:
    words, arguments = SCENES[scene]
    run(jostle, words, "--seconds", "0.3", "--sample", "0.1", "--output", tmp_path / "run.nc")
    with xr.open_dataset(tmp_path / "run.nc", engine="scipy") as found:
        expected = package.Simulation(scene, **arguments).run(0.3, every=0.1)  # type: ignore[arg-type]
        xr.testing.assert_equal(found, expected)
        assert set(found.coords) == set(expected.coords)
        for name, array in expected.variables.items():
            assert bits(found[name]) == bits(expected[name]), name
            assert found[name].dims == array.dims
            assert found[name].attrs == array.attrs
        assert {name: found.attrs[name] for name in expected.attrs} == expected.attrs


def test_an_array_whose_name_a_parameter_has_keeps_its_elements(jostle: Path, tmp_path: Path) -> None:
    """`support.angle` is a parameter, `support[1].angle` an output: NetCDF and Python name them alike."""
    words = ["three_disk", "--drive", "random-supports", "--seconds", "0.3", "--sample", "0.1"]
    run(jostle, words, "--output", tmp_path / "run.nc")
    with xr.open_dataset(tmp_path / "run.nc", engine="scipy") as found:
        expected = package.Simulation("three_disk", drive="random-supports").run(0.3, every=0.1)
        xr.testing.assert_equal(found, expected)
        assert found.attrs["support.angle"] == expected.attrs["support.angle"]


def test_a_seed_of_64_bits_is_kept_as_text(jostle: Path, tmp_path: Path) -> None:
    seed = "9223372036854775807"
    words = ["packing", "--disks", "3", "--set", f"seed={seed}", "--seconds", "0.01"]
    run(jostle, words, "--output", tmp_path / "run.nc")
    with xr.open_dataset(tmp_path / "run.nc", engine="scipy") as found:
        assert found.attrs["seed"] == seed


def test_parquet_is_read_by_pandas_and_polars_as_csv_is(jostle: Path, tmp_path: Path) -> None:
    words = ["three_disk", "--seconds", "0.3", "--sample", "0.001"]
    for name in ("run.csv", "run.parquet"):
        run(jostle, words, "--output", tmp_path / name)
    found, expected = (
        pl.read_parquet(tmp_path / "run.parquet"),
        pl.read_csv(tmp_path / "run.csv", infer_schema_length=None),
    )
    assert found.columns == expected.columns
    assert found["slips"].dtype == pl.Int64
    assert found.cast(pl.Float64).equals(expected.cast(pl.Float64))
    table = pd.read_parquet(tmp_path / "run.parquet")
    np.testing.assert_array_equal(table.to_numpy(float), found.cast(pl.Float64).to_numpy())
    told = pl.read_parquet_metadata(tmp_path / "run.parquet")
    assert (told["scene"], told["engine"]) == ("three_disk", "molecular-dynamics")
    assert told["units/disk.angle[1]"] == "rad"


@pytest.mark.parametrize("scene", ["packing", "ratchet", "wedge", "three_disk"])
@pytest.mark.parametrize(("name", "form"), [("t.xyz", "extxyz"), ("t.dump", "lammps-dump-text")])
def test_trajectories_are_read_by_ase(jostle: Path, tmp_path: Path, scene: str, name: str, form: str) -> None:
    words, _ = SCENES[scene]
    files = ["--output", tmp_path / "run.nc", "--trajectory", tmp_path / name]
    run(jostle, words, "--seconds", "0.3", "--sample", "0.1", *files)
    frames = ase.io.read(tmp_path / name, ":", format=form)
    with xr.open_dataset(tmp_path / "run.nc", engine="scipy") as data:
        assert len(frames) == data.sizes["time"] == 4
        for frame, sample in zip(frames, range(4), strict=True):
            now = data.isel(time=sample)
            places = np.stack([now["disk.x"], now["disk.y"], np.zeros(data.sizes["disk"])], axis=1)
            np.testing.assert_array_equal(frame.positions, places)
            assert list(frame.pbc) == [scene == "ratchet", False, False]
        if form == "extxyz":
            assert frames[3].info["Time"] == data["time"].values[3]
            np.testing.assert_array_equal(frames[3].arrays["angular_velocity"][:, 2], data["disk.angular_velocity"][3])
            if "disk.radius" in data.coords:
                np.testing.assert_array_equal(frames[3].arrays["radius"], data["disk.radius"])
        width = {"packing": 0.4, "ratchet": 0.06}.get(scene)
        assert width is None or frames[0].cell[0, 0] == pytest.approx(width, rel=1e-15)


PEAK = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True, capture_output=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""


def peak(*words: str | Path) -> float:
    """Largest resident memory of a program [MB], started by a small one: a program counts who started it."""
    done = subprocess.run([sys.executable, "-S", "-c", PEAK, *words], check=True, capture_output=True, text=True)
    return int(done.stdout) / 1024


@pytest.mark.skipif(sys.platform != "linux", reason="other systems count in other units")
@pytest.mark.parametrize("ending", ["csv", "nc", "parquet"])
def test_memory_does_not_grow_with_the_run(jostle: Path, tmp_path: Path, ending: str) -> None:
    """The wedge map is the cheapest scene: what counts is rows. 150,000 of them are 15 MB and more.

    Parquet holds up to 4 MB of rows, and keeps an entry for each column of each such group.
    """
    file = tmp_path / f"run.{ending}"
    words = [jostle, "run", "wedge", "--engine", "map", "--sample", "0.01", "--no-progress", "--output", file]
    short, long = (peak(*words, "--seconds", seconds) for seconds in ("500", "1500"))
    assert file.stat().st_size > 1.5e7
    assert long < short + 2.0
