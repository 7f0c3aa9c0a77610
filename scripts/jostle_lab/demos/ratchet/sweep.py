"""A shaker whose controller holds Gamma by feedback while it sweeps the frequency; the grains' flow reverses.

    controller -> voltage -> loudspeaker -> base displacement, velocity -> ratchet FMU -> reaction force -> loudspeaker
        ^--------------------- acceleration of the base <---------------------'

Teeth and layer depth are those of a curve of F Fig. 10 (h = 6 mm, a = 0.25, n = 0.7). There the amplitude is the same
at all frequencies; thicker beds turn from positive to negative as the frequency rises, and this one stays negative.
Here Gamma is held, so the amplitude falls as the frequency rises, and the flow turns from negative to positive.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.coupling.master import Coupling
from jostle_lab.demos.ratchet.controller import GammaController
from jostle_lab.errors import require
from jostle_lab.fmu.ratchet import FmuRatchet
from jostle_lab.loudspeaker.model import Loudspeaker
from jostle_lab.plots.curves import velocity_axes
from jostle_lab.plots.style import WIDTH
from jostle_lab.progress import progress
from jostle_lab.statements import Product, Statement, verdict
from jostle_lab.statistics.estimates import Estimate, sign_changes, zero_crossings

STEP = 1.0 / 4096.0
"""Of the exchange [s]: exact in binary, a hundred and more to a period."""
ROD = 3e-3
"""Mass of a disk [kg]: a steel rod of the diameter of F's disks, 11 cm long."""
SETTLING = 1.0
"""After each change of frequency [s]; the loudspeaker needs 0.1 s, the flow some periods more."""
FIRST_VOLTAGE = 1.0
AMPLIFIER = 60.0
"""Largest voltage [V]."""
PARAMETERS = {"tooth.height": 6e-3, "tooth.asymmetry": 0.25, "tooth.count": 10, "disk.mass": ROD}


@dataclass(frozen=True)
class Plan:
    """Where the controller goes."""

    gamma: float = 3.0
    """Held at all frequencies."""
    frequencies: tuple[float, ...] = tuple(float(f) for f in range(16, 47, 2))
    """[Hz], in this order."""
    seconds: float = 12.0
    """At each, settling apart."""
    seed: int = 1


@dataclass(frozen=True)
class Plateau:
    """What was measured at one frequency."""

    frequency: float
    gamma: Estimate
    """Mean over periods and their standard deviation."""
    amplitude: float
    """Of the base, A = Gamma g / (2 pi f)^2 [m]."""
    voltage: float
    """Mean amplitude [V]."""
    unloaded_gamma: float
    """What that voltage gives without grains."""
    velocity: Estimate
    """Of the grains, and its standard error [cm/s]."""


class Period(NamedTuple):
    """A period of the drive, when it ends."""

    time: float
    """[s]."""
    gamma: float
    frequency: float
    """[Hz]."""
    voltage: float
    """Amplitude from now on [V]."""
    place: float
    """Mean place of the grains to the right [m]."""


@dataclass(frozen=True)
class Sweep:
    """The whole run."""

    plateaus: Sequence[Plateau]
    periods: Sequence[Period]


class Rig:
    """Controller, loudspeaker and grains."""

    def __init__(self, grains: FmuRatchet, plan: Plan) -> None:
        self.grains = grains
        self.speaker = Loudspeaker(STEP, plan.frequencies[0], grains.weight)
        self.coupling = Coupling(self.speaker, grains)
        self.controller = GammaController(plan.gamma, FIRST_VOLTAGE, AMPLIFIER, grains.gravity)
        self.records: list[Period] = []

    def run(self, seconds: float) -> None:
        """Advance; the controller acts at the end of each period."""
        for _ in range(round(seconds / STEP)):
            turns = self.speaker.drive_turns
            if self.controller.update(self.speaker.acceleration(self.coupling.reaction_force), turns):
                self.speaker.voltage_amplitude = self.controller.voltage
                self.records.append(self._period())
            self.coupling.run(1)

    def _period(self) -> Period:
        speaker, controller = self.speaker, self.controller
        place = self.grains.mean_displacement()
        return Period(speaker.time, controller.measured, speaker.drive_frequency, controller.voltage, place)

    def plateau(self, frequency: float, seconds: float) -> Plateau:
        """Go to a frequency, settle, measure."""
        self.speaker.retune(frequency)
        self.run(SETTLING)
        first = len(self.records)
        self.grains.restart_averages()
        self.run(seconds)
        gammas, voltages = np.array([(r.gamma, r.voltage) for r in self.records[first + 1 :]]).T
        gamma, voltage = float(gammas.mean()), float(voltages.mean())
        unloaded = abs(self.speaker.steady_state(voltage).acceleration) / self.grains.gravity
        return Plateau(
            frequency,
            Estimate(gamma, float(gammas.std(ddof=1))),
            gamma * self.grains.gravity / (math.tau * frequency) ** 2,
            voltage,
            unloaded,
            self.grains.transport(),
        )


def sweep(fmu: Path, plan: Plan, show_progress: bool) -> Sweep:
    """The controller goes through the frequencies."""
    require("seconds at each frequency", plan.seconds, 1.0, 1e4, "A few seconds or more.")
    for frequency in plan.frequencies:
        require("frequency [Hz]", frequency, 5.0, 200.0, "The loudspeaker and the exchange are made for 5 to 200 Hz.")
    grains = FmuRatchet(fmu, {**PARAMETERS, "seed": plan.seed})
    try:
        rig = Rig(grains, plan)
        bar = progress(plan.frequencies, unit="frequencies", what="ratchet demo", show=show_progress)
        plateaus = [rig.plateau(frequency, plan.seconds) for frequency in bar]
    finally:
        grains.close()
    return Sweep(plateaus, rig.records)


def make(fmu: Path, plan: Plan, show_progress: bool = True) -> Product:
    """Run, and check the statements."""
    found = sweep(fmu, plan, show_progress)
    rows: list[dict[str, Any]] = [
        {
            "frequency_hz": p.frequency,
            "gamma": p.gamma.mean,
            "gamma_deviation": p.gamma.error,
            "amplitude_m": p.amplitude,
            "voltage": p.voltage,
            "gamma_of_that_voltage_without_grains": p.unloaded_gamma,
            "velocity_cm_per_s": p.velocity.mean,
            "error": p.velocity.error,
        }
        for p in found.plateaus
    ]
    notes = [
        "teeth of F Fig. 10: h = 6 mm, a = 0.25, ten teeth",
        f"20 disks, n = 0.7, steel rods of {1e3 * ROD:g} g; seed {plan.seed}",
        f"exchange every 1/{1 / STEP:.0f} s, {SETTLING:g} s to settle, then averages over {plan.seconds:g} s",
        "loudspeaker of the packing's laboratory; lock-in over each period, U <- U (Gamma_set/Gamma)^0.3",
    ]
    return Product(
        "A shaker that holds Gamma, and grains whose flow reverses",
        rows,
        draw(found, plan),
        statements(found, plan),
        notes,
    )


def statements(found: Sweep, plan: Plan) -> list[Statement]:
    """Gamma held, grains felt, flow reversed."""
    plateaus = found.plateaus
    worst = max(abs(p.gamma.mean / plan.gamma - 1.0) for p in plateaus)
    scatter = max(p.gamma.error / plan.gamma for p in plateaus)
    load = [p.unloaded_gamma / plan.gamma - 1.0 for p in plateaus]
    crossings = zero_crossings([p.frequency for p in plateaus], [p.velocity for p in plateaus])
    flow = ", ".join(f"{p.frequency:g}: {p.velocity}" for p in plateaus)
    return [
        Statement(
            "demo",
            f"the controller holds Gamma = {plan.gamma:g}",
            f"means within {100 * worst:.2f} %; single periods deviate by at most {100 * scatter:.1f} % rms",
            verdict(worst < 0.01),
        ),
        Statement(
            "demo",
            "the grains act back on the shaker",
            "without them the voltages would give a Gamma that differs by "
            f"{100 * min(load):+.1f} to {100 * max(load):+.1f} %",
            verdict(max(map(abs, load)) > 3.0 * worst),
        ),
        Statement(
            "F Fig. 10, Gamma held instead of A",
            "the flow reverses as the frequency is swept",
            f"{sign_changes(crossings, 'Hz')}; [cm/s] by frequency [Hz]: {flow}",
            verdict(bool(crossings)),
        ),
    ]


def draw(found: Sweep, plan: Plan) -> Figure:
    """Frequency and Gamma against time, place of the grains; below, velocity against frequency."""
    figure = Figure(figsize=(WIDTH, 5.6), layout="constrained")
    mosaic = figure.subplot_mosaic([["gamma", "velocity"], ["frequency", "velocity"], ["place", "velocity"]])
    gamma, frequency, place, velocity = (mosaic[name] for name in ("gamma", "frequency", "place", "velocity"))
    time, gammas, frequencies, _, places = np.array(found.periods).T
    gamma.plot(time, gammas, lw=0.5, color="#1f5fa8")
    gamma.axhline(plan.gamma, color="0.3", lw=0.7, ls="--")
    gamma.set(ylabel=r"$\Gamma$, each period", ylim=(0.0, 1.25 * plan.gamma))
    frequency.plot(time, frequencies, color="0.3", lw=1.0)
    frequency.set_ylabel("drive [Hz]")
    place.plot(time, 100.0 * places, color="#c0272d", lw=1.0)
    place.set(ylabel="mean place [cm]", xlabel="time [s]")
    for panel in (gamma, frequency, place):
        panel.sharex(place)
    for panel in (gamma, frequency):
        panel.tick_params(labelbottom=False)
    x, points = [p.frequency for p in found.plateaus], [p.velocity for p in found.plateaus]
    velocity_axes(velocity, "driving frequency [Hz]")
    velocity.errorbar(
        x, [p.mean for p in points], yerr=[p.error for p in points], fmt="o-", ms=4, lw=0.9, color="#c0272d"
    )
    velocity.set_title(rf"flow at $\Gamma$ = {plan.gamma:g}, held by feedback")
    return figure
