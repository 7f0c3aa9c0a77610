"""One impact from the equations of motion themselves: P 4.2, 4.3, 4.52 and 4.59, without their printed solutions.

A disk of mass m hits a wall: overlap' = -u_n, m overlap'' = -n, n = k_n overlap + gamma_n overlap', and the slip u_t of
the surfaces changes by 3 tau / m. The tangential spring follows the slip (sticking), or is held where k_t |stretch| is
mu n (sliding). Each phase is integrated by an explicit Runge-Kutta method of eighth order to a tight tolerance, and a
phase ends where an event says so. Units: SI. Signs: u_n < 0 on approach, tau acts on the disk along its slip.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from jostle_lab.statistics.estimates import Numbers

PRECISE = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-18}
MOST_PHASES = 400


@dataclass(frozen=True)
class Contact:
    """A disk and a wall."""

    mass: float = 4.5e-3
    """m_eff [kg]."""
    stiffness: float = 4.5e6
    """k_n [N/m]."""
    damping: float = 9.84
    """gamma_n [kg/s]."""
    ratio: float = 1.0
    """kappa = k_t / k_n."""
    friction: float = 0.1
    """mu."""
    load: float = 0.0
    """Acceleration that presses the disk on the wall [m/s^2]."""

    @property
    def frequency(self) -> float:
        """omega_0 = sqrt(k_n / m) [1/s]."""
        return float(np.sqrt(self.stiffness / self.mass))

    @property
    def damping_ratio(self) -> float:
        """Damping ratio c = beta / omega_0."""
        return self.damping / (2.0 * self.mass * self.frequency)

    @property
    def tangential(self) -> float:
        """k_t [N/m]."""
        return self.ratio * self.stiffness

    def normal(self, overlap: Any, rate: Any) -> Any:
        """4.53 [N]."""
        return self.stiffness * overlap + self.damping * rate

    def normal_rate(self, overlap: float, rate: float) -> float:
        """Derivative of the normal force [N/s], from the equation of motion."""
        return float(self.stiffness * rate + self.damping * (self.load - self.normal(overlap, rate) / self.mass))


@dataclass(frozen=True)
class Phase:
    """A time of sticking or of sliding."""

    sliding: bool
    start: float
    end: float
    """[s]."""
    state: Callable[[Any], Numbers]
    """Overlap [m], its rate [m/s], stretch [m], slip [m/s] at a time."""


@dataclass(frozen=True)
class Impact:
    """All phases of an impact, in their order."""

    contact: Contact
    phases: Sequence[Phase]

    @property
    def duration(self) -> float:
        """Until the normal force vanishes [s]."""
        return self.phases[-1].end

    def states(self, times: Numbers) -> Numbers:
        """Overlap, rate, stretch, slip at times within the impact; shape (4, times)."""
        found = np.empty((4, len(times)))
        for phase in self.phases:
            inside = (times >= phase.start) & (times <= phase.end)
            if inside.any():
                found[:, inside] = phase.state(times[inside])
        return found

    def forces(self, times: Numbers) -> tuple[Numbers, Numbers]:
        """Normal and tangential force [N]."""
        overlap, rate, stretch, _ = self.states(times)
        return np.asarray(self.contact.normal(overlap, rate)), -self.contact.tangential * stretch

    @property
    def restitutions(self) -> tuple[float, float]:
        """e_n and e_t."""
        first, last = self.phases[0].state(0.0), self.phases[-1].state(self.duration)
        return float(-last[1] / first[1]), float(last[3] / first[3])


def integrate(contact: Contact, approach: float, slip: float) -> Impact:
    """The impact with u_n = -`approach` and u_t = `slip` [m/s]."""
    state = np.array([0.0, approach, 0.0, slip])
    time = 0.0
    phases: list[Phase] = []
    limit = contact.friction * contact.normal_rate(0.0, approach)
    # Without damping the friction limit starts from zero: it slides at once if the spring would load faster.
    sliding = contact.damping == 0.0 and contact.tangential * abs(slip) > limit
    end = 20.0 * (1.0 + contact.damping_ratio) / contact.frequency
    while len(phases) < MOST_PHASES:
        phase, over = _phase(contact, state, time, end, sliding)
        phases.append(phase)
        if over:
            return Impact(contact, phases)
        time, sliding = phase.end, not sliding
        state = phase.state(time)
    raise RuntimeError(f"more than {MOST_PHASES} phases of sticking and sliding")


def _phase(c: Contact, state: Numbers, start: float, end: float, sliding: bool) -> tuple[Phase, bool]:
    sign = float(np.sign(state[2]) or np.sign(state[3]))

    def held(overlap: Any, rate: Any) -> Any:
        return sign * c.friction * c.normal(overlap, rate) / c.tangential

    def move(_: float, y: Numbers) -> list[float]:
        normal = c.normal(y[0], y[1])
        stretch = held(y[0], y[1]) if sliding else y[2]
        follow = sign * c.friction * c.normal_rate(y[0], y[1]) / c.tangential if sliding else y[3]
        return [y[1], c.load - normal / c.mass, follow, -3.0 * c.tangential * stretch / c.mass]

    def leave(_: float, y: Numbers) -> float:
        return float(c.normal(y[0], y[1]))

    def change(_: float, y: Numbers) -> float:
        if sliding:
            return float(sign * y[3] - c.friction * c.normal_rate(y[0], y[1]) / c.tangential)
        return float(c.tangential * abs(y[2]) - c.friction * c.normal(y[0], y[1]))

    for event, direction in ((leave, -1.0), (change, -1.0 if sliding else 1.0)):
        event.terminal, event.direction = True, direction  # type: ignore[attr-defined]
    step = 0.02 / (c.frequency * max(1.0, np.sqrt(3.0 * c.ratio)))
    found = solve_ivp(
        move, (start, end), state, events=(leave, change), dense_output=True, max_step=step, first_step=step, **PRECISE
    )
    if found.status != 1:
        raise RuntimeError("the impact does not end")

    def at(time: Any) -> Numbers:
        y = np.array(found.sol(time))
        if sliding:
            y[2] = held(y[0], y[1])
        return y

    return Phase(sliding, start, float(found.t[-1]), at), len(found.t_events[0]) > 0
