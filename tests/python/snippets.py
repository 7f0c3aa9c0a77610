"""The fenced blocks of the pages that people write, and how one is run."""

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from conftest import ROOT

RELEASE = Path(os.environ.get("CARGO_TARGET_DIR", "target")) / "release"
LANGUAGES = {"python", "c", "cpp", "sh", "rust", "toml"}
"""Languages whose blocks a test runs. Other blocks are text."""
PAGES = ("README.md", "CONTRIBUTING.md", "SECURITY.md", "benches/peers/README.md", "python/README.md")
"""Beside those in docs/."""


@dataclass(frozen=True)
class Snippet:
    """A block ```LANGUAGE NAME of a page."""

    page: str
    language: str
    name: str
    text: str


def pages() -> list[Path]:
    """Every page that people write."""
    found = [ROOT / name for name in PAGES]
    return found + sorted((ROOT / "docs").glob("*.md"))


@cache
def snippets() -> tuple[Snippet, ...]:
    """Every block of these pages, in order."""
    found = []
    for page in pages():
        for info, text in re.findall(r"^```(.*)\n((?:.*\n)*?)```$", page.read_text(), re.MULTILINE):
            language, _, name = info.partition(" ")
            found.append(Snippet(str(page.relative_to(ROOT)), language, name, text))
    return tuple(found)


def snippet(page: str, language: str, name: str) -> str:
    """The text of the one block ```LANGUAGE NAME of a page."""
    found = [s.text for s in snippets() if (s.page, s.language, s.name) == (page, language, name)]
    assert len(found) == 1, f"{page} has {len(found)} blocks ```{language} {name}, not one"
    return found[0]


def run(*command: str, folder: Path = ROOT) -> str:
    """What a command prints; it must succeed."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command[0]} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return done.stdout


def python(program: str, folder: Path = ROOT) -> str:
    """What a Python program prints."""
    return run(sys.executable, "-c", program, folder=folder)


def shell(script: str) -> str:
    """What a script of the shell prints; programs of this checkout are those that were built."""
    here = script.replace("target/release", str(RELEASE)).replace(".venv/bin/python", sys.executable)
    return run("bash", "-euo", "pipefail", "-c", here)


def compiled(source: Path, language: str, *more: str) -> str:
    """What a C program prints that is compiled as `c` or as `c++`, every warning being an error."""
    standard = {"c": ["cc", "-std=c11"], "c++": ["c++", "-x", "c++", "-std=c++17"]}[language]
    program = source.with_suffix("")
    run(*standard, "-O2", "-Wall", "-Wextra", "-Werror", str(source), "-x", "none", "-o", str(program), *more)
    return run(str(program))
