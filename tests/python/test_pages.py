"""What the pages name exists: tests, benchmarks, examples, scripts, commands, files; and no page grows too long."""

import re
import subprocess
import sys
import tomllib
from functools import cache
from pathlib import Path

import pytest
from conftest import ROOT
from snippets import RELEASE, pages

IMPORTERS = (ROOT / "docs/importers.md").read_text()
TESTS = [ROOT / "tests", *ROOT.glob("crates/*/tests")]
SOURCES = {path.name: path.read_text() for of in TESTS for path in of.rglob("*") if path.suffix in (".py", ".rs")}
WRITTEN = {str(page.relative_to(ROOT)): page.read_text() for page in pages()}
GENERATED = {str(page.relative_to(ROOT)): page.read_text() for page in (ROOT / "docs/generated").glob("*.md")}
EVERYTHING = WRITTEN | GENERATED


def named(pattern: str, texts: dict[str, str] = EVERYTHING) -> set[str]:
    """What the first group of a pattern finds in all pages."""
    return {found for text in texts.values() for found in re.findall(pattern, text)}


def test_every_test_that_the_page_of_importers_names_exists() -> None:
    everything = "\n".join(SOURCES.values())
    tests = [match[1] for match in re.finditer(r"`(?:\w+\.py::)?(test_\w+)`", IMPORTERS)]
    tests += re.findall(r"`(?:crates/[\w-]+/)?tests/\w+/\w+\.rs` \(`(\w+)`\)", IMPORTERS)
    files = re.findall(r"`(?:(?:crates/[\w-]+/)?tests/(?:\w+/)?)?(\w+\.(?:py|rs))(?:::\w+)?`", IMPORTERS)
    assert len(tests) > 10
    assert len(files) > 10
    assert [name for name in files if name not in SOURCES] == []
    assert [name for name in tests if not re.search(rf"\b(?:def|fn) {name}\(", everything)] == []
    # `test_fmuloader_2`, `_3`: what follows a comma is another ending of the same name.
    for first, rest in re.findall(r"`\w+\.py::(test_[a-z]+)\w*`((?:, `_\w+`)+)", IMPORTERS):
        for end in re.findall(r"`(_\w+)`", rest):
            assert f"def {first}{end}(" in everything, f"{first}{end}"


def rust_files(folder: Path, kind: str) -> set[str]:
    """Names of the tests, benches or examples of a package: files, and what its manifest names."""
    manifest = tomllib.loads((folder / "Cargo.toml").read_text())
    stated = {
        target["name"]
        for target in manifest.get({"tests": "test", "benches": "bench", "examples": "example"}[kind], [])
    }
    found = [*folder.glob(f"{kind}/*.rs"), *folder.glob(f"{kind}/*/main.rs")]
    return stated | {path.parent.name if path.name == "main.rs" else path.stem for path in found}


@pytest.mark.parametrize("kind", ["test", "bench", "example"])
def test_every_cargo_target_that_a_page_names_exists_in_the_package_that_it_names(kind: str) -> None:
    plural = {"test": "tests", "bench": "benches", "example": "examples"}[kind]
    folders = {"": ROOT, "jostle-c": ROOT / "capi"} | {path.name: path for path in ROOT.glob("crates/*")}
    folders["reference-models"] = ROOT / "crates/fmi-component/examples/reference_models"
    found = [
        (page, command)
        for page, text in EVERYTHING.items()
        for command in re.findall(rf"cargo [^`\n|]*--{kind} [^`\n|]*", text)
    ]
    assert found
    wrong = []
    for page, command in found:
        package = re.search(r" -p ([a-z-]+)", command)
        known = rust_files(folders[package[1] if package else ""], plural)
        wrong += [f"{page}: {command}" for name in re.findall(rf"--{kind} ([a-z_]+)", command) if name not in known]
    assert wrong == []


def test_every_script_that_a_page_names_exists() -> None:
    scripts = named(r"(?<![\w/.])((?:scripts|fuzz|\.ci)/[a-z]+)(?![\w/.])")
    assert "scripts/demo" in scripts
    assert [script for script in sorted(scripts) if not (ROOT / script).exists()] == []


def test_every_package_that_a_page_builds_exists() -> None:
    manifests = [
        *ROOT.glob("crates/*/Cargo.toml"),
        *ROOT.glob("crates/*/examples/*/Cargo.toml"),
        *ROOT.glob("fmu/*/Cargo.toml"),
        ROOT / "capi/Cargo.toml",
    ]
    packages = {re.findall(r'^name = "(.+)"', path.read_text(), re.MULTILINE)[0] for path in manifests}
    built = named(r"cargo [a-z]+[^`\n|]* -p ([a-z-]+)")
    assert "jostle-cli" in built
    assert sorted(built - packages) == []


@cache
def commands(*program: str) -> str:
    """The help of a command line."""
    done = subprocess.run([*program, "--help"], cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else ""


def test_every_python_command_that_a_page_names_exists() -> None:
    found = {
        (module, command) for text in EVERYTHING.values() for module, command in re.findall(r"-m (\w+) ([a-z-]+)", text)
    }
    known = {"pytest", "zipfile"}
    modules = {module for module, _ in found} - known
    assert "jostle_lab" in modules
    missing = [
        f"python -m {module} {command}"
        for module, command in sorted(found)
        if module not in known and not re.search(rf"^\W*{command}\b", commands(sys.executable, "-m", module), re.M)
    ]
    assert missing == []


def test_every_command_of_jostle_that_a_page_names_exists() -> None:
    found = named(r"(?:`|release/)jostle ([a-z]+)")
    assert "describe" in found
    program = str(RELEASE / "jostle")
    assert [c for c in sorted(found) if not re.search(rf"^  {c}\b", commands(program), re.MULTILINE)] == []


def test_files_that_a_page_names_in_code_exist() -> None:
    paths = named(
        r"`((?:docs|src|capi|benches|tests|examples|scripts|include|modelDescription|fuzz)/[\w./*-]+)`", WRITTEN
    )
    assert len(paths) > 10
    missing = [
        path for path in sorted(paths) if not re.search("SCENE|LAW|DRIVE|ENGINE", path) and not list(ROOT.glob(path))
    ]
    assert missing == []


def test_links_lead_somewhere() -> None:
    """Of the files alone: scripts/docs checks the anchors too."""
    targets = [
        (page, target.split("#")[0])
        for page, text in EVERYTHING.items()
        for target in re.findall(r"\]\(([^)\s]+)\)", text)
        if not target.startswith(("https:", "#"))
    ]
    assert len(targets) > 50
    assert [(page, target) for page, target in targets if not (ROOT / page).parent.joinpath(target).is_file()] == []


def test_readme_is_short_and_its_picture_small() -> None:
    assert len((ROOT / "README.md").read_bytes()) <= 6 * 1024
    assert (ROOT / "docs/packing.png").stat().st_size < 300 * 1024


def test_book_lists_every_page() -> None:
    listed = set(re.findall(r"\]\((.+?\.md)\)", (ROOT / "docs/SUMMARY.md").read_text()))
    there = {str(path.relative_to(ROOT / "docs")) for path in (ROOT / "docs").rglob("*.md")} - {"SUMMARY.md"}
    assert listed == there


def markdown_tables(text: str) -> list[list[str]]:
    """The rows of each table of a page."""
    return [table.splitlines() for table in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE)]


def test_every_row_of_a_table_has_the_cells_of_its_head() -> None:
    broken = []
    for page, text in EVERYTHING.items():
        for table in markdown_tables(text + "\n"):
            widths = {len(re.findall(r"(?<!\\)\|", row)) for row in table}
            broken += [f"{page}: {table[0]}"] * (len(widths) > 1)
    assert broken == []


def test_figures_of_a_case_stand_on_one_page_only() -> None:
    """A sentence with three or more numbers is a result: it stands once, other pages link to it."""
    seen: dict[str, str] = {}
    twice = []
    for page, text in WRITTEN.items():
        if page == "docs/index.md":
            continue
        for sentence in re.split(r"(?<=[.:])\s+", re.sub(r"```.*?```", "", text, flags=re.DOTALL)):
            plain = " ".join(sentence.split())
            if len(re.findall(r"\d[\d.e-]*", plain)) >= 3 and seen.setdefault(plain, page) != page:
                twice.append(f"{page} and {seen[plain]}: {plain}")
    assert twice == []


def test_paths_of_this_machine_are_on_no_page() -> None:
    assert [page for page, text in EVERYTHING.items() if re.search(r"/(?:home|root|work|tmp)/", text)] == []
