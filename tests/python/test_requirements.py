"""The exact versions of scripts/requirements.lock are within the ranges of scripts/pyproject.toml."""

import tomllib

from conftest import ROOT
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

PROJECT = tomllib.loads((ROOT / "scripts/pyproject.toml").read_text())["project"]
LINES = [line for line in (ROOT / "scripts/requirements.lock").read_text().splitlines() if not line.startswith("#")]
LOCKED = dict(line.split("==") for line in LINES)
NAMED = {canonicalize_name(name): version for name, version in LOCKED.items()}
ASKED = [*PROJECT["dependencies"], *(text for extra in PROJECT["optional-dependencies"].values() for text in extra)]
REQUIREMENTS = [requirement for text in ASKED if (requirement := Requirement(text)).name != PROJECT["name"]]


def test_every_package_that_is_asked_for_is_locked_within_its_range() -> None:
    assert len(REQUIREMENTS) > 15
    versions = {r: NAMED.get(canonicalize_name(r.name), "missing") for r in REQUIREMENTS}
    assert {str(r): v for r, v in versions.items() if not r.specifier.contains(v, prereleases=True)} == {}


def test_what_the_laboratory_needs_is_a_range_not_one_version() -> None:
    needed = [Requirement(text) for text in PROJECT["dependencies"]]
    assert all({s.operator for s in r.specifier} == {">=", "<"} for r in needed), needed
