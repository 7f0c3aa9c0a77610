"""What a wheel holds besides the compiled module: the command line and ready FMUs."""

import os
import subprocess
import sys
from pathlib import Path

from jostle import arguments
from jostle.errors import JostleError, ParameterError

HERE = Path(__file__).resolve().parent
SUFFIX = ".exe" if os.name == "nt" else ""


def program() -> Path:
    """Return the command line `jostle`.

    Raises:
        JostleError: this installation holds none.

    """
    return _there(HERE / "bin" / f"jostle{SUFFIX}", "the command line")


def fmu(scene: str, fmi: int = 3) -> Path:
    """Return the ready FMU of a scene, with the scene's first engine, first drive and usual number of disks.

    Others are made by the command line: `jostle fmu packing --disks 20 --out packing.fmu`.

    Args:
        scene: `packing`, `ratchet`, `wedge` or `three_disk`.
        fmi: version of FMI, 2 or 3.

    Raises:
        ParameterError: no such scene or version.
        JostleError: this installation holds no FMUs.

    """
    arguments.text("scene", scene, "jostle.scenes() lists what there is.")
    if fmi not in (2, 3) or not hasattr(fmi, "__index__"):  # 2.0 would be part of a file's name
        raise ParameterError.of("fmi", arguments.shown(fmi), "2 or 3", "Give the version that your importer reads.")
    folder = _there(HERE / "fmus", "the FMUs")
    known = sorted(path.name.removesuffix(".fmi3.fmu") for path in folder.glob("*.fmi3.fmu"))
    if scene not in known:
        remedy = "Name one of these; jostle fmu makes others."
        raise ParameterError.of("scene", scene, f"one of: {', '.join(known)}", remedy)
    return folder / f"{scene}.fmi{fmi}.fmu"


def _there(path: Path, what: str) -> Path:
    if path.exists():
        return path
    remedy = "Install a wheel that scripts/wheel made, or run scripts/setup in a checkout."
    raise JostleError(f"{what} of jostle is not in {HERE}. {remedy}", remedy)


def main() -> None:
    """Run the command line with the arguments of this process: what the script `jostle` of a wheel calls."""
    try:
        words = [str(program()), *sys.argv[1:]]
    except JostleError as error:
        sys.exit(f"jostle: {error}")
    if os.name == "nt":  # where exec leaves the caller before the program has ended
        sys.exit(subprocess.run(words, check=False).returncode)
    os.execv(words[0], words)
