"""What the loudspeaker has to move and what moves it: a real driver and the estimated masses of the rail.

The thesis names neither the driver nor any mass. The driver is a catalogue part; the masses are estimated below from
the dimensions that P 2.4.1 gives. Not here: motion (`loudspeaker`).
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Driver:
    """Small-signal (Thiele-Small) parameters of a loudspeaker driver."""

    name: str
    source: str
    coil_resistance: float
    """R_e [ohm]."""
    coil_inductance: float
    """L_e [H]."""
    force_factor: float
    """Bl [N/A = V.s/m]."""
    moving_mass: float
    """M_ms, cone, coil and air [kg]."""
    suspension_stiffness: float
    """1 / C_ms [N/m]."""
    suspension_damping: float
    """R_ms [kg/s]."""
    maximum_excursion: float
    """X_max, one way, linear [m]."""
    rated_power: float
    """Thermal power of the coil [W]."""


def damping_of_quality(moving_mass: float, suspension_stiffness: float, mechanical_quality: float) -> float:
    """R_ms [kg/s] = sqrt(M_ms / C_ms) / Q_ms, the definition of the mechanical quality factor."""
    return math.sqrt(moving_mass * suspension_stiffness) / mechanical_quality


GBS_250F38CP01_04 = Driver(
    name="Tymphany GBS-250F38CP01-04, 10 inch, 4 ohm",
    source="Tymphany HK Ltd, Driver Specification Sheet GBS-250F38CP01-04, revision 3, 2019-01-17",
    coil_resistance=3.45,
    coil_inductance=2.36e-3,
    force_factor=13.11,
    moving_mass=0.1034,
    suspension_stiffness=1.0 / 172.5e-6,
    suspension_damping=damping_of_quality(0.1034, 1.0 / 172.5e-6, 5.62),
    maximum_excursion=6e-3,
    rated_power=200.0,
)
"""C_ms 172.5 um/N and Q_ms 5.62 on the sheet; f_s = 37.69 Hz follows from them and checks the transcription."""

ALUMINIUM_DENSITY = 2700.0  # kg/m3
PROFILE_LENGTH = 0.40  # m, P 2.4.1


def _rectangular_tube_mass(width: float, height: float, wall: float, length: float) -> float:
    """Mass [kg] of an aluminium tube of outer cross-section width x height [m]."""
    area = width * height - (width - 2.0 * wall) * (height - 2.0 * wall)
    return ALUMINIUM_DENSITY * area * length


def _angle_mass(leg: float, thickness: float, length: float) -> float:
    """Mass [kg] of an aluminium L of two equal legs [m]."""
    return ALUMINIUM_DENSITY * (2.0 * leg - thickness) * thickness * length


CARRIED_MASSES = {
    "profile A, 2 x 4 inch tube, 40 cm, 1/8 inch wall assumed": _rectangular_tube_mass(
        0.0508, 0.1016, 0.003175, PROFILE_LENGTH
    ),
    "profile P, L of 3 mm, 40 cm, legs of 38 mm assumed": _angle_mass(0.038, 0.003, PROFILE_LENGTH),
    "two housed linear bearings for 12 mm rods (SCS12UU class), 0.10 kg each": 0.20,
    "1/4 inch rod, nuts, acrylic pane on the cone, sensors": 0.12,
}
"""What is bolted to the cone [kg]: P 2.4.1 gives the sections and lengths, the rest is assumed as each line says."""

CARRIED_MASS = sum(CARRIED_MASSES.values())
"""Mass of rail and bottom [kg], about 1.56."""
