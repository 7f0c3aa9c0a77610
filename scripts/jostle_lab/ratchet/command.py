"""`python -m jostle_lab ratchet-demo`."""

from pathlib import Path
from typing import Annotated

import matplotlib as mpl
import typer

from jostle_lab.figures import STYLE
from jostle_lab.fmu_grains import fingerprint
from jostle_lab.ratchet.demo import Plan, make
from jostle_lab.thesis.product import write


def ratchet_demo(
    fmu: Annotated[Path, typer.Option(help="Ratchet FMU, 2.0 or 3.0: `jostle fmu ratchet --drive input`.")] = Path(
        "build/ratchet.fmu"
    ),
    results: Annotated[Path, typer.Option(help="Folder that gets ratchet-demo/.")] = Path("results"),
    gamma: Annotated[float, typer.Option(help="Gamma that the controller holds.")] = 3.0,
    low: Annotated[float, typer.Option(help="First frequency [Hz].")] = 16.0,
    high: Annotated[float, typer.Option(help="Last frequency [Hz].")] = 46.0,
    steps: Annotated[int, typer.Option(min=2, max=200, help="Frequencies, ends included.")] = 16,
    seconds: Annotated[float, typer.Option(help="Simulated seconds at each frequency, settling apart.")] = 12.0,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the disks.")] = 1,
    progress: Annotated[bool, typer.Option(help="Show a progress bar.")] = True,
) -> None:
    """Hold Gamma of a shaken ratchet by feedback, sweep the frequency, and watch the flow reverse."""
    frequencies = tuple(low + (high - low) * i / (steps - 1) for i in range(steps))
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        product = make(fmu, Plan(gamma, frequencies, seconds, seed), progress)
        command = f"python -m jostle_lab ratchet-demo --gamma {gamma:g} --low {low:g} --high {high:g} --steps {steps}"
        command += f" --seconds {seconds:g} --seed {seed}"
        paths = write(product, results / "ratchet-demo", command, f"FMU binary {fingerprint(fmu)}")
    for statement in product.statements:
        typer.echo(f"{statement.printed}: {statement.verdict}\n  {statement.found}")
    for path in paths:
        typer.echo(path)
