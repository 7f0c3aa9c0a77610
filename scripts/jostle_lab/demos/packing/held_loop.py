"""A loop with everything in it: amplifier, loudspeaker, grains, and a controller that holds Gamma.

Of each exchange: the longest step at which the loop can be trusted, and how its error falls with the step. Trusted in
two respects. At rest: without voltage the base comes to rest after the packing has collapsed on it; an unstable
exchange keeps it alive. In motion: Gamma is that asked for, and the work received is the work done by the plate, within
FAITHFUL.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling
from jostle_lab.demos.ratchet.controller import GammaController
from jostle_lab.errors import LabError
from jostle_lab.fmu.grains import Grains, GrainsFactory
from jostle_lab.loudspeaker.model import Loudspeaker
from jostle_lab.statistics.estimates import relative_error
from jostle_lab.tables import markdown_table

FREQUENCY = 80
"""Of the drive [Hz]."""
RATES = (160, 240, 320, 400, 480, 640, 800, 960, 1280, 1920, 2560, 3840, 5120, 7680, 10_240)
"""At which the loop is tried [steps a second]; multiples of the frequency of the drive."""
CONTROLLER_RATE = 640
"""Samples a second of the controller, whatever the exchange; at rates below it a sample a step."""
ALIVE = 1e-5
"""Deviation of the velocity [m/s] above which a base without drive is not at rest."""
FAITHFUL = 0.05
"""Relative errors of Gamma and of the work that are put up with."""
AMPLIFIER = 60.0
"""Largest voltage [V]."""
PERIODS = 6
"""Over which errors are measured: the controller has acted PERIODS - 1 times."""
SAMPLES_A_PERIOD = 4
ORDER_RATES = (640, 1280, 2560, 5120, 10_240)
REFERENCE_RATE = 81_920
RESTING_GAMMA, MOVING_GAMMA = 0.7, 2.0
"""Held while errors are measured, and while work is compared."""


class HeldLoop:
    """A coupling whose voltage a controller sets at the end of each period."""

    def __init__(self, grains: Grains, exchange: Exchange, rate: int, gamma: float) -> None:
        self.grains = grains
        self.speaker = Loudspeaker(1.0 / rate, FREQUENCY, grains.weight)
        self.coupling = Coupling(self.speaker, grains, exchange)
        voltage = self.speaker.voltage_for_acceleration(gamma * grains.gravity)
        self.controller = GammaController(gamma, 0.8 * voltage, AMPLIFIER, grains.gravity)
        self.speaker.voltage_amplitude = self.controller.voltage

        self._each = max(rate // CONTROLLER_RATE, 1)
        # The mean of a sine of the drive between two samples is less than its value in the middle by this factor.
        angle = math.pi * FREQUENCY * self._each / rate
        self._gain = angle / math.sin(angle) * rate / self._each
        self._velocity, self._steps = 0.0, 0

    def run(self, steps: int) -> NDArray[np.float64]:
        """Velocity of the base [m/s] at the end of each step, shape (steps,).

        The controller is given the change of the velocity between its samples: the acceleration from the force of the
        grains, which is known as a mean over steps, would lag by half a step.
        """
        velocities = np.empty(steps)
        for n in range(steps):
            self.coupling.run(1)
            velocities[n] = self.speaker.velocity
            self._steps += 1
            if self._steps % self._each:
                continue
            # Rounding must not move the end of a period by a step.
            turns = math.fmod(self.speaker.drive_turns + 1e-9, 1.0)
            if self.controller.update(self._gain * (velocities[n] - self._velocity), turns):
                self.speaker.voltage_amplitude = self.controller.voltage
            self._velocity = velocities[n]
        return velocities


def is_at_rest(grains: Grains, exchange: Exchange, rate: int, seconds: int) -> bool:
    """Whether the base is at rest `seconds` after the packing was let go, without voltage."""
    coupling = Coupling(Loudspeaker(1.0 / rate, FREQUENCY, grains.weight), grains, exchange)
    coupling.run(rate * seconds)
    velocities = np.empty(rate // 2)
    for n in range(velocities.size):
        coupling.advance()
        velocities[n] = coupling.loudspeaker.velocity
    return float(np.std(velocities)) < ALIVE


def is_faithful(grains: Grains, exchange: Exchange, rate: int, seconds: int) -> bool:
    """Whether Gamma is held and work is conserved between the models, after as long to settle."""
    loop = HeldLoop(grains, exchange, rate, MOVING_GAMMA)
    loop.run(rate * seconds)
    plate, received = loop.coupling.work_by_plate, grains.energy_input()
    velocities = loop.run(rate * seconds)
    plate, received = loop.coupling.work_by_plate - plate, grains.energy_input() - received
    sine = 2.0 * complex(np.mean(velocities * np.exp(-2j * np.pi * FREQUENCY / rate * np.arange(velocities.size))))
    gamma = math.tau * FREQUENCY * abs(sine) / grains.gravity
    return abs(gamma / MOVING_GAMMA - 1.0) < FAITHFUL and abs(plate / received - 1.0) < FAITHFUL


Trial = Callable[[Grains, Exchange, int, int], bool]


def longest(factory: GrainsFactory, exchange: Exchange, seconds: int, passes: Trial) -> float:
    """The longest step [s] up to which a loop passes at every one tried, 0 if at none."""
    found = 0.0
    for rate in sorted(RATES, reverse=True):
        grains = factory(1, {"initial.settled": 0, **exchange.parameters})
        try:
            if not passes(grains, exchange, rate, seconds):
                break
        except LabError:
            break
        finally:
            grains.close()
        found = 1.0 / rate
    return found


def errors(factory: GrainsFactory, exchange: Exchange, exact: NDArray[np.float64]) -> list[float]:
    """Rms error of the base's displacement over its rms, at each of ORDER_RATES; nan where the loop fails."""
    found = []
    for rate in ORDER_RATES:
        try:
            found.append(relative_error(displacements(factory, exchange, rate), exact))
        except LabError:
            found.append(math.nan)
    return found


def displacements(factory: GrainsFactory, exchange: Exchange, rate: int) -> NDArray[np.float64]:
    """Displacement of the base [m], SAMPLES_A_PERIOD times a period."""
    grains = factory(1, exchange.parameters)
    try:
        loop = HeldLoop(grains, exchange, rate, RESTING_GAMMA)
        path = np.empty(PERIODS * SAMPLES_A_PERIOD)
        for sample in range(path.size):
            loop.run(rate // (FREQUENCY * SAMPLES_A_PERIOD))
            path[sample] = loop.speaker.displacement
        return path
    finally:
        grains.close()


def table(factory: GrainsFactory, seconds: int = 2) -> str:
    """Markdown table: a row for each exchange."""
    exact = displacements(factory, Exchange.ITERATED, REFERENCE_RATE)
    rows = []
    for exchange in Exchange:
        steps = [longest(factory, exchange, seconds, trial) for trial in (is_at_rest, is_faithful)]
        found = errors(factory, exchange, exact)
        known = [(math.log(rate), math.log(e)) for rate, e in zip(ORDER_RATES, found, strict=True) if e > 0.0]
        order = math.nan
        if len(known) >= 3:
            order = -float(np.polyfit([rate for rate, _ in known], [error for _, error in known], 1)[0])
        rows.append([exchange.value, *(f"{1e3 * step:.3g}" for step in steps), *(f"{e:.1e}" for e in found)])
        rows[-1].append(f"{order:.2f}")
    trusted = ["longest step at rest [ms]", f"at Gamma {MOVING_GAMMA:g} [ms]"]
    header = ["exchange", *trusted, *(f"error at {rate} a second" for rate in ORDER_RATES), "order"]
    return markdown_table(header, rows)
