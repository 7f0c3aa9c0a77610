"""The command line and the FMUs beside the package."""

import subprocess
import sys
from pathlib import Path

import fmpy
import pytest

import jostle
from jostle import installed


def test_the_program_is_there() -> None:
    told = subprocess.run([jostle.program(), "--version"], check=True, capture_output=True, text=True).stdout
    assert told.split() == ["jostle", jostle.__version__]


def test_python_runs_the_program_with_its_exit_code() -> None:
    words = [sys.executable, "-m", "jostle", "describe", "packing", "--disks", "0"]
    done = subprocess.run(words, check=False, capture_output=True, text=True)
    assert done.returncode == 2
    assert "--disks = 0" in done.stderr


@pytest.mark.parametrize("scene", ["packing", "ratchet", "wedge", "three_disk"])
@pytest.mark.parametrize("fmi", [2, 3])
def test_fmus_are_there(scene: str, fmi: int) -> None:
    description = fmpy.read_model_description(str(jostle.fmu(scene, fmi)))
    assert description.fmiVersion.startswith(str(fmi))
    assert description.modelName.startswith(scene)


@pytest.mark.parametrize(
    ("scene", "fmi", "text"), [("sandpile", 3, "one of: packing"), ("packing", 1, "2 or 3"), ("packing", 2.0, "2 or 3")]
)
def test_what_is_not_there_is_told(scene: str, fmi: int, text: str) -> None:
    with pytest.raises(jostle.ParameterError, match=text):
        jostle.fmu(scene, fmi)
    with pytest.raises(jostle.ParameterError, match="scene"):
        jostle.fmu(7)  # type: ignore[arg-type]


def test_an_installation_without_them_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(installed, "HERE", tmp_path)
    with pytest.raises(jostle.JostleError, match="scripts/wheel"):
        jostle.program()
    with pytest.raises(jostle.JostleError, match="FMUs"):
        jostle.fmu("packing")
