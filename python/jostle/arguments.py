"""Arguments of calls, checked before anything is done: numbers, whole numbers, texts."""

import math
from typing import Any

from jostle.errors import ParameterError

LONGEST = 80
"""Characters of what was given that a message shows."""


def shown(value: object) -> str:
    """Return what was given as a message shows it: texts in quotation marks, nothing longer than a line."""
    text = repr(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def seconds(name: str, value: Any) -> float:
    """Return a time above 0 [s].

    Raises:
        ParameterError: anything else.

    """
    number = _real(value)
    if not (math.isfinite(number) and number > 0.0):
        raise ParameterError.of(name, shown(value), "a time above 0 s", "Give a time in seconds such as 10 or 1e-3.")
    return number


def instant(name: str, value: Any) -> float:
    """Return a point of time [s].

    Raises:
        ParameterError: anything else.

    """
    number = _real(value)
    if not math.isfinite(number):
        raise ParameterError.of(name, shown(value), "a finite time in s", "Give a time in seconds such as 10 or 1e-3.")
    return number


def whole(name: str, value: Any, least: int, most: int, remedy: str) -> int:
    """Return a whole number from `least` to `most`.

    Raises:
        ParameterError: anything else.

    """
    try:
        number = value.__index__()
    except (AttributeError, TypeError):
        number = least - 1
    if not least <= number <= most:
        raise ParameterError.of(name, shown(value), f"a whole number from {least} to {most}", remedy)
    return int(number)


def text(name: str, value: Any, remedy: str) -> str:
    """Return a text.

    Raises:
        ParameterError: anything else.

    """
    if not isinstance(value, str) or not value.isprintable():
        raise ParameterError.of(name, shown(value), "a name", remedy)
    return value


def _real(value: Any) -> float:
    if isinstance(value, str | bytes):
        return math.nan
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        return math.nan
