"""An FMU in, an initialised instance out: one wrapper for FMI 2.0 and FMI 3.0.

Of this package only this file uses fmpy. Calls in the loop go straight to the C functions that it has loaded, with
arrays made once: a few microseconds each where fmpy's own wrappers build arrays anew. Not here: what the variables of a
scene mean (`packing`, `ratchet`, `disk_on_two_supports`).
"""

import ctypes
import json
import shutil
import tempfile
import zipfile
import zlib
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from time import perf_counter
from types import TracebackType
from typing import Any, Self

import numpy as np
from fmpy import extract, fmi2, read_model_description
from fmpy.fmi1 import FMICallException, printLogMessage
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.logging import addLoggerProxy
from numpy.typing import NDArray

from jostle_lab import locate
from jostle_lab.errors import LabError, did_you_mean

WARNING = 1
"""Highest status that is still a success: 0 ok, 1 warning, 2 discard, 3 error, 4 fatal."""
START_TIME = 0.0


def describe(path: Path, scene: str = "packing", version: int = 3) -> Any:
    """The model description; `version` is that of the FMU which the error says how to make."""
    try:
        return read_model_description(str(path))
    except Exception as error:
        remedy = f"Make it again: {_made(scene, version)}"
        raise LabError(f"{path} is not a readable FMU: {str(error).rstrip('.')}. {remedy}") from error


def require_version(path: Path, scene: str, version: int, option: str) -> None:
    """Raise LabError unless the FMU is for this version of FMI, which `option` asks for."""
    found = describe(path, scene, version).fmiVersion
    if not found.startswith(str(version)):
        raise LabError(f"{option} {path} is an FMU for FMI {found}, not {version}.0. Make one: {_made(scene, version)}")


def _made(scene: str, version: int) -> str:
    return f"jostle fmu {scene} --drive input --fmi {version} --out {scene}_fmi{version}.fmu"


def fingerprint(path: Path) -> str:
    """Checksum of the binaries of an FMU, eight hexadecimal digits: the same physics, the same fingerprint."""
    try:
        archive = zipfile.ZipFile(path)
    except zipfile.BadZipFile as error:
        raise LabError(f"{path} is not a readable FMU: {error}. Bundle it again with `jostle fmu`.") from None
    with archive:
        sums = [entry.CRC for entry in archive.infolist() if entry.filename.startswith("binaries/")]
    return f"{zlib.crc32(repr(sums).encode()):08x}"


def _unpacked(path: Path) -> str:
    """A temporary folder with what is in an FMU; raises LabError if there is no room for it."""
    folder = tempfile.mkdtemp(prefix="jostle-fmu-")
    try:
        extract(str(path), unzipdir=folder)
    except OSError as error:
        shutil.rmtree(folder, ignore_errors=True)
        there = tempfile.gettempdir()
        raise LabError(
            f"{path} cannot be unpacked in {there}: {error.strerror or error}. Make room there, or name another folder "
            "with TMPDIR."
        ) from None
    return folder


class Group:
    """A fixed group of Float64 variables, read or written in one call."""

    def __init__(self, references: Sequence[int], fmi_version: int) -> None:
        count = len(references)
        self.values = np.zeros(count)
        self.references = (ctypes.c_uint * count)(*references)
        pointer = self.values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
        common = (self.references, count, pointer)
        self.arguments: tuple[Any, ...] = common if fmi_version == 2 else (*common, count)
        """Of `fmi2GetReal` or `fmi3GetFloat64` and of the setters, after the instance."""


_LOGS: dict[int, list[str]] = {}
"""Messages of the FMI 2.0 instances that live, by their environment."""


def _route(environment: int | None, name: bytes, status: int, category: bytes, message: bytes) -> None:
    """One logger for all: fmpy's proxy, which formats messages, keeps a single target for the whole process."""
    if environment in _LOGS:
        _LOGS[environment].append(message.decode(errors="replace"))
    else:
        printLogMessage(environment, name, status, category, message)


_LOGGER = fmi2.fmi2CallbackLoggerTYPE(_route)


class FmuInstance:
    """One instance of a co-simulation FMU, initialised at time 0; close it, or use it in a `with` block.

    Args:
        path: the FMU.
        parameters: values by name, set before initialisation.
        events: FMI 3.0 only: ask for early return and event mode, so that a step ends where an event is.
        directory: where the FMU is unpacked already; None: it is unpacked for this instance.

    Raises LabError when the file, a variable or a parameter is not what the laboratory needs.

    """

    scene = "packing"

    def __init__(
        self,
        path: Path,
        parameters: Mapping[str, float] | None = None,
        events: bool = False,
        directory: Path | None = None,
    ) -> None:
        self.path = locate.fmu(f"{self.scene}.fmu", self.scene, path)
        self.events = events
        self.costs = {"step": 0.0, "get and set": 0.0, "save and restore": 0.0}
        """Seconds of wall clock spent, by part."""
        self.time = START_TIME
        self._log: list[str] = []
        self._description = describe(path, self.scene)
        self._variables = {v.name: v for v in self._description.modelVariables}
        self._temporary = directory is None
        self._directory = str(directory) if directory is not None else _unpacked(path)
        self._fmu: Any = None
        try:
            self._instantiate()
            self._initialise(parameters or {})
            self._prepare()
        except BaseException:
            self.close()
            raise

    def _prepare(self) -> None:
        """What a scene reads once after initialisation."""

    def _instantiate(self) -> None:
        description, kind = self._description, self._description.coSimulation
        if kind is None:
            raise LabError(f"{self.path} has no co-simulation interface. Make one: {_made(self.scene, 3)}")
        self.fmi_version = 2 if description.fmiVersion.startswith("2") else 3
        if self.events and not (self.fmi_version == 3 and kind.hasEventMode):
            raise LabError(f"{self.path} has no event mode. Make one: {_made(self.scene, 3)}")
        slave = FMU2Slave if self.fmi_version == 2 else FMU3Slave
        fmu: Any = slave(
            guid=description.guid,
            unzipDirectory=self._directory,
            modelIdentifier=kind.modelIdentifier,
            instanceName=self.scene,
        )
        try:
            if self.fmi_version == 2:
                fmu.instantiate(callbacks=self._callbacks())
            else:
                modes = {"eventModeUsed": self.events, "earlyReturnAllowed": self.events}
                fmu.instantiate(logMessage=self._record_log, **modes)
        except Exception as error:
            said = " ".join(self._log) or f"{str(error).rstrip('.')}."
            raise LabError(f"{self.path} cannot be instantiated. {said} Bundle it again after a build.") from error
        self._fmu = fmu
        self._bind(fmu.dll)

    def _bind(self, library: Any) -> None:
        """The C functions of the loop."""
        prefix, real = f"fmi{self.fmi_version}", "Real" if self.fmi_version == 2 else "Float64"
        self._do_step, self._get, self._set = (
            getattr(library, f"{prefix}{name}") for name in ("DoStep", f"Get{real}", f"Set{real}")
        )
        self._flags, self._reached = [ctypes.c_bool() for _ in range(3)], ctypes.c_double()
        flags = [ctypes.byref(flag) for flag in self._flags]
        results = (*flags, ctypes.byref(self._reached))
        self._step_arguments: tuple[Any, ...] = (0,) if self.fmi_version == 2 else (False, *results)

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

    def _initialise(self, parameters: Mapping[str, float]) -> None:
        try:
            for name, value in parameters.items():
                self._set_parameter(name, value)
            if self.fmi_version == 2:
                self._fmu.setupExperiment(startTime=START_TIME)
            self._fmu.enterInitializationMode()
            self._fmu.exitInitializationMode()
        except LabError:
            raise
        except Exception as error:
            given = ", ".join(f"{name} = {value:g}" for name, value in parameters.items()) or "its start values"
            said = " ".join(self._log[-1:]) or f"{str(error).rstrip('.')}, and the FMU gave no message."
            raise LabError(f"{self.path} refuses {given}: {said}") from error
        if self.events:
            self.resume()

    def reset(self, parameters: Mapping[str, float]) -> None:
        """Back to time 0 with these parameters."""
        self._fmu.reset()
        self.time = START_TIME
        self._initialise(parameters)

    def _variable(self, name: str) -> Any:
        if name not in self._variables:
            near = did_you_mean(name, self._variables)
            made = f"Is it bundled with `jostle fmu {self.scene} --drive input`?"
            raise LabError(f"{self.path} has no variable {name}.{near} {made}")
        return self._variables[name]

    def group(self, names: Sequence[str]) -> Group:
        """Float64 variables to be read or written together."""
        return Group([self._variable(name).valueReference for name in names], self.fmi_version)

    def _set_parameter(self, name: str, value: float) -> None:
        variable = self._variable(name)
        number = value if variable.type in {"Real", "Float64"} else int(value)
        getattr(self._fmu, f"set{variable.type}")([variable.valueReference], [number])

    def check(self, status: int, doing: str) -> None:
        """Raise LabError, with the FMU's own words, if a status is not a success."""
        if status > WARNING:
            said = " ".join(self._log[-3:]) or "It gave no message."
            raise LabError(f"{self.path} failed while {doing} at t = {self.time:.9g} s (status {status}). {said}")

    def read_group(self, group: Group) -> NDArray[np.float64]:
        """Present values; the array is overwritten by the next call."""
        started = perf_counter()
        self.check(self._get(self._fmu.component, *group.arguments), "reading")
        self.costs["get and set"] += perf_counter() - started
        return group.values

    def write_group(self, group: Group, doing: str) -> None:
        """Set the variables of a group to its values."""
        self.check(self._set(self._fmu.component, *group.arguments), doing)

    def read(self, name: str) -> float:
        """Present value of one Float64 variable."""
        return float(self.read_group(self.group([name]))[0])

    def read_integers(self, names: Sequence[str]) -> list[int]:
        """Present values of integer variables."""
        getter: Callable[[list[int]], list[int]] = getattr(
            self._fmu, "getInteger" if self.fmi_version == 2 else "getInt64"
        )
        return [int(value) for value in getter([self._variable(name).valueReference for name in names])]

    def write(self, name: str, value: float) -> None:
        """Set one Float64 input."""
        group = self.group([name])
        group.values[0] = value
        self.write_group(group, f"setting {name}")

    def do_step(self, step: float) -> bool:
        """Step by `step` [s] from `time`, which the caller moves on; whether the FMU is at an event now."""
        started = perf_counter()
        self.check(self._do_step(self._fmu.component, self.time, step, *self._step_arguments), "stepping")
        self.costs["step"] += perf_counter() - started
        return self.events and self._flags[0].value

    def step_to(self, end: float) -> bool:
        """Go to `end` [s], or to an event before it; whether it stopped for an event and waits in event mode."""
        event = self.do_step(end - self.time)
        _, terminate, early = (flag.value for flag in self._flags)
        if terminate:
            raise LabError(f"{self.path} asks to end the run at t = {self.time} s.")
        self.time = self._reached.value if early else end
        if event:
            self._fmu.enterEventMode()
        return event

    def resume(self) -> None:
        """Event iteration, from event mode back to step mode."""
        again = True
        while again:
            again, *_ = self._fmu.updateDiscreteStates()
        self._fmu.enterStepMode()

    @property
    def can_save(self) -> bool:
        """Whether it has the functions for its state."""
        return bool(self._description.coSimulation.canGetAndSetFMUstate)

    def save(self) -> Any:
        """Handle of a copy of the state, for `restore` and `discard`."""
        if not self.can_save:
            raise LabError(
                f"{self.path} cannot save its state (canGetAndSetFMUState is not true): "
                "take an exchange without rollback and fixed steps."
            )
        started = perf_counter()
        state = self._fmu.getFMUstate() if self.fmi_version == 2 else self._fmu.getFMUState()
        self.costs["save and restore"] += perf_counter() - started
        return state, self._clock()

    def restore(self, saved: Any) -> None:
        """Return to the state of `saved`; `saved` stays valid."""
        started = perf_counter()
        state, clock = saved
        (self._fmu.setFMUstate if self.fmi_version == 2 else self._fmu.setFMUState)(state)
        self._set_clock(clock)
        self.costs["save and restore"] += perf_counter() - started

    def discard(self, saved: Any) -> None:
        """Free `saved`."""
        (self._fmu.freeFMUstate if self.fmi_version == 2 else self._fmu.freeFMUState)(saved[0])

    @property
    def can_serialise(self) -> bool:
        """Whether it has the functions for its state as bytes."""
        return self.can_save and bool(self._description.coSimulation.canSerializeFMUstate)

    def to_bytes(self) -> bytes:
        """The state, for an instance with the same parameters in another process."""
        state, clock = self.save()
        try:
            serialise = self._fmu.serializeFMUstate if self.fmi_version == 2 else self._fmu.serializeFMUState
            return json.dumps(clock).encode() + b"\n" + bytes(serialise(state))
        finally:
            self.discard((state, clock))

    def from_bytes(self, state: bytes) -> None:
        """Go on from a state that `to_bytes` gave.

        Raises LabError if the FMU refuses it.
        """
        clock, _, kept = state.partition(b"\n")
        read = self._fmu.deSerializeFMUstate if self.fmi_version == 2 else self._fmu.deserializeFMUState
        try:
            saved = read(kept), tuple(json.loads(clock))
        except (FMICallException, ValueError) as error:
            said = " ".join(self._log[-1:]) or f"{str(error).rstrip('.')}."
            raise LabError(f"{self.path} refuses the state that was kept of it. {said}") from error
        self.restore(saved)
        self.discard(saved)

    def _clock(self) -> tuple[Any, ...]:
        return (self.time,)

    def _set_clock(self, clock: tuple[Any, ...]) -> None:
        (self.time,) = clock

    def close(self) -> None:
        """Free the instance and its folder."""
        if self._fmu is not None:
            with suppress(FMICallException):  # an instance that never ran or has failed cannot be terminated
                self._fmu.terminate()
            self._fmu.freeInstance()
            self._fmu = None
        _LOGS.pop(id(self), None)
        if self._temporary:
            shutil.rmtree(self._directory, ignore_errors=True)

    def __enter__(self) -> Self:
        """Use it in a `with` block."""
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _value: BaseException | None, _trace: TracebackType | None
    ) -> None:
        """Close."""
        self.close()
