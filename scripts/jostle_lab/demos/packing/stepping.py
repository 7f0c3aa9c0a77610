"""Controlled communication steps beside fixed ones: a burst of shaking that a packing takes and comes to rest from."""

from time import process_time
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling
from jostle_lab.coupling.step_control import StepControl, advance_controlled
from jostle_lab.fmu.grains import GrainsFactory
from jostle_lab.loudspeaker.model import Loudspeaker
from jostle_lab.tables import markdown_table

GAMMA = 2.0
"""Unloaded, during the burst."""
BURST, SECONDS = 0.025, 0.1
"""Length of the burst, and of the whole [s]."""
SAMPLES = 8
"""Instants at which the base is compared."""
RATES = (400, 800, 1600, 3200, 6400, 12_800)
"""Of the fixed steps [1/s]; multiples of SAMPLES / SECONDS."""
TOLERANCES = (1e-3, 1e-4, 3e-5, 1e-5, 1e-6)
"""Of the controlled steps [m/s]: error of the base per second."""
REFERENCE_RATE = 204_800
LEAST = 1e-6
"""[s]."""


class Burst(NamedTuple):
    """One run."""

    path: NDArray[np.float64]
    """Displacement of the base [m], shape (SAMPLES,)."""
    steps: int
    """Steps of the grains, those of steps refused and of whole steps for comparison included."""
    cpu_seconds: float
    control: StepControl | None


def shake(factory: GrainsFactory, exchange: Exchange, rate: int = 0, tolerance: float = 0.0) -> Burst:
    """With fixed steps at `rate`, or with controlled ones within `tolerance` [m/s]."""
    grains = factory(1, exchange.parameters)
    control = StepControl(tolerance, least=LEAST) if tolerance > 0.0 else None
    try:
        speaker = Loudspeaker(1.0 / rate if rate else 1e-4, grains_weight=grains.weight)
        coupling = Coupling(speaker, grains, exchange)
        voltage = speaker.voltage_for_acceleration(GAMMA * grains.gravity)
        path, started, each = np.empty(SAMPLES), process_time(), SECONDS / SAMPLES
        for sample in range(SAMPLES):
            speaker.voltage_amplitude = voltage if sample * each < BURST - 1e-9 else 0.0
            if control is None:
                coupling.run(round(rate * each))
            else:
                advance_controlled(coupling, sample * each, (sample + 1) * each, control)
            path[sample] = speaker.displacement
        taken = 3 * (control.accepted + control.rejected) if control else round(rate * SECONDS)
        return Burst(path, taken, process_time() - started, control)
    finally:
        grains.close()


def table(factory: GrainsFactory, exchange: Exchange = Exchange.GRAINS_FIRST) -> str:
    """Markdown table of error against cost: fixed steps, then controlled ones.

    The cost is the number of steps of the grains: three for each pair of half steps, kept or not.
    """
    exact = shake(factory, Exchange.ITERATED, REFERENCE_RATE).path
    rows = []
    for name, rate, tolerance in [
        *((f"fixed, {rate} a second", rate, 0.0) for rate in RATES),
        *((f"controlled, {tolerance:g} m/s", 0, tolerance) for tolerance in TOLERANCES),
    ]:
        found = shake(factory, exchange, rate, tolerance)
        error = float(np.sqrt(np.mean((found.path - exact) ** 2) / np.mean(exact**2)))
        control = found.control
        steps = [f"{1e3 / rate:.3g}"] * 2 if control is None else [f"{1e3 * f(control.steps):.2g}" for f in (min, max)]
        counts = ["", ""] if control is None else [str(control.accepted), str(control.rejected)]
        rows.append([name, f"{error:.1e}", str(found.steps), f"{1e3 * found.cpu_seconds:.3g}", *steps, *counts])
    header = ["steps", "error of the base", "steps of the grains", "CPU time [ms]", "shortest [ms]", "longest [ms]"]
    return markdown_table([*header, "accepted", "rejected"], rows)
