"""A three_disk FMU through fmpy, stepped and stopped at events: FMI 2.0 plainly, FMI 3.0 plainly or with event mode."""

import shutil
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from jostle_lab.errors import LabError

OUTPUTS = ("disk.angular_velocity[1]", "disk.angle[1]")
STATES = ("contact[1].state", "contact[2].state")
"""1 open, 2 stick, 3 slip counter-clockwise, 4 slip clockwise."""


class DiskFmu:
    """One disk on two supports whose input is a torque.

    Args:
        path: FMU made by `jostle fmu three_disk --drive input`.
        parameters: values by name, set before initialisation.
        events: FMI 3.0 only: ask for early return and event mode, so that a step ends where a contact changes.

    """

    def __init__(self, path: Path, parameters: Mapping[str, float] | None = None, events: bool = False) -> None:
        if not path.is_file():
            raise LabError(f"No FMU at {path}. Make one: target/release/jostle fmu three_disk --out {path}")
        self.path, self.time = path, 0.0
        self._description = read_model_description(str(path))
        self._references = {v.name: v.valueReference for v in self._description.modelVariables}
        missing = [name for name in ("torque", *OUTPUTS, *STATES) if name not in self._references]
        if missing or self._description.coSimulation is None:
            raise LabError(f"{path} has no {', '.join(missing)}. Bundle it with `jostle fmu three_disk --drive input`.")
        self.fmi_version = 2 if self._description.fmiVersion.startswith("2") else 3
        self.events = events
        if events and not (self.fmi_version == 3 and self._description.coSimulation.hasEventMode):
            raise LabError(f"{path} has no event mode. Bundle it with `jostle fmu three_disk --fmi 3`.")
        self._directory = extract(str(path))
        self._fmu: Any = None
        try:
            self._start(dict(parameters or {}))
        except Exception as error:
            self.close()
            raise LabError(f"{path} refuses {dict(parameters or {})}: {error}") from error

    def _start(self, parameters: dict[str, float]) -> None:
        arguments = {
            "guid": self._description.guid,
            "unzipDirectory": self._directory,
            "modelIdentifier": self._description.coSimulation.modelIdentifier,
            "instanceName": "three_disk",
        }
        if self.fmi_version == 2:
            fmu: Any = FMU2Slave(**arguments)
            fmu.instantiate()
            fmu.setupExperiment(startTime=0.0)
            self._get_real, self._get_integer, self._set_real = fmu.getReal, fmu.getInteger, fmu.setReal
        else:
            fmu = FMU3Slave(**arguments)
            fmu.instantiate(eventModeUsed=self.events, earlyReturnAllowed=self.events)
            self._get_real, self._get_integer, self._set_real = fmu.getFloat64, fmu.getInt64, fmu.setFloat64
        self._fmu = fmu
        for name, value in parameters.items():
            if name not in self._references:
                raise LabError(f"it has no {name}")
            self._set_real([self._references[name]], [value])
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        if self.events:
            self._update()

    def _update(self) -> None:
        """Event iteration, from event mode back to step mode."""
        again = True
        while again:
            again, *_ = self._fmu.updateDiscreteStates()
        self._fmu.enterStepMode()

    def read(self, name: str) -> float:
        """Present value of a real variable."""
        if name not in self._references:
            raise LabError(f"{self.path} has no variable {name}. Bundle it with `jostle fmu three_disk --drive input`.")
        return float(self._get_real([self._references[name]])[0])

    def velocity(self) -> float:
        """Angular velocity [rad/s]."""
        return self.read(OUTPUTS[0])

    def angle(self) -> float:
        """Angle [rad]."""
        return self.read(OUTPUTS[1])

    def states(self) -> tuple[int, int]:
        """What both contacts do: 1 open, 2 stick, 3 slip counter-clockwise, 4 slip clockwise."""
        left, right = self._get_integer([self._references[name] for name in STATES])
        return int(left), int(right)

    def apply(self, torque: float) -> None:
        """Hold this torque [N m] from now on."""
        self._set_real([self._references["torque"]], [torque])

    def step(self, end: float) -> bool:
        """Go to `end` [s], or with events to where a contact changes before; whether it stopped there for an event.

        After an event the FMU is in event mode: `apply` what the event calls for, then `resume`.
        """
        if self.fmi_version == 2:
            self._fmu.doStep(currentCommunicationPoint=self.time, communicationStepSize=end - self.time)
            self.time = end
            return False
        event, terminate, early, reached = self._fmu.doStep(self.time, end - self.time)
        if terminate:
            raise LabError(f"{self.path} asks to end the run at t = {self.time} s.")
        self.time = reached if early else end
        if event and self.events:
            self._fmu.enterEventMode()
            return True
        return False

    def resume(self) -> None:
        """Back from event mode to stepping."""
        self._update()

    def close(self) -> None:
        """Free the instance and its folder."""
        if self._fmu is not None:
            with suppress(FMICallException):  # an instance that never ran cannot be terminated
                self._fmu.terminate()
            self._fmu.freeInstance()
            self._fmu = None
        shutil.rmtree(self._directory, ignore_errors=True)

    def __enter__(self) -> Self:
        """Use it in a `with` block."""
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _value: BaseException | None, _trace: TracebackType | None
    ) -> None:
        """Close."""
        self.close()
