"""Every FMU that the command line can write: valid, the same bits in both versions of the standard."""

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
    ("packing", "molecular-dynamics-located", "input"),
    ("packing", "molecular-dynamics-located", "sine"),
    ("packing", "event-driven", "input"),
    ("packing", "event-driven", "sine"),
    ("wedge", "map", "sine"),
    ("wedge", "event-driven", "input"),
    ("wedge", "event-driven", "sine"),
    ("wedge", "molecular-dynamics", "input"),
    ("wedge", "molecular-dynamics", "sine"),
    ("ratchet", "event-driven", "input"),
    ("ratchet", "event-driven", "sine"),
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
