"""The smallest example model of `fmi-component` becomes valid FMUs of both versions by the example of `fmi-bundle`."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

BUILD = "cargo build --locked --quiet --profile test --workspace --example decay --example decay_fmu"
"""Of the whole workspace: then all that `cargo test` has compiled is used."""
EXAMPLES = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "debug/examples"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """With the FMUs of Dahlquist's equation."""
    made = tmp_path_factory.mktemp("two words")
    subprocess.run(BUILD.split(), check=True, cwd=ROOT)
    subprocess.run([EXAMPLES / "decay_fmu", EXAMPLES / "libdecay.so", made], check=True)
    return made


@pytest.mark.parametrize("version", [2, 3])
def test_the_solution_is_an_exponential(folder: Path, version: int) -> None:
    fmu = str(folder / f"decay.fmi{version}.fmu")
    assert validate_fmu(fmu) == []
    result = simulate_fmu(fmu, stop_time=5.0, output_interval=0.01, start_values={"k": 1.5}, output=["x"])
    assert result["x"] == pytest.approx(np.exp(-1.5 * result["time"]), rel=1e-12)


def test_both_versions_compute_the_same_bits(folder: Path) -> None:
    runs = [simulate_fmu(str(folder / f"decay.fmi{version}.fmu"), stop_time=5.0) for version in (2, 3)]
    assert np.array_equal(runs[0]["x"], runs[1]["x"])
