"""Error of the shaker loop against its communication step: orders of exchange and which inputs are connected.

The loudspeaker starts to shake a packing at rest; the error is that of the base's motion over the first two periods,
before chaos has made it a matter of chance, against the same loop so finely coupled that it is as good as one model.
Three wirings: displacement and velocity, so that the base moves on the cubic that both define; displacement with its
derivative by `fmi2SetRealInputDerivatives`, which is the same to the bit; and displacement alone, velocity left at
zero, as by an importer that connects one wire.
"""

from collections.abc import Callable
from time import process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling
from jostle_lab.errors import LabError
from jostle_lab.fmu.grains import Grains
from jostle_lab.loudspeaker.model import Loudspeaker
from tools.work_precision import points
from tools.work_precision.points import Work, trouble

CASE = "shaker_loop"
SECONDS = 0.025
SAMPLES = 20
"""Instants at which the base is compared; every rate is a multiple of SAMPLES / SECONDS."""
RATES = (800, 1600, 3200, 6400, 12_800, 25_600, 51_200)
"""Communication steps a second."""
REFERENCE_RATE = 819_200
GAMMA = 2.0
QUANTITY = "base"
CASES = [
    {
        "case": CASE,
        "quantity": QUANTITY,
        "error": "rms error of the base's displacement over its rms",
        "setting": "communication step [s]",
        "reference": f"iterated exchange at {REFERENCE_RATE} steps a second",
        "problem": f"A loudspeaker at 80 Hz starts to shake a packing of 60 disks at rest, unloaded Gamma {GAMMA:g}, "
        f"for {SECONDS} s: orders of exchange between two models, and which inputs are wired.",
    }
]

Numbers = NDArray[np.float64]


class DisplacementAlone:
    """Grains of which only `base.displacement` is wired: the velocity stays zero."""

    def __init__(self, grains: Grains) -> None:
        self._grains = grains

    def __getattr__(self, name: str) -> Any:
        """Everything else is the grains' own."""
        return getattr(self._grains, name)

    def step(self, displacement: float, velocity: float, step: float) -> float:
        """See `Grains.step`; `velocity` is not passed on."""
        del velocity
        return self._grains.step(displacement, 0.0, step)


class InputDerivative:
    """Grains in an FMU of FMI 2.0, whose velocity is set as the derivative of the input `base.displacement`."""

    def __init__(self, grains: Grains) -> None:
        self._grains: Any = grains

    def __getattr__(self, name: str) -> Any:
        """Everything else is the grains' own."""
        return getattr(self._grains, name)

    def step(self, displacement: float, velocity: float, step: float) -> float:
        """See `Grains.step`."""
        self._grains.set_displacement_derivative(velocity)
        return float(self._grains.step_with_last_velocity(displacement, step))


Wiring = Callable[[Grains], Any]
WIRINGS: dict[str, Wiring] = {
    "displacement and velocity": lambda grains: grains,
    "input derivative": InputDerivative,
    "displacement": DisplacementAlone,
}


def works(factory: Callable[[int], Grains]) -> list[Work]:
    """All points of the loop; `factory` makes grains of a seed."""
    known: list[Numbers] = []

    def reference() -> Numbers:
        if not known:
            known.append(_run(factory, WIRINGS["displacement and velocity"], Exchange.ITERATED, REFERENCE_RATE)[0])
        return known[0]

    def point(wiring: Wiring, exchange: Exchange, rate: int) -> Callable[[], tuple[dict[str, float], float, float]]:
        def run() -> tuple[dict[str, float], float, float]:
            exact = reference()
            path, seconds = _run(factory, wiring, exchange, rate)
            error = float(np.sqrt(np.mean((path - exact) ** 2) / np.mean(exact**2)))
            return {QUANTITY: error}, seconds, SECONDS * rate

        return run

    return [
        Work(CASE, f"{exchange.value}, {name}", 1.0 / rate, point(wiring, exchange, rate))
        for name, wiring in WIRINGS.items()
        for exchange in Exchange
        for rate in RATES
    ]


def measure(factory: Callable[[int], Grains], rounds: int) -> list[dict[str, str]]:
    """Rows of all points; an exchange that is unstable at a step is a row that says so."""
    rows: list[dict[str, str]] = []
    for work in works(factory):
        try:
            rows += points.measure([work], rounds)
        except LabError as error:
            rows += trouble(CASE, [QUANTITY], work.method, work.setting, str(error))
    return rows


def _run(factory: Callable[[int], Grains], wiring: Wiring, exchange: Exchange, rate: int) -> tuple[Numbers, float]:
    """Displacement of the base at SAMPLES instants, shape (SAMPLES,), and CPU seconds, Python included."""
    grains = factory(1)
    try:
        loudspeaker = Loudspeaker(1.0 / rate, grains_weight=grains.weight)
        loudspeaker.voltage_amplitude = loudspeaker.voltage_for_acceleration(GAMMA * grains.gravity)
        coupling = Coupling(loudspeaker, wiring(grains), exchange)
        each = round(SECONDS * rate / SAMPLES)
        path, started = np.empty(SAMPLES), process_time()
        for sample in range(SAMPLES):
            coupling.run(each)
            path[sample] = loudspeaker.displacement
        return path, process_time() - started
    finally:
        grains.close()
