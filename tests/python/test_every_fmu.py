"""Every FMU that the command line can write: valid, the same bits in both versions of the standard."""

import csv
import subprocess
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

ROOT = Path(__file__).parents[2]

COMPONENTS = [
    ("packing", "molecular-dynamics", "input"),
    ("packing", "molecular-dynamics", "sine"),
    ("packing", "event-driven", "input"),
    ("packing", "event-driven", "sine"),
    ("wedge", "map", "sine"),
    ("wedge", "event-driven", "input"),
    ("wedge", "event-driven", "sine"),
    ("wedge", "molecular-dynamics", "input"),
    ("wedge", "molecular-dynamics", "sine"),
    ("ratchet", "event-driven", "input"),
    ("ratchet", "event-driven", "sine"),
    ("three_disk", "molecular-dynamics", "input"),
    ("three_disk", "molecular-dynamics", "harmonic-torque"),
    ("three_disk", "molecular-dynamics", "random-supports"),
    ("three_disk", "molecular-dynamics", "sine"),
]


@pytest.mark.parametrize(("scene", "engine", "drive"), COMPONENTS)
def test_valid_and_equal_in_both_versions(tmp_path: Path, scene: str, engine: str, drive: str) -> None:
    """Bundled, validated, run for 0.1 s; the outputs of FMI 2.0 and FMI 3.0 are equal to the bit."""
    results = []
    for version in ("2", "3"):
        fmu = tmp_path / f"{scene}{version}.fmu"
        command = [ROOT / "target/release/jostle", "fmu", scene, "--engine", engine, "--drive", drive]
        subprocess.run([*command, "--fmi", version, "--out", fmu], check=True)
        assert validate_fmu(str(fmu)) == []
        outputs = ["disk.angle[1]", "base.reaction_force", "energy.kinetic", "energy.lost"]
        results.append(simulate_fmu(str(fmu), stop_time=0.1, output_interval=1 / 1024, output=outputs))
    two, three = results
    assert len(two) > 90
    for name in two.dtype.names:
        assert np.array_equal(two[name], three[name]), name


@pytest.mark.parametrize("version", ["2", "3"])
def test_ratchet_runs_alike_in_and_out_of_a_component(tmp_path: Path, version: str) -> None:
    """`jostle run` and the FMU give the same bits at the same communication points, averages and all."""
    jostle = ROOT / "target/release/jostle"
    fmu, table = tmp_path / "ratchet.fmu", tmp_path / "run.csv"
    choice = ["ratchet", "--drive", "sine"]
    subprocess.run([jostle, "fmu", *choice, "--fmi", version, "--out", fmu], check=True)
    run = [jostle, "run", *choice, "--seconds", "2", "--sample", str(1 / 128), "--set", "measure.start=0.3"]
    subprocess.run([*run, "--output", table], check=True)
    with table.open(encoding="utf-8") as file:
        native = list(csv.DictReader(file))
    outputs = [name for name in native[0] if name != "time"]
    start_values = {"measure.start": 0.3}
    result = simulate_fmu(
        str(fmu), stop_time=2.0, step_size=1 / 128, output_interval=1 / 128, start_values=start_values, output=outputs
    )
    assert len(result) == len(native) == 257
    assert float(native[-1]["transport_velocity.standard_error"]) > 0.0
    for name in ["time", *outputs]:
        assert np.array_equal(result[name], [float(row[name]) for row in native]), name
