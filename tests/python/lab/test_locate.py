"""The laboratory finds program and FMUs by argument, environment or beside itself, and never in a source tree."""

import ast
import sys
from pathlib import Path

import pytest
from conftest import ROOT

from jostle_lab import locate
from jostle_lab.errors import LabError

PACKAGE = ROOT / "scripts/jostle_lab"


@pytest.fixture
def alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A machine with nothing: no environment, an empty package, Python and PATH without the program."""
    for name in ("JOSTLE_PROGRAM", "JOSTLE_FMUS"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("PATH", str(tmp_path / "path"))
    monkeypatch.setattr(locate, "PACKAGE", tmp_path / "package")
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python/python"))
    return tmp_path


def made(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch(mode=0o755)
    return path


def test_program_by_argument_environment_package_python_and_path(alone: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert made(alone / "path/jostle") == locate.program()
    assert made(alone / "python/jostle") == locate.program()
    assert made(alone / "package/bin/jostle") == locate.program()
    monkeypatch.setenv("JOSTLE_PROGRAM", str(made(alone / "named/jostle")))
    assert locate.program() == alone / "named/jostle"
    assert made(alone / "given") == locate.program(alone / "given")


def test_fmu_by_argument_environment_and_package(alone: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert made(alone / "package/fmus/packing.fmu") == locate.fmu("packing.fmu", "packing")
    monkeypatch.setenv("JOSTLE_FMUS", str(made(alone / "fmus/packing.fmu").parent))
    assert locate.fmu("packing.fmu", "packing") == alone / "fmus/packing.fmu"
    assert made(alone / "given.fmu") == locate.fmu("packing.fmu", "packing", alone / "given.fmu")


def test_what_is_missing_is_reported_with_places_and_remedy(alone: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(LabError, match=r"No program jostle at .*package/bin/jostle or .*python/jostle or PATH\. Build"):
        locate.program()
    with pytest.raises(LabError, match=r"No FMU at .*package/fmus/ratchet\.fmu\. Make one: jostle fmu ratchet .*--fmu"):
        locate.fmu("ratchet.fmu", "ratchet")
    made(alone / "path/jostle")
    monkeypatch.setenv("JOSTLE_PROGRAM", str(alone / "wrong"))  # named but not there: nothing else is tried
    with pytest.raises(LabError, match=r"No program jostle at .*/wrong\. .*JOSTLE_PROGRAM"):
        locate.program()


@pytest.mark.parametrize("module", sorted(PACKAGE.rglob("*.py")), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_the_installed_package_knows_no_source_tree(module: Path) -> None:
    tree = ast.parse(module.read_text())
    imported = {n.module.split(".")[0] for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) and n.module}
    assert not imported & {"studies", "tools"}
    strings = [n.value for n in ast.walk(tree) if isinstance(n, ast.Constant) and isinstance(n.value, str)]
    assert [s for s in strings if "target/" in s or "build/" in s] == []
