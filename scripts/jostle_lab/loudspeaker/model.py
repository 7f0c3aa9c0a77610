"""Amplifier voltage and the force of the grains in, motion of the base out.

    L di/dt = u - R i - Bl v                       coil: resistance, inductance, back-EMF
    dx/dt   = v
    m dv/dt = Bl i - R_ms v - k x + (F + W)        F: force of the grains on the base [N], up positive

x [m] counts from the equilibrium under the weight of the moving parts and of the grains, W [N]; so grains at rest
(F = -W) leave the base at rest. The system is linear and is stepped exactly, whatever the step: the drive
u = U sin(2 pi f t) as a harmonic oscillator joined to the state, F constant over the step. U and f may change from
step to step. Guarantees: no error of its
own but rounding. Not here: order of the exchange with the grains (`coupling`).
"""

import cmath
import math
from dataclasses import dataclass
from operator import mul
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from jostle_lab.errors import require
from jostle_lab.loudspeaker.driver import CARRIED_MASS, GBS_250F38CP01_04, Driver

DIGITS = 12
"""Decimal places of the transition matrix: those that linear algebra on every processor agrees on."""


@dataclass(frozen=True)
class SteadyState:
    """Amplitudes of the unloaded, sinusoidal steady state (peak values, complex: phase against u = sin)."""

    current: complex
    displacement: complex
    velocity: complex
    acceleration: complex


STEPS = 1e-7, 1.0
"""Least and greatest communication step [s]."""
KEPT_TRANSITIONS = 64
"""Steps whose matrices are kept."""


class Mark(NamedTuple):
    """When step or frequency changed last: what is counted from there."""

    steps: int = 0
    time: float = 0.0
    turns: float = 0.0


class Loudspeaker:
    """A driver that carries the rail and the bottom of the box, stepped exactly; the step changes only when told.

    Args:
        step: communication step h [s].
        drive_frequency: f [Hz].
        grains_weight: static load W [N] that the suspension already carries at x = 0.
        driver: Thiele-Small parameters.
        carried_mass: mass bolted to the cone [kg].

    """

    def __init__(
        self,
        step: float,
        drive_frequency: float = 80.0,
        grains_weight: float = 0.0,
        driver: Driver = GBS_250F38CP01_04,
        carried_mass: float = CARRIED_MASS,
    ) -> None:
        self.step_size = require("communication step [s]", step, *STEPS, "Choose a step between 1e-5 and 1e-3 s.")
        self.drive_frequency = require("drive frequency [Hz]", drive_frequency, 1e-3, 1e5, "The thesis drives at 80.")
        self.grains_weight = grains_weight
        self.driver = driver
        self.mass = driver.moving_mass + carried_mass
        self.voltage_amplitude = 0.0
        self.steps_taken = 0
        self._mark = Mark()
        self._state = np.zeros(3)
        self._transitions: dict[tuple[float, float], list[list[float]]] = {}
        self._transition = self._transition_matrix()

    def system_matrix(self) -> NDArray[np.float64]:
        """Matrix of d/dt (i, x, v) = A (i, x, v) without drive and grains, shape (3, 3)."""
        d = self.driver
        return np.array(
            [
                [-d.coil_resistance / d.coil_inductance, 0.0, -d.force_factor / d.coil_inductance],
                [0.0, 0.0, 1.0],
                [d.force_factor / self.mass, -d.suspension_stiffness / self.mass, -d.suspension_damping / self.mass],
            ]
        )

    def _transition_matrix(self) -> list[list[float]]:
        """First three rows of exp(M h) for the state (i, x, v, F + W, u, du/dt / (2 pi f)), shape (3, 6)."""
        key = (self.step_size, self.drive_frequency)
        if key not in self._transitions:
            while len(self._transitions) >= KEPT_TRANSITIONS:
                del self._transitions[next(iter(self._transitions))]
            angular_frequency = math.tau * self.drive_frequency
            joined = np.zeros((6, 6))
            joined[:3, :3] = self.system_matrix()
            joined[2, 3] = 1.0 / self.mass
            joined[0, 4] = 1.0 / self.driver.coil_inductance
            joined[4, 5] = angular_frequency
            joined[5, 4] = -angular_frequency
            exact = expm(joined * self.step_size)[:3]
            self._transitions[key] = [[float(f"{value:.{DIGITS}e}") for value in row] for row in exact.tolist()]
        return self._transitions[key]

    def retune(self, drive_frequency: float) -> None:
        """Drive at another frequency [Hz] from now on; the voltage goes on without a jump in phase."""
        require("drive frequency [Hz]", drive_frequency, 1e-3, 1e5, "Choose one between 5 and 500.")
        self._mark = Mark(self.steps_taken, self.time, self.drive_turns)
        self.drive_frequency = drive_frequency
        self._transition = self._transition_matrix()

    def change_step(self, step: float) -> None:
        """Take steps of this length [s] from now on."""
        if step == self.step_size:
            return
        require("communication step [s]", step, *STEPS, "Choose a step between 1e-5 and 1e-3 s.")
        self._mark = Mark(self.steps_taken, self.time, self.drive_turns)
        self.step_size = step
        self._transition = self._transition_matrix()

    @property
    def drive_turns(self) -> float:
        """Phase of the voltage in turns, in [0, 1)."""
        since = self.steps_taken - self._mark.steps
        return math.fmod(self._mark.turns + self.drive_frequency * since * self.step_size, 1.0)

    @property
    def time(self) -> float:
        """Time [s]: steps taken times step while the step stays the same, never a running sum."""
        return self._mark.time + (self.steps_taken - self._mark.steps) * self.step_size

    @property
    def current(self) -> float:
        """Coil current [A]."""
        return float(self._state[0])

    @property
    def displacement(self) -> float:
        """Base displacement from equilibrium [m], up positive."""
        return float(self._state[1])

    @property
    def velocity(self) -> float:
        """Base velocity [m/s]."""
        return float(self._state[2])

    def acceleration(self, reaction_force: float) -> float:
        """Base acceleration [m/s2] while the grains push with `reaction_force` [N, up positive]."""
        current, displacement, velocity = self._state.tolist()
        d = self.driver
        force = d.force_factor * current - d.suspension_damping * velocity - d.suspension_stiffness * displacement
        return float((force + reaction_force + self.grains_weight) / self.mass)

    def advance(self, reaction_force: float) -> float:
        """One step under the constant `reaction_force` [N]; return the work [J] done by the base on the grains.

        The work is the exact integral -F (x(t + h) - x(t)) of a force that is constant over the step.
        """
        before = self._state[1]
        phase = math.tau * self.drive_turns
        drive = (self.voltage_amplitude * math.sin(phase), self.voltage_amplitude * math.cos(phase))
        entries = [*self._state.tolist(), reaction_force + self.grains_weight, *drive]
        # Rounded once: vector units add up in an order of their own, and grains make another run of another last bit.
        self._state = np.array([math.fsum(map(mul, row, entries)) for row in self._transition])
        self.steps_taken += 1
        return float(-reaction_force * (self._state[1] - before))

    def save(self) -> tuple[NDArray[np.float64], int, float, Mark]:
        """Everything that `advance` and `change_step` change."""
        return self._state.copy(), self.steps_taken, self.step_size, self._mark

    def restore(self, saved: tuple[NDArray[np.float64], int, float, Mark]) -> None:
        """Return to a state that `save` gave; the drive frequency stays."""
        state, self.steps_taken, self.step_size, self._mark = saved
        self._state = state.copy()
        self._transition = self._transition_matrix()

    def energy(self) -> float:
        """Magnetic, elastic and kinetic energy [J], zero at equilibrium."""
        d = self.driver
        current, displacement, velocity = self._state.tolist()
        return 0.5 * float(
            d.coil_inductance * current**2 + d.suspension_stiffness * displacement**2 + self.mass * velocity**2
        )

    def steady_state(self, voltage_amplitude: float) -> SteadyState:
        """Unloaded response to u = U sin(2 pi f t): each signal is Im(phasor exp(2 pi i f t))."""
        d = self.driver
        s = 1j * math.tau * self.drive_frequency
        mechanical = self.mass * s + d.suspension_damping + d.suspension_stiffness / s
        electrical = d.coil_resistance + s * d.coil_inductance
        current = voltage_amplitude / (electrical + d.force_factor**2 / mechanical)
        velocity = d.force_factor * current / mechanical
        return SteadyState(current, velocity / s, velocity, velocity * s)

    def voltage_for_acceleration(self, amplitude: float) -> float:
        """Voltage amplitude [V] whose unloaded response has the acceleration `amplitude` [m/s2].

        Raises LabError beyond the thermal rating or the linear excursion (weight included) of the driver.
        """
        d = self.driver
        voltage = amplitude / abs(self.steady_state(1.0).acceleration)
        response = self.steady_state(voltage)
        power = 0.5 * abs(response.current) ** 2 * d.coil_resistance
        remedy = "Lower the acceleration at full drive or choose a stronger driver."
        require("coil power at full drive [W]", power, 0.0, d.rated_power, remedy)
        excursion = abs(response.displacement) + self.static_sag()
        require("excursion at full drive, sag included [m]", excursion, 0.0, d.maximum_excursion, remedy)
        return voltage

    def static_sag(self, gravity: float = 9.8) -> float:
        """How far [m] the weight of the moving parts and of the grains presses the suspension down."""
        return (self.mass * gravity + self.grains_weight) / self.driver.suspension_stiffness


def phase_of(phasor: complex) -> float:
    """Phase [rad] of a steady-state signal against the voltage."""
    return cmath.phase(phasor)
