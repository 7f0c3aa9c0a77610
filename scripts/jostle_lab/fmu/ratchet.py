"""A ratchet FMU as `Grains`: disks that flow sideways on a sawtooth."""

from jostle_lab.fmu.packing import FmuGrains
from jostle_lab.statistics.estimates import Estimate

CENTIMETRE = 100.0
"""cm in a metre."""


class FmuRatchet(FmuGrains):
    """One instance of a ratchet FMU. Needs equal masses, the scene's default."""

    scene = "ratchet"
    marks = 0
    """Times that the averages were started anew."""

    def _width_and_weight(self) -> tuple[float, float]:
        """By the layer count, n = N 2 r_min / width, and the equal masses."""
        width = len(self.radii) * 2.0 * self.read("disk.radius_min") / self.read("layers")
        return width, len(self.radii) * self.read("disk.mass") * self.gravity

    def restart_averages(self) -> None:
        """Start the averages anew at the next step."""
        self.marks += 1
        self.write("measure.mark", float(self.marks))

    def transport(self) -> Estimate:
        """Mean velocity to the right since the averages were started, and its standard error by batch means [cm/s]."""
        mean, error = self.read("transport_velocity"), self.read("transport_velocity.standard_error")
        return Estimate(CENTIMETRE * mean, CENTIMETRE * error)

    def mean_displacement(self) -> float:
        """Mean place of the disks to the right [m], periods undone."""
        return float(self.positions()[:, 0].mean())
