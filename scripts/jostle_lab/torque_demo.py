"""A PI controller holds the angular velocity of a disk by torque, in spite of stick and slip at its two contacts.

Couplings of the same physics: FMI 2.0 and FMI 3.0 stepped plainly, and FMI 3.0 with event mode, where a step ends when
a contact begins to stick or slip and the controller acts at that instant rather than at its next sample. The last one
uses what event mode tells: when a contact has stuck on the way to another reference, it takes the integral at once to
the torque that friction holds (P 5.3, 5.5) instead of waiting for the error to build it up.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from jostle_lab.disk_fmu import DiskFmu
from jostle_lab.figures import STYLE, WIDTH
from jostle_lab.report import markdown_table
from jostle_lab.tables import write_table

BAND = 0.02
"""A segment has settled when the velocity stays within this share of the step of its reference."""


@dataclass(frozen=True)
class Segment:
    """A reference that is held from a time on."""

    begin: float
    """[s]."""
    reference: float
    """[rad/s]."""


PROFILE = (Segment(0.0, 0.5), Segment(2.0, 0.02), Segment(4.0, -0.02), Segment(6.0, -0.5), Segment(8.0, 0.0))
"""Fast, slow, slow the other way through stick, fast, stop."""
END = 10.0
"""[s]."""


@dataclass(frozen=True)
class Plant:
    """What the controller is designed for."""

    inertia: float
    """m R^2 / 2 [kg m2]."""
    clockwise: float
    """A_S1, the torque that friction holds clockwise [N m]."""
    counter_clockwise: float
    """A_S2 [N m]."""

    @classmethod
    def of(cls, fmu: DiskFmu) -> "Plant":
        """Of the disk in an FMU, by P 5.3 to 5.5."""
        names = ("gravity", "disk.mass", "disk.radius", "contact.friction", "support.angle", "tilt")
        gravity, mass, radius, friction, half_angle, tilt = (fmu.read(name) for name in names)
        unit = gravity * mass * friction * radius / (math.cos(half_angle) * (1.0 + friction**2))
        shares = [math.cos(tilt) + sign * friction * math.sin(tilt) for sign in (1.0, -1.0)]
        return cls(0.5 * mass * radius**2, unit * shares[0], unit * shares[1])


@dataclass
class Controller:
    """Proportional and integral, with the integral held while the torque is at its bound.

    With I the inertia and no friction, `2 omega_c I` and `omega_c^2 I` make the closed loop a critically damped one.
    """

    plant: Plant
    rate: float = 20.0
    """omega_c [rad/s]."""
    bound: float = 0.0
    """Largest torque [N m]; 0: ten times what friction holds and what gives the rate in 1 / omega_c."""
    stored: float = field(default=0.0, init=False)
    at: float = field(default=0.0, init=False)

    def __post_init__(self) -> None:
        """Choose the bound."""
        self.proportional, self.integral = 2.0 * self.rate * self.plant.inertia, self.rate**2 * self.plant.inertia
        if self.bound == 0.0:
            self.bound = 10.0 * max(self.plant.clockwise, self.plant.counter_clockwise, self.plant.inertia)

    def act(self, now: float, reference: float, velocity: float) -> float:
        """Torque from `now` [s] on [N m]. Calls may be apart by any time."""
        error = reference - velocity
        stored = self.stored + self.integral * error * (now - self.at)
        self.at = now
        wanted = self.proportional * error + stored
        torque = min(max(wanted, -self.bound), self.bound)
        if torque == wanted or (stored - self.stored) * wanted < 0.0:
            self.stored = stored
        return torque

    def stuck(self, reference: float) -> None:
        """The disk has stopped: start the integral where friction gives way in the sense of the reference."""
        if reference != 0.0:
            self.stored = self.plant.counter_clockwise if reference > 0.0 else -self.plant.clockwise


@dataclass(frozen=True)
class Record:
    """A run, one row each millisecond and one at each event."""

    name: str
    time: NDArray[np.float64]
    velocity: NDArray[np.float64]
    torque: NDArray[np.float64]
    states: NDArray[np.int64]
    """Shape (rows, 2)."""
    events: int
    cost: float
    """[s]."""


def reference_at(now: float) -> float:
    """Reference [rad/s] at a time [s]."""
    return [segment.reference for segment in PROFILE if segment.begin <= now + 1e-12][-1]


def run(fmu: DiskFmu, name: str, sample: float, step: float, unstick: bool = False) -> Record:
    """Controller every `sample` [s] and, if the FMU tells events, at events too; rows each `step` [s]."""
    controller, rows, events = Controller(Plant.of(fmu)), [], 0
    begun = time.perf_counter()
    steps, each = round(END / step), round(sample / step)
    torque = 0.0
    for index in range(steps):
        if index % each == 0:
            torque = controller.act(index * step, reference_at(index * step), fmu.velocity())
            fmu.apply(torque)
        rows.append((fmu.time, fmu.velocity(), torque, *fmu.states()))
        while fmu.step((index + 1) * step):
            events += 1
            if unstick and 2 in fmu.states():
                controller.stuck(reference_at(fmu.time))
            torque = controller.act(fmu.time, reference_at(index * step), fmu.velocity())
            fmu.apply(torque)
            rows.append((fmu.time, fmu.velocity(), torque, *fmu.states()))
            fmu.resume()
            if fmu.time >= (index + 1) * step:
                break
    table = np.array(rows)
    return Record(
        name, table[:, 0], table[:, 1], table[:, 2], table[:, 3:].astype(np.int64), events, time.perf_counter() - begun
    )


@dataclass(frozen=True)
class Quality:
    """How well a segment was held."""

    reference: float
    settling: float
    """Time until the velocity stays in the band [s]; NaN if never."""
    ripple: float
    """Peak to peak over the last half second [rad/s]."""
    error: float
    """Mean of velocity less reference over the last half second [rad/s]."""
    sticking: float
    """Share of the segment with both contacts sticking."""


def qualities(record: Record) -> list[Quality]:
    """Of every segment."""
    ends = [*(segment.begin for segment in PROFILE[1:]), END]
    before, found = 0.0, []
    for segment, end in zip(PROFILE, ends, strict=True):
        inside = (record.time >= segment.begin) & (record.time < end)
        at, velocity = record.time[inside], record.velocity[inside]
        band = BAND * abs(segment.reference - before)
        outside = np.flatnonzero(np.abs(velocity - segment.reference) > band)
        last = int(outside[-1]) + 1 if len(outside) else 0
        late = at >= end - 0.5
        found.append(
            Quality(
                segment.reference,
                float(at[last] - segment.begin) if last < len(at) else math.nan,
                float(np.ptp(velocity[late])),
                float(np.mean(velocity[late]) - segment.reference),
                float(np.mean((record.states[inside] == 2).all(axis=1))),
            )
        )
        before = segment.reference
    return found


def draw(records: Sequence[Record], plant: Plant) -> Figure:
    """Velocity, torque and contacts against time."""
    figure = Figure(figsize=(WIDTH, 5.6), layout="constrained")
    top, middle, bottom = figure.subplots(3, 1, sharex=True, height_ratios=(3, 3, 1))
    grid = np.linspace(0.0, END, 4001)
    top.plot(grid, [reference_at(float(t)) for t in grid], color="0.1", lw=0.8, ls="--", label="reference")
    styles = (("#9dbfe0", 3.4), ("#d07a1f", 2.0), ("0.1", 0.7), ("#c0272d", 1.0))
    for record, (colour, width) in zip(records, styles, strict=False):
        top.plot(record.time, record.velocity, color=colour, lw=width, label=record.name)
        middle.plot(record.time, record.torque, color=colour, lw=width)
    for limit in (plant.counter_clockwise, -plant.clockwise):
        middle.axhline(limit, color="0.4", lw=0.7, ls=":")
    middle.text(1.0, plant.counter_clockwise, "friction holds", va="bottom", fontsize=7)
    shown = records[-1]
    for contact in range(2):
        for state, colour in ((1, "#c0272d"), (2, "0.75"), (3, "#1f5fa8"), (4, "#d07a1f")):
            inside = shown.states[:, contact] == state
            bottom.plot(shown.time[inside], np.full(np.count_nonzero(inside), contact + 1), "|", color=colour, ms=9)
    bottom.set(yticks=(1, 2), yticklabels=("left", "right"), ylim=(0.4, 2.6), xlabel="time [s]")
    bottom.set_title(
        "contacts of the last: grey stick, blue slip counter-clockwise, orange slip clockwise, red open", fontsize=8
    )
    top.set(ylabel="angular velocity [rad/s]", xlim=(0.0, END))
    shown_torque = 4.0 * max(plant.clockwise, plant.counter_clockwise)
    middle.set(ylabel="torque [N m]", ylim=(-shown_torque, shown_torque))
    top.legend(loc="upper right", ncols=2)
    return figure


def page(records: Sequence[Record], sample: float) -> str:
    """Numbers of every coupling and segment."""
    header = ("coupling", "reference [rad/s]", "settling [s]", "ripple [rad/s]", "steady error [rad/s]", "sticking")
    rows = [
        (
            record.name,
            f"{q.reference:g}",
            "never" if math.isnan(q.settling) else f"{q.settling:.3f}",
            f"{q.ripple:.1e}",
            f"{q.error:+.1e}",
            f"{q.sticking:.2f}",
        )
        for record in records
        for q in qualities(record)
    ]
    costs = [f"- {record.name}: {record.events} events, {record.cost:.2f} s" for record in records]
    return "\n".join(
        [
            "# A PI controller on a disk with stick and slip",
            "",
            markdown_table(header, rows),
            "",
            f"Controller every {1e3 * sample:g} ms. Settled: within {100 * BAND:g} % of the step of the reference for "
            "good. Ripple: peak to peak over the last half second. Sticking: share of a segment, both contacts.",
            "",
            *costs,
            "",
        ]
    )


def demonstrate(fmi2: Path, fmi3: Path, results: Path, sample: float, parameters: dict[str, float]) -> list[Path]:
    """Run all couplings; write torque.csv, torque.png and torque.md; return their paths."""
    couplings = [
        ("FMI 2.0, plain steps", fmi2, False, False),
        ("FMI 3.0, plain steps", fmi3, False, False),
        ("FMI 3.0, event mode", fmi3, True, False),
        ("the same, unsticks", fmi3, True, True),
    ]
    records = []
    for name, path, events, unstick in couplings:
        with DiskFmu(path, parameters, events) as fmu:
            plant = Plant.of(fmu)
            records.append(run(fmu, name, sample, 1e-3, unstick))
    results.mkdir(parents=True, exist_ok=True)
    table, picture, text = results / "torque.csv", results / "torque.png", results / "torque.md"
    rows: list[dict[str, Any]] = [
        {"coupling": r.name, "time": t, "velocity": v, "torque": m, "left": int(s[0]), "right": int(s[1])}
        for r in records
        for t, v, m, s in zip(r.time.tolist(), r.velocity.tolist(), r.torque.tolist(), r.states, strict=True)
    ]
    write_table(table, rows)
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        draw(records, plant).savefig(picture)
    text.write_text(page(records, sample))
    return [table, picture, text]
