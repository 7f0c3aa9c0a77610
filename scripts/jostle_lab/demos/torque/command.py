"""`jostle-lab torque-demo`. What takes long to import is imported when it is needed."""

from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate, options
from jostle_lab.errors import LabError, require


def torque_demo(
    fmi2: Annotated[Path | None, typer.Option(help="FMU of three_disk for FMI 2.0; else three_disk_fmi2.fmu.")] = None,
    fmi3: Annotated[Path | None, typer.Option(help="FMU of three_disk for FMI 3.0; else three_disk.fmu.")] = None,
    results: options.ResultsOption = Path("results/torque"),
    sample: Annotated[
        float, typer.Option(help="Time between actions of the controller [s], whole milliseconds.")
    ] = 5e-3,
    parameters: options.SetOption = None,
) -> None:
    """Hold the angular velocity of a disk by torque, in spite of stick and slip: numbers, a table and a picture."""
    from jostle_lab.demos.torque.demo import demonstrate
    from jostle_lab.fmu.instance import require_version

    milliseconds = 1e3 * require("--sample", sample, 1e-3, 1.0, "Give a time in seconds, such as 0.005.")
    if abs(milliseconds - round(milliseconds)) > 1e-6:
        raise LabError(f"--sample = {sample:g} s is not a whole number of milliseconds. Write, say, --sample 0.005")
    chosen = dict(options.parameters(parameters))
    two = locate.fmu("three_disk_fmi2.fmu", "three_disk", fmi2, 2, "--fmi2")
    three = locate.fmu("three_disk.fmu", "three_disk", fmi3, 3, "--fmi3")
    for path, version in ((two, 2), (three, 3)):
        require_version(path, "three_disk", version, f"--fmi{version}")
    _, _, page = paths = demonstrate(two, three, results, round(milliseconds) / 1e3, chosen)
    typer.echo(page.read_text())
    for path in paths:
        typer.echo(path)
