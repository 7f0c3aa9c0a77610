"""Progress of long work: a bar on a terminal; in a pipe or a log a line now and then, without control characters."""

import sys
from collections.abc import Iterable
from typing import Any

from tqdm import tqdm

BETWEEN_LINES = 15.0
"""Shortest time from line to line where no terminal is [s]."""
BAR = "{desc}: {percentage:3.0f} %|{bar}| {n_fmt} of {total_fmt} {unit}, {remaining} left{postfix}"
LINE = "{desc}: {percentage:.0f} %, {n_fmt} of {total_fmt} {unit}, {elapsed} gone, {remaining} left{postfix}"


class _Lines(tqdm):  # type: ignore[misc]
    """Progress as plain lines."""

    disable: bool
    n: float

    def display(self, msg: str | None = None, pos: int | None = None) -> None:
        """A line with what is done."""
        del pos
        self.fp.write(f"{msg if msg is not None else self}\n")
        self.fp.flush()

    def close(self) -> None:
        """The last line, if it says something new."""
        if self.disable:
            return
        if self.n != self.last_print_n:
            self.display()
        self.disable = True
        self._decr_instances(self)

    def clear(self, *_: Any, **__: Any) -> None:
        """Lines stay."""


def progress(
    items: Iterable[Any] | None = None,
    *,
    what: str,
    total: float | None = None,
    done: float = 0,
    unit: str,
    show: bool = True,
    **others: Any,
) -> Any:
    """A bar of tqdm, or lines: `update(n)`, `set_postfix`, a `with` block; iterating it goes through `items`."""
    terminal = sys.stderr.isatty()
    kind, layout, pause = (tqdm, BAR, 0.5) if terminal else (_Lines, LINE, BETWEEN_LINES)
    return kind(
        items,
        total=total,
        initial=done,
        desc=what,
        unit=unit,
        disable=not show,
        bar_format=layout,
        mininterval=pause,
        maxinterval=max(pause, 10.0),
        dynamic_ncols=terminal,
        **others,
    )


def say(text: str) -> None:
    """A line on stdout, above the bar if there is one."""
    tqdm.write(text, file=sys.stdout)
    sys.stdout.flush()
