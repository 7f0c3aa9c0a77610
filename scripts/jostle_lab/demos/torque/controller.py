"""A PI controller of the angular velocity of a disk, the plant that it is designed for, and its reference."""

import math
from dataclasses import dataclass, field

from jostle_lab.fmu.disk_on_two_supports import DiskFmu


@dataclass(frozen=True)
class Segment:
    """A reference that is held from a time on."""

    begin: float
    """[s]."""
    reference: float
    """[rad/s]."""


PROFILE = (Segment(0.0, 0.5), Segment(2.0, 0.02), Segment(4.0, -0.02), Segment(6.0, -0.5), Segment(8.0, 0.0))
"""Fast, slow, slow the other way through stick, fast, stop."""
END = 10.0
"""[s]."""


@dataclass(frozen=True)
class Plant:
    """What the controller is designed for."""

    inertia: float
    """m R^2 / 2 [kg m2]."""
    clockwise: float
    """A_S1, the torque that friction holds clockwise [N m]."""
    counter_clockwise: float
    """A_S2 [N m]."""

    @classmethod
    def of(cls, fmu: DiskFmu) -> "Plant":
        """Of the disk in an FMU, by P 5.3 to 5.5."""
        names = ("gravity", "disk.mass", "disk.radius", "contact.friction", "support.angle", "tilt")
        gravity, mass, radius, friction, half_angle, tilt = (fmu.read(name) for name in names)
        unit = gravity * mass * friction * radius / (math.cos(half_angle) * (1.0 + friction**2))
        shares = [math.cos(tilt) + sign * friction * math.sin(tilt) for sign in (1.0, -1.0)]
        return cls(0.5 * mass * radius**2, unit * shares[0], unit * shares[1])


@dataclass
class Controller:
    """Proportional and integral, with the integral held while the torque is at its bound.

    With I the inertia and no friction, `2 omega_c I` and `omega_c^2 I` make the closed loop a critically damped one.
    """

    plant: Plant
    rate: float = 20.0
    """omega_c [rad/s]."""
    bound: float = 0.0
    """Largest torque [N m]; 0: ten times what friction holds and what gives the rate in 1 / omega_c."""
    stored: float = field(default=0.0, init=False)
    """Torque of the integral [N m]."""
    acted_at: float = field(default=0.0, init=False)
    """Time of the last action [s]."""

    def __post_init__(self) -> None:
        """Choose the bound."""
        self.proportional, self.integral = 2.0 * self.rate * self.plant.inertia, self.rate**2 * self.plant.inertia
        if self.bound == 0.0:
            self.bound = 10.0 * max(self.plant.clockwise, self.plant.counter_clockwise, self.plant.inertia)

    def act(self, now: float, reference: float, velocity: float) -> float:
        """Torque from `now` [s] on [N m]. Calls may be apart by any time."""
        error = reference - velocity
        stored = self.stored + self.integral * error * (now - self.acted_at)
        self.acted_at = now
        wanted = self.proportional * error + stored
        torque = min(max(wanted, -self.bound), self.bound)
        if torque == wanted or (stored - self.stored) * wanted < 0.0:
            self.stored = stored
        return torque

    def start_from_stick(self, reference: float) -> None:
        """The disk has stopped: start the integral where friction gives way in the sense of the reference."""
        if reference != 0.0:
            self.stored = self.plant.counter_clockwise if reference > 0.0 else -self.plant.clockwise


def reference_at(now: float) -> float:
    """Reference [rad/s] at a time [s]."""
    return [segment.reference for segment in PROFILE if segment.begin <= now + 1e-12][-1]
