"""The order in which loudspeaker and grains exchange position, velocity and force.

    jacobi        both step from the values at t: the loudspeaker feels the force of the step before
    grains-first  the grains step with position and velocity extrapolated from the loudspeaker's present state; then
                  the loudspeaker takes the force averaged over that same step
    iterated      as grains-first, then the grains are rolled back and repeat the step to the loudspeaker's end state,
                  and the loudspeaker repeats it with the corrected force

The measure of the coupling error is the difference between the work done by the plate (force times the loudspeaker's
displacement) and the work received by the grains (force times the displacement of their base). It vanishes with h.
"""

from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.errors import LabError
from jostle_lab.fmu.grains import Grains
from jostle_lab.loudspeaker.model import Loudspeaker


class Coupling:
    """A loudspeaker and grains that advance together in steps of `loudspeaker.step_size`."""

    def __init__(self, loudspeaker: Loudspeaker, grains: Grains, exchange: Exchange = Exchange.GRAINS_FIRST) -> None:
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
            Exchange.ITERATED: self._advance_iterated,
        }[exchange]

    def advance(self) -> None:
        """One communication step."""
        self._advance()

    def run(self, steps: int) -> NDArray[np.float64]:
        """Advance by `steps`; return the base acceleration [m/s2] at the end of each, shape (steps,).

        Raises LabError when the base leaves the excursion of the driver, as it does in an unstable exchange.
        """
        acceleration = np.empty(steps)
        allowed = self.loudspeaker.driver.maximum_excursion
        for n in range(steps):
            self._advance()
            if not abs(self.loudspeaker.displacement) <= allowed:
                self._refuse_excursion()
            acceleration[n] = self.loudspeaker.acceleration(self.reaction_force)
        return acceleration

    def _refuse_excursion(self) -> None:
        speaker = self.loudspeaker
        raise LabError(
            f"{self.exchange.value} exchange: the base is at {speaker.displacement:.3g} m at t = {speaker.time:.6g} s, "
            f"the driver ends at +-{speaker.driver.maximum_excursion:g} m. An unstable exchange? Take a smaller step "
            f"(now {speaker.step_size:.3g} s) or the iterated exchange; or lower the drive."
        )

    def _move_loudspeaker(self, force: float) -> float:
        started = perf_counter()
        work = self.loudspeaker.advance(force)
        self.loudspeaker_cost += perf_counter() - started
        return work

    def _step_grains(self, displacement: float, velocity: float) -> float:
        return self.grains.step(displacement, velocity, self.loudspeaker.step_size)

    def _advance_jacobi(self) -> None:
        lagged = self.reaction_force
        self.reaction_force = self._step_grains(self.loudspeaker.displacement, self.loudspeaker.velocity)
        self.work_by_plate += self._move_loudspeaker(lagged)

    def _advance_grains_first(self) -> None:
        self.reaction_force = self._step_grains(self.loudspeaker.displacement, self.loudspeaker.velocity)
        self.work_by_plate += self._move_loudspeaker(self.reaction_force)

    def _advance_iterated(self) -> None:
        start, grains_start = self.loudspeaker.save(), self.grains.save()
        try:
            self._move_loudspeaker(self._step_grains(self.loudspeaker.displacement, self.loudspeaker.velocity))
            end_velocity = self.loudspeaker.velocity
            landing = self.loudspeaker.displacement - self.loudspeaker.step_size * end_velocity
            self.grains.restore(grains_start)
            self.loudspeaker.restore(start)
            self.reaction_force = self._step_grains(landing, end_velocity)
            self.work_by_plate += self._move_loudspeaker(self.reaction_force)
        finally:
            self.grains.discard(grains_start)
