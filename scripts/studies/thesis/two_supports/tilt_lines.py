"""Simulations against the amplitude of a slow torque at five tilts: what P Figs 5.2, 5.3 and 5.7 show."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statistics.estimates import Numbers
from studies.thesis.two_supports.lines import Line
from studies.thesis.two_supports.runs import Torque, limits, turnings

TILTS = tuple(share * math.pi for share in (0.0, 0.03, 0.06, 0.09, 0.12))
"""theta_T [rad], as in the captions."""
EXCESS = tuple(np.geomspace(0.1, 12.0, 13))
"""(A_e - A_S2) / (A_S1 - A_S2): unidirectional below 1."""
QUICK_EXCESS = (0.1, 0.3, 0.8, 1.5, 4.0, 10.0)


@dataclass(frozen=True)
class TiltLine(Line):
    """One tilt."""

    tilt: float
    lower: float
    """A_S2 [N m], rigid contacts."""
    upper: float
    """A_S1 [N m]."""
    dense: Numbers
    """Amplitudes of `curve` [N m]."""

    def between(self, low: float, high: float) -> tuple[Numbers, Numbers, Numbers]:
        """A_e - A_S2, simulation and theory where that is between so many widths A_S1 - A_S2."""
        excess = (self.amplitudes - self.lower) / (self.upper - self.lower)
        inside = (excess >= low) & (excess <= high)
        return self.amplitudes[inside] - self.lower, self.velocities[inside], self.theory[inside]


def lines(laboratory: Laboratory, title: str, quick: bool) -> list[TiltLine]:
    """Run all tilts."""
    bounds = {tilt: limits(laboratory, tilt) for tilt in TILTS}
    widest = bounds[TILTS[1]]["A_S1"] - bounds[TILTS[1]]["A_S2"]
    chosen: dict[float, tuple[Torque, ...]] = {}
    for tilt, bound in bounds.items():
        width = bound["A_S1"] - bound["A_S2"] or widest
        above = QUICK_EXCESS if quick else EXCESS
        amplitudes = [0.97 * bound["A_S2"], *(bound["A_S2"] + width * np.asarray(above))]
        chosen[tilt] = tuple(Torque(tilt, float(amplitude)) for amplitude in amplitudes)
    done = turnings(laboratory, title, [torque for torques in chosen.values() for torque in torques])
    found = []
    for tilt, torques in chosen.items():
        lower, upper = bounds[tilt]["A_S2"], bounds[tilt]["A_S1"]
        dense = np.linspace(0.95 * lower, torques[-1].amplitude, 200)
        close = [Torque(tilt, float(amplitude)) for amplitude in dense]
        line = TiltLine.of(laboratory, torques, done, close, tilt=tilt, lower=lower, upper=upper, dense=dense)
        found.append(line)
    return found


def rows(found: Sequence[TiltLine]) -> list[dict[str, Any]]:
    """Data, with both theories."""
    return [row for line in found for row in line.rows(A_S1=line.upper, A_S2=line.lower)]
