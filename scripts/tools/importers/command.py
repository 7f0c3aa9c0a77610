"""`python -m tools importers FOLDER`: importers that are too heavy for the tests, on FMUs of four scenes."""

import json
import math
import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from jostle_lab.errors import LabError
from jostle_lab.locate import program
from jostle_lab.tables import markdown_table

DRIVERS = Path(__file__).with_name("drivers")
STEP, STEPS, AMPLITUDE, OMEGA = 1.0 / 512.0, 128, 1e-3, 2.0 * math.pi * 20.0


@dataclass(frozen=True)
class Importer:
    """An importer, what pip needs for it, and the driver that runs or checks one case."""

    name: str
    requirements: tuple[str, ...]
    driver: str
    runs: bool = True
    """It simulates, so that its outputs are compared; otherwise it reads or checks."""


TOOLBOX = ("fmu-manipulation-toolbox==2.0", "fmpy==0.3.32")
IMPORTERS = (
    Importer("ecospy 0.7.2", ("ecospy==0.7.2", "tbb"), "run_ecos"),
    Importer("cofmupy 1.0.0", ("cofmupy==1.0.0",), "run_cofmupy"),
    Importer("fmucontainer 2.0", TOOLBOX, "run_container"),
    Importer("fmutool 2.0, check", TOOLBOX, "check_fmutool", runs=False),
    Importer("fmureader 0.1.2", ("fmureader==0.1.2",), "read_fmureader", runs=False),
    Importer("xsdata 26.10, strict", ("xsdata[cli,lxml]==26.10", "ruff", "fmpy==0.3.32"), "read_strictly", runs=False),
)
SCENES = {
    "packing": ("base.displacement", "base.velocity"),
    "ratchet": ("base.displacement", "base.velocity"),
    "wedge": (),
    "three_disk": ("torque",),
}
"""Each with the inputs that are set; the wedge is the map, which has none."""
OUTPUTS = ("disk.angle[1]", "base.reaction_force", "energy.kinetic")
CASES = [(scene, version, ()) for scene in SCENES for version in (2, 3)] + [("packing", 3, ("--arrays",))]


def importers(
    folder: Annotated[Path, typer.Argument(help="Empty folder for environments and FMUs; 2 GB, a few minutes.")],
    only: Annotated[list[str] | None, typer.Option(help="Names that begin so; all without.")] = None,
) -> None:
    """Install each importer into an environment of its own, and print what it makes of four scenes as a table.

    Outputs after a quarter of a second are compared with those of fmpy through FMI 2.0, to the last bit.
    """
    chosen = [each for each in IMPORTERS if not only or each.name.startswith(tuple(only))]
    if not chosen:
        raise LabError(f"--only {only}: no importer begins so. There are: {', '.join(each.name for each in IMPORTERS)}")
    folder.mkdir(parents=True, exist_ok=True)
    folder = folder.resolve()
    paths = [_case(folder, *case) for case in CASES]
    rows = []
    for importer in chosen:
        python = _environment(folder, importer)
        rows.append([importer.name, *(_outcome(python, importer, path) for path in paths)])
        typer.echo(f"{importer.name}: done", err=True)
    header = ["importer", *(path.stem for path in paths)]
    typer.echo(markdown_table(header, rows))


def _case(folder: Path, scene: str, version: int, options: Sequence[str]) -> Path:
    """Writes the FMU and, beside it, what a driver needs to know."""
    name = f"{scene}{version}{''.join(options).replace('--', '_')}"
    fmu, path = folder / f"{name}.fmu", folder / f"{name}.json"
    jostle = str(program())
    subprocess.run([jostle, "fmu", scene, "--fmi", str(version), *options, "--out", fmu], check=True)
    inputs = SCENES[scene]
    rows = [_motion(scene, n * STEP)[: len(inputs)] for n in range(STEPS)]
    case = {"fmu": str(fmu), "step": STEP, "inputs": inputs, "outputs": OUTPUTS, "rows": rows}
    if version == 2:
        case["expected"] = _in_fmpy(case)
    else:
        case["expected"] = json.loads((folder / f"{scene}2.json").read_text(encoding="utf-8"))["expected"]
    path.write_text(json.dumps(case), encoding="utf-8")
    return path


def _motion(scene: str, time: float) -> list[float]:
    if scene == "three_disk":
        return [0.1 * math.sin(OMEGA * time)]
    return [AMPLITUDE * (1.0 - math.cos(OMEGA * time)), AMPLITUDE * OMEGA * math.sin(OMEGA * time)]


def _in_fmpy(case: dict[str, Any]) -> list[float]:
    model = read_model_description(case["fmu"])
    reference = {variable.name: variable.valueReference for variable in model.modelVariables}
    identifier = model.coSimulation.modelIdentifier
    unpacked = extract(case["fmu"])
    slave = FMU2Slave(guid=model.guid, unzipDirectory=unpacked, modelIdentifier=identifier, instanceName="x")
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    for n, row in enumerate(case["rows"]):
        slave.setReal([reference[name] for name in case["inputs"]], row)
        slave.doStep(n * STEP, STEP)
    values = list(slave.getReal([reference[name] for name in case["outputs"]]))
    slave.terminate()
    slave.freeInstance()
    return values


def _environment(folder: Path, importer: Importer) -> Path:
    """The interpreter of an environment with the importer, made if it is not there."""
    place = folder / importer.driver
    python = place / "bin" / "python"
    if not (place / "complete").is_file():
        subprocess.run([sys.executable, "-m", "venv", "--clear", place], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", *importer.requirements], check=True)
        (place / "complete").touch()
    return python


def _outcome(python: Path, importer: Importer, path: Path) -> str:
    """What the driver says of a case: a word, or the last line of its error."""
    # Packages such as tbb put libraries there, which the loader does not find otherwise.
    libraries = {"LD_LIBRARY_PATH": str(python.parents[1] / "lib")}
    # Nothing of this project is to be imported there.
    surroundings = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    command = [str(python), str(DRIVERS / f"{importer.driver}.py"), str(path)]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=300, env=surroundings | libraries
    )
    if done.returncode != 0:
        lines = (done.stderr + done.stdout).strip().splitlines()
        return f"fails: {lines[-1] if lines else f'ended with {done.returncode}'}"
    said = json.loads(done.stdout.splitlines()[-1])
    if not importer.runs:
        return str(said)
    expected = json.loads(path.read_text(encoding="utf-8"))["expected"]
    return "same bits" if said == expected else f"{said} instead of {expected}"
