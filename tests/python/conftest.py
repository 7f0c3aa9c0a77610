"""Fixtures: the FMUs under test; the modules of this folder can be imported."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(Path(__file__).resolve().parent))


def bundled(name: str, version: int) -> Path:
    path = ROOT / "build" / name
    if not path.is_file():
        pytest.fail(
            f"{path} is not there. Make it: cargo build --release && "
            f"target/release/jostle fmu packing --fmi {version} --out build/{name}",
            pytrace=False,
        )
    return path


@pytest.fixture(scope="session")
def fmu3() -> Path:
    return bundled("packing.fmu", 3)


@pytest.fixture(scope="session")
def fmu2() -> Path:
    return bundled("packing_fmi2.fmu", 2)


@pytest.fixture(params=[2, 3], ids=["fmi2", "fmi3"])
def fmu(request: pytest.FixtureRequest) -> Path:
    return bundled({2: "packing_fmi2.fmu", 3: "packing.fmu"}[request.param], request.param)
