"""Orders of the exchange between loudspeaker and grains, by name; `master` has what they do."""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from jostle_lab.fmu.names import EXTRAPOLATION_DEGREE

LANDING_DEGREE = 2
"""Of the extrapolation of grains whose base can be led to a given end: through the inputs at t alone."""


class Exchange(StrEnum):
    """Order of the exchange."""

    JACOBI = "jacobi"
    GRAINS_FIRST = "grains-first"
    PLANNED = "planned"
    ITERATED = "iterated"

    @property
    def parameters(self) -> Mapping[str, float]:
        """What it asks of the grains' parameters: planned and iterated need it, the others are the better for it."""
        return MappingProxyType({EXTRAPOLATION_DEGREE: LANDING_DEGREE})

    @property
    def lands(self) -> bool:
        """Whether the grains' base is led to a given end of the step."""
        return self in {Exchange.PLANNED, Exchange.ITERATED}

    @property
    def order(self) -> int:
        """Power of the step with which the error of the motion falls."""
        return 1 if self is Exchange.JACOBI else 2
