"""The orders of exchange side by side: coupling error, Gamma and cost for several step sizes."""

from time import perf_counter

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling
from jostle_lab.errors import LabError
from jostle_lab.fmu.grains import Grains, GrainsFactory
from jostle_lab.loudspeaker.model import Loudspeaker
from jostle_lab.sensors.spectral_amplitude import true_amplitude
from jostle_lab.tables import markdown_table

STEP_RATES = (400, 800, 1200, 2400, 4800, 9600)
"""Communication rates to compare [Hz]."""


def compare_exchanges(factory: GrainsFactory, seconds: int, amplitude: float, gamma: float = 5.0) -> str:
    """Markdown table, one run each of `seconds` at `amplitude` times the drive of `gamma`, after as long to settle."""
    rows = []
    for rate in STEP_RATES:
        for exchange in Exchange:
            grains = factory(1, exchange.parameters)
            try:
                measured = _measure(grains, exchange, rate, seconds, amplitude, gamma)
            except LabError as error:
                measured = ["fails", str(error)[:60], "", ""]
            finally:
                grains.close()
            rows.append([str(rate), exchange.value, *measured])
    header = ["steps per s", "exchange", "true Gamma", "work received [J]", "coupling error", "us per step"]
    return markdown_table(header, rows)


def _measure(grains: Grains, exchange: Exchange, rate: int, seconds: int, amplitude: float, gamma: float) -> list[str]:
    loudspeaker = Loudspeaker(1.0 / rate, grains_weight=grains.weight)
    loudspeaker.voltage_amplitude = amplitude * loudspeaker.voltage_for_acceleration(gamma * grains.gravity)
    coupling = Coupling(loudspeaker, grains, exchange)
    coupling.run(rate * seconds)
    plate, received, started = coupling.work_by_plate, grains.energy_input(), perf_counter()
    acceleration = coupling.run(rate * seconds)
    cost = (perf_counter() - started) / (rate * seconds)
    plate, received = coupling.work_by_plate - plate, grains.energy_input() - received
    true = true_amplitude(acceleration, rate, loudspeaker.drive_frequency) / grains.gravity
    error = f"{100.0 * (plate - received) / received:+.3g} %" if received else "no work"
    return [f"{true:.4f}", f"{received:.4g}", error, f"{1e6 * cost:.1f}"]
