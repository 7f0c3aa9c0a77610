"""A packing FMU as `Grains`."""

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from jostle_lab.fmu.instance import FmuInstance
from jostle_lab.fmu.names import EXTRAPOLATION_DEGREE

NOTHING: Mapping[str, float] = MappingProxyType({})


@dataclass(frozen=True)
class FmuFactory:
    """Makes `FmuGrains` of a file; can be sent to another process."""

    path: str
    parameters: tuple[tuple[str, float], ...] = ()
    """Not `seed`, which is that of the call."""

    def __post_init__(self) -> None:
        """Refuse a seed, which would be recorded and not used."""
        if "seed" in dict(self.parameters):
            raise LabError(
                "seed cannot be set here: packing by packing it is 1, 2, ..., or from --first-seed on. Leave it out."
            )

    def __call__(self, seed: int, /, extra: Mapping[str, float] = NOTHING) -> "FmuGrains":
        """Grains of one packing; see `GrainsFactory`."""
        return FmuGrains(Path(self.path), {**extra, **dict(self.parameters), "seed": seed})


class FmuGrains(FmuInstance):
    """One instance of an FMU of disks on a base that follows inputs: a packing, unless a subclass says otherwise."""

    def _prepare(self) -> None:
        self._inputs = self.group(["base.displacement", "base.velocity", "base.acceleration_input"])
        self._force = self.group(["base.reaction_force"])
        self._energy = self.group(["energy.input"])
        disks = range(1, 1 + sum(name.startswith("disk.angle[") for name in self._variables))
        self._angles = self.group([f"disk.angle[{i}]" for i in disks])
        self._positions = self.group([f"disk.{axis}[{i}]" for i in disks for axis in "xy"])
        self.radii = self.read_group(self.group([f"disk.radius[{i}]" for i in disks])).copy()
        self.gravity = self.read("gravity")
        (self.extrapolation_degree,) = self.read_integers([EXTRAPOLATION_DEGREE])
        self.box_width, self.weight = self._width_and_weight()
        self._start = self._step = 0.0
        self._steps = 0

    def _width_and_weight(self) -> tuple[float, float]:
        """Width of the box [m] and weight of the disks [N]."""
        area = float(np.pi * np.sum(self.radii**2))
        return self.read("box.width"), self.read("disk.surface_density") * area * self.gravity

    def step(self, displacement: float, velocity: float, acceleration: float, step: float) -> float:
        """See `Grains.step`."""
        started = perf_counter()
        self._inputs.values[:] = displacement, velocity, acceleration
        self.write_group(self._inputs, "setting the base")
        self.costs["get and set"] += perf_counter() - started
        return self._advance(step)

    def _advance(self, step: float) -> float:
        """Step with the inputs as they are; the force over the step [N]. Time is start + n h while h stays the same."""
        self.do_step(step)
        if step != self._step:
            self._start, self._step, self._steps = self.time, step, 0
        self._steps += 1
        self.time = self._start + self._steps * step
        return float(self.read_group(self._force)[0])

    def set_displacement_derivative(self, velocity: float) -> None:
        """Give the base's velocity as the derivative of its displacement, by `fmi2SetRealInputDerivatives`."""
        if self.fmi_version != 2:
            raise LabError(f"{self.path}: input derivatives are of FMI 2.0. Bundle it with `jostle fmu --fmi 2`.")
        order, rate = ctypes.c_int(1), ctypes.c_double(velocity)
        status = self._fmu.dll.fmi2SetRealInputDerivatives(
            self._fmu.component, self._inputs.references, 1, ctypes.byref(order), ctypes.byref(rate)
        )
        self.check(status, "setting the derivative of the base's displacement")

    def step_with_last_velocity(self, displacement: float, step: float) -> float:
        """As `step`, with the velocity that was set last."""
        self.write("base.displacement", displacement)
        return self._advance(step)

    def energy_input(self) -> float:
        """See `Grains.energy_input`."""
        return float(self.read_group(self._energy)[0])

    def angles(self) -> NDArray[np.float64]:
        """See `Grains.angles`."""
        return self.read_group(self._angles).copy()

    def positions(self) -> NDArray[np.float64]:
        """See `Grains.positions`."""
        return self.read_group(self._positions).reshape(-1, 2).copy()

    def _clock(self) -> tuple[Any, ...]:
        return self.time, self._steps, self._start, self._step

    def _set_clock(self, clock: tuple[Any, ...]) -> None:
        self.time, self._steps, self._start, self._step = clock
