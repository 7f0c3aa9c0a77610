"""What the library of any FMU for co-simulation answers to wrong calls: the table of docs/fmi-frameworks.md.

Each wrong call is made by a process of its own, in step mode at time 0 unless it says otherwise: some end the process
that makes them. Linux only. Nothing here depends on how the library was made: it gets the calls of the headers.
"""

import ctypes
import os
import signal
from collections.abc import Callable
from ctypes import byref, c_char_p, c_double, c_size_t, c_uint, c_void_p
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab.errors import LabError

OK_OR_WARNING = 1
ENDLESS = 20
"""Seconds after which a call is taken for one that does not return."""


@dataclass(frozen=True)
class Subject:
    """A library, and the value references of variables of its model."""

    library: Path
    version: int
    token: str
    output: int
    parameter: int
    resources: str


class Client:
    """An instance of the library, in one version of FMI."""

    def __init__(self, subject: Subject) -> None:
        self.subject, self.three = subject, subject.version == 3
        self.library = ctypes.CDLL(str(subject.library))
        self.logger = ctypes.CFUNCTYPE(None)(lambda: None)
        logger = ctypes.cast(self.logger, c_void_p).value
        allocators = [ctypes.cast(getattr(ctypes.CDLL(None), name), c_void_p).value for name in ("calloc", "free")]
        self.callbacks = (c_void_p * 5)(logger, *allocators, None, None)
        self.pointer = self.make(subject.token)

    def make(self, token: str) -> int | None:
        """A new instance; none if the library refuses."""
        name, token_, resources = b"name", token.encode(), self.subject.resources.encode() or None
        if self.three:
            create = self.library.fmi3InstantiateCoSimulation
            create.restype = c_void_p
            flags = (False, False, False, False)
            created = create(name, token_, resources, *flags, None, c_size_t(0), None, self.logger, None)
        else:
            create = self.library.fmi2Instantiate
            create.restype = c_void_p
            created = create(name, 1, token_, resources, self.callbacks, 0, 0)
        return created if created is None else int(created)

    def call(self, name: str, *arguments: object) -> int:
        """The status of the function of this name after `fmi2` or `fmi3`, called for the instance."""
        function = getattr(self.library, f"fmi{self.subject.version}{name}")
        return int(function(c_void_p(self.pointer), *arguments))

    def enter(self) -> int:
        """Enters initialisation mode."""
        if self.three:
            return self.call("EnterInitializationMode", False, c_double(0), c_double(0), False, c_double(0))
        return self.call("SetupExperiment", 0, c_double(0), c_double(0), 0, c_double(0)) or self.call(
            "EnterInitializationMode"
        )

    def start(self) -> "Client":
        """Brings it to step mode."""
        if self.pointer is None or self.enter() > OK_OR_WARNING or self.call("ExitInitializationMode") > OK_OR_WARNING:
            raise LabError(f"{self.subject.library}: cannot be started.")
        return self

    def step(self, time: float, size: float, results: bool = True) -> int:
        """A step; with nowhere to write to in FMI 3.0 if there are no `results`."""
        if not self.three:
            return self.call("DoStep", c_double(time), c_double(size), 1)
        flags, reached = (ctypes.c_bool * 3)(), c_double()
        places = [byref(flags, index) for index in range(3)] + [byref(reached)]
        return self.call("DoStep", c_double(time), c_double(size), True, *(places if results else [None] * 4))

    def get(self, references: object, values: object, count: int = 1) -> int:
        """Reads reals."""
        name, tail = ("GetFloat64", [c_size_t(count)]) if self.three else ("GetReal", [])
        return self.call(name, references, c_size_t(count), values, *tail)

    def set(self, reference: int, value: float) -> int:
        """Sets a real."""
        name, tail = ("SetFloat64", [c_size_t(1)]) if self.three else ("SetReal", [])
        return self.call(name, byref(c_uint(reference)), c_size_t(1), byref(c_double(value)), *tail)

    def state(self, action: str, *arguments: object) -> int:
        """A function of saved states, such as `Get`."""
        return self.call(f"{action}FMUState" if self.three else f"{action}FMUstate", *arguments)

    def stale(self) -> int:
        """Restores a state that was freed."""
        state = c_void_p()
        self.state("Get", byref(state))
        stale = c_void_p(state.value)
        self.state("Free", byref(state))
        return self.state("Set", stale)

    def junk(self) -> int:
        """Reads a state from bytes that are none."""
        name = "Deserialize" if self.three else "DeSerialize"
        return self.state(name, c_char_p(b"<xml>" * 20), c_size_t(100), byref(c_void_p()))

    def reset_of(self, pointer: int | None) -> int:
        """Resets what is no instance."""
        self.pointer = pointer
        return self.call("Reset")


REFUSED = 3
NOTHING = (ctypes.c_uint64 * 64)()
Misuse = Callable[[Client], int]
MISUSES: dict[str, Misuse] = {
    "a step of length zero": lambda client: client.step(0.0, 0.0),
    "a step backward": lambda client: client.step(0.0, -0.1),
    "a step of no number": lambda client: client.step(0.0, float("nan")),
    "an endless step": lambda client: client.step(0.0, float("inf")),
    "a step from elsewhere": lambda client: client.step(0.7, 0.1),
    "a step with nowhere to write its end to (FMI 3.0)": lambda client: (
        client.step(0.0, 0.1, results=False) if client.three else REFUSED
    ),
    "initialisation twice": Client.enter,
    "an unknown reference": lambda client: client.get(byref(c_uint(9999)), byref(c_double())),
    "no references": lambda client: client.get(None, byref(c_double())),
    "no room for values": lambda client: client.get(byref(c_uint(client.subject.output)), None),
    "a length that no memory has": lambda client: client.get(
        byref(c_uint(client.subject.output)), byref(c_double()), 2**64 - 1
    ),
    "setting a frozen parameter": lambda client: client.set(client.subject.parameter, 1.0),
    "no state to restore": lambda client: client.state("Set", None),
    "a state that is none": lambda client: client.state("Set", c_void_p(4096 + 1234)),
    "a state that was freed": Client.stale,
    "bytes that are no state": Client.junk,
    "model exchange": lambda client: client.call("SetTime", c_double(1.0)),
    "another token": lambda client: REFUSED if client.make("{another}") is None else 0,
    "no instance": lambda client: client.reset_of(None),
    "memory that is no instance": lambda client: client.reset_of(ctypes.addressof(NOTHING)),
}


def answer(subject: Subject, misuse: Misuse) -> str:
    """What the library does: refused, accepted, or how the process ended."""
    child = os.fork()
    if child == 0:
        signal.alarm(ENDLESS)
        quiet = os.open(os.devnull, os.O_WRONLY)
        os.dup2(quiet, 1)
        os.dup2(quiet, 2)
        try:
            status = misuse(Client(subject).start())
        except LabError:
            os._exit(9)
        os._exit(0 if status > OK_OR_WARNING else 1)
    ended = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if ended == 9:
        raise LabError(f"{subject.library} cannot be started with the token {subject.token}.")
    if ended < 0:
        return "does not return" if -ended == signal.SIGALRM else f"ends the host ({signal.Signals(-ended).name})"
    return "refused" if ended == 0 else "accepted"


def misuse(
    library: Annotated[Path, typer.Argument(help="Library of an FMU for this system.")],
    version: Annotated[int, typer.Option(help="Version of FMI, 2 or 3.")],
    token: Annotated[str, typer.Option(help="instantiationToken or guid of its model description.")],
    output: Annotated[int, typer.Option(help="Value reference of a real output.")],
    parameter: Annotated[int, typer.Option(help="Value reference of a fixed real parameter.")],
    resources: Annotated[str, typer.Option(help="Resource path, for FMI 2.0 a URI, if the library needs one.")] = "",
) -> None:
    """Call a library of an FMU wrongly, and say what it answers."""
    subject = Subject(library.resolve(), version, token, output, parameter, resources)
    answers = {name: answer(subject, wrong) for name, wrong in MISUSES.items()}
    for name, said in answers.items():
        typer.echo(f"{name:52} {said}")
    kinds = ("refused", "accepted", "ends the host", "does not return")
    counts = {kind: sum(said.startswith(kind) for said in answers.values()) for kind in kinds}
    typer.echo(", ".join(f"{kind}: {count}" for kind, count in counts.items()))
