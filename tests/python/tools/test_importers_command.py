"""The command that tries importers in environments of their own; the environments themselves need a package index."""

import json
from pathlib import Path

import pytest

from jostle_lab.errors import LabError
from tools.importers import command


def test_every_importer_has_a_driver() -> None:
    drivers = {path.stem for path in command.DRIVERS.glob("*.py")}
    assert drivers == {importer.driver for importer in command.IMPORTERS}
    assert all("==" in importer.requirements[0] for importer in command.IMPORTERS), "pinned"


def test_an_unknown_importer_is_refused(tmp_path: Path) -> None:
    with pytest.raises(LabError, match="There are: ecospy"):
        command.importers(tmp_path / "folder", only=["nobody"])
    assert not (tmp_path / "folder").exists()


def test_outcomes_are_compared_and_failures_quoted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Drivers that say the expected numbers, others, and none."""
    path = tmp_path / "case.json"
    path.write_text(json.dumps({"expected": [1.5, -2.0]}), encoding="utf-8")
    monkeypatch.setattr(command, "DRIVERS", tmp_path)
    importer = command.Importer("it", ("it==1",), "driver")
    python = tmp_path / "bin" / "python"
    python.parent.mkdir()
    for script, outcome in [
        ("echo noise; echo '[1.5, -2.0]'", "same bits"),
        ("echo '[1.5, -2.5]'", "[1.5, -2.5] instead of [1.5, -2.0]"),
        ("echo first >&2; echo 'no such thing' >&2; exit 1", "fails: no such thing"),
        ("exit 3", "fails: ended with 3"),
    ]:
        python.write_text(f"#!/bin/sh\n{script}\n")
        python.chmod(0o755)
        assert command._outcome(python, importer, path) == outcome
