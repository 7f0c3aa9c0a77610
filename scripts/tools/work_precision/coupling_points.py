"""Error of the shaker loop against its communication step: orders of exchange and which inputs are connected.

The loudspeaker starts to shake a packing at rest; the error is that of the base's motion over the first two periods,
before chaos has made it a matter of chance, against the same loop so finely coupled that it is as good as one model.
Wirings: displacement, velocity and acceleration, extrapolated with degree two or one that the FMU chooses; displacement
and velocity; the same with the velocity as the derivative of the displacement by `fmi2SetRealInputDerivatives`; and
displacement alone, as by an importer that connects one wire. Only the first can lead the base to a given end, which the
exchanges planned and iterated do.

Rows of `points_coupling_earlier.csv` were measured with builds whose base went to displacement + h velocity.
"""

from collections.abc import Callable
from dataclasses import dataclass
from time import process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling
from jostle_lab.errors import LabError
from jostle_lab.fmu.grains import Grains, GrainsFactory
from jostle_lab.fmu.names import EXTRAPOLATION_DEGREE
from jostle_lab.loudspeaker.model import Loudspeaker
from jostle_lab.statistics.estimates import relative_error
from tools.work_precision import points
from tools.work_precision.points import Work, trouble

CASE = "shaker_loop"
SECONDS = 0.025
SAMPLES = 20
"""Instants at which the base is compared; at a rate that reaches fewer, at those."""
RATES = (400, 800, 1600, 3200, 6400, 12_800, 25_600, 51_200)
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
        f"for {SECONDS} s (initial.settled = 0): orders of exchange between two models, and which inputs are wired.",
    }
]
AUTOMATIC = -1

Numbers = NDArray[np.float64]


class _Rewired:
    """Grains of which not all inputs are wired."""

    def __init__(self, grains: Grains) -> None:
        self._grains: Any = grains

    def __getattr__(self, name: str) -> Any:
        """Everything else is the grains' own."""
        return getattr(self._grains, name)


class DisplacementAlone(_Rewired):
    """Grains of which only `base.displacement` is wired: velocity and acceleration stay zero."""

    def step(self, displacement: float, _velocity: float, _acceleration: float, step: float) -> float:
        """See `Grains.step`."""
        return float(self._grains.step(displacement, 0.0, 0.0, step))


class DisplacementAndVelocity(_Rewired):
    """Grains of which the acceleration is not wired."""

    def step(self, displacement: float, velocity: float, _acceleration: float, step: float) -> float:
        """See `Grains.step`."""
        return float(self._grains.step(displacement, velocity, 0.0, step))


class InputDerivative(_Rewired):
    """Grains in an FMU of FMI 2.0, whose velocity is set as the derivative of the input `base.displacement`."""

    def step(self, displacement: float, velocity: float, _acceleration: float, step: float) -> float:
        """See `Grains.step`."""
        self._grains.set_displacement_derivative(velocity)
        return float(self._grains.step_with_last_velocity(displacement, step))


@dataclass(frozen=True)
class Wiring:
    """Which inputs are connected."""

    name: str
    wire: Callable[[Grains], Any]
    degree: int
    exchanges: tuple[Exchange, ...]


FORWARD = (Exchange.JACOBI, Exchange.GRAINS_FIRST)
WIRINGS = (
    Wiring("displacement, velocity and acceleration", lambda grains: grains, 2, tuple(Exchange)),
    Wiring("displacement, velocity and acceleration, automatic degree", lambda grains: grains, AUTOMATIC, FORWARD),
    Wiring("displacement and velocity", DisplacementAndVelocity, AUTOMATIC, FORWARD),
    Wiring("input derivative", InputDerivative, AUTOMATIC, FORWARD),
    Wiring("displacement", DisplacementAlone, AUTOMATIC, FORWARD),
)


def works(factory: GrainsFactory) -> list[Work]:
    """All points of the loop; `factory` makes grains of a seed."""
    known: list[Numbers] = []

    def reference() -> Numbers:
        if not known:
            known.append(_run(factory, WIRINGS[0], Exchange.ITERATED, REFERENCE_RATE)[0])
        return known[0]

    def point(wiring: Wiring, exchange: Exchange, rate: int) -> Callable[[], tuple[dict[str, float], float, float]]:
        def run() -> tuple[dict[str, float], float, float]:
            exact = reference()
            path, seconds = _run(factory, wiring, exchange, rate)
            every = SAMPLES // len(path)
            exact = exact[every - 1 :: every]
            return {QUANTITY: relative_error(path, exact)}, seconds, SECONDS * rate

        return run

    return [
        Work(CASE, f"{exchange.value}, {wiring.name}", 1.0 / rate, point(wiring, exchange, rate))
        for wiring in WIRINGS
        for exchange in wiring.exchanges
        for rate in RATES
    ]


def measure(factory: GrainsFactory, rounds: int) -> list[dict[str, str]]:
    """Rows of all points; an exchange that is unstable at a step is a row that says so."""
    rows: list[dict[str, str]] = []
    for work in works(factory):
        try:
            rows += points.measure([work], rounds)
        except LabError as error:
            rows += trouble(CASE, [QUANTITY], work.method, work.setting, str(error))
    return rows


def _run(factory: GrainsFactory, wiring: Wiring, exchange: Exchange, rate: int) -> tuple[Numbers, float]:
    """Displacement of the base at up to SAMPLES instants, evenly spaced, and CPU seconds, Python included."""
    grains = factory(1, {"initial.settled": 0, EXTRAPOLATION_DEGREE: wiring.degree})
    try:
        loudspeaker = Loudspeaker(1.0 / rate, grains_weight=grains.weight)
        loudspeaker.voltage_amplitude = loudspeaker.voltage_for_acceleration(GAMMA * grains.gravity)
        coupling = Coupling(loudspeaker, wiring.wire(grains), exchange)
        samples = min(SAMPLES, round(SECONDS * rate))
        each = round(SECONDS * rate / samples)
        path, started = np.empty(samples), process_time()
        for sample in range(samples):
            coupling.run(each)
            path[sample] = loudspeaker.displacement
        return path, process_time() - started
    finally:
        grains.close()
