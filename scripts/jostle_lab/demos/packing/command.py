"""`jostle-lab demo`, `draw`, `exchanges`, `held-loop`, `step-control`. Each command imports what it needs."""

from contextlib import closing, suppress
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate, options
from jostle_lab.coupling.exchange import Exchange
from jostle_lab.errors import LabError
from jostle_lab.protocol import intervals

AMPLITUDES = "1,0.7,0.5,0.35,0.25,0.18,0.12,0.08,0.05"
FIRST_PICTURE = "packing.png"


def _amplitudes(text: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise LabError(f"--amplitudes {text} is not a list of numbers. Write, say, --amplitudes 1,0.5,0.2") from None


def _seeds(first: int, count: int) -> tuple[int, ...]:
    last = first + count - 1
    if last > options.LARGEST_SEED:
        raise LabError(
            f"--first-seed = {first} gives {count} packings seeds up to {last}, the largest is {options.LARGEST_SEED}."
        )
    return tuple(range(first, first + count))


def demo(
    fmu: options.FmuOption = None,
    results: options.ResultsOption = Path("results"),
    full: Annotated[
        bool, typer.Option("--full", help="The thesis' protocol: 25 packings, 32 amplitudes of 20 minutes. Resumable.")
    ] = False,
    exchange: Annotated[Exchange, typer.Option(help="Order of the exchange.")] = Exchange.GRAINS_FIRST,
    seconds_per_amplitude: Annotated[
        int, typer.Option(help="Simulated seconds for each amplitude, 8 to 1200, a quarter of them to relax.")
    ] = 40,
    amplitudes: Annotated[str, typer.Option(help="Fractions of the full drive, separated by commas.")] = AMPLITUDES,
    packings: Annotated[int | None, typer.Option(min=1, max=1000, help="Number of packings; 2, or 25 if full.")] = None,
    first_seed: Annotated[
        int, typer.Option(min=0, max=options.LARGEST_SEED, help="Seed of the first packing; the others follow.")
    ] = 1,
    processes: Annotated[int, typer.Option(min=1, max=256, help="Packings shaken at the same time.")] = 2,
    steps_per_second: Annotated[
        int, typer.Option(help="Exchanges a second: a multiple of 400 for 80 Hz and 200 Hz.")
    ] = 4800,
    full_drive_gamma: Annotated[
        float, typer.Option(help="Gamma of the empty base at A = 1, at most 8; sets the amplifier's voltage.")
    ] = 5.0,
    sensor_bandwidth: Annotated[
        float | None, typer.Option(help="Low-pass of the accelerometers [Hz]; the part's is 100. None: no filter.")
    ] = None,
    sensor_resolution: Annotated[
        float, typer.Option(min=0.0, max=1.0, help="[g]; the thesis says 0.01, the part offers 0.0039 or 0.031.")
    ] = 0.01,
    pictures: Annotated[
        bool, typer.Option("--pictures", help="Also draw what a webcam sees, and find and follow the marks in it.")
    ] = False,
    parameters: options.SetOption = None,
    progress: options.ProgressOption = True,
) -> None:
    """Shake packings with decreasing amplitude; write CSV files, pictures and a page of numbers."""
    from jostle_lab.coupling.master import check_landing
    from jostle_lab.fmu.instance import fingerprint
    from jostle_lab.fmu.packing import FmuFactory
    from jostle_lab.protocol.experiment import Setup
    from jostle_lab.protocol.packings import Plan, run
    from jostle_lab.protocol.pictures import Processing, process
    from jostle_lab.protocol.results import Results
    from jostle_lab.sensors.accelerometer import Accelerometer
    from jostle_lab.sensors.markings import require_scikit_image

    chosen = options.parameters(parameters, seed="--first-seed")
    path = locate.fmu("packing.fmu", "packing", fmu)
    schedule = intervals.thesis() if full else intervals.scaled_down(_amplitudes(amplitudes), seconds_per_amplitude)
    accelerometer = Accelerometer(bandwidth=sensor_bandwidth, resolution=sensor_resolution)
    setup = Setup(
        schedule,
        steps_per_second,
        exchange,
        full_drive_gamma=full_drive_gamma,
        accelerometer=accelerometer,
        keep_positions=pictures,
    )
    if pictures:
        require_scikit_image()
    seeds = _seeds(first_seed, packings if packings is not None else (25 if full else 2))
    factory = FmuFactory(str(path), chosen)
    # A wrong file or parameter is reported here, before any process starts.
    with closing(factory(first_seed, exchange.parameters)) as grains:
        check_landing(exchange, grains)
    labels = (("FMU binary", fingerprint(path)), *((name, f"{value:g}") for name, value in chosen))
    plan = Plan(results, seeds, setup, processes, progress, labels)
    (results / FIRST_PICTURE).unlink(missing_ok=True)
    run(plan, factory, lambda: _draw_first(results))
    if pictures:
        process(Results(results), Processing())
    draw(results)


def _draw_first(results: Path) -> None:
    """Draw one picture as soon as one packing has gone through one interval."""
    if (results / FIRST_PICTURE).exists():
        return
    from jostle_lab.demos.packing import figures
    from jostle_lab.protocol.results import Results

    # Another process may be replacing the tables at this moment: then the next interval gives the picture.
    with suppress(LabError, OSError):
        path = figures.draw(FIRST_PICTURE, Results(results, unfinished=True))
        typer.echo(f"\n{path}: first picture, drawn after the strongest drive and again at the end")


def draw(results: options.ResultsOption = Path("results")) -> None:
    """Draw the pictures and write the page of numbers of a results folder again."""
    from jostle_lab.demos.packing import figures, numbers
    from jostle_lab.protocol.results import Results

    found = Results(results)
    for path in [*figures.draw_all(found), numbers.write_report(found)]:
        typer.echo(path)


def exchanges(
    fmu: options.FmuOption = None,
    seconds: Annotated[int, typer.Option(min=1, max=100, help="Simulated seconds for each line of the table.")] = 2,
    amplitude: Annotated[float, typer.Option(min=0.01, max=1.0, help="Fraction of the full drive.")] = 0.5,
    parameters: options.SetOption = None,
) -> None:
    """Compare the coupling error and the cost of the orders of exchange for several step sizes."""
    from jostle_lab.coupling.compare import compare_exchanges
    from jostle_lab.fmu.packing import FmuFactory

    path = locate.fmu("packing.fmu", "packing", fmu)
    typer.echo(compare_exchanges(FmuFactory(str(path), options.parameters(parameters)), seconds, amplitude))


def held_loop(
    fmu: options.FmuOption = None,
    seconds: Annotated[int, typer.Option(min=1, max=100, help="Simulated seconds to settle, and to compare.")] = 2,
    parameters: options.SetOption = None,
) -> None:
    """Longest step and order of each exchange in a loop with amplifier, loudspeaker and a controller of Gamma."""
    from jostle_lab.demos.packing import held_loop as loop
    from jostle_lab.fmu.packing import FmuFactory

    path = locate.fmu("packing.fmu", "packing", fmu)
    typer.echo(loop.table(FmuFactory(str(path), options.parameters(parameters)), seconds))


def step_control(
    fmu: options.FmuOption = None,
    exchange: Annotated[Exchange, typer.Option(help="Order of the exchange.")] = Exchange.GRAINS_FIRST,
    parameters: options.SetOption = None,
) -> None:
    """Compare controlled communication steps with fixed ones: error against cost of a burst of shaking."""
    from jostle_lab.demos.packing import stepping
    from jostle_lab.fmu.packing import FmuFactory

    path = locate.fmu("packing.fmu", "packing", fmu)
    typer.echo(stepping.table(FmuFactory(str(path), options.parameters(parameters)), exchange))
