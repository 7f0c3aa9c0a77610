"""`jostle-lab demo`, `draw`, `exchanges`, `held-loop`, `step-control`. Each command imports what it needs."""

import time
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jostle_lab import locate, options
from jostle_lab.coupling.exchange import Exchange
from jostle_lab.demos.packing import schedules
from jostle_lab.errors import LabError, describe_os_error
from jostle_lab.protocol import intervals

if TYPE_CHECKING:
    from jostle_lab.fmu.packing import FmuFactory
    from jostle_lab.protocol.packings import Plan


def _amplitudes(text: str) -> tuple[float, ...]:
    try:
        return schedules.numbers(text)
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
    results: Annotated[
        Path | None, typer.Option(help="Folder for tables, pictures and pages: results, or results/quick with --quick.")
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="A short run: 6 amplitudes of 12 s.")] = False,
    full: Annotated[
        bool, typer.Option("--full", help="The thesis' protocol: 25 packings, 32 amplitudes of 20 minutes. Resumable.")
    ] = False,
    exchange: Annotated[Exchange, typer.Option(help="Order of the exchange.")] = Exchange.GRAINS_FIRST,
    seconds_per_amplitude: Annotated[
        int | None,
        typer.Option(help="Simulated seconds for each amplitude, 8 to 1200, a quarter of them to relax; else 40."),
    ] = None,
    amplitudes: Annotated[
        str | None, typer.Option(help=f"Fractions of the full drive; {schedules.AMPLITUDES} unless set.")
    ] = None,
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
    """Shake packings with decreasing amplitude; write tables, pictures and the page index.html.

    The first picture comes some seconds after the start. It may be stopped at any time: the same command goes on.
    """
    from jostle_lab.coupling.master import check_landing
    from jostle_lab.fmu.instance import fingerprint
    from jostle_lab.fmu.packing import FmuFactory
    from jostle_lab.protocol.experiment import Setup
    from jostle_lab.protocol.packings import Plan
    from jostle_lab.sensors.accelerometer import Accelerometer
    from jostle_lab.sensors.markings import require_scikit_image

    started = time.monotonic()
    chosen = options.parameters(parameters, seed="--first-seed")
    path = locate.fmu("packing.fmu", "packing", fmu)
    setup = Setup(
        _schedule(quick, full, amplitudes, seconds_per_amplitude),
        steps_per_second,
        exchange,
        full_drive_gamma=full_drive_gamma,
        accelerometer=Accelerometer(bandwidth=sensor_bandwidth, resolution=sensor_resolution),
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
    folder = results if results is not None else Path("results/quick" if quick else "results")
    _shake_and_draw(Plan(folder, seeds, setup, processes, progress, labels), factory, pictures, started)


def _schedule(quick: bool, full: bool, amplitudes: str | None, seconds: int | None) -> intervals.Protocol:
    """The protocol that the options ask for."""
    if full:
        names = (("--quick", quick), ("--amplitudes", amplitudes), ("--seconds-per-amplitude", seconds))
        if given := [name for name, value in names if value]:
            raise LabError(f"--full is the whole protocol of the thesis and {given[0]} changes it. Leave one out.")
        return schedules.FULL
    usual, usual_seconds = schedules.AMPLITUDES, schedules.SECONDS
    if quick:
        usual, usual_seconds = schedules.QUICK_AMPLITUDES, schedules.QUICK_SECONDS
    return intervals.scaled_down(
        _amplitudes(usual if amplitudes is None else amplitudes), usual_seconds if seconds is None else seconds
    )


def _shake_and_draw(plan: "Plan", factory: "FmuFactory", pictures: bool, started: float) -> None:
    from jostle_lab.demos.packing.live import Live
    from jostle_lab.locks import held
    from jostle_lab.progress import say
    from jostle_lab.protocol.packings import claim, run_in_held_folder
    from jostle_lab.protocol.pictures import Processing, process
    from jostle_lab.protocol.results import Results

    plan.results.mkdir(parents=True, exist_ok=True)
    with held(plan.results, "demo"):
        claim(plan)
        live = Live(plan.results, plan.setup.full_drive_gamma, say, started)
        try:
            live.begin(plan.seconds_kept() / plan.seconds())
            run_in_held_folder(plan, factory, live)
            if pictures:
                process(Results(plan.results), Processing())
            _draw(plan.results)
        except KeyboardInterrupt:
            live.ended(plan.kept())
            raise
        except (LabError, OSError) as error:
            kept = plan.kept()
            live.ended(f"{describe_os_error(error) if isinstance(error, OSError) else error} {kept}")
            typer.echo(f"\n{kept}", err=True)
            raise
        live.finished()


def draw(results: options.ResultsOption = Path("results")) -> None:
    """Draw the pictures and write the pages of a results folder again."""
    from jostle_lab.locks import held

    if not results.is_dir():
        raise LabError(f"There is no folder {results}. Run `jostle-lab demo --results {results}`.")
    with held(results, "drawing"):
        _draw(results)


def _draw(folder: Path) -> None:
    from jostle_lab.demos.packing import figures, numbers, page
    from jostle_lab.protocol.results import Results

    found = Results(folder)
    for path in [*figures.draw_all(found), numbers.write_report(found)]:
        typer.echo(path)
    typer.echo(f"{page.write(folder)}: all of it with explanations; open this one")


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
