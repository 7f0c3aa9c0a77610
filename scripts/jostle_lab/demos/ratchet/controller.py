"""Measured acceleration in, voltage out: holds Gamma of the base by feedback, period by period.

    a_1 = (2/T) integral of a exp(-i phase) over whole periods      lock-in at the phase of the drive
    U <- U (Gamma_set g / |a_1|)^gain                               an integrator of the logarithm

It knows no model of the shaker: whatever the shaker, the grains or the frequency do to the ratio of acceleration to
voltage is corrected by the same share of its logarithm each period. Stable for gains below 2 if the shaker settles
within a period; a shaker that takes longer needs a smaller gain. Not here: where Gamma and frequency should go
(`demo`).
"""

import cmath
import math
from dataclasses import dataclass, field

from jostle_lab.errors import LabError, require


@dataclass
class GammaController:
    """Voltage amplitude that holds Gamma."""

    target: float
    """Gamma to hold."""
    voltage: float
    """Amplitude now [V]; where to start."""
    limit: float
    """Largest amplitude [V] that the amplifier gives."""
    gravity: float
    """[m/s2]."""
    gain: float = 0.3
    """Share of the logarithmic error that a period corrects."""
    measured: float = field(default=0.0, init=False)
    """Gamma of the last whole period."""
    _sum: complex = field(default=0j, init=False)
    _samples: int = field(default=0, init=False)
    _turns: float = field(default=0.0, init=False)

    def __post_init__(self) -> None:
        """Refuse what cannot work."""
        require("Gamma to hold", self.target, 1e-3, 1e3, "Choose one between 0.1 and 30.")
        require("gain of the controller", self.gain, 1e-6, 1.9, "Choose one between 0.05 and 1.")
        require("voltage at the start [V]", self.voltage, 1e-6, self.limit, "Choose one between 0 and the limit.")

    def update(self, acceleration: float, turns: float) -> bool:
        """Take the acceleration [m/s2] at a phase of the drive [turns]; True at the end of a period.

        Raises LabError if the voltage would pass the limit.
        """
        whole = turns < self._turns
        if whole and self._samples > 0:
            self._correct()
        self._turns = turns
        self._sum += acceleration * cmath.exp(-1j * math.tau * turns)
        self._samples += 1
        return whole

    def _correct(self) -> None:
        self.measured = 2.0 * abs(self._sum) / self._samples / self.gravity
        self._sum, self._samples = 0j, 0
        # A base that hardly moves yet must not ask for everything at once.
        ratio = min(max(self.target / max(self.measured, 1e-9), 0.25), 4.0)
        wanted = self.voltage * ratio**self.gain
        if not wanted <= self.limit:
            raise LabError(
                f"The controller asks for {wanted:.3g} V, the amplifier gives {self.limit:g} V, at Gamma "
                f"{self.measured:.3g} of {self.target:g}. Lower Gamma, or the mass of the disks."
            )
        self.voltage = wanted
