"""Runs of one disk on two supports (P 5), and the theory beside them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import Table

SCENE, ENGINE = "three_disk", "molecular-dynamics"
MARKERS = ("o", "v", "^", "s", "D")
"""Symbols of the thesis' captions, in their order."""
NORMAL_STIFFNESS, TANGENTIAL_STIFFNESS = 1e3, 1e6
"""k_n and k_t of P 5.1 [N/m]."""
PERIODS = 3
"""Periods of the torque in a run; the last one is measured."""
TIME_STEP = 1e-4
"""[s]: 0.8 rad of the fastest mode. The default, a third of it, changes a turn by 1e-12 of its size."""
SLOW = 1.0
"""Angular frequency of the torque in the figures [rad/s]; the thesis does not say its own. sqrt(k_n / m) is 100."""


@dataclass(frozen=True)
class Torque:
    """A harmonic torque on a tilted disk."""

    tilt: float
    """theta_T [rad]."""
    amplitude: float
    """A_e [N m]."""
    angular_frequency: float = SLOW
    """omega_e [rad/s]."""
    normal_stiffness: float = NORMAL_STIFFNESS
    """k_n [N/m]; k_t stays."""

    @property
    def period(self) -> float:
        """Of the torque [s]."""
        return math.tau / self.angular_frequency

    def run(self, samples: int = 1) -> Run:
        """PERIODS periods with so many rows in each."""
        settings = (
            ("tilt", self.tilt),
            ("torque.amplitude", self.amplitude),
            ("torque.angular_frequency", self.angular_frequency),
            ("contact.normal_stiffness", self.normal_stiffness),
            ("contact.stiffness_ratio", TANGENTIAL_STIFFNESS / self.normal_stiffness),
            ("time_step", TIME_STEP),
            ("measure.start", (PERIODS - 1) * self.period),
        )
        return Run(SCENE, ENGINE, PERIODS * self.period, self.period / samples, settings, drive="harmonic-torque")


@dataclass(frozen=True)
class Turning:
    """Mean angular velocity over the last period of a run."""

    velocity: float
    """[rad/s]."""
    change: float
    """From the period before: what a run without chance has for an error bar [rad/s]."""
    regime: int
    """0 none, 1 unidirectional, 2 bidirectional."""
    opened: bool
    """Whether a contact opened."""
    clockwise: float
    """Time at S1 in the last period [s]."""
    counter_clockwise: float
    """Time at S2 in the last period [s]."""

    @property
    def estimate(self) -> Estimate:
        """Angular velocity, with its change for an error [rad/s]."""
        return Estimate(self.velocity, self.change)


def turning(torque: Torque, table: Table) -> Turning:
    """What a run with one row a period shows."""
    turned = np.diff(table["disk.angle[1]"]) / torque.period
    return Turning(
        float(turned[-1]),
        float(abs(turned[-1] - turned[-2])),
        int(table["sliding_regime"][-1]) - 1,
        bool(table["detachments"][-1] > 0),
        float(table["sliding.s1.time"][-1]),
        float(table["sliding.s2.time"][-1]),
    )


def turnings(laboratory: Laboratory, title: str, torques: Sequence[Torque]) -> dict[Torque, Turning]:
    """Run them all."""
    tables = laboratory.run([torque.run() for torque in torques], title)
    return {torque: turning(torque, tables[torque.run()]) for torque in torques}


def velocity(
    laboratory: Laboratory,
    tilts: Sequence[float],
    amplitudes: Sequence[float],
    angular_frequency: float = SLOW,
    normal_stiffness: float = math.inf,
) -> Table:
    """Theory at all pairs of tilt and amplitude: mean angular velocity; `closed_form`: P 5.9, NaN beyond its range."""
    return laboratory.theory(
        SCENE,
        "velocity",
        tilt=tilts,
        torque__amplitude=amplitudes,
        torque__angular_frequency=angular_frequency,
        contact__normal_stiffness=normal_stiffness,
    )


def limits(laboratory: Laboratory, tilt: float, normal_stiffness: float = math.inf) -> dict[str, float]:
    """Theory: A_S1, A_S2, A_0, A_rest [N m], detachment_tilt [rad] at a tilt."""
    table = laboratory.theory(SCENE, "limits", tilt=tilt, contact__normal_stiffness=normal_stiffness)
    return {name: float(column[0]) for name, column in table.items()}


def row(torque: Torque, found: Turning, theory: float) -> dict[str, Any]:
    """A row of data."""
    return {
        "tilt": torque.tilt,
        "torque_amplitude": torque.amplitude,
        "torque_angular_frequency": torque.angular_frequency,
        "normal_stiffness": torque.normal_stiffness,
        "angular_velocity": found.velocity,
        "change_from_period_before": found.change,
        "theory": theory,
        "regime": found.regime,
        "opened": int(found.opened),
    }


def notes() -> list[str]:
    """Parameters, for the page of statements."""
    return [
        "k_n = 1e3 N/m, k_t = 1e6 N/m, gamma_n = 10 kg/s, mu = 0.1, g = 10 m/s^2, R = 1 m, m = 0.1 kg (P 5.1)",
        f"omega_e = {SLOW:g} rad/s, not given in the thesis; {PERIODS} periods, the last one measured; no chance, "
        "the change from the period before stands for an error bar",
    ]
