"""While packings are shaken: a picture of the first one now, and the page of results, both drawn again and again."""

import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from jostle_lab.demos.packing import figures, page
from jostle_lab.demos.packing.captions import NOW
from jostle_lab.plots.style import house_style, save
from jostle_lab.protocol.now import Now
from jostle_lab.protocol.packings import Watcher

BETWEEN_PICTURES = 8.0
"""Shortest time from one to the next [s]: drawing takes half a second of a processor."""


class Live(Watcher):
    """Draws into a results folder what it is told of.

    Args:
        results: the folder; it holds `run.json`.
        full_drive_gamma: Gamma of the empty base at A = 1.
        say: prints a line.
        started: `time.monotonic()` of the beginning.

    """

    def __init__(self, results: Path, full_drive_gamma: float, say: Callable[[str], None], started: float) -> None:
        self._results, self._gamma, self._say, self._started = results, full_drive_gamma, say, started
        self._latest: dict[int, Now] = {}
        self._drawn_at: float | None = None
        self._first: tuple[float, float] | None = None
        self._share = 0.0
        self._picture.unlink(missing_ok=True)

    @property
    def _picture(self) -> Path:
        return self._results / NOW.file

    def begin(self, share: float) -> None:
        """Write the page before there is anything to see; `share` is done already."""
        self._share, self._first = share, (time.monotonic(), share)
        path = page.write(self._results, page.Status("running", share))
        self._say(f"{path}: page of results; open it in a browser now, it loads itself again until all is done")

    def now(self, now: Now) -> None:
        """Keep what the packings do, for the next picture."""
        self._latest[now.seed] = now

    def tick(self, share: float) -> None:
        """Draw, if there is something new and enough time has passed."""
        self._share = share
        if not self._latest or (self._drawn_at is not None and time.monotonic() - self._drawn_at < BETWEEN_PICTURES):
            return
        first, now = self._drawn_at is None, self._latest[min(self._latest)]
        self._latest.clear()
        with house_style():
            save(figures.packing_now(now, now.amplitude * self._gamma), self._picture)
        page.write(self._results, page.Status("running", share, self._left()))
        self._drawn_at = time.monotonic()
        if first:
            after = self._drawn_at - self._started
            self._say(
                f"{self._picture}: first picture after {after:.0f} s: the disks of packing {now.seed}, coloured by how "
                "fast they turn, red clockwise and blue counter-clockwise; drawn again every few seconds"
            )

    def ended(self, said: str) -> None:
        """The run ended before it was finished; what fails now is nobody's concern any more."""
        with suppress(OSError):
            page.write(self._results, page.Status("stopped", self._share, said=said))

    def finished(self) -> None:
        """The pictures of the whole run are there."""
        self._picture.unlink(missing_ok=True)

    def _left(self) -> str:
        """Time on the clock that it still takes, in words."""
        if self._first is None:
            return ""
        since, share = self._first
        gained = self._share - share
        if gained <= 0.0:
            return ""
        return in_words((time.monotonic() - since) * (1.0 - self._share) / gained)


def in_words(seconds: float) -> str:
    """A time to wait, roughly."""
    for size, name in ((86_400.0, "days"), (3_600.0, "hours"), (60.0, "minutes")):
        if seconds >= 1.5 * size:
            return f"{seconds / size:.0f} {name}"
    return f"{max(5.0, 5.0 * round(seconds / 5.0)):.0f} seconds"
