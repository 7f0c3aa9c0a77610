"""The crate fmi-rs validates and simulates: an importer in Rust, with rules of its own for model descriptions."""

import csv
import subprocess
from pathlib import Path

import fmpy
import pytest
from conftest import PROGRAM, ROOT
from fmpy import simulate_fmu
from fmpy.model_description import read_model_description


@pytest.fixture(scope="module")
def importer() -> Path:
    """Built beside the FMUs."""
    target = ROOT / "build/fmi-rs"
    command = ["cargo", "build", "--locked", "--quiet", "--manifest-path", ROOT / "tests/fmi-rs/Cargo.toml"]
    subprocess.run([*command, "--target-dir", target], check=True)
    return target / "debug/fmi-rs-importer"


@pytest.mark.parametrize(
    "arguments",
    [
        ["packing", "--fmi", "2"],
        ["packing", "--fmi", "3"],
        ["packing", "--fmi", "3", "--arrays"],
        ["packing", "--engine", "event-driven", "--drive", "sine", "--fmi", "3"],
        ["packing", "--engine", "molecular-dynamics-located", "--fmi", "2"],
        ["wedge", "--fmi", "2"],
        ["wedge", "--engine", "event-driven", "--fmi", "3"],
        ["wedge", "--engine", "molecular-dynamics", "--fmi", "3"],
        ["ratchet", "--fmi", "2"],
        ["ratchet", "--fmi", "3"],
        ["three_disk", "--drive", "sine", "--fmi", "2"],
        ["three_disk", "--drive", "harmonic-torque", "--fmi", "3"],
    ],
    ids=" ".join,
)
def test_validates_and_runs(importer: Path, tmp_path: Path, arguments: list[str]) -> None:
    """No problem found, and at the end the values that fmpy sees. fmi-rs writes the shortest text of the same bits."""
    fmu, folder, result = tmp_path / "it.fmu", tmp_path / "it is unpacked", tmp_path / "result.csv"
    subprocess.run([PROGRAM, "fmu", *arguments, "--out", fmu], check=True)
    fmpy.extract(str(fmu), str(folder))
    done = subprocess.run([importer, folder, result, "0.25", "0.03125"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader(result.open()))
    assert len(rows) == 9
    names = [v.name for v in read_model_description(str(fmu)).modelVariables if v.causality == "output"]
    assert list(rows[0]) == ["time", *names]
    expected = simulate_fmu(str(fmu), stop_time=0.25, output_interval=0.03125, output=names)
    for name in names:
        seen = [float(value) for value in rows[-1][name].split()]
        assert seen == expected[name][-1].ravel().tolist(), name
