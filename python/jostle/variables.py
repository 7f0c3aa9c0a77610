"""The variables of a scene, by name: single ones, and those of which each disk has one."""

import difflib
import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from jostle.arguments import LONGEST, shown
from jostle.errors import NoVariableError

if TYPE_CHECKING:
    from jostle._core import Row

INPUTS = ("base.displacement", "base.velocity", "base.acceleration_input", "torque", "torque.rate")
"""Of the drive `input`, in any scene."""


@dataclass(frozen=True, slots=True)
class Variable:
    """What is known of a variable, or of an array of them.

    Attributes:
        name: such as `base.position`, or `disk.angle` for `disk.angle[1]`, `disk.angle[2]`, ..., or `contact.state` for
            `contact[1].state`, `contact[2].state`.
        causality: `parameter`, `calculated` (from the parameters), `input` or `output`.
        kind: `real`, `integer` or `option`.
        unit: such as `m/s`; `1` for pure numbers.
        minimum: smallest allowed value.
        maximum: largest allowed value.
        start: value if none is given; NaN if the scene computes it.
        options: names of the options.
        description: one sentence.
        recommended: range in which the model makes sense, or which quantity has which; empty for none. Outside of it
            the simulation warns.
        reason: what is wrong outside of it.
        tunable: a parameter that may be set between steps too.
        positions: of its elements in the table of the scene.
        elements: their names; empty for a single variable.

    """

    name: str
    causality: str
    kind: str
    unit: str
    minimum: float
    maximum: float
    start: float
    options: tuple[str, ...]
    description: str
    recommended: str
    reason: str
    tunable: bool
    positions: tuple[int, ...]
    elements: tuple[str, ...]

    @property
    def is_array(self) -> bool:
        """Whether it has elements with numbers."""
        return bool(self.elements)


def grouped(rows: "Iterable[Row]") -> dict[str, Variable]:
    """Variables by name; those that differ only in a number in brackets as one, unless that name is taken."""
    members: dict[str, list[tuple[int, Row]]] = {}
    rows = list(rows)
    taken = {row[0] for row in rows}
    for position, row in enumerate(rows):
        base = re.sub(r"\[\d+\]", "", row[0]) if "[" in row[0] else row[0]
        name = row[0] if base in taken else base
        members.setdefault(name, []).append((position, row))
    return {base: _variable(base, found) for base, found in members.items()}


def _variable(base: str, members: "list[tuple[int, Row]]") -> Variable:
    """What is known of all from the first of them."""
    name, causality, kind, unit, low, high, start, options, told, recommended, reason, tunable = members[0][1]
    elements = tuple(row[0] for _, row in members) if name != base else ()
    positions = tuple(position for position, _ in members)
    text = re.sub(r"\bof disk 1\b", "of each disk", told)
    about = (tuple(options), text, recommended, reason, tunable)
    return Variable(base, causality, kind, unit, low, high, start, *about, positions, elements)


def find(variables: dict[str, Variable], name: str, scene: str) -> tuple[Variable, int | None]:
    """Return the variable of this name, and which element `disk.angle[3]` means, from 0; None for all.

    Raises:
        NoVariableError: there is none; says which are alike.

    """
    if not isinstance(name, str):
        remedy = "Names are texts, such as 'disk.angle'."
        raise NoVariableError(f"{scene} has no variable {shown(name)}. {remedy}", remedy)
    if name in variables:
        return variables[name], None
    variable = variables.get(re.sub(r"\[[^]]*\]", "", name))
    if variable is not None and variable.is_array and name in variable.elements:
        return variable, variable.elements.index(name)
    if name in INPUTS:
        remedy = "It is an input: make the simulation with drive='input', where the engine has it."
    elif name == "time":
        remedy = "The time is the attribute `time` of the simulation, and the coordinate `time` of a run."
    elif variable is not None and variable.is_array:
        remedy = f"They go from {variable.elements[0]} to {variable.elements[-1]}."
    else:
        alike = difflib.get_close_matches(name[:LONGEST], variables, n=3, cutoff=0.5)
        table = "The table `variables` of the simulation has all names."
        remedy = f"Did you mean {' or '.join(alike)}?" if alike else table
    raise NoVariableError(f"{scene} has no variable {shown(name)}. {remedy}", remedy)
