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
from jostle_lab.statistics.estimates import relative_error
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
    exchanges: int
    """Communication steps, those of steps refused and the whole ones for comparison included."""
    cpu_seconds: float


def shake(factory: GrainsFactory, exchange: Exchange, steps: int | StepControl) -> Burst:
    """With a fixed number of steps a second, or with controlled ones by a control that has done nothing yet."""
    grains = factory(1, exchange.parameters)
    try:
        first = steps.first if isinstance(steps, StepControl) else 1.0 / steps
        speaker = Loudspeaker(first, grains_weight=grains.weight)
        coupling = Coupling(speaker, grains, exchange)
        voltage = speaker.voltage_for_acceleration(GAMMA * grains.gravity)
        path, started, each = np.empty(SAMPLES), process_time(), SECONDS / SAMPLES
        for sample in range(SAMPLES):
            speaker.voltage_amplitude = voltage if sample * each < BURST - 1e-9 else 0.0
            if isinstance(steps, StepControl):
                advance_controlled(coupling, sample * each, (sample + 1) * each, steps)
            else:
                coupling.run(round(steps * each))
            path[sample] = speaker.displacement
        tried = 3 * (steps.accepted + steps.rejected) if isinstance(steps, StepControl) else round(steps * SECONDS)
        return Burst(path, tried, process_time() - started)
    finally:
        grains.close()


def table(factory: GrainsFactory, exchange: Exchange = Exchange.GRAINS_FIRST) -> str:
    """Markdown table of error against cost: fixed steps, then controlled ones.

    The cost is the number of exchanges: three for each pair of half steps, kept or not. An iterated exchange steps the
    grains twice.
    """
    exact = shake(factory, Exchange.ITERATED, REFERENCE_RATE).path
    rows = []
    for rate in RATES:
        row = _row(f"fixed, {rate} a second", shake(factory, exchange, rate), exact)
        rows.append([*row, *[f"{1e3 / rate:.3g}"] * 2, "", ""])
    for tolerance in TOLERANCES:
        control = StepControl(tolerance, least=LEAST, order=exchange.order)
        row = _row(f"controlled, {tolerance:g} m/s", shake(factory, exchange, control), exact)
        limits = [f"{1e3 * step:.2g}" for step in (min(control.steps), max(control.steps))]
        rows.append([*row, *limits, str(control.accepted), str(control.rejected)])
    header = ["steps", "error of the base", "exchanges", "CPU time [ms]", "shortest [ms]", "longest [ms]"]
    return markdown_table([*header, "accepted", "rejected"], rows)


def _row(name: str, found: Burst, exact: NDArray[np.float64]) -> list[str]:
    error = relative_error(found.path, exact)
    return [name, f"{error:.1e}", str(found.exchanges), f"{1e3 * found.cpu_seconds:.3g}"]
