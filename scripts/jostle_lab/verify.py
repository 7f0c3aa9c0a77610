"""Runs what scripts/release built as its users will: along its reference, in fmpy, and into a panic.

Every FMU follows its own reference trajectory to the last bit, by `jostle replay` and in fmpy, which knows nothing of
us; and a panic inside of a scene, which a small FMU made for tests provokes, stays in its instance.
"""

import csv
import multiprocessing
import subprocess
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

from jostle_lab.errors import LabError

REFERENCE = "extra/jostle/reference.csv"
"""Where an FMU keeps its reference trajectory."""

STEP = 1e-2
"""Communication step of the probe [s]."""

PANIC_TIME = 0.05
"""The probe is told to panic in a step beyond this [s]."""


def verify(folder: Path, probes: list[Path]) -> list[str]:
    """Check every FMU in `folder` and the FMUs `probes` that can be told to panic; what was done, a line each.

    Raises LabError at the first thing that is not as it should be.
    """
    told = []
    for two in sorted((folder / "fmu").glob("*.fmi2.fmu")):
        three = two.with_name(two.name.replace(".fmi2.", ".fmi3."))
        counts = []
        for fmu in (two, three):
            _replayed(folder / "jostle", fmu)
            problems = validate_fmu(str(fmu))
            _hold(not problems, f"fmpy's validator finds in {fmu}: {problems}")
            counts.append(_along_the_reference(fmu))
        told.append(f"{two.name.removesuffix('.fmi2.fmu')}: {counts[0]} outputs to the bit, FMI 2.0 and 3.0")
    _hold(bool(told), f"there is no FMU in {folder / 'fmu'}. Run scripts/release")
    for probe in probes:
        in_a_child(_panic_stays_in_its_instance, probe)
        told.append(f"{probe.name}: a panic stayed in its instance, its neighbour went on, a reset healed it")
    return told


def _replayed(program: Path, fmu: Path) -> None:
    done = subprocess.run([program, "replay", "--exact", fmu], capture_output=True, text=True, check=False)
    _hold(done.returncode == 0, f"{fmu} does not follow its own reference: {done.stderr.strip()}")


def _along_the_reference(fmu: Path) -> int:
    """Runs an FMU in fmpy with the inputs of its reference; how many outputs there are, each as in the reference."""
    with zipfile.ZipFile(fmu) as archive:
        lines = archive.read(REFERENCE).decode().splitlines()
    names = next(csv.reader(lines))
    table = np.array([[float(cell) for cell in row] for row in csv.reader(lines[1:])]).T
    reference = dict(zip(names, table, strict=True))
    description = read_model_description(str(fmu))
    inputs = [variable.name for variable in description.modelVariables if variable.causality == "input"]
    outputs = [name for name in names if name not in ("time", *inputs)]
    columns = [reference["time"], *(reference[name] for name in inputs)]
    signals = np.rec.fromarrays(columns, dtype=[(name, float) for name in ("time", *inputs)]) if inputs else None
    time = reference["time"]
    try:
        seen = simulate_fmu(
            str(fmu), stop_time=time[-1], output_interval=time[1] - time[0], input=signals, output=outputs
        )
    except FMICallException as error:
        raise LabError(f"{fmu} does not run in fmpy: {error}") from error
    _hold(len(seen) == len(time), f"{fmu}: fmpy took {len(seen)} points, the reference has {len(time)}")
    for name in outputs:
        _hold(bool(np.array_equal(seen[name], reference[name])), f"{fmu}: {name} in fmpy is not that of the reference")
    return len(outputs)


def in_a_child(check: Callable[[Path], None], fmu: Path) -> None:
    """An uncaught panic aborts the process: it shall be one that can tell of it no more than by its exit code."""
    child = multiprocessing.get_context("spawn").Process(target=check, args=(fmu,))
    child.start()
    child.join()
    _hold(child.exitcode == 0, f"{fmu}: a panic of the scene ended its process with exit code {child.exitcode}")


def _panic_stays_in_its_instance(fmu: Path) -> None:
    with tempfile.TemporaryDirectory() as directory:
        extract(str(fmu), directory)
        with _instance(fmu, Path(directory), 1e9) as alone:
            expected = [_stepped(alone, n) for n in range(8)]
        with (
            _instance(fmu, Path(directory), PANIC_TIME) as panicking,
            _instance(fmu, Path(directory), 1e9) as neighbour,
        ):
            before = [(_stepped(panicking, n), _stepped(neighbour, n)) for n in range(4)]
            _hold(before == [(value, value) for value in expected[:4]], f"{fmu}: runs differ before the panic")
            for _ in range(2):
                _hold(_refused(panicking, 4, 3 * STEP), f"{fmu}: the step into the panic was not refused")
            _hold(
                [_stepped(neighbour, n) for n in range(4, 8)] == expected[4:],
                f"{fmu}: a panic changed another instance",
            )
            panicking.reset()
            _initialise(panicking, _references(fmu), 1e9)
            _hold([_stepped(panicking, n) for n in range(8)] == expected, f"{fmu}: a reset does not heal a panic")


def _references(fmu: Path) -> dict[str, int]:
    return {variable.name: variable.valueReference for variable in read_model_description(str(fmu)).modelVariables}


@contextmanager
def _instance(fmu: Path, directory: Path, panic_time: float) -> Iterator[Any]:
    description = read_model_description(str(fmu))
    kind = FMU2Slave if description.fmiVersion == "2.0" else FMU3Slave
    slave = kind(
        guid=description.guid,
        unzipDirectory=str(directory),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="probe",
    )
    slave.instantiate()
    _initialise(slave, _references(fmu), panic_time)
    slave.observed = _references(fmu)["disk.displacement[1]"]
    try:
        yield slave
    finally:
        slave.freeInstance()


def _initialise(slave: Any, references: dict[str, int], panic_time: float) -> None:
    setter = slave.setReal if isinstance(slave, FMU2Slave) else slave.setFloat64
    setter([references["fault.panic_time"]], [panic_time])
    if isinstance(slave, FMU2Slave):
        slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()


def _stepped(slave: Any, number: int) -> float:
    slave.doStep(number * STEP, STEP)
    getter = slave.getReal if isinstance(slave, FMU2Slave) else slave.getFloat64
    return float(getter([slave.observed])[0])


def _refused(slave: Any, number: int, step: float) -> bool:
    try:
        slave.doStep(number * STEP, step)
    except FMICallException:
        return True
    return False


def _hold(condition: bool, otherwise: str) -> None:
    if not condition:
        raise LabError(otherwise)
