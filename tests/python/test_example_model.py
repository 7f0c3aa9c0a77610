"""The example model of `fmi-component` becomes valid FMUs of both versions by the example of `fmi-bundle`."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

BUILD = "cargo build --locked --quiet --profile test --workspace --example van_der_pol --example van_der_pol_fmu"
"""Of the whole workspace: then all that `cargo test` has compiled is used."""
EXAMPLES = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "debug/examples"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """With the FMUs of Van der Pol's oscillator."""
    made = tmp_path_factory.mktemp("van der pol")
    subprocess.run(BUILD.split(), check=True, cwd=ROOT)
    subprocess.run([EXAMPLES / "van_der_pol_fmu", EXAMPLES / "libvan_der_pol.so", made], check=True)
    return made


@pytest.mark.parametrize("version", [2, 3])
def test_the_limit_cycle_of_van_der_pol_has_its_amplitude_and_period(folder: Path, version: int) -> None:
    """At mu = 1 amplitude 2.00862 and period 6.66329 (order 8, tolerance 1e-12), as far as steps of 1e-3 let it."""
    fmu = str(folder / f"van_der_pol.fmi{version}.fmu")
    assert validate_fmu(fmu) == []
    result = simulate_fmu(fmu, stop_time=60.0, output_interval=0.01, output=["x"])
    time, x = result["time"], result["x"]
    late = time > 20.0
    assert np.max(x[late]) == pytest.approx(2.00862, abs=2e-3)
    rising = np.flatnonzero((x[:-1] < 0.0) & (x[1:] >= 0.0) & late[1:])
    crossings = time[rising] - x[rising] * 0.01 / (x[rising + 1] - x[rising])
    assert np.diff(crossings) == pytest.approx(6.66329, abs=5e-3)


def test_both_versions_compute_the_same_bits(folder: Path) -> None:
    runs = [simulate_fmu(str(folder / f"van_der_pol.fmi{version}.fmu"), stop_time=5.0) for version in (2, 3)]
    assert np.array_equal(runs[0]["x"], runs[1]["x"])
