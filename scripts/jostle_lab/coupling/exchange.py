"""Orders of the exchange between loudspeaker and grains, by name; `master` has what they do."""

from enum import StrEnum


class Exchange(StrEnum):
    """Order of the exchange."""

    JACOBI = "jacobi"
    GRAINS_FIRST = "grains-first"
    ITERATED = "iterated"
