"""An FMU of disks as `Grains`, through fmpy, for FMI 2.0 and FMI 3.0 alike. Only this file knows fmpy.

Calls in the loop go straight to the C functions that fmpy has loaded, with arrays made once: a few microseconds each
where fmpy's own wrappers build arrays anew.
"""

import ctypes
import shutil
import zipfile
import zlib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from fmpy import extract, fmi2, read_model_description
from fmpy.fmi1 import FMICallException, printLogMessage
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.logging import addLoggerProxy
from numpy.typing import NDArray

from jostle_lab.errors import LabError

WARNING = 1
"""Highest status that is still a success: 0 ok, 1 warning, 2 discard, 3 error, 4 fatal."""


@dataclass(frozen=True)
class FmuFactory:
    """Makes `FmuGrains` of a file; can be sent to another process."""

    path: str
    parameters: tuple[tuple[str, float], ...] = ()

    def __call__(self, seed: int) -> "FmuGrains":
        """Grains of one packing."""
        return FmuGrains(Path(self.path), {**dict(self.parameters), "seed": seed})


def _describe(path: Path) -> Any:
    try:
        return read_model_description(str(path))
    except Exception as error:
        raise LabError(f"{path} is not a readable FMU: {error}. Bundle it again with `jostle fmu packing`.") from error


def fingerprint(path: Path) -> str:
    """Checksum of the binaries of an FMU, eight hexadecimal digits: the same physics, the same fingerprint."""
    with zipfile.ZipFile(path) as archive:
        sums = [entry.CRC for entry in archive.infolist() if entry.filename.startswith("binaries/")]
    return f"{zlib.crc32(repr(sums).encode()):08x}"


class _Variables:
    """A fixed group of Float64 variables, read or written in one call."""

    def __init__(self, references: list[int]) -> None:
        self.count = len(references)
        self.references = (ctypes.c_uint * self.count)(*references)
        self.values = np.zeros(self.count)
        self.pointer = self.values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


_LOGS: dict[int, list[str]] = {}
"""Messages of the FMI 2.0 instances that live, by their environment."""


def _route(environment: int | None, name: bytes, status: int, category: bytes, message: bytes) -> None:
    """One logger for all: fmpy's proxy, which formats messages, keeps a single target for the whole process."""
    if environment in _LOGS:
        _LOGS[environment].append(message.decode(errors="replace"))
    else:
        printLogMessage(environment, name, status, category, message)


_LOGGER = fmi2.fmi2CallbackLoggerTYPE(_route)


class FmuGrains:
    """One instance of an FMU of disks on a base that follows inputs: a packing, unless a subclass says otherwise.

    Args:
        path: the FMU.
        parameters: values by name, set before initialisation.

    Raises LabError when the file, a variable or a parameter is not what the laboratory needs.

    """

    scene = "packing"

    def __init__(self, path: Path, parameters: Mapping[str, float] | None = None) -> None:
        if not path.is_file():
            raise LabError(f"No FMU at {path}. Make one: target/release/jostle fmu {self.scene} --fmi 3 --out {path}")
        self.path = path
        self.costs = {"step": 0.0, "get and set": 0.0, "save and restore": 0.0}
        self._log: list[str] = []
        self._description = _describe(path)
        self._variables = {v.name: v for v in self._description.modelVariables}
        self._directory = extract(str(path))
        self._time = self._start = self._step = 0.0
        self._steps = 0
        self._fmu: Any = None
        try:
            self._instantiate()
            self._initialise(dict(parameters or {}))
        except BaseException:
            self.close()
            raise

    def _instantiate(self) -> None:
        description = self._description
        if description.coSimulation is None:
            raise LabError(f"{self.path} has no co-simulation interface. Bundle it with `jostle fmu {self.scene}`.")
        self.fmi_version = 2 if description.fmiVersion.startswith("2") else 3
        arguments = {
            "guid": description.guid,
            "unzipDirectory": self._directory,
            "modelIdentifier": description.coSimulation.modelIdentifier,
            "instanceName": self.scene,
        }
        try:
            if self.fmi_version == 2:
                fmu: Any = FMU2Slave(**arguments)
                fmu.instantiate(callbacks=self._callbacks())
            else:
                fmu = FMU3Slave(**arguments)
                fmu.instantiate(logMessage=self._record_log)
        except Exception as error:
            said = " ".join(self._log) or f"{error}."
            raise LabError(f"{self.path} cannot be instantiated. {said} Bundle it again after a build.") from error
        self._fmu = fmu
        library, prefix = fmu.dll, f"fmi{self.fmi_version}"
        self._do_step = getattr(library, f"{prefix}DoStep")
        real = "Real" if self.fmi_version == 2 else "Float64"
        self._get = getattr(library, f"{prefix}Get{real}")
        self._set = getattr(library, f"{prefix}Set{real}")
        self._flags = tuple(ctypes.byref(ctypes.c_bool()) for _ in range(3))
        self._reached = ctypes.byref(ctypes.c_double())

    def _callbacks(self) -> Any:
        """FMI 2.0 callbacks that keep the messages of the FMU for our errors."""
        callbacks = fmi2.fmi2CallbackFunctions()
        callbacks.logger = _LOGGER
        callbacks.allocateMemory = fmi2.defaultCallbacks.allocateMemory
        callbacks.freeMemory = fmi2.defaultCallbacks.freeMemory
        callbacks.componentEnvironment = id(self)
        addLoggerProxy(ctypes.byref(callbacks))
        _LOGS[id(self)] = self._log
        return callbacks

    def _record_log(self, _environment: Any, _status: int, _category: bytes, message: bytes) -> None:
        self._log.append(message.decode(errors="replace"))

    def _initialise(self, parameters: dict[str, float]) -> None:
        try:
            for name, value in parameters.items():
                self._set_parameter(name, value)
            if self.fmi_version == 2:
                self._fmu.setupExperiment(startTime=0.0)
            self._fmu.enterInitializationMode()
            self._fmu.exitInitializationMode()
        except LabError:
            raise
        except Exception as error:
            raise LabError(f"{self.path} refuses {parameters}: {error}. {' '.join(self._log)}") from error
        self._inputs = self._group(["base.displacement", "base.velocity"])
        self._force = self._group(["base.reaction_force"])
        self._energy = self._group(["energy.input"])
        disks = sum(1 for name in self._variables if name.startswith("disk.angle["))
        indices = range(1, disks + 1)
        self._angles = self._group([f"disk.angle[{i}]" for i in indices])
        self._positions = self._group([f"disk.{axis}[{i}]" for i in indices for axis in "xy"])
        self.radii = self._read(self._group([f"disk.radius[{i}]" for i in indices])).copy()
        self.gravity = self.read("gravity")
        self.box_width, self.weight = self._width_and_weight()

    def _width_and_weight(self) -> tuple[float, float]:
        """Width of the box [m] and weight of the disks [N]."""
        area = float(np.pi * np.sum(self.radii**2))
        return self.read("box.width"), self.read("disk.surface_density") * area * self.gravity

    def _variable(self, name: str) -> Any:
        if name not in self._variables:
            raise LabError(
                f"{self.path} has no variable {name}. Is it bundled with `jostle fmu {self.scene} --drive input`?"
            )
        return self._variables[name]

    def _group(self, names: list[str]) -> _Variables:
        return _Variables([self._variable(name).valueReference for name in names])

    def _set_parameter(self, name: str, value: float) -> None:
        variable = self._variable(name)
        number = value if variable.type in {"Real", "Float64"} else int(value)
        getattr(self._fmu, f"set{variable.type}")([variable.valueReference], [number])

    def _check(self, status: int, doing: str) -> None:
        if status > WARNING:
            said = " ".join(self._log[-3:]) or "It gave no message."
            raise LabError(f"{self.path} failed while {doing} at t = {self._time:.9g} s (status {status}). {said}")

    def _read(self, group: _Variables) -> NDArray[np.float64]:
        started = perf_counter()
        if self.fmi_version == 2:
            status = self._get(self._fmu.component, group.references, group.count, group.pointer)
        else:
            status = self._get(self._fmu.component, group.references, group.count, group.pointer, group.count)
        self._check(status, "reading")
        self.costs["get and set"] += perf_counter() - started
        return group.values

    def read(self, name: str) -> float:
        """Present value of one Float64 variable."""
        return float(self._read(self._group([name]))[0])

    def write(self, name: str, value: float) -> None:
        """Set one Float64 input."""
        group = self._group([name])
        group.values[0] = value
        if self.fmi_version == 2:
            status = self._set(self._fmu.component, group.references, 1, group.pointer)
        else:
            status = self._set(self._fmu.component, group.references, 1, group.pointer, 1)
        self._check(status, f"setting {name}")

    def step(self, displacement: float, velocity: float, step: float) -> float:
        """See `Grains.step`."""
        started = perf_counter()
        inputs, component = self._inputs, self._fmu.component
        inputs.values[0] = displacement
        inputs.values[1] = velocity
        if self.fmi_version == 2:
            status = self._set(component, inputs.references, 2, inputs.pointer)
        else:
            status = self._set(component, inputs.references, 2, inputs.pointer, 2)
        self._check(status, "setting the base")
        self.costs["get and set"] += perf_counter() - started
        return self._go(step)

    def _go(self, step: float) -> float:
        """Step with the inputs as they stand; the force over the step [N]."""
        ready, component = perf_counter(), self._fmu.component
        if self.fmi_version == 2:
            status = self._do_step(component, self._time, step, 0)
        else:
            status = self._do_step(component, self._time, step, False, *self._flags, self._reached)
        self._check(status, "stepping")
        self._advance_clock(step)
        self.costs["step"] += perf_counter() - ready
        return float(self._read(self._force)[0])

    def tell_rate(self, velocity: float) -> None:
        """Tell the base's velocity as the derivative of its displacement, by `fmi2SetRealInputDerivatives`."""
        if self.fmi_version != 2:
            raise LabError(f"{self.path}: input derivatives are of FMI 2.0. Bundle it with `jostle fmu --fmi 2`.")
        order, rate = ctypes.c_int(1), ctypes.c_double(velocity)
        status = self._fmu.dll.fmi2SetRealInputDerivatives(
            self._fmu.component, self._inputs.references, 1, ctypes.byref(order), ctypes.byref(rate)
        )
        self._check(status, "setting the derivative of the base's displacement")

    def step_on(self, displacement: float, step: float) -> float:
        """As `step`, with the velocity as it was told last."""
        self.write("base.displacement", displacement)
        return self._go(step)

    def _advance_clock(self, step: float) -> None:
        """Time is start + n h while h stays the same."""
        if step != self._step:
            self._start, self._step, self._steps = self._time, step, 0
        self._steps += 1
        self._time = self._start + self._steps * step

    def energy_input(self) -> float:
        """See `Grains.energy_input`."""
        return float(self._read(self._energy)[0])

    def angles(self) -> NDArray[np.float64]:
        """See `Grains.angles`."""
        return self._read(self._angles).copy()

    def positions(self) -> NDArray[np.float64]:
        """See `Grains.positions`."""
        return self._read(self._positions).reshape(-1, 2).copy()

    def save(self) -> Any:
        """See `Grains.save`."""
        started = perf_counter()
        state = self._fmu.getFMUstate() if self.fmi_version == 2 else self._fmu.getFMUState()
        clock = (self._time, self._steps, self._start, self._step)
        self.costs["save and restore"] += perf_counter() - started
        return state, clock

    def restore(self, saved: Any) -> None:
        """See `Grains.restore`."""
        started = perf_counter()
        state, (self._time, self._steps, self._start, self._step) = saved
        if self.fmi_version == 2:
            self._fmu.setFMUstate(state)
        else:
            self._fmu.setFMUState(state)
        self.costs["save and restore"] += perf_counter() - started

    def discard(self, saved: Any) -> None:
        """See `Grains.discard`."""
        if self.fmi_version == 2:
            self._fmu.freeFMUstate(saved[0])
        else:
            self._fmu.freeFMUState(saved[0])

    def close(self) -> None:
        """See `Grains.close`."""
        if self._fmu is not None:
            with suppress(FMICallException):  # an instance that never ran or has failed cannot be terminated
                self._fmu.terminate()
            self._fmu.freeInstance()
            self._fmu = None
        _LOGS.pop(id(self), None)
        shutil.rmtree(self._directory, ignore_errors=True)
