"""A grid of parameters, from a TOML file or from options, as runs.

    scene = "ratchet"
    engine = "event-driven"                     # and drive; the scene's own and sine unless named
    seconds = 31.0
    seeds = 7                                   # 1 to 7, or a list
    [set]
    "tooth.height" = 3e-3
    "measure.start" = 1.0
    [grid]
    "drive.frequency" = {from = 15.0, to = 40.0, count = 26}
    disks = [10, 20, 30]

Every combination of the grid's values is run with every seed. `disks` is the number of disks, in `set` or in `grid`;
all other names are parameters of the scene.
"""

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from typing import Any

from jostle_lab.errors import LabError, did_you_mean
from jostle_lab.runs.run import Run

ENGINES = {
    "packing": "molecular-dynamics",
    "wedge": "map",
    "ratchet": "event-driven",
    "three_disk": "molecular-dynamics",
}
"""Engine of a scene unless another is named."""
KEYS = ("scene", "engine", "drive", "seconds", "seeds", "set", "grid")
RANGE = {"from", "to", "count"}
MOST_RUNS = 1_000_000


@dataclass(frozen=True)
class Grid:
    """Axes and what they have in common."""

    scene: str
    seconds: float
    engine: str = ""
    """Empty: the scene's own of `ENGINES`."""
    drive: str = "sine"
    seeds: tuple[int, ...] = (1,)
    fixed: Mapping[str, float] = field(default_factory=dict)
    axes: Mapping[str, tuple[float, ...]] = field(default_factory=dict)

    def runs(self) -> list[Run]:
        """Every combination with every seed; seeds change first, then the last axis.

        Raises LabError for a grid that no program can run.
        """
        if self.scene not in ENGINES and not self.engine:
            near = did_you_mean(self.scene, ENGINES)
            raise LabError(
                f"scene = {self.scene!r} is none of {', '.join(ENGINES)}.{near} Name one of them, or an engine."
            )
        if not (math.isfinite(self.seconds) and self.seconds > 0.0):
            raise LabError(f"seconds = {self.seconds:g} is not a time above 0. Write, say, seconds = 30.0")
        if "seed" in {*self.fixed, *self.axes}:
            raise LabError("seed is neither set nor on the grid. Say which there are with seeds (a number or a list).")
        twice = sorted(set(self.fixed) & set(self.axes))
        if twice:
            raise LabError(f"{', '.join(twice)} is both fixed and on the grid. Remove one of the two.")
        empty = [name for name, values in {**self.axes, "seeds": self.seeds}.items() if not values]
        if empty:
            raise LabError(f"{', '.join(empty)} has no values. Give at least one.")
        count = math.prod(map(len, self.axes.values())) * len(self.seeds)
        if count > MOST_RUNS:
            raise LabError(f"The grid has {count} runs, allowed are {MOST_RUNS}. Take fewer values, or several sweeps.")
        return [
            self._run({**self.fixed, **dict(zip(self.axes, point, strict=True))}, seed)
            for point in product(*self.axes.values())
            for seed in self.seeds
        ]

    def _run(self, values: Mapping[str, float], seed: int) -> Run:
        settings = dict(values)
        disks = settings.pop("disks", None)
        if disks is not None and (disks != int(disks) or disks < 1):
            raise LabError(f"disks = {disks:g} is not a number of disks. Give whole numbers above 0.")
        engine = self.engine or ENGINES[self.scene]
        # A whole number without a point, since a parameter may be an integer; a real one takes both.
        plain = {name: int(value) if value == int(value) else value for name, value in settings.items()}
        chosen = (*plain.items(), ("seed", seed))
        count = None if disks is None else int(disks)
        return Run(self.scene, engine, self.seconds, self.seconds, chosen, drive=self.drive, disks=count)


def read_grid(path: Path, changes: Mapping[str, Any] | None = None) -> Grid:
    """The grid of a TOML file; `changes`, of the same form, go over what it says."""
    try:
        table = tomllib.loads(path.read_text())
    except OSError as error:
        raise LabError(f"{path} cannot be read: {error.strerror}.") from None
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise LabError(f"{path} is not TOML: {error}.") from None
    return make_grid(table, changes or {}, str(path))


def make_grid(table: Mapping[str, Any], changes: Mapping[str, Any], where: str) -> Grid:
    """The grid of a table as in the file; `changes` go over it. `where` names the table in errors."""
    unknown = sorted(set(table) - set(KEYS))
    if unknown:
        near = did_you_mean(unknown[0], KEYS)
        raise LabError(f"{where}: {', '.join(unknown)} is not known.{near} There are {', '.join(KEYS)}.")
    fixed = {**_flat(table.get("set", {}), where), **changes.get("set", {})}
    axes = {**_flat(table.get("grid", {}), where), **changes.get("grid", {})}
    for name in changes.get("set", {}):
        axes.pop(name, None)
    for name in changes.get("grid", {}):
        fixed.pop(name, None)
    top = {**table, **{key: value for key, value in changes.items() if value is not None}}
    for key in ("scene", "seconds"):
        if key not in top:
            raise LabError(f"{where}: {key} is missing. A grid needs scene, seconds and seeds.")
    return Grid(
        scene=str(top["scene"]),
        seconds=_number("seconds", top["seconds"], where),
        engine=str(top.get("engine", "")),
        drive=str(top.get("drive", "sine")),
        seeds=_seeds(top.get("seeds", 1), where),
        fixed={name: _number(name, value, where) for name, value in fixed.items()},
        axes={name: _axis(name, value, where) for name, value in axes.items()},
    )


def _flat(table: Any, where: str, prefix: str = "") -> dict[str, Any]:
    """Names with dots, whether TOML took them as keys or as tables in tables."""
    if not isinstance(table, Mapping):
        raise LabError(f"{where}: {prefix or 'set and grid'} must be a table of names and values.")
    flat: dict[str, Any] = {}
    for name, value in table.items():
        whole = prefix + name
        inner = isinstance(value, Mapping) and set(value) != RANGE
        flat.update(_flat(value, where, f"{whole}.") if inner else {whole: value})
    return flat


def _number(name: str, value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise LabError(f"{where}: {name} = {value!r} is not a finite number.")
    return value


def _axis(name: str, value: Any, where: str) -> tuple[float, ...]:
    if isinstance(value, Mapping):
        low, high = (_number(f"{name}.{end}", value.get(end), where) for end in ("from", "to"))
        count = value.get("count")
        if not isinstance(count, int) or count < 2:
            raise LabError(f"{where}: {name}.count = {count!r} must be a whole number, 2 or more.")
        if count > MOST_RUNS:
            raise LabError(f"{where}: {name}.count = {count}, allowed are {MOST_RUNS}. Take fewer values.")
        return tuple(low + (high - low) * i / (count - 1) for i in range(count))
    if not isinstance(value, Sequence) or isinstance(value, str):
        raise LabError(f"{where}: {name} = {value!r} is no axis. Give a list, or {{from = , to = , count = }}.")
    return tuple(_number(name, item, where) for item in value)


def _seeds(value: Any, where: str) -> tuple[int, ...]:
    listed = range(1, value + 1) if isinstance(value, int) and not isinstance(value, bool) else value
    if not isinstance(listed, Sequence) or not all(isinstance(seed, int) and seed >= 0 for seed in listed):
        raise LabError(f"{where}: seeds = {value!r} is neither a number of seeds nor a list of whole numbers.")
    return tuple(dict.fromkeys(listed))
