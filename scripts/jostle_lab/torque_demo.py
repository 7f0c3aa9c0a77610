"""A PI controller holds the angular velocity of a disk by torque, in spite of stick and slip at its two contacts.

Three couplings of the same physics: FMI 2.0 and FMI 3.0 stepped plainly, and FMI 3.0 with event mode, where it ends
a step when a contact begins to stick or slip and the controller acts at that instant rather than at its next sample.
"""

import math
import time
from collections.abc import Callable, Sequence
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

INERTIA = 0.05
"""m R^2 / 2 of the default disk [kg m2]."""
LIMITS = 0.11433
"""Torque that friction holds without tilt, A_0 (P 5.4) [N m]."""
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


@dataclass
class Controller:
    """Proportional and integral, with the integral held while the torque is at its bound.

    With I the inertia and no friction, `proportional = 2 omega_c I` and `integral = omega_c^2 I` make the closed loop a
    critically damped one of omega_c.
    """

    proportional: float = 2.0 * 20.0 * INERTIA
    """[N m s]."""
    integral: float = 20.0**2 * INERTIA
    """[N m]."""
    bound: float = 1.0
    """Largest torque [N m]."""
    stored: float = field(default=0.0, init=False)
    at: float = field(default=0.0, init=False)

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


def run(fmu: DiskFmu, name: str, sample: float, step: float) -> Record:
    """Controller every `sample` [s] and, if the FMU tells events, at events too; rows each `step` [s]."""
    controller, rows, events = Controller(), [], 0
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


def draw(records: Sequence[Record]) -> Figure:
    """Velocity, torque and contacts against time."""
    figure = Figure(figsize=(WIDTH, 5.6), layout="constrained")
    top, middle, bottom = figure.subplots(3, 1, sharex=True, height_ratios=(3, 3, 1))
    grid = np.linspace(0.0, END, 4001)
    top.plot(grid, [reference_at(float(t)) for t in grid], color="0.1", lw=0.8, ls="--", label="reference")
    styles = (("#9dbfe0", 3.0), ("#d07a1f", 1.6), ("#14406f", 0.7))
    for record, (colour, width) in zip(records, styles, strict=False):
        top.plot(record.time, record.velocity, color=colour, lw=width, label=record.name)
        middle.plot(record.time, record.torque, color=colour, lw=width)
    for sign in (-1.0, 1.0):
        middle.axhline(sign * LIMITS, color="0.4", lw=0.7, ls=":")
    middle.text(0.05, LIMITS, "friction", va="bottom", fontsize=7)
    shown = records[-1]
    for contact in range(2):
        for state, colour in ((1, "#c0272d"), (2, "0.75"), (3, "#1f5fa8"), (4, "#d07a1f")):
            inside = shown.states[:, contact] == state
            bottom.plot(shown.time[inside], np.full(np.count_nonzero(inside), contact + 1), "|", color=colour, ms=9)
    bottom.set(yticks=(1, 2), yticklabels=("left", "right"), ylim=(0.4, 2.6), xlabel="time [s]")
    bottom.set_title("contacts: grey stick, blue slip counter-clockwise, orange slip clockwise, red open", fontsize=8)
    top.set(ylabel="angular velocity [rad/s]", xlim=(0.0, END))
    middle.set(ylabel="torque [N m]", ylim=(-0.5, 0.5))
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
    """Run all three couplings; write torque.csv, torque.png and torque.md; return their paths."""
    couplings: list[tuple[str, Callable[[], DiskFmu]]] = [
        ("FMI 2.0, plain steps", lambda: DiskFmu(fmi2, parameters)),
        ("FMI 3.0, plain steps", lambda: DiskFmu(fmi3, parameters)),
        ("FMI 3.0, event mode", lambda: DiskFmu(fmi3, parameters, events=True)),
    ]
    records = []
    for name, make in couplings:
        with make() as fmu:
            records.append(run(fmu, name, sample, 1e-3))
    results.mkdir(parents=True, exist_ok=True)
    table, picture, text = results / "torque.csv", results / "torque.png", results / "torque.md"
    rows: list[dict[str, Any]] = [
        {"coupling": r.name, "time": t, "velocity": v, "torque": m, "left": int(s[0]), "right": int(s[1])}
        for r in records
        for t, v, m, s in zip(r.time.tolist(), r.velocity.tolist(), r.torque.tolist(), r.states, strict=True)
    ]
    write_table(table, rows)
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        draw(records).savefig(picture)
    text.write_text(page(records, sample))
    return [table, picture, text]
