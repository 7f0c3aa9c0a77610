"""Structs with `#[derive(Component)]` become valid FMUs of both versions: the first one of the README of fmi-component,
and the models of the Reference FMUs, which compute what the Modelica Association publishes."""

import csv
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

CRATE = ROOT / "crates/fmi-component"
MODELS = CRATE / "examples/reference_models"
NAMES = ("BouncingBall", "Dahlquist", "Feedthrough", "Resource", "Stair", "StateSpace", "VanDerPol")
LIBRARIES = ("bouncing_ball", "dahlquist", "feedthrough", "resource", "stair", "state_space", "van_der_pol")
TARGETS = [f"--example={name}" for name in LIBRARIES] + ["--bin=reference-models", "--bin=first-fmu"]
BUILD = ["cargo", "build", "--locked", "--quiet", "--profile", "test", "--workspace", *TARGETS]
"""Of the whole workspace: then all that `cargo test` has compiled is used."""
PROGRAMS = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "debug"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """With the FMUs of all models."""
    made = tmp_path_factory.mktemp("reference models")
    subprocess.run(BUILD, check=True, cwd=ROOT)
    subprocess.run([PROGRAMS / "reference-models", made], check=True)
    return made


def published(name: str) -> dict[str, list[str]]:
    with (MODELS / f"tests/data/{name}_out.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    return {column[0]: list(column[1:]) for column in zip(*rows, strict=True)}


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_fmpy_runs_each_model_to_its_published_results(folder: Path, name: str, version: int) -> None:
    fmu = str(folder / f"{name}.fmi{version}.fmu")
    assert validate_fmu(fmu) == []
    expected = published(name)
    times = np.array(expected.pop("time"), dtype=float)
    variables = {variable.name for variable in read_model_description(fmu).modelVariables}
    vectors = [column for column in expected if f"{column}[1]" in variables]
    outputs = [f"{column}[{i}]" for column in vectors for i in (1, 2, 3)]
    outputs += [column for column in expected if column in variables]
    result = simulate_fmu(
        fmu,
        stop_time=times[-1],
        step_size=times[1],
        output_interval=times[1],
        output=[output for output in outputs if not output.startswith(("String", "Binary"))],
    )
    assert result["time"] == pytest.approx(times, abs=1e-9)
    for output in result.dtype.names[1:]:
        stem, _, index = output.partition("[")
        texts = expected[stem] if not index else [text.split()[int(index[:-1]) - 1] for text in expected[stem]]
        values = [text == "true" if text in ("true", "false") else float(text) for text in texts]
        assert result[output] == pytest.approx(np.array(values), rel=1e-9, abs=1e-9), output


def test_fmi_2_leaves_binary_variables_out(folder: Path) -> None:
    two, three = (read_model_description(str(folder / f"Feedthrough.fmi{version}.fmu")) for version in (2, 3))
    names = {variable.name: variable for variable in three.modelVariables}
    missing = set(names) - {variable.name for variable in two.modelVariables}
    assert missing == {"Binary_input", "Binary_output"}
    types = {variable.type for variable in three.modelVariables}
    whole = {f"{sign}Int{bits}" for sign in ("", "U") for bits in (8, 16, 32, 64)}
    assert types == whole | {"Float32", "Float64", "Boolean", "String", "Binary", "Enumeration"}
    assert names["String_input"].start == "Set me!"
    assert names["Binary_input"].start == "666f6f"
    assert names["Float64_tunable_parameter"].variability == "tunable"
    assert names["Float64_discrete_input"].variability == "discrete"


def test_events_of_the_ball_and_the_stair_end_steps(folder: Path) -> None:
    def times(name: str, stop: float, interval: float) -> np.ndarray:
        result = simulate_fmu(
            str(folder / f"{name}.fmi3.fmu"),
            stop_time=stop,
            output_interval=interval,
            early_return_allowed=True,
            use_event_mode=True,
        )
        return np.unique(np.round(result["time"], 9))

    impacts = set(times("BouncingBall", 3.0, 0.5)) - {0.5 * i for i in range(7)}
    assert len(impacts) > 6
    assert min(impacts) == pytest.approx(np.sqrt(2.0 / 9.81), abs=2e-3)
    assert {1.0, 2.0, 3.0} <= set(times("Stair", 3.5, 0.7))


def test_matrices_and_vectors_are_array_variables_where_it_is_asked_for(folder: Path) -> None:
    fmu = str(folder / "StateSpace.arrays.fmu")
    assert validate_fmu(fmu) == []
    variables = {variable.name: variable for variable in read_model_description(fmu).modelVariables}
    assert list(variables) == ["time", "A", "B", "C", "D", "x0", "u", "y", "x"]
    assert [int(dimension.start) for dimension in variables["A"].dimensions] == [3, 3]
    assert variables["A"].start == "1.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0"
    assert variables["u"].start == "1.0 2.0 3.0"
    result = simulate_fmu(fmu, stop_time=10.0, step_size=1.0, output_interval=1.0, output=["y"])
    expected = [[float(number) for number in text.split()] for text in published("StateSpace")["y"]]
    assert np.array(result["y"]) == pytest.approx(np.array(expected), rel=1e-9)
    doubled = "2 0 0 0 2 0 0 0 2"
    other = simulate_fmu(fmu, stop_time=1.0, output_interval=1.0, start_values={"D": doubled}, output=["y"])
    assert np.array(other["y"])[0] == pytest.approx([2.0, 4.0, 6.0])


def test_the_first_fmu_of_the_readme_takes_25_lines_and_one_command(folder: Path, tmp_path: Path) -> None:
    readme = (CRATE / "README.md").read_text()
    blocks = re.findall(r"^```rust.*\n((?:.*\n)*?)```$", readme, re.MULTILINE)
    package = CRATE / "examples/first_fmu"
    library, program = ((package / f"src/{name}.rs").read_text() for name in ("lib", "main"))
    assert blocks[:2] == [library, program]
    assert len((library + program).splitlines()) <= 25
    assert re.search(r'^crate-type = \["cdylib", "rlib"\]$', (package / "Cargo.toml").read_text(), re.MULTILINE)
    # What `cargo run --release` starts once it has built.
    subprocess.run([PROGRAMS / "first-fmu"], check=True, cwd=tmp_path)
    for version in (2, 3):
        fmu = str(tmp_path / f"Dahlquist.fmi{version}.fmu")
        assert validate_fmu(fmu) == []
        result = simulate_fmu(fmu, stop_time=5.0, output_interval=0.01, start_values={"k": 1.5}, output=["x"])
        assert result["x"] == pytest.approx(np.exp(-1.5 * result["time"]), rel=1e-12)
