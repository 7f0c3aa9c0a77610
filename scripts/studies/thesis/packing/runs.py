"""Packings of 60 disks as P 3.2 and 3.3 shake them: gravity, frequency, methods."""

import math
from dataclasses import dataclass

GRAVITY = 9.8
FREQUENCY = 80.0
DISKS = 60


def amplitude(gamma: float, frequency: float = FREQUENCY) -> float:
    """A [m] of dimensionless acceleration Gamma = A omega_b^2 / g."""
    return gamma * GRAVITY / (math.tau * frequency) ** 2


@dataclass(frozen=True)
class Method:
    """How a packing is simulated."""

    engine: str
    base: int | None
    """Bottom of the event-driven packing: 1 random phase, 2 moving."""
    name: str

    def settings(self) -> tuple[tuple[str, float], ...]:
        """Parameters that choose it."""
        return () if self.base is None else (("base.model", self.base),)


MOLECULAR = Method("molecular-dynamics", None, "MD")
RANDOM_PHASE = Method("event-driven", 1, "ED, random phase")
MOVING = Method("event-driven", 2, "ED, moving base")


def shaken(
    method: Method, stiffness: float, gamma: float, seed: int, start: float, frequency: float = FREQUENCY
) -> tuple[tuple[str, float], ...]:
    """Parameters of a packing whose rotation is measured from `start` [s] on; others are those of P 3.2."""
    return (
        ("seed", seed),
        ("gravity", GRAVITY),
        ("drive.amplitude", amplitude(gamma, frequency)),
        ("drive.frequency", frequency),
        ("contact.normal_stiffness", stiffness),
        ("measure.start", start),
        *method.settings(),
    )
