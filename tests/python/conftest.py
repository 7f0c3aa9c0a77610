"""Fixtures: what scripts/setup built, and the laboratory on it; the modules of these folders can be imported."""

import os
import sys
from pathlib import Path

import pytest

from jostle_lab.runs.laboratory import Laboratory

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RELEASE = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "release"
PROGRAM = Path(os.environ.get("JOSTLE_PROGRAM", RELEASE / "jostle"))
FMUS = Path(os.environ.get("JOSTLE_FMUS", ROOT / "build"))
sys.path[:0] = [str(HERE), str(HERE / "lab"), str(HERE / "fmus"), str(HERE / "release")]


def built(path: Path) -> Path:
    if not path.is_file():
        pytest.fail(f"{path} is not there. Make it: scripts/setup", pytrace=False)
    return path


@pytest.fixture(scope="session")
def jostle() -> Path:
    """The native command line."""
    return built(PROGRAM)


@pytest.fixture
def laboratory(jostle: Path, tmp_path: Path) -> Laboratory:
    return Laboratory(jostle, tmp_path / "runs", show_progress=False)


@pytest.fixture(scope="session")
def fmu3() -> Path:
    return built(FMUS / "packing.fmu")


@pytest.fixture(scope="session")
def fmu2() -> Path:
    return built(FMUS / "packing_fmi2.fmu")


@pytest.fixture(params=[2, 3], ids=["fmi2", "fmi3"])
def fmu(request: pytest.FixtureRequest) -> Path:
    return built(FMUS / {2: "packing_fmi2.fmu", 3: "packing.fmu"}[request.param])
