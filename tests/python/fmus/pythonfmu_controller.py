"""A controller that pythonfmu makes an FMU of: shakes a base so that the grains push harder, up to a limit."""

import math

from pythonfmu.enums import Fmi2Causality
from pythonfmu.fmi2slave import Fmi2Slave
from pythonfmu.variables import Real

OMEGA = 2.0 * math.pi * 20.0
LARGEST_AMPLITUDE = 1e-3


class Controller(Fmi2Slave):
    """Outputs displacement [m] and velocity [m/s] of the base; input is the force [N] of the grains on it."""

    def __init__(self, **arguments: object) -> None:
        super().__init__(**arguments)
        self.force = 0.0
        self.amplitude = 1e-4
        self.displacement = 0.0
        self.velocity = 0.0
        self.register_variable(Real("force", causality=Fmi2Causality.input))
        for output in ("displacement", "velocity"):
            self.register_variable(Real(output, causality=Fmi2Causality.output))

    def do_step(self, current_time: float, step_size: float) -> bool:
        """The amplitude grows while the force is below 3 N; the base moves as a sine of it."""
        self.amplitude = min(LARGEST_AMPLITUDE, self.amplitude + step_size * 1e-3 * (3.0 - abs(self.force)))
        phase = OMEGA * (current_time + step_size)
        self.displacement = self.amplitude * (1.0 - math.cos(phase))
        self.velocity = self.amplitude * OMEGA * math.sin(phase)
        return True
