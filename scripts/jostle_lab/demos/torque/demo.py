"""A PI controller holds the angular velocity of a disk by torque, in spite of stick and slip at its two contacts.

Couplings of the same physics: FMI 2.0 and FMI 3.0 stepped plainly, and FMI 3.0 with event mode, where a step ends when
a contact begins to stick or slip and the controller acts at that instant rather than at its next sample. The last one
uses what event mode reports: when a contact has stuck before a new reference is reached, it sets the integral at once
to the torque that friction holds (P 5.3, 5.5) instead of waiting for the error to build it up.
"""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.demos.torque.controller import END, Plant, reference_at
from jostle_lab.demos.torque.record import BAND, Record, qualities, run
from jostle_lab.fmu.disk_on_two_supports import DiskFmu
from jostle_lab.plots.style import WIDTH, house_style, save
from jostle_lab.tables import Row, markdown_table, write_table


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
    results.mkdir(parents=True, exist_ok=True)  # before the work, which would be lost
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
    table, picture, text = results / "torque.csv", results / "torque.png", results / "torque.md"
    rows: list[Row] = [
        {"coupling": r.name, "time": t, "velocity": v, "torque": m, "left": int(s[0]), "right": int(s[1])}
        for r in records
        for t, v, m, s in zip(r.time.tolist(), r.velocity.tolist(), r.torque.tolist(), r.states, strict=True)
    ]
    write_table(table, rows)
    with house_style():
        save(draw(records, plant), picture)
    text.write_text(page(records, sample))
    return [table, picture, text]
