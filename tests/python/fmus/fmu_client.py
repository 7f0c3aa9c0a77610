"""Low-level use of FMUs through fmpy, alike for both versions."""

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import fmpy
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.model_description import ModelDescription


def describe(fmu: Path) -> tuple[ModelDescription, dict[str, int]]:
    """The model description and the value references by name."""
    description = fmpy.read_model_description(str(fmu))
    return description, {variable.name: variable.valueReference for variable in description.modelVariables}


@contextmanager
def in_fmpy(fmu: Path, unpacked: Path, *, initialized: bool = True) -> Iterator[tuple[Any, dict[str, int]]]:
    """An instance in fmpy without a resource path and its value references; freed and unloaded at the end."""
    description, reference = describe(fmu)
    shutil.rmtree(unpacked, ignore_errors=True)
    fmpy.extract(str(fmu), str(unpacked))
    common = {
        "unzipDirectory": str(unpacked),
        "modelIdentifier": description.coSimulation.modelIdentifier,
        "guid": description.guid,
    }
    if description.fmiVersion == "2.0":
        slave: Any = FMU2Slave(**common)
        slave.instantiate()
        if initialized:
            slave.setupExperiment(startTime=0.0)
            slave.enterInitializationMode()
            slave.exitInitializationMode()
    else:
        slave = FMU3Slave(**common, instanceName="grains")
        slave.instantiate()
        if initialized:
            slave.enterInitializationMode()
            slave.exitInitializationMode()
    yield slave, reference
    slave.freeInstance()


def getter(slave: Any) -> Callable[[list[int]], Any]:
    """The function that reads reals."""
    return slave.getReal if isinstance(slave, FMU2Slave) else slave.getFloat64


def setter(slave: Any) -> Callable[[list[int], list[float]], Any]:
    """The function that sets reals."""
    return slave.setReal if isinstance(slave, FMU2Slave) else slave.setFloat64
