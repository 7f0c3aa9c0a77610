"""Errors that a reader can act on: name, value, range, remedy."""

import errno
import math
import os
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import TypeVar

Value = TypeVar("Value")


class LabError(Exception):
    """Something that the user can put right; the message says how."""


def require(name: str, value: float, low: float, high: float, remedy: str) -> float:
    """Return `value` if it is finite and in [low, high], else raise LabError with name, value, range and remedy."""
    if math.isfinite(value) and low <= value <= high:
        return value
    raise LabError(f"{name} = {value:g} is outside [{low:g}, {high:g}]. {remedy}")


def repeated(values: Sequence[Value]) -> list[Value]:
    """Values of which an equal one comes before, in their order."""
    return [value for number, value in enumerate(values) if value in values[:number]]


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """` Did you mean X?` for the known name that is most like a wrong one; a part between dots counts as the whole."""
    whole = list(known)
    parts = {part: candidate for candidate in reversed(whole) for part in candidate.split(".")}
    near = get_close_matches(name, whole, n=1, cutoff=0.7)
    near = near or [parts[part] for part in get_close_matches(name, parts, n=1, cutoff=0.8)]
    return f" Did you mean {near[0]}?" if near else ""


REMEDIES = {
    errno.ENOSPC: "Make room, or name a folder on another disk.",
    errno.EDQUOT: "Make room, or name a folder on another disk.",
    errno.EFBIG: "Make room, or name a folder on another disk.",
    errno.EACCES: "Name a place that you may write to.",
    errno.EPERM: "Name a place that you may write to.",
    errno.EROFS: "Name a folder on another disk.",
    errno.EISDIR: "Name a file.",
}
"""By the number of an OSError."""


def describe_os_error(error: OSError) -> str:
    """File, what the operating system says, remedy."""
    text = error.strerror or str(error)
    said = " -> ".join(str(name) for name in (error.filename, error.filename2) if name is not None)
    remedy = REMEDIES.get(error.errno or 0, "Is the path right?")
    return f"{said}: {text}. {remedy}" if said else f"{text.rstrip('.')}. {remedy}"


def about(path: Path, error: OSError) -> OSError:
    """The error with its number and file. Polars writes the number into the text only, as `(os error 28)`."""
    digits = str(error).partition("(os error ")[2].partition(")")[0]
    number = int(digits) if error.errno is None and digits.isdigit() else error.errno
    if number is None:
        return OSError(f"{path}: {error}")
    return OSError(number, os.strerror(number), str(path))
