"""A ratchet FMU as `Grains`: disks that flow sideways on a sawtooth."""

import numpy as np

from jostle_lab.errors import LabError
from jostle_lab.fmu_grains import FmuGrains


class FmuRatchet(FmuGrains):
    """One instance of a ratchet FMU. Needs equal masses, the scene's default."""

    scene = "ratchet"

    def _width_and_weight(self) -> tuple[float, float]:
        """By the layer count, n = N 2 r_min / width, and the equal masses."""
        width = len(self.radii) * 2.0 * self.read("disk.radius_min") / self.read("layers")
        return width, len(self.radii) * self.read("disk.mass") * self.gravity

    def travelled(self) -> float:
        """Mean place of the disks to the right [m], periods undone."""
        place = float(np.mean(self.positions()[:, 0]))
        if not np.isfinite(place):
            raise LabError(f"{self.path}: the disks are at {place} m.")
        return place
