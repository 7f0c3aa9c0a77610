"""Systems that `scripts/release` built for, and how this machine runs programs of each: itself, by wine, by qemu."""

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import fmpy
import pytest
from conftest import ROOT

HERE = Path(__file__).resolve().parent
RELEASE = Path(os.environ.get("JOSTLE_RELEASE", ROOT / "build" / "release"))
"""What `scripts/release` built."""
PROBES = RELEASE.with_name(f"{RELEASE.name}-probe")
IS_TRIAL = RELEASE.name == "trial"
"""Whether `scripts/release --trial` built it: the libraries of this machine are then those of a plain build."""
ARM_LIBC = Path("/usr/aarch64-linux-gnu")
HEADERS = Path(fmpy.__path__[0]) / "c-code"
ZIG = [sys.executable, "-m", "ziglang", "cc"]


@dataclass(frozen=True)
class Tools:
    """What a system needs on this machine, beside what was built for it."""

    compiler: list[str]
    runner: list[str]
    install: str
    library: str
    """Name of a library NAME of cargo's."""
    program: str


SYSTEMS = {
    "x86_64-linux": Tools(["cc"], [], "gcc", "lib{}.so", "{}"),
    "x86_64-windows": Tools(
        ["x86_64-w64-mingw32-gcc"], ["wine"], "gcc-mingw-w64-x86-64 wine wine64", "{}.dll", "{}.exe"
    ),
    "aarch64-linux": Tools(
        [*ZIG, "-target", "aarch64-linux-gnu.2.17"],
        ["qemu-aarch64-static", "-L", str(ARM_LIBC)],
        "qemu-user-static libc6-dev-arm64-cross",
        "lib{}.so",
        "{}",
    ),
}
"""Those that can be run here: nothing on Linux runs programs for macOS."""


@dataclass(frozen=True)
class System:
    """One that was built, with a folder for what is compiled for it."""

    name: str
    made: Path
    environment: dict[str, str]

    @property
    def tools(self) -> Tools:
        """What it needs here."""
        return SYSTEMS[self.name]

    @property
    def is_windows(self) -> bool:
        """Whether its paths and names are those of Windows."""
        return self.name.endswith("windows")

    @property
    def folder(self) -> Path:
        """Of the release."""
        return RELEASE / self.name

    @property
    def jostle(self) -> Path:
        """The command line."""
        return self.folder / self.tools.program.format("jostle")

    def library(self, name: str) -> Path:
        """A library of the release, by its name in cargo."""
        return RELEASE / self.name / self.tools.library.format(name)

    def path(self, file: Path) -> str:
        """How a program of this system calls a file of this machine."""
        return f"Z:{file}".replace("/", "\\") if self.is_windows else str(file)

    def run(self, program: Path, *words: str | Path, **variables: str) -> subprocess.CompletedProcess[str]:
        """A program of this system, run with these words, of which paths are those of this machine."""
        texts = [self.path(word) if isinstance(word, Path) else word for word in words]
        return subprocess.run(
            [*self.tools.runner, str(program), *texts],
            env={**self.environment, **variables},
            capture_output=True,
            text=True,
            encoding="utf-8",
            errors="replace",
            check=False,
            timeout=600,
        )

    def output(self, program: Path, *words: str | Path, **variables: str) -> str:
        """What it prints; it must succeed."""
        done = self.run(program, *words, **variables)
        assert done.returncode == 0, f"{program} {words}: {done.returncode}\n{done.stdout}{done.stderr}"
        return done.stdout

    def compiled(self, source: Path, *options: str) -> Path:
        """A C program of this system."""
        program = self.made / self.tools.program.format(source.stem)
        flags = ["-std=gnu11", "-O1", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror"]
        words = [*self.tools.compiler, *flags, str(source), "-o", str(program)]
        system = ["-lshell32"] if self.is_windows else ["-lm", "-ldl", "-lpthread"]
        if not program.is_file():
            subprocess.run([*words, *options, *system], check=True, capture_output=True, text=True)
        return program


def system(name: str, made: Path) -> System:
    """The system called `name`; skips the test, by name, where it was not built or cannot be run."""
    tools = SYSTEMS[name]
    if not (RELEASE / name).is_dir():
        pytest.skip(f"{name}: {RELEASE / name} is missing. Make it: scripts/release {name}")
    missing = [word for word in (tools.compiler[0], *tools.runner[:1]) if not shutil.which(word)]
    if missing or (name == "aarch64-linux" and not ARM_LIBC.is_dir()):
        pytest.skip(f"{name}: it cannot be run without {tools.install}. Install: apt-get install {tools.install}")
    environment = {**os.environ, "LC_ALL": "C.UTF-8"}
    if name == "x86_64-windows":
        environment |= {"WINEPREFIX": str(made / "wine"), "WINEDEBUG": "-all"}
        subprocess.run(["wineboot", "-i"], env=environment, capture_output=True, check=True, timeout=600)
        stub = made / "wine/drive_c/windows/system32/bcryptprimitives.dll"
        if not stub.is_file():
            words = [*tools.compiler, "-shared", "-O1", str(HERE / "bcryptprimitives.c"), "-o", str(stub), "-ladvapi32"]
            subprocess.run(words, check=True)
    return System(name, made, environment)
