"""A packing in the middle of its protocol, on disk: state in, file out, and back to the bit.

    {what is plain: JSON} + {arrays} <-> one .npz file, whole or absent

No code is stored: a file from somebody else can hold wrong numbers, but run nothing.
"""

import json
import zipfile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from jostle_lab.files import replacing

FILE = "checkpoint.npz"
"""In the folder of a packing, until it is finished."""
PLAIN = "plain"


class Checkpoint(NamedTuple):
    """What goes into the file."""

    plain: dict[str, Any]
    """Whatever JSON takes; numbers come back to the bit."""
    arrays: dict[str, NDArray[Any]]


def save(folder: Path, checkpoint: Checkpoint) -> None:
    """Write the file of a folder."""
    text = json.dumps(checkpoint.plain, default=lambda value: value.item())
    arrays: dict[str, Any] = {PLAIN: np.frombuffer(text.encode(), np.uint8), **checkpoint.arrays}
    with replacing(folder / FILE) as draft, draft.open("wb") as file:
        np.savez(file, **arrays)


def plain(folder: Path) -> dict[str, Any] | None:
    """The plain part alone; None if there is no file."""
    return found.plain if (found := _read(folder, arrays=False)) else None


def load(folder: Path) -> Checkpoint | None:
    """All of it; None if there is no file. Raises LabError if it is damaged."""
    return _read(folder, arrays=True)


def _read(folder: Path, arrays: bool) -> Checkpoint | None:
    path = folder / FILE
    if not path.exists():
        return None
    try:
        with np.load(path, allow_pickle=False) as file:
            values: dict[str, Any] = json.loads(file[PLAIN].tobytes())
            return Checkpoint(values, {n: file[n] for n in file.files if n != PLAIN} if arrays else {})
    except (ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise LabError(f"{path} is damaged: {error}. Remove {folder}: that packing is then shaken anew.") from None
