"""Tables beside the diagram of the shaker loop: work, the loop with a controller, controlled steps."""

from jostle_lab.coupling.compare import compare_exchanges
from jostle_lab.coupling.exchange import Exchange
from jostle_lab.demos.packing import held_loop, stepping
from jostle_lab.fmu.grains import GrainsFactory
from tools.work_precision.coupling_points import CASE

SECONDS = 2
"""Simulated, for each line of the first two tables."""
HALF_DRIVE = 0.5


def notes(factory: GrainsFactory) -> list[dict[str, str]]:
    """Rows of a file of notes."""
    work = (
        f"Work done by the plate less work received by the grains, over {SECONDS} s at half of the drive of Gamma 5 "
        "(`python -m jostle_lab exchanges`):\n\n" + compare_exchanges(factory, SECONDS, HALF_DRIVE)
    )
    held = (
        "With amplifier and a controller that holds Gamma (`python -m jostle_lab held-loop`). Longest steps that can "
        "be trusted, of those tried: at rest, without voltage the base comes to rest after the packing has collapsed "
        f"on it; at Gamma {held_loop.MOVING_GAMMA:g}, Gamma and the balance of work hold to "
        f"{100.0 * held_loop.FAITHFUL:g} %. Errors: of the base's displacement over {held_loop.PERIODS} periods at "
        f"Gamma {held_loop.RESTING_GAMMA:g}, after each of which the controller corrects the voltage.\n\n"
        + held_loop.table(factory, SECONDS)
    )
    burst = (
        "Controlled steps beside fixed ones (`python -m jostle_lab step-control`): a burst of "
        f"{stepping.BURST} s at Gamma {stepping.GAMMA:g}, {stepping.SECONDS} s in all. Each pair of half steps costs "
        "three exchanges.\n\n"
    )
    controlled = [
        f"{exchange.value}:\n\n{stepping.table(factory, exchange)}"
        for exchange in (Exchange.GRAINS_FIRST, Exchange.PLANNED)
    ]
    return [{"case": CASE, "note": note} for note in (work, held, burst + "\n\n".join(controlled))]
