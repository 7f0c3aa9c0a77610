"""The order in which loudspeaker and grains exchange motion and force.

    jacobi        both step from the values at t: the loudspeaker feels the force of the step before
    grains-first  the grains step with the motion of the loudspeaker at t, which they extrapolate; then the loudspeaker
                  takes the force averaged over that same step
    planned       the loudspeaker takes the step under the force of the step before, so that the drive and its own
                  dynamics are known; the grains step to where that led; then the loudspeaker repeats the step with
                  their force. The grains are not rolled back, the loudspeaker is
    iterated      as grains-first, then the grains are rolled back and repeat the step to the loudspeaker's end state,
                  and the loudspeaker repeats it with the corrected force

The motion is displacement, velocity and acceleration, the last under the force of the step before. The measure of the
coupling error is the difference between the work done by the plate (force times the loudspeaker's displacement) and the
work received by the grains (force times the displacement of their base). It vanishes with h.
"""

import math
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from jostle_lab.coupling.exchange import LANDING_DEGREE, Exchange
from jostle_lab.errors import LabError
from jostle_lab.fmu.grains import Grains
from jostle_lab.fmu.names import EXTRAPOLATION_DEGREE
from jostle_lab.loudspeaker.model import Loudspeaker


class Motion(NamedTuple):
    """Of the base."""

    displacement: float
    """[m]."""
    velocity: float
    """[m/s]."""
    acceleration: float
    """[m/s2]."""

    def moved(self, time: float) -> "Motion":
        """The motion `time` [s] later, at this acceleration; earlier, if it is negative."""
        x, v, a = self
        return Motion(x + time * v + 0.5 * time**2 * a, v + time * a, a)


def check_landing(exchange: Exchange, grains: Grains) -> None:
    """Raise LabError for a planned or an iterated exchange with grains that extrapolate with another degree."""
    if exchange.lands and grains.extrapolation_degree != LANDING_DEGREE:
        raise LabError(
            f"The {exchange.value} exchange needs grains with {EXTRAPOLATION_DEGREE} = {LANDING_DEGREE}, not "
            f"{grains.extrapolation_degree}. Leave out --set {EXTRAPOLATION_DEGREE}, in Python make the grains with "
            f"Exchange.parameters; or take the {Exchange.GRAINS_FIRST.value} exchange."
        )


class Coupling:
    """A loudspeaker and grains that advance together in steps of `loudspeaker.step_size`.

    Raises LabError for grains that `check_landing` refuses.
    """

    def __init__(self, loudspeaker: Loudspeaker, grains: Grains, exchange: Exchange = Exchange.GRAINS_FIRST) -> None:
        check_landing(exchange, grains)
        self.loudspeaker = loudspeaker
        self.grains = grains
        self.exchange = exchange
        self.reaction_force = -loudspeaker.grains_weight
        """Force of the grains on the base over the last step [N], up positive."""
        self.work_by_plate = 0.0
        """Work [J] done by the loudspeaker's plate on the grains since the start."""
        self.loudspeaker_cost = 0.0
        """Seconds of wall clock spent on the loudspeaker."""
        self._advance = {
            Exchange.JACOBI: self._advance_jacobi,
            Exchange.GRAINS_FIRST: self._advance_grains_first,
            Exchange.PLANNED: self._advance_planned,
            Exchange.ITERATED: self._advance_iterated,
        }[exchange]

    def advance(self) -> None:
        """One communication step."""
        self._advance()

    def advance_by(self, step: float) -> None:
        """One communication step of `step` [s]; see `step_control.Steppable`.

        Raises LabError when the base leaves the excursion of the driver.
        """
        self.loudspeaker.change_step(step)
        self._advance()
        self.check_excursion()

    def observed(self) -> NDArray[np.float64]:
        """Displacement of the base, and its velocity over the angular frequency of the drive [m], shape (2,)."""
        speaker = self.loudspeaker
        return np.array([speaker.displacement, speaker.velocity / (math.tau * speaker.drive_frequency)])

    def run(self, steps: int) -> NDArray[np.float64]:
        """Advance by `steps`; return the base acceleration [m/s2] at the end of each, shape (steps,).

        Raises LabError when the base leaves the excursion of the driver, as it does in an unstable exchange.
        """
        acceleration = np.empty(steps)
        for n in range(steps):
            self._advance()
            self.check_excursion()
            acceleration[n] = self.loudspeaker.acceleration(self.reaction_force)
        return acceleration

    def check_excursion(self) -> None:
        """Raise LabError when the base has left the excursion of the driver."""
        speaker = self.loudspeaker
        if abs(speaker.displacement) <= speaker.driver.maximum_excursion:
            return
        raise LabError(
            f"{self.exchange.value} exchange: the base is at {speaker.displacement:.3g} m at t = {speaker.time:.6g} s, "
            f"the driver ends at +-{speaker.driver.maximum_excursion:g} m. An unstable exchange? Take a smaller step "
            f"(now {speaker.step_size:.3g} s) or the iterated exchange; or lower the drive."
        )

    def motion(self) -> Motion:
        """Of the loudspeaker now, under the force of the last step."""
        speaker = self.loudspeaker
        return Motion(speaker.displacement, speaker.velocity, speaker.acceleration(self.reaction_force))

    def save(self) -> Any:
        """Everything that `advance` changes, for `restore` and `discard`."""
        return self.loudspeaker.save(), self.grains.save(), self.reaction_force, self.work_by_plate

    def restore(self, saved: Any) -> None:
        """Return to the state of `saved`, which stays valid."""
        speaker, grains, self.reaction_force, self.work_by_plate = saved
        self.loudspeaker.restore(speaker)
        self.grains.restore(grains)

    def discard(self, saved: Any) -> None:
        """Free `saved`."""
        self.grains.discard(saved[1])

    def _move_loudspeaker(self, force: float) -> float:
        started = perf_counter()
        work = self.loudspeaker.advance(force)
        self.loudspeaker_cost += perf_counter() - started
        return work

    def _step_grains(self, motion: Motion) -> float:
        return self.grains.step(*motion, self.loudspeaker.step_size)

    def _advance_jacobi(self) -> None:
        lagged, motion = self.reaction_force, self.motion()
        self.reaction_force = self._step_grains(motion)
        self.work_by_plate += self._move_loudspeaker(lagged)

    def _advance_grains_first(self) -> None:
        self.reaction_force = self._step_grains(self.motion())
        self.work_by_plate += self._move_loudspeaker(self.reaction_force)

    def _landing(self) -> Motion:
        """The inputs at the start of a step that lead the base to the present motion of the loudspeaker at its end."""
        return self.motion().moved(-self.loudspeaker.step_size)

    def _advance_planned(self) -> None:
        start = self.loudspeaker.save()
        self._move_loudspeaker(self.reaction_force)
        landing = self._landing()
        self.loudspeaker.restore(start)
        self.reaction_force = self._step_grains(landing)
        self.work_by_plate += self._move_loudspeaker(self.reaction_force)

    def _advance_iterated(self) -> None:
        start, grains_start = self.loudspeaker.save(), self.grains.save()
        try:
            self.reaction_force = self._step_grains(self.motion())
            self._move_loudspeaker(self.reaction_force)
            landing = self._landing()
            self.grains.restore(grains_start)
            self.loudspeaker.restore(start)
            self.reaction_force = self._step_grains(landing)
            self.work_by_plate += self._move_loudspeaker(self.reaction_force)
        finally:
            self.grains.discard(grains_start)
