"""Of curves whose setting is a step: the longest step for an error, and the order."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from jostle_lab.tables import markdown_table

ERRORS = (1e-2, 1e-3, 1e-4)


class Curve(NamedTuple):
    """One method."""

    method: str
    order: float | None
    errors: Sequence[tuple[float, float]]
    """Steps [s] and their errors."""


def step_at(errors: Sequence[tuple[float, float]], error: float) -> float | None:
    """The longest step up to which the curve stays within `error`, along straight lines between its points [s].

    None if its shortest step does not reach the error.
    """
    path = sorted(errors)
    if not path or path[0][1] > error:
        return None
    for (short, least), (long, greater) in pairwise(path):
        if greater > error:
            share = math.log(error / least) / math.log(greater / least)
            return float(short * (long / short) ** share)
    return path[-1][0]


def section(curves: Sequence[Curve]) -> str:
    """Table of all curves."""
    rows = []
    for method, order, errors in curves:
        longest = max(errors)[0]
        steps = [step_at(errors, error) for error in ERRORS]
        words = ["" if s is None else f"{s:.2e}" if s < longest else f"{s:.2e} or more" for s in steps]
        rows.append([method, "" if order is None else f"{order:.2f}", *words])
    header = ["method", "order", *(f"step for {error:.0e} [s]" for error in ERRORS)]
    text = "The longest step up to which the error stays below a bound, along straight lines between the points."
    return f"{text}\n\n{markdown_table(header, rows)}"
