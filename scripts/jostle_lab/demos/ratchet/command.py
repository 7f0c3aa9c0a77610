"""`jostle-lab ratchet-demo`. What takes long to import is imported when it is needed."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate, options
from jostle_lab.errors import LabError


def ratchet_demo(
    fmu: options.FmuOption = None,
    results: Annotated[Path, typer.Option(help="Folder that gets ratchet-demo/.")] = Path("results"),
    gamma: Annotated[float, typer.Option(help="Gamma that the controller holds.")] = 3.0,
    low: Annotated[float, typer.Option(help="First frequency [Hz]; above --high it falls.")] = 16.0,
    high: Annotated[float, typer.Option(help="Last frequency [Hz].")] = 46.0,
    steps: Annotated[int, typer.Option(min=2, max=200, help="Frequencies, ends included.")] = 16,
    seconds: Annotated[float, typer.Option(help="Simulated seconds at each frequency, settling apart.")] = 12.0,
    seed: Annotated[int, typer.Option(min=0, max=options.LARGEST_SEED, help="Seed of the disks.")] = 1,
    progress: options.ProgressOption = True,
) -> None:
    """Hold Gamma of a shaken ratchet by feedback, sweep the frequency, and watch the flow reverse."""
    from jostle_lab.demos.ratchet.sweep import Plan, make
    from jostle_lab.fmu.instance import fingerprint
    from jostle_lab.plots.style import house_style
    from jostle_lab.statements import write

    if low == high:
        raise LabError(f"--low = {low:g} and --high = {high:g} are one frequency, which shows no reversal. Name two.")
    path = locate.fmu("ratchet.fmu", "ratchet", fmu)
    folder = results / "ratchet-demo"
    folder.mkdir(parents=True, exist_ok=True)  # before the work, which would be lost
    frequencies = tuple(low + (high - low) * i / (steps - 1) for i in range(steps))
    with house_style():
        product = make(path, Plan(gamma, frequencies, seconds, seed), progress)
        command = f"jostle-lab ratchet-demo --gamma {gamma:g} --low {low:g} --high {high:g} --steps {steps}"
        command += f" --seconds {seconds:g} --seed {seed}"
        paths = write(product, folder, command, f"FMU binary {fingerprint(path)}")
    for statement in product.statements:
        typer.echo(f"{statement.printed}: {statement.verdict}\n  {statement.found}")
    for written in paths:
        typer.echo(written)
