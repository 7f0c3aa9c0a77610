"""A run as a film needs it: where each disk was, how it was turned, what moved the base.

Made from the dataset that `jostle.Simulation.run` returns; `sources` makes that of files. Nothing is repaired: what is
missing, not a number, or out of order is refused by its name.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError

if TYPE_CHECKING:
    import xarray as xr

Numbers = NDArray[np.float64]
SCENES = ("packing", "ratchet", "wedge", "three_disk")
"""That can be drawn."""
OPTIONS = {
    "wall.motion": ("fixed", "with_base"),
    "support.shape": ("disks", "walls"),
    "base.model": ("moving", "random_phase"),
}
"""Parameters that are options: a dataset has their names, the file of `jostle run` their numbers, from 1."""
NEEDED = ("disk.x", "disk.y", "disk.angle")


@dataclass(frozen=True)
class Recording:
    """Samples of one run."""

    data: "xr.Dataset"
    """All that was recorded."""
    time: Numbers
    """[s], shape (samples,); it increases."""
    x: Numbers
    """To the right [m], shape (samples, disks); in `three_disk` from where the disk just touches both supports."""
    y: Numbers
    """Up [m], shape (samples, disks)."""
    angle: Numbers
    """Counter-clockwise [rad], shape (samples, disks)."""
    radius: Numbers
    """[m], shape (disks,)."""
    base: Numbers | None
    """Displacement of the base up [m], shape (samples,); None if it was not recorded."""

    @property
    def scene(self) -> str:
        """Name of the scene."""
        return str(self.data.attrs["scene"])

    @property
    def engine(self) -> str:
        """Name of the engine."""
        return str(self.data.attrs.get("engine", ""))

    @property
    def drive(self) -> str:
        """What moves the base."""
        return str(self.data.attrs.get("drive", ""))

    @property
    def disks(self) -> int:
        """Number of disks."""
        return len(self.radius)

    @property
    def interval(self) -> float:
        """Median time from sample to sample [s]."""
        return float(np.median(np.diff(self.time)))

    def parameter(self, name: str) -> float:
        """Value of a parameter that is a number."""
        found = self.data.attrs.get(name)
        try:
            return float(found)  # type: ignore[arg-type]
        except (TypeError, ValueError):
            raise LabError(
                f"{name} is not among the parameters of this run (found: {found!r}), but {self.scene} cannot be drawn "
                "without it. Keep the attributes of the dataset, or the file NAME.parameters.csv beside a table."
            ) from None

    def option(self, name: str) -> str:
        """Name of the chosen option of a parameter."""
        found, names = self.data.attrs.get(name), OPTIONS[name]
        if isinstance(found, str) and found in names:
            return found
        if found is not None and str(found) in {"1", "2", "1.0", "2.0"}:
            return names[int(float(found)) - 1]
        allowed = ", ".join(f"{number} {text}" for number, text in enumerate(names, 1))
        raise LabError(f"{name} = {found!r} is not allowed: one of {allowed}. Keep the parameters of the run.")

    def period(self) -> float | None:
        """Period of what drives the scene [s]; None if it has none."""
        attributes = self.data.attrs
        if self.drive in ("sine", "sine-fixed-bottom"):
            frequency, amplitude = self.parameter("drive.frequency"), self.parameter("drive.amplitude")
            return 1.0 / frequency if frequency > 0.0 and amplitude > 0.0 else None
        if self.drive == "harmonic-torque" and "torque.angular_frequency" in attributes:
            return math.tau / self.parameter("torque.angular_frequency")
        return None

    def base_is_at_rest(self) -> bool:
        """Whether the engine only lends impacts the velocity of a base that stays where it is."""
        random = "base.model" in self.data.attrs and self.option("base.model") == "random_phase"
        return self.engine == "map" or random


def record(data: "xr.Dataset", origin: str = "the dataset") -> Recording:
    """What a film needs of a dataset.

    Args:
        data: as `jostle.Simulation.run` returns it.
        origin: what messages call it.

    Raises:
        LabError: something is missing, empty, not a number, or out of order.

    """
    scene = data.attrs.get("scene")
    if scene not in SCENES:
        raise LabError(
            f"{origin}: the attribute scene is {scene!r}, which is not allowed: one of {', '.join(SCENES)}. "
            "Give a dataset of jostle.Simulation.run with its attributes."
        )
    missing = [name for name in NEEDED if name not in data]
    if missing or "time" not in data.coords:
        names = ", ".join(missing or ["time"])
        raise LabError(f"{origin} has no {names}: a film needs {', '.join(NEEDED)}. Record them, or all outputs.")
    for name in NEEDED:
        if data[name].dims != ("time", "disk"):
            raise LabError(f"{origin}: {name} has the dimensions {data[name].dims}, not ('time', 'disk').")
    time = np.asarray(data["time"].values, dtype=np.float64)
    if len(time) < 2 or data.sizes["disk"] == 0:
        raise LabError(
            f"{origin} has {len(time)} samples of {data.sizes['disk']} disks: at least 2 samples of 1 disk make a "
            "film. Run longer, or sample more often (every=...)."
        )
    if not np.all(np.isfinite(time)) or np.any(np.diff(time) <= 0.0):
        at = int(np.argmax(~(np.diff(time) > 0.0)))
        raise LabError(
            f"{origin}: after time = {time[at]:g} s comes {time[at + 1]:g} s: times have to increase. "
            "The first sample of a second run is the last one of the first: leave one out."
        )
    x, y, angle = (_finite(data, name, time, origin) for name in NEEDED)
    return Recording(data, time, x, y, angle, _radius(data, origin), _base(data, time, origin))


def _finite(data: "xr.Dataset", name: str, time: Numbers, origin: str) -> Numbers:
    values = np.asarray(data[name].values, dtype=np.float64)
    wrong = ~np.isfinite(values)
    if wrong.any():
        at = tuple(int(i) for i in np.argwhere(wrong)[0])
        which = f"{name}[{at[1] + 1}]" if len(at) > 1 else name
        raise LabError(
            f"{origin}: {which} = {values[at]} at {time[at[0]]:g} s is no place to draw at: every value has to be a "
            "finite number. Leave these samples out."
        )
    return values


def _radius(data: "xr.Dataset", origin: str) -> Numbers:
    disks = data.sizes["disk"]
    if "disk.radius" in data:
        radius = np.asarray(data["disk.radius"].values, dtype=np.float64)
    else:
        radius = np.full(disks, float(data.attrs.get("disk.radius", math.nan)))
    if radius.shape != (disks,) or not np.all(np.isfinite(radius) & (radius > 0.0)):
        raise LabError(
            f"{origin} does not say how large the disks are: disk.radius has to be a coordinate of {disks} lengths "
            "above 0, or a parameter. Keep the coordinates of the dataset, or NAME.parameters.csv beside a table."
        )
    return radius


def _base(data: "xr.Dataset", time: Numbers, origin: str) -> Numbers | None:
    return _finite(data, "base.position", time, origin) if "base.position" in data else None
