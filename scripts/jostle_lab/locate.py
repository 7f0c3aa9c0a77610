"""Where the program `jostle` and the FMUs are: named, in the environment, or beside this package.

    program: argument -> JOSTLE_PROGRAM -> beside the package, in bin/ -> beside the Python interpreter -> PATH
    FMU:     argument -> JOSTLE_FMUS, a folder -> beside the package, in fmus/

What was named but is not there is an error; nothing else is tried instead. Nothing here knows a source tree.
"""

import hashlib
import os
import shutil
import sys
from pathlib import Path

from jostle_lab.errors import LabError

PROGRAM, FMUS = "JOSTLE_PROGRAM", "JOSTLE_FMUS"
"""Environment variables: a file, and a folder of FMUs."""
PACKAGE = Path(__file__).parent


def program(given: Path | None = None) -> Path:
    """The native command line; raises LabError with all places that were looked at."""
    name = "jostle.exe" if sys.platform == "win32" else "jostle"
    beside = [PACKAGE / "bin" / name, Path(sys.executable).parent / name]
    on_path = shutil.which(name)
    places = _places(given, PROGRAM, "", [*beside, *([Path(on_path)] if on_path else [])])
    remedy = "Build it: cargo build --release -p jostle-cli. Then name it with --program, or set JOSTLE_PROGRAM"
    looked = [*map(str, places), *(["PATH"] if len(places) > 1 else [])]
    return _first(places, "program jostle", looked, remedy)


def fmu(file: str, scene: str, given: Path | None = None, version: int = 3, option: str = "--fmu") -> Path:
    """The FMU `file` of a scene whose drive are inputs; raises LabError with all places that were looked at."""
    places = _places(given, FMUS, file, [PACKAGE / "fmus" / file])
    made = f"Make one: jostle fmu {scene} --drive input --fmi {version} --out {file}"
    return _first(places, "FMU", list(map(str, places)), f"{made}. Then name it with {option}, or set JOSTLE_FMUS")


def _places(given: Path | None, variable: str, file: str, beside: list[Path]) -> list[Path]:
    if given is not None:
        return [given]
    named = os.environ.get(variable)
    return [Path(named) / file if file else Path(named)] if named else beside


def _first(places: list[Path], what: str, looked: list[str], remedy: str) -> Path:
    for place in places:
        if place.is_file():
            return place
    raise LabError(f"No {what} at {' or '.join(looked)}. {remedy}.")


def fingerprint(file: Path) -> str:
    """First digits of the checksum of a program: the same bytes, the same numbers."""
    return hashlib.sha256(program(file).read_bytes()).hexdigest()[:12]
