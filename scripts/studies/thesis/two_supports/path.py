"""P Fig. 5.6: the path of the tangential springs in the plane of departure and stretch, for two torques."""

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.tables import Table
from jostle_lab.verdicts import exact, true
from studies.thesis.two_supports.runs import NORMAL_STIFFNESS, PERIODS, Torque, notes
from studies.thesis.two_supports.spring_region import Region, distance_to_path, region

TILT = 0.1 * math.pi
STILL, SLIDING = Torque(TILT, 0.100), Torque(TILT, 0.113)
SAMPLES = 500
"""Points a period."""
QUICK_SAMPLES = 300
ON_PATH = 1e-2
"""A point within this part of the distance from S1 to S2 is on a line: the width of a line in print."""
SHOWN = 1e8
"""Scale of the axes."""


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Both paths, and how close the second one comes to the one of P 5.2.3."""
    samples = QUICK_SAMPLES if quick else SAMPLES
    tables = laboratory.run([torque.run(samples) for torque in (STILL, SLIDING)], "figure 5.6")
    still, sliding = (tables[torque.run(samples)] for torque in (STILL, SLIDING))
    rigid, soft = region(laboratory, TILT), region(laboratory, TILT, NORMAL_STIFFNESS)
    rows = [
        _row(torque, table, i)
        for torque, table in ((STILL, still), (SLIDING, sliding))
        for i in range(len(table["time"]))
    ]
    page = [
        *notes(),
        f"tilt 0.1 pi, {samples} points a period; distances over the last period, in units of the distance from S1 to "
        f"S2, {rigid.size:.3e} rad; S and T: rigid contacts, and soft ones whose disk has sunk in",
    ]
    return Product(
        "Figure 5.6: paths of the tangential springs",
        rows,
        _draw(still, sliding, rigid),
        _statements(still, sliding, rigid, soft),
        page,
    )


def _row(torque: Torque, table: Table, index: int) -> dict[str, Any]:
    names = ("time", "torque.applied", "skin.departure", "skin.stretch", "disk.angle[1]")
    return {"torque_amplitude": torque.amplitude, **{name: float(table[name][index]) for name in names}}


def _points(table: Table, last_period: bool = True) -> Numbers:
    points = np.column_stack([table["skin.departure"], table["skin.stretch"]])
    return points[-(len(points) // PERIODS) :] if last_period else points


def _draw(still: Table, sliding: Table, rigid: Region) -> Figure:
    figure = Figure(figsize=(0.85 * WIDTH, 4.6), layout="constrained")
    panel = figure.subplots()
    panel.plot(*(SHOWN * rigid.outline.T), "k:", lw=1.0, label="admissible region, 4.41 to 4.49")
    panel.plot(*(SHOWN * rigid.cycle().T), color="#c0272d", lw=2.4, alpha=0.35, label="path of 5.2.3")
    for table, colour, amplitude in ((sliding, "0.1", SLIDING.amplitude), (still, "0.6", STILL.amplitude)):
        panel.plot(
            *(SHOWN * _points(table, last_period=False).T),
            color=colour,
            lw=0.7,
            label=f"simulation, $A_e$ = {amplitude:.3f} N m",
        )
    for name, corner in rigid.corners.items():
        if name.startswith("D"):
            continue
        panel.plot(*(SHOWN * corner), "ko", ms=3.5)
        left = corner[0] < 0.0
        panel.annotate(
            f"${name[0]}_{name[1]}$", tuple(SHOWN * corner), xytext=(-14 if left else 6, 4), textcoords="offset points"
        )
    panel.set(xlabel=r"$\delta\theta$ [$10^{-8}$ rad]", ylabel=r"$\Theta$ [$10^{-8}$ rad]")
    panel.margins(0.08)
    panel.legend(loc="lower right")
    return figure


def _statements(still: Table, sliding: Table, rigid: Region, soft: Region) -> list[Statement]:
    points = _points(sliding)
    unit = rigid.size
    from_path = {
        name: distance_to_path(points, found.cycle()) / unit for name, found in (("rigid", rigid), ("soft", soft))
    }
    beyond = {name: found.outside(points) / unit for name, found in (("rigid", rigid), ("soft", soft))}
    corners = {
        name: [float(np.min(np.linalg.norm(points - found.corners[s], axis=1))) / unit for s in ("S1", "S2")]
        for name, found in (("rigid", rigid), ("soft", soft))
    }
    levels = {s: _level(sliding, points, s, soft) for s in ("S1", "S2")}
    angle = still["disk.angle[1]"][-len(points) - 1 :]
    turned, rolled = float(abs(angle[-1] - angle[0])), float(np.ptp(angle))
    inside = float(np.max(rigid.outside(_points(still, last_period=False)))) / unit
    regimes = [int(table["sliding_regime"][-1]) - 1 for table in (still, sliding)]

    def listed(values: dict[str, Numbers]) -> str:
        return "; ".join(
            f"{name}: largest {v.max():.1e}, rms {math.sqrt(float(np.mean(v * v))):.1e}" for name, v in values.items()
        )

    text = "; ".join(
        f"{name}: Theta strays by {spread / unit:.1e} while the departure covers {span / unit:.2f}"
        for name, (spread, span) in levels.items()
    )
    close = f"{ON_PATH:g} of the distance from S1 to S2"
    return [
        Statement.judged(
            "5.2.3",
            "A_e = 0.100: never at a sliding point, the disk does not rotate",
            f"{turned:.1e} rad in the last period; it rolls to and fro by {rolled:.1e} rad as its centre moves; "
            f"at most {inside:.1e} outside the quadrilateral, regime {regimes[0]}",
            exact(regimes[0], 0.0, "sliding regime") & exact(turned / rolled, 1e-6, "rotation over rolling"),
        ),
        Statement.judged(
            "5.2.3",
            "A_e = 0.113: bidirectional, S1 and S2 are reached",
            f"regime {regimes[1]}; distance of the path from S1 and S2: "
            + "; ".join(f"{name} {pair[0]:.1e}, {pair[1]:.1e}" for name, pair in corners.items()),
            true(regimes[1] == 2 and max(corners["rigid"]) < ON_PATH, f"both senses, each point within {close}"),
        ),
        Statement.judged(
            "Fig. 5.6",
            "the path stays in the quadrilateral",
            "distance beyond it: " + listed(beyond),
            exact(float(beyond["rigid"].max()), ON_PATH, "distance over that from S1 to S2"),
        ),
        Statement.judged(
            "5.2.3",
            "S1, Theta = const, line T2 S2, S2, Theta = const, line T1 S1, S1",
            "distance from that path: " + listed(from_path),
            exact(float(from_path["rigid"].max()), ON_PATH, "distance over that from S1 to S2"),
        ),
        Statement.judged(
            "5.2.3",
            "when the disk stops the system leaves S along Theta = Theta_S",
            text + "; the springs oscillate along this line after the stop, damped by the normal dashpots alone",
            true(
                all(spread < ON_PATH * unit < span for spread, span in levels.values()),
                f"Theta stays within {close}, the departure does not",
            ),
        ),
        Statement.judged(
            "5.2.3",
            "on T1 S1 contact 1 starts to slide",
            _sliding(sliding, points, rigid),
            true(_sliding_contact(sliding, points, rigid) == 1, "which contact slips on that edge; no chance"),
            "4.38 (c), the condition of that edge, is the one of contact 2, as P 4.4 says: a slip of the pen in 5.2.3",
        ),
    ]


def _sliding_contact(table: Table, points: Numbers, rigid: Region) -> int:
    """Contact that slips alone along the inner part of the edge T1 S1."""
    edge = np.array([rigid.corners["T1"], rigid.corners["S1"]])
    near = distance_to_path(points, edge) < ON_PATH * rigid.size
    away = np.linalg.norm(points - rigid.corners["S1"], axis=1) > 0.1 * rigid.size
    states = np.column_stack([table[f"contact[{i}].state"][-len(points) :] for i in (1, 2)])[near & away]
    alone = [(int(np.sum((states[:, i] > 2) & (states[:, 1 - i] == 2))), i + 1) for i in (0, 1)]
    return max(alone)[1]


def _sliding(table: Table, points: Numbers, rigid: Region) -> str:
    return f"contact {_sliding_contact(table, points, rigid)} slips there, the other one sticks"


def _level(table: Table, points: Numbers, name: str, soft: Region) -> tuple[float, float]:
    """Spread of the stretch, span of the departure after the disk has left a sliding point and both contacts stick."""
    last = -len(points)
    states = np.column_stack([table[f"contact[{i}].state"][last:] for i in (1, 2)])
    sticking = (states == 2).all(axis=1) & (np.abs(points[:, 1] - soft.corners[name][1]) < 0.05 * soft.size)
    chosen = points[sticking]
    if len(chosen) == 0:
        return math.nan, math.nan
    return float(np.ptp(chosen[:, 1])), float(np.ptp(chosen[:, 0]))
