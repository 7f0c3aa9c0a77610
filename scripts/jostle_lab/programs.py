"""Other programs, run to their end."""

import subprocess
from collections.abc import Sequence
from pathlib import Path

from jostle_lab.errors import LabError


def completed(words: Sequence[str | Path], folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """A program that has ended, with what it printed; raises LabError if it cannot be started."""
    try:
        return subprocess.run(words, cwd=folder, capture_output=True, text=True, errors="replace", check=False)
    except OSError as error:
        if folder is not None and not folder.is_dir():
            raise LabError(f"The folder {folder} does not exist, where {words[0]} was to run. Name another.") from None
        raise LabError(f"{words[0]} cannot be started: {error.strerror}. Install it, or name another.") from None


def output_of(words: Sequence[str | Path], folder: Path | None = None) -> str:
    """What a program prints; raises LabError with its messages if it fails."""
    done = completed(words, folder)
    if done.returncode != 0:
        where = f" in {folder}" if folder else ""
        raise LabError(f"{' '.join(map(str, words))} failed{where}:\n{done.stderr.strip()}")
    return done.stdout
