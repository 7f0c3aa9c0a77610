"""Communication steps as long as the accuracy asked for allows: two half steps against one.

A step from t to t + h is done once whole and once in two halves, from the same saved state. The difference of both
ends over 2^p - 1 is the error of the halves, where p is the order of the exchange (Richardson). What it is compared
with grows with the step: an error per unit step, so that the errors of a second add up to the tolerance whatever the
steps. The halves are kept if their error is small enough, else the state is restored and a shorter step is tried. The
next step is by a PI controller of the error, within limits.

Sources: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, II.4; K. Gustafsson, ACM Trans.
Math. Softw. 17 (1991) 533 (PI controller of the step).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError, require


class Steppable(Protocol):
    """Models that advance together: a `Coupling`, or a master of one's own."""

    def advance_by(self, step: float) -> None:
        """One communication step of `step` [s]."""

    def observed(self) -> NDArray[np.float64]:
        """What the error is judged by, in units in which errors count alike."""

    def save(self) -> Any:
        """Handle of a copy of the state, for `restore` and `discard`."""

    def restore(self, saved: Any) -> None:
        """Return to the state of `saved`; `saved` stays valid."""

    def discard(self, saved: Any) -> None:
        """Free `saved`."""


@dataclass
class StepControl:
    """The accuracy asked for and the limits of the step, and what has been done so far."""

    tolerance: float
    """Error [units of `observed` per second] that a step may add."""
    least: float = 1e-6
    """Shortest step [s]; a step that would have to be shorter is an error."""
    greatest: float = 5e-3
    """Longest step [s]."""
    first: float = 1e-4
    """Where to begin [s]."""
    order: int = 2
    """Order p of the exchange, `Exchange.order`."""
    safety: float = 0.9
    """What of the step that seems right is taken."""
    shrink: float = 0.2
    """By which a step changes at least at once."""
    grow: float = 2.0
    """By which a step changes at most at once."""
    grid: int = 4
    """Steps in a factor of two; the step is rounded down to them, for models that prepare for a step. 0: none."""
    accepted: int = field(default=0, init=False)
    """Pairs of half steps kept."""
    rejected: int = field(default=0, init=False)
    """Steps done again."""
    steps: list[float] = field(default_factory=list, init=False)
    """Those kept [s]."""
    refusal: str = field(default="", init=False)
    """What a model said if it refused the step tried last, else nothing."""

    def __post_init__(self) -> None:
        """Refuse what cannot work."""
        require("tolerance per second", self.tolerance, 1e-300, 1e300, "Choose, say, 1e-3 of the largest value.")
        require("greatest step [s]", self.greatest, 1e-9, 1e300, "Choose, say, a tenth of the period of the drive.")
        require("least step [s]", self.least, 1e-9, self.greatest, "Choose one between 1e-7 s and the greatest.")
        require("first step [s]", self.first, self.least, self.greatest, "Choose one between least and greatest.")
        require("order of the exchange", self.order, 1, 10, "Take that of the exchange: Exchange.order.")
        self.next = self.first
        """Step [s] to try next."""
        self._error = 1.0  # of the last step kept, over the tolerance

    def rounded(self, step: float) -> float:
        """A step of the grid within the limits."""
        within = min(max(step, self.least), self.greatest)
        if self.grid <= 0:
            return within
        octaves = math.floor(self.grid * math.log2(within / self.greatest) + 1e-9) / self.grid
        return max(self.greatest * math.pow(2.0, octaves), self.least)

    def accept(self, step: float, error: float) -> None:
        """A step has been kept, with an `error` over the tolerance."""
        self.accepted += 1
        self.steps.append(step)
        error = max(error, 1e-10)
        factor = self.safety * error ** (-0.7 / self.order) * self._error ** (0.4 / self.order)
        self._error = max(error, 1e-4)
        self.next = self.rounded(step * min(max(factor, self.shrink), self.grow))

    def reject(self, step: float, error: float, time: float) -> None:
        """A step has been refused. Raises LabError if none is left to try."""
        self.rejected += 1
        if step <= self.least * (1.0 + 1e-6):
            raise LabError(
                f"At t = {time:.6g} s a step of {step:.3g} s has {error:.3g} times the error allowed, and no shorter "
                f"one may be tried. Raise the tolerance ({self.tolerance:g} per second) or lower the least step."
                f"{self.refusal}"
            )
        factor = self.safety * error ** (-1.0 / self.order) if math.isfinite(error) else self.shrink
        # A step less by one of the grid at least, else the same would be tried again.
        self.next = self.rounded(step * min(max(factor, self.shrink), 0.84))


def advance_controlled(
    system: Steppable,
    start: float,
    end: float,
    control: StepControl,
    watch: Callable[[float], None] = lambda time: None,
) -> None:
    """Go from `start` to `end` [s] by steps whose errors stay within the tolerance; `watch` is told every time reached.

    `control` may be used again for what follows: it goes on with the step that has proved right. Raises LabError when a
    model cannot save its state, when the step would fall below the least, and for an `end` before `start`.
    """
    require("start [s]", start, -1e300, 1e300, "Give the time at which the models are.")
    require("end [s]", end, start, 1e300, "Give a time that is not before the start.")
    time = start
    while end > time:
        left = end - time
        ends = left <= control.next * (1.0 + 1e-6)
        # Two equal steps where one would leave a splinter.
        step = left if ends else min(control.next, 0.5 * left) if left < 2.0 * control.next else control.next
        saved = system.save()
        try:
            error = _try(system, saved, step, control)
            if error <= 1.0:
                time = end if ends else time + step
                _keep(control, step, error)
                watch(time)
            else:
                system.restore(saved)
                control.reject(step, error, time)
        finally:
            system.discard(saved)


def _keep(control: StepControl, step: float, error: float) -> None:
    wanted = control.next
    control.accept(step, error)
    if step < wanted:  # one that was cut to fit says little about the next one
        control.next = max(control.next, wanted)


def _try(system: Steppable, saved: Any, step: float, control: StepControl) -> float:
    """Two half steps; their error over the tolerance, infinite where a model refuses any of the three."""
    control.refusal = ""
    try:
        system.advance_by(step)
        whole = system.observed().copy()
        system.restore(saved)
        system.advance_by(0.5 * step)
        system.advance_by(0.5 * step)
    except LabError as refusal:
        control.refusal = f" {refusal}"
        return math.inf
    error = float(np.max(np.abs(system.observed() - whole))) / (2**control.order - 1)
    return error / (step * control.tolerance) if math.isfinite(error) else math.inf
