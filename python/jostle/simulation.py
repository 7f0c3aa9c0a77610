"""A simulation of any scene."""

import copy
import math
import warnings
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from jostle import arguments
from jostle._core import VERSION, Core, State
from jostle.dataset import dataset
from jostle.errors import JostleError, JostleWarning, NoVariableError, ParameterError, StateError
from jostle.variables import Variable, find, grouped

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

MOST_VALUES = 2**31
"""Of one run: 16 GiB. More is a slip of the keyboard."""
ROWS_AT_ONCE = 256
"""Of a run that the engine does in one call: what it holds twice."""


class Simulation:
    """One run of a scene, from time 0 on.

    Its numbers have the same bits as those of the FMU, the C library, the Rust crate and the command line.

    Args:
        scene: `packing`, `ratchet`, `wedge` or `three_disk`; `jostle.scenes()` lists them.
        engine: None: the scene's first.
        drive: what moves the base. None: `sine` if the engine has it. `input` follows the inputs of `step`.
        disks: number of disks. None: the scene's usual number.
        values: parameters, and inputs at the start, that differ from their start values. Names with points go in as
            `**{"drive.frequency": 25.0}`; an option by its name or number.

    Raises:
        ParameterError: a scene, engine, drive, number or value that is not allowed.
        NoVariableError: a name that the scene does not have.

    """

    __slots__ = ("__weakref__", "_core", "_variables", "_views")
    __iter__ = None
    """Names are looked up; `variables` lists them."""

    def __init__(
        self,
        scene: str,
        *,
        engine: str | None = None,
        drive: str | None = None,
        disks: int | None = None,
        **values: float | str,
    ) -> None:
        table = "jostle.scenes() lists what there is."
        arguments.text("scene", scene, table)
        for name, value in (("engine", engine), ("drive", drive)):
            if value is not None:
                arguments.text(name, value, table)
        self._prepare(scene, engine, drive, disks)
        self._set(values)
        self._core.start()
        for text in self._core.warnings():
            warnings.warn(text, JostleWarning, stacklevel=2)

    def _prepare(self, scene: str, engine: str | None, drive: str | None, disks: int | None) -> None:
        if disks is not None:
            disks = arguments.whole("disks", disks, 0, 2**32 - 1, "jostle.scenes() says how many a scene takes.")
        self._core = Core(scene, engine, drive, disks)
        self._variables = grouped(self._core.variables())
        self._views: dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]] = {}

    @property
    def scene(self) -> str:
        """Name of the scene."""
        return self._core.names[0]

    @property
    def engine(self) -> str:
        """Name of the engine."""
        return self._core.names[1]

    @property
    def drive(self) -> str:
        """What moves the base."""
        return self._core.names[2]

    @property
    def disks(self) -> int:
        """Number of disks."""
        return self._core.disks

    @property
    def time(self) -> float:
        """Time reached [s]; other threads may read it while a step is done."""
        return self._core.time

    @property
    def variables(self) -> "pd.DataFrame":
        """Table of the variables: one row a name.

        Columns: causality, kind, unit, minimum, maximum, recommended (range in which the model makes sense, as a text),
        reason (what is wrong outside of it), start, size, options, description, tunable (a parameter that may be set
        between steps too).
        """
        import pandas as pd  # noqa: PLC0415 - takes longer than all else, and loops do without

        rows = {
            v.name: {
                "causality": v.causality,
                "kind": v.kind,
                "unit": v.unit,
                "minimum": v.minimum,
                "maximum": v.maximum,
                "recommended": v.recommended,
                "reason": v.reason,
                "start": v.start,
                "size": len(v.positions),
                "options": ", ".join(v.options),
                "description": v.description,
                "tunable": v.tunable,
            }
            for v in self._variables.values()
        }
        return pd.DataFrame.from_dict(rows, orient="index").rename_axis("name")

    def __getitem__(self, name: str) -> Any:
        """Value now: a number, or a new array of shape (disks,) for `disk.angle` and its kind.

        Raises:
            NoVariableError: the scene has no such variable.

        """
        variable, element = find(self._variables, name, self.scene)
        if element is not None or not variable.is_array:
            return self._core.get(variable.positions[element or 0])
        if variable.kind != "real":
            return np.array([self._core.get(position) for position in variable.positions])
        return self.read(name)

    def __contains__(self, name: object) -> bool:
        """Whether the scene has a variable of this name."""
        try:
            find(self._variables, name, self.scene)  # type: ignore[arg-type]
        except NoVariableError:
            return False
        return True

    def __setitem__(self, name: str, value: float | str) -> None:
        """Set an input, which holds until it is set again, or a tunable parameter, which acts from the next step on.

        Raises:
            NoVariableError: the scene has no such variable.
            ParameterError: a value out of range.
            CallError: a parameter that is not tunable, frozen since the start, or an output.

        """
        self._set({name: value})

    def read(self, name: str, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Return all elements of an array of reals, such as `disk.angle`, as shape (disks,).

        Args:
            name: of the array.
            out: array of doubles that is filled and returned, so that a loop allocates nothing.

        Raises:
            NoVariableError: the scene has no such variable.
            ParameterError: a single variable, or `out` has another shape or type.

        """
        variable, element = find(self._variables, name, self.scene)
        size = len(variable.positions)
        if not variable.is_array or element is not None or variable.kind != "real":
            raise ParameterError.of("name", name, "an array of reals", f"Read {name} as simulation[{name!r}].")
        if out is None:
            out = np.empty(size)
        elif (
            not isinstance(out, np.ndarray)
            or out.dtype != np.float64
            or out.shape != (size,)
            or not (out.flags.carray and out.flags.aligned)
        ):
            shape = getattr(out, "shape", None)
            given = f"{getattr(out, 'dtype', type(out).__name__)} of shape {shape}"
            allowed = f"float64 of shape ({size},), contiguous and writable"
            raise ParameterError.of("out", given, allowed, f"Make it by numpy.empty({size}).")
        self._core.read(variable.positions, out)
        return out

    def view(self, name: str) -> NDArray[np.float64]:
        """Return a read-only array that shows the present values of `disk.angle` and its kind, shape (disks,).

        It is the same array at every call. Each step, run and restore fills it, so that loops allocate nothing.

        Raises:
            NoVariableError, ParameterError: as `read`.

        """
        if name not in self._views:
            filled = self.read(name)
            filled.flags.writeable = False
            self._views[name] = filled, filled.view()
        return self._views[name][1]

    def contacts(self) -> "pd.DataFrame":
        """Return the closed contacts of now, one a row, of engines whose contacts last.

        Columns: `first` and `second`, numbers of the disks (`second` is 0 at a wall or support), `wall`, number of the
        wall or support (0 between disks), `x`, `y` [m], middle of the overlap, `normal_x`, `normal_y`, unit normal
        towards the first disk, `normal_force` [N], not negative, and `tangential_force` [N] on the first disk along the
        normal turned clockwise. Units and descriptions are in `attrs`.

        Raises:
            CallError: the engine has impacts instead of contacts.

        """
        import pandas as pd  # noqa: PLC0415 - as in `variables`

        columns, numbers = self._core.list("contacts")
        names = [name for name, _, _ in columns]
        table = pd.DataFrame(np.frombuffer(numbers).reshape(-1, len(names)), columns=names)
        table.attrs = {
            "units": {name: unit for name, unit, _ in columns},
            "descriptions": {name: description for name, _, description in columns},
        }
        return table.astype(dict.fromkeys(("first", "second", "wall"), int))

    def step(self, step: float, **inputs: float) -> None:
        """Do one communication step.

        With the drive `input` the base follows an extrapolation of the inputs, as in an FMU. Inputs are those at the
        begin of the step, that is at the present `time`.

        Args:
            step: length [s], above 0.
            inputs: and tunable parameters, such as `**{"base.displacement": 1e-3, "base.velocity": 0.1}`.

        Raises:
            StepError: the step cannot be done; the simulation is as before.
            ParameterError, NoVariableError: a step or input that is not allowed.

        """
        length = arguments.seconds("step", step)
        before = {name: self[name] for name in inputs}
        self._set(inputs)
        try:
            self.advance_to(self.time + length)
        except JostleError:
            self._set(before)
            raise

    def advance_to(self, time: float) -> None:
        """Advance to a time [s], as one communication step; loops that need exact times take this rather than `step`.

        Raises:
            StepError: the step cannot be done; the simulation is as before.
            ParameterError: a time that is not after the present one.

        """
        self._core.advance_to(arguments.instant("time", time))
        self._refresh()

    def run(self, seconds: float, every: float = 0.01, outputs: Iterable[str] | None = None) -> "xr.Dataset":
        """Advance and sample, the present time included.

        Args:
            seconds: how long [s].
            every: time from sample to sample [s]; the last one is at the end in any case.
            outputs: names, such as `("disk.angle", "base.position")`; None: all outputs.

        Returns:
            dimensions `time` and, for what each disk has, `disk` (the contacts of `three_disk`: `contact`); units and
            descriptions as attributes, the parameters as attributes of the whole. `disk.radius` is a coordinate.

        Raises:
            StepError: a step cannot be done. The samples before it are in the attribute `partial` of the exception, and
                of whatever else stops the sampling, `KeyboardInterrupt` too; the simulation stands at the last of them.
                Ctrl-C ends the step under way, which is then not done.
            ParameterError, NoVariableError: an argument that is not allowed.

        """
        sampled = self._outputs(outputs)
        positions = [p for v in sampled for p in v.positions]
        span, interval = arguments.seconds("seconds", seconds), arguments.seconds("every", every)
        times = self._times(span, interval, len(positions))
        columns = _table(len(times), len(positions))
        constant = self._fixed(), self._attributes()
        rows = 0
        try:
            while rows < len(times):
                part = slice(rows, rows + ROWS_AT_ONCE)
                done, stopped = self._core.sample(times[part].tolist(), positions, columns[part])
                rows += done
                if stopped is not None:
                    raise stopped
            self._refresh()
            return dataset(times, columns, sampled, *constant)
        except (JostleError, KeyboardInterrupt) as error:
            error.partial = dataset(times[:rows], columns[:rows], sampled, *constant)  # type: ignore[union-attr]
            error.add_note(f"{rows} whole samples are in the attribute `partial` of this exception.")
            self._refresh()
            raise

    def save(self) -> State:
        """Return the state in memory, for `restore`. To pickle, take the simulation itself or `to_bytes`."""
        return self._core.save()

    def restore(self, state: State | bytes) -> None:
        """Go back to a state of this scene, from `save` or `to_bytes`, parameters included; the same bits follow.

        Raises:
            StateError: no state, damaged bytes, or one of another scene or version. The simulation is then as before.

        """
        if isinstance(state, State):
            self._core.restore(state)
        elif isinstance(state, bytes | bytearray | memoryview):
            self._core.restore_bytes(bytes(state))
        else:
            remedy = "Take what `save` or `to_bytes` of a simulation gave."
            raise StateError(f"state refused: {arguments.shown(state)} is no state. {remedy}", remedy)
        self._refresh()

    def to_bytes(self) -> bytes:
        """Return the state for a file or another process; FMU, C library and Rust crate take the same bytes."""
        return self._core.to_bytes()

    def limit_work(self, most: int) -> None:
        """Refuse a step of more events (or time steps of ten soft disks) than this."""
        self._core.limit_work(arguments.whole("most", most, 1, 2**63, "Give a number of events such as 1000000."))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle, with the state: processes and files take simulations as they are."""
        return _restored, (self.scene, self.engine, self.drive, self.disks, self.to_bytes())

    def __copy__(self) -> "Simulation":
        """Return an independent simulation in the same state."""
        return copy.deepcopy(self)

    def __repr__(self) -> str:
        """Say what it is and where it stands."""
        size = f", {self.disks} disks" if self.disks > 1 else ""
        return f"<jostle.Simulation: {self.scene}, {self.engine}, drive {self.drive}{size}, t = {self.time:g} s>"

    def _refresh(self) -> None:
        for name, (filled, _) in self._views.items():
            filled.flags.writeable = True
            self.read(name, filled)
            filled.flags.writeable = False

    def _set(self, values: dict[str, Any]) -> None:
        given = []
        for name, value in values.items():
            variable, element = find(self._variables, name, self.scene)
            if variable.is_array and element is None and variable.causality in ("parameter", "input"):
                raise ParameterError.of(name, value, "one element", f"Set {variable.elements[0]} and so on.")
            given.append((variable.positions[element or 0], value))
        self._core.set(given)

    def _times(self, seconds: float, every: float, width: int) -> NDArray[np.float64]:
        # A remainder below a billionth of a sample is rounding, not a sample: as the command line does it.
        ratio = seconds / every - 1e-9
        last = max(math.ceil(ratio), 1) if ratio < MOST_VALUES else MOST_VALUES
        if last * (width + 1) > MOST_VALUES:
            allowed = f"at most {MOST_VALUES:.2g} values of one run, here {ratio * (width + 1):.2g}"
            remedy = "Sample less often, fewer outputs, or run in parts."
            raise ParameterError.of("every", f"{every} s", allowed, remedy)
        after: NDArray[np.float64] = self.time + np.minimum(np.arange(last + 1) * every, seconds)
        return after

    def _outputs(self, names: Iterable[str] | None) -> list[Variable]:
        if names is None:
            return [v for v in self._variables.values() if v.causality == "output"]
        if isinstance(names, str):
            names = (names,)
        if not isinstance(names, Iterable):
            raise ParameterError.of("outputs", arguments.shown(names), "names", "Give a list such as ['disk.angle'].")
        found = []
        for name in dict.fromkeys(names):
            variable, element = find(self._variables, name, self.scene)
            if element is not None:
                raise ParameterError.of("outputs", name, "whole arrays", f"Take {variable.name}, then [:, {element}].")
            if not (variable.is_array and variable.causality == "calculated"):  # a coordinate of every run
                found.append(variable)
        return found

    def _fixed(self) -> dict[str, tuple[Variable, Any]]:
        arrays = [v for v in self._variables.values() if v.causality == "calculated" and v.is_array]
        return {v.name: (v, self.read(v.name)) for v in arrays}

    def _attributes(self) -> dict[str, Any]:
        names = {"scene": self.scene, "engine": self.engine, "drive": self.drive, "disks": self.disks}
        parameters = [v for v in self._variables.values() if v.causality == "parameter" and not v.is_array]
        return names | {"jostle_version": VERSION} | {v.name: self._shown(v) for v in parameters}

    def _shown(self, variable: Variable) -> float | int | str:
        value = self._core.get(variable.positions[0])
        return variable.options[int(value) - 1] if variable.options else value


def _table(rows: int, columns: int) -> NDArray[np.float64]:
    try:
        return np.empty((rows, columns))
    except MemoryError:
        size = f"{rows * columns * 8 / 2**30:.1f} GiB"
        remedy = "Sample less often, fewer outputs, or run in parts."
        raise ParameterError.of("every", size, "what fits into memory", remedy) from None


def _restored(scene: str, engine: str, drive: str, disks: int, state: bytes) -> Simulation:
    simulation = Simulation.__new__(Simulation)
    simulation._prepare(scene, engine, drive, disks)  # not started: the state has all that a start would compute
    simulation.restore(state)
    return simulation
