"""The ring of F II A, an experiment, and its balls as disks: what a part of it in the plane holds.

Two hundred balls stand on the whole ring. A cell of ten teeth has its share of them, whatever a layer is.
"""

import math

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import exact, near, true
from studies.ratchet.cases import gamma_of
from studies.ratchet.study import stated

MEAN_DIAMETER = 100.0
"""Of the glass cylinders [mm]."""
CIRCUMFERENCE = math.pi * MEAN_DIAMETER
"""[mm]."""
BALL = 3.3
"""Diameter of a glass ball [mm]; +- 2 %."""
GAPS = (3.0, 5.0)
"""Between the cylinders [mm]."""
BALLS = 200
"""Of Fig. 3."""
PRINTED_LAYERS = 4
BALL_CHANGES = {
    "disk.radius_min": 1.617e-3,
    "disk.radius_max": 1.683e-3,
    "disk.inertia_factor": 0.4,
}
"""Disks that are balls: radii of 1.65 mm +- 2 %, and the moment of inertia of a ball."""


def balls_on(teeth: int, tooth_width: float, balls: int = BALLS) -> int:
    """Share of `balls` on the whole ring that stands on some teeth of a width [mm]."""
    return round(balls * teeth * tooth_width / CIRCUMFERENCE)


def balls_of_layers(layers: float, teeth: int, tooth_width: float) -> int:
    """Disks of n layers, where one layer is as many as lie side by side."""
    return max(1, round(layers * teeth * tooth_width / BALL))


def zigzag_spacing(gap: float) -> float:
    """Distance along the gap of balls that touch each other and the walls in turn [mm]."""
    across = gap - BALL
    return math.sqrt(BALL**2 - across**2)


def layer_count() -> list[Statement]:
    """F II B: 200 balls are four layers."""
    side_by_side, zigzag = CIRCUMFERENCE / BALL, CIRCUMFERENCE / zigzag_spacing(max(GAPS))
    printed_layer = BALLS / PRINTED_LAYERS
    return [
        stated(
            "II B, Fig. 3",
            "200 balls amount to 4 layers",
            f"{BALLS / side_by_side:.2f} layers of balls side by side ({side_by_side:.0f} on {CIRCUMFERENCE:.1f} mm), "
            f"{BALLS / zigzag:.2f} of balls in zigzag in the gap of 5 mm ({zigzag:.0f})",
            near(Estimate(BALLS / side_by_side, 0.0), PRINTED_LAYERS, 0.5),
            f"F's layer here has {printed_layer:.0f} balls, one for each {CIRCUMFERENCE / printed_layer:.1f} mm, which "
            f"is about two in each of the {CIRCUMFERENCE / 12.0:.0f} valleys of 12 mm (52): not the count of F IV, "
            "width over diameter. So the simulation takes the number of balls, 7.6 for each tooth, not of layers",
        ),
        stated(
            "II A",
            "balls of 3.3 mm between cylinders with a gap of 3 or 5 mm",
            f"balls of {BALL:g} mm +- 2 % fit in {' and '.join(f'{g:g} mm' for g in GAPS if g > BALL)} only",
            true(all(gap > BALL for gap in GAPS), "every gap is wider than a ball; no chance"),
            "an error of F, or its gap of 3 mm is for other particles. In the gap of 5 mm balls pass beside each other "
            "and rub on glass, which disks in a plane cannot",
        ),
    ]


def arithmetic() -> list[Statement]:
    """Numbers of F II that follow from others."""
    lengths = [1000.0 * metres / CIRCUMFERENCE for metres in (1.5, 6.0)]
    return [
        stated(
            "II B; IV A",
            "Gamma = (2 pi f)^2 A / g = 5 for A = 2 mm, f = 25 Hz (IV A: 5.0)",
            f"{gamma_of(25.0):.3f} with g = 9.81 m/s2",
            exact(gamma_of(25.0) - 5.0, 0.05, "difference from 5.0"),
        ),
        stated(
            "II B",
            "1.5 and 6 m are 5 to 20 times the circumference of the system",
            f"{lengths[0]:.2f} and {lengths[1]:.2f} times pi 10 cm",
            true(round(lengths[0]) == 5 and abs(lengths[1] / 20.0 - 1.0) < 0.05, "5 rounded, 20 to 5 %; no chance"),
        ),
    ]
