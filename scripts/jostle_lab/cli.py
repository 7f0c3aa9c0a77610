"""Command line: `python -m jostle_lab`. Thin: argument in, library call out."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import protocol
from jostle_lab.accelerometer import Accelerometer
from jostle_lab.binaries_command import binaries, verify
from jostle_lab.compare import compare_exchanges
from jostle_lab.coupling import Exchange
from jostle_lab.driver import CARRIED_MASSES, GBS_250F38CP01_04
from jostle_lab.errors import LabError, require
from jostle_lab.experiment import Setup
from jostle_lab.figures import draw_all
from jostle_lab.fmu_grains import FmuFactory, fingerprint
from jostle_lab.leave_out import leave_out
from jostle_lab.loudspeaker import Loudspeaker
from jostle_lab.notices import notices_command
from jostle_lab.peers import compare, compare_molecular_dynamics
from jostle_lab.ratchet.command import ratchet_demo
from jostle_lab.ratchet.page import ratchet_page
from jostle_lab.report import write_report
from jostle_lab.report_command import report
from jostle_lab.results import Results
from jostle_lab.run import Plan, run
from jostle_lab.stability_page import stability
from jostle_lab.sweep.command import sweep
from jostle_lab.thesis.command import figure
from jostle_lab.torque_demo import demonstrate

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="The laboratory of vibrated granular disks on a computer: a loudspeaker shakes a packing FMU, two "
    "accelerometers and a camera watch.",
)

app.command()(figure)
app.command()(report)
app.command()(leave_out)
app.command()(stability)
app.command()(sweep)
app.command()(ratchet_page)
app.command()(ratchet_demo)

DEMO_AMPLITUDES = "1,0.7,0.5,0.35,0.25,0.18,0.12,0.08,0.05"

FmuOption = Annotated[
    Path, typer.Option(help="Packing FMU, FMI 2.0 or 3.0, made by `jostle fmu packing --drive input`.")
]
ResultsOption = Annotated[Path, typer.Option(help="Folder for CSV files, pictures and the page of numbers.")]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="FMU parameter, such as contact.friction=0.2; may be repeated."),
]


def _parameters(assignments: list[str] | None) -> tuple[tuple[str, float], ...]:
    parsed = []
    for assignment in assignments or []:
        name, equals, value = assignment.partition("=")
        try:
            if not equals:
                raise ValueError
            parsed.append((name.strip(), float(value)))
        except ValueError:
            raise LabError(f"--set {assignment} is not NAME=NUMBER. Write, say, --set contact.friction=0.2") from None
    return tuple(parsed)


def _amplitudes(text: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise LabError(f"--amplitudes {text} is not a list of numbers. Write, say, --amplitudes 1,0.5,0.2") from None


@app.command()
def demo(
    fmu: FmuOption = Path("build/packing.fmu"),
    results: ResultsOption = Path("results"),
    full: Annotated[
        bool, typer.Option("--full", help="The thesis' protocol: 25 packings, 32 amplitudes of 20 minutes. Resumable.")
    ] = False,
    exchange: Annotated[Exchange, typer.Option(help="Order of the exchange.")] = Exchange.GRAINS_FIRST,
    seconds_per_amplitude: Annotated[
        int, typer.Option(help="Simulated seconds for each amplitude, 8 to 1200, a quarter of them to relax.")
    ] = 40,
    amplitudes: Annotated[
        str, typer.Option(help="Fractions of the full drive, separated by commas.")
    ] = DEMO_AMPLITUDES,
    packings: Annotated[int | None, typer.Option(min=1, max=1000, help="Number of packings; 2, or 25 if full.")] = None,
    first_seed: Annotated[int, typer.Option(min=0, help="Seed of the first packing; the others follow.")] = 1,
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
    parameters: SetOption = None,
    progress: Annotated[bool, typer.Option(help="Show a progress bar.")] = True,
) -> None:
    """Shake packings with decreasing amplitude; write CSV files, pictures and a page of numbers."""
    chosen = _parameters(parameters)
    schedule = protocol.thesis() if full else protocol.scaled_down(_amplitudes(amplitudes), seconds_per_amplitude)
    setup = Setup(
        schedule,
        steps_per_second,
        exchange,
        full_drive_gamma=full_drive_gamma,
        accelerometer=Accelerometer(bandwidth=sensor_bandwidth, resolution=sensor_resolution),
    )
    count = packings if packings is not None else (25 if full else 2)
    factory = FmuFactory(str(fmu), chosen)
    factory(first_seed).close()  # a wrong file or parameter is told here, before any process starts
    labels = (("FMU binary", fingerprint(fmu)), *((name, f"{value:g}") for name, value in chosen))
    plan = Plan(results, tuple(range(first_seed, first_seed + count)), setup, processes, progress, labels)
    run(plan, factory)
    _present(results)


@app.command()
def draw(results: ResultsOption = Path("results")) -> None:
    """Draw the pictures and write the page of numbers of a results folder again."""
    _present(results)


@app.command()
def exchanges(
    fmu: FmuOption = Path("build/packing.fmu"),
    seconds: Annotated[int, typer.Option(min=1, max=100, help="Simulated seconds for each line of the table.")] = 2,
    amplitude: Annotated[float, typer.Option(min=0.01, max=1.0, help="Fraction of the full drive.")] = 0.5,
    parameters: SetOption = None,
) -> None:
    """Compare the coupling error and the cost of the three orders of exchange for several step sizes."""
    typer.echo(compare_exchanges(FmuFactory(str(fmu), _parameters(parameters)), seconds, amplitude))


@app.command()
def torque_demo(
    fmi2: Annotated[Path, typer.Option(help="three_disk FMU for FMI 2.0.")] = Path("build/three_disk_fmi2.fmu"),
    fmi3: Annotated[Path, typer.Option(help="three_disk FMU for FMI 3.0.")] = Path("build/three_disk.fmu"),
    results: ResultsOption = Path("results/torque"),
    sample: Annotated[
        float, typer.Option(help="Time between actions of the controller [s], whole milliseconds.")
    ] = 5e-3,
    parameters: SetOption = None,
) -> None:
    """Hold the angular velocity of a disk by torque, in spite of stick and slip: numbers, a table and a picture."""
    milliseconds = 1e3 * require("--sample", sample, 1e-3, 1.0, "Give a time in seconds, such as 0.005.")
    if abs(milliseconds - round(milliseconds)) > 1e-6:
        raise LabError(f"--sample = {sample:g} s is not a whole number of milliseconds. Write, say, --sample 0.005")
    _, _, page = paths = demonstrate(fmi2, fmi3, results, round(milliseconds) / 1e3, dict(_parameters(parameters)))
    typer.echo(page.read_text())
    for path in paths:
        typer.echo(path)


@app.command()
def loudspeaker() -> None:
    """Print the loudspeaker: driver, masses, and what full drive asks of it."""
    speaker, driver = Loudspeaker(1.0 / 2400), GBS_250F38CP01_04
    typer.echo(f"{driver.name}\n  {driver.source}")
    for name, mass in CARRIED_MASSES.items():
        typer.echo(f"  {mass:6.3f} kg  {name}")
    typer.echo(f"  {speaker.mass:6.3f} kg  in all, with {driver.moving_mass} kg of cone and coil")
    typer.echo(f"  {1e3 * speaker.static_sag():.2f} mm sag of {1e3 * driver.maximum_excursion:g} mm linear excursion")
    for gamma in (0.2, 1.0, 5.0, 8.0):
        voltage = speaker.voltage_for_acceleration(gamma * 9.8)
        response = speaker.steady_state(voltage)
        power = 0.5 * abs(response.current) ** 2 * driver.coil_resistance
        typer.echo(
            f"  Gamma {gamma:3.1f}: {voltage:6.2f} V, {abs(response.current):5.2f} A peak, {power:6.1f} W of "
            f"{driver.rated_power:g} W, {1e3 * abs(response.displacement):.3f} mm"
        )


@app.command()
def peers(
    source: Annotated[Path, typer.Argument(help="C++ source, such as refed.cpp, or refdem.cpp with --state.")],
    rounds: Annotated[int, typer.Option(min=1, max=50, help="Runs of each program, in turn.")] = 5,
    state: Annotated[
        list[Path] | None, typer.Option(help="State of molecular dynamics, such as s60.txt; may be repeated.")
    ] = None,
    copies: Annotated[
        list[int] | None, typer.Option(min=1, help="With --state: copies of it side by side; may be repeated.")
    ] = None,
) -> None:
    """Measure an engine beside another program: nanoseconds a collision, or with --state a disk and step."""
    typer.echo("case            ours [ns]  theirs [ns]  ratio")
    rows: list[tuple[str, float, float, float]]
    if state:
        rows = compare_molecular_dynamics(source, state, copies or [1], rounds)
    else:
        rows = [(f"{row[0]} disks", *row[1:]) for row in compare(source, rounds)]
    for case, ours, theirs, ratio in rows:
        typer.echo(f"{case:14} {ours:10.2f} {theirs:12.2f} {ratio:6.2f}")


app.command()(binaries)
app.command()(verify)
app.command("notices")(notices_command)


def _present(folder: Path) -> None:
    results = Results(folder)
    for path in [*draw_all(results), write_report(results)]:
        typer.echo(path)


def main() -> None:
    """Entry point: what the user can put right is told in one line, without a traceback."""
    try:
        app()
    except LabError as error:
        typer.echo(f"error: {error}", err=True)
        raise SystemExit(2) from None
