"""P Fig. 4.3: the region that Coulomb friction (Amontons' in P) admits, quasi-static or at constant normal forces."""

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement, verdict
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.tables import Table
from studies.thesis.two_supports.runs import ENGINE, SCENE, TANGENTIAL_STIFFNESS, TIME_STEP, Torque
from studies.thesis.two_supports.spring_region import Region, distance_to_path, region

TILT = 0.1 * math.pi
FRICTION, HALF_ANGLE, WEIGHT = 0.1, math.pi / 6.0, 1.0
SECONDS, QUICK_SECONDS = 4.0, 1.0
SAMPLE = 1e-3
"""Time between points [s]."""
SLOW_SAMPLES = 1000
"""Points of the path under a slow torque."""
AMPLITUDE = 1e-5
"""Of the supports [m]: the centre of the disk is accelerated by a per cent of gravity."""
SHOWN = 1e8
"""Scale of the axes."""


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Regions from the theory; points of a disk on weakly vibrating supports, which come to all four corners."""
    settings = (
        ("tilt", TILT),
        ("support.amplitude", AMPLITUDE),
        ("time_step", TIME_STEP),
    )
    run = Run(SCENE, ENGINE, QUICK_SECONDS if quick else SECONDS, SAMPLE, settings, drive="random-supports")
    slow = Torque(TILT, 0.113)
    tables = laboratory.run([run, slow.run(SLOW_SAMPLES)], "figure 4.3")
    table, turned = tables[run], tables[slow.run(SLOW_SAMPLES)]
    slow_path = np.column_stack([turned["skin.departure"], turned["skin.stretch"]])[-SLOW_SAMPLES:]
    quasi_static, upright = region(laboratory, TILT), region(laboratory, 0.0)
    constant = constant_normal_forces(TILT)
    points = np.column_stack([table["skin.departure"], table["skin.stretch"]])[10:]
    rows: list[dict[str, Any]] = [
        {"what": name, "departure": float(p[0]), "stretch": float(p[1])}
        for name, p in [
            *quasi_static.corners.items(),
            *((f"constant {i}", p) for i, p in enumerate(constant)),
            *(("random supports", p) for p in points),
            *(("slow torque", p) for p in slow_path),
        ]
    ]
    notes = [
        f"tilt 0.1 pi, mu = 0.1, k_t = 1e6 N/m, m g = 1 N, R = 1 m; points: random supports of {AMPLITUDE:g} m rms, "
        f"{run.seconds:g} s, one each {SAMPLE:g} s, seed 1, after 10 ms",
    ]
    return Product(
        "Figure 4.3: admissible region",
        rows,
        _draw(quasi_static, constant, points, slow_path),
        _statements(quasi_static, upright, constant, points, table),
        notes,
    )


def constant_normal_forces(tilt: float) -> Numbers:
    """Corners of the region if both normal forces stay at those without tangential forces; shape (4, 2)."""
    unit = 2.0 * TANGENTIAL_STIFFNESS
    left = WEIGHT * math.sin(HALF_ANGLE + tilt) / math.sin(2.0 * HALF_ANGLE)
    right = WEIGHT * math.sin(HALF_ANGLE - tilt) / math.sin(2.0 * HALF_ANGLE)
    signs = ((1, 1), (1, -1), (-1, -1), (-1, 1))
    forces = [(FRICTION * left * a, FRICTION * right * b) for a, b in signs]
    return np.array([(-(one + two) / unit, (two - one) / unit) for one, two in forces])


def _draw(quasi_static: Region, constant: Numbers, points: Numbers, slow: Numbers) -> Figure:
    figure = Figure(figsize=(0.75 * WIDTH, 4.6), layout="constrained")
    panel = figure.subplots()
    panel.plot(*(SHOWN * points.T), ".", color="#7fa8d1", ms=1.5, label="simulation, supports vibrate weakly", zorder=1)
    panel.plot(*(SHOWN * slow.T), color="#c0272d", lw=1.8, alpha=0.6, label="simulation, slow torque")
    panel.plot(*(SHOWN * np.vstack([constant, constant[:1]]).T), "k:", lw=1.3, label="constant normal forces")
    panel.plot(*(SHOWN * quasi_static.outline.T), "k--", lw=1.3, label="quasi-static")
    for name in ("S1", "S2", "T1", "T2"):
        corner = quasi_static.corners[name]
        panel.plot(*(SHOWN * corner), "ko", ms=3.5)
        left = corner[0] < 0.0
        panel.annotate(
            f"${name[0]}_{name[1]}$",
            tuple(SHOWN * corner),
            xytext=(-16 if left else 7, -9 if name == "T2" else 5),
            textcoords="offset points",
        )
    panel.set(xlabel=r"$\delta\theta$ [$10^{-8}$ rad]", ylabel=r"$\Theta$ [$10^{-8}$ rad]", aspect="equal")
    panel.margins(0.08)
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, 1.2), ncols=2)
    return figure


def _share(first: Numbers, second: Numbers) -> str:
    """How many of the points near either outline are near the first."""
    near = (first < 0.01) | (second < 0.01)
    return f"{100.0 * float(np.mean(first[near] < 0.01)):.0f} %"


def _statements(
    quasi_static: Region, upright: Region, constant: Numbers, points: Numbers, table: Table
) -> list[Statement]:
    def skew(corners: Numbers) -> float:
        """How far the corners are from being symmetric about the origin, over the size."""
        return float(np.max(np.abs(corners + np.roll(corners, 2, axis=0))) / np.max(np.abs(corners)))

    def reflected(found: Region) -> float:
        """How far the region is from its mirror image in the departure, over the size."""
        corners = found.corners
        rest = [corners["S1"] - corners["S2"] * (-1, 1), corners["T1"] * (1, 0), corners["T2"] * (1, 0)]
        return float(np.max(np.abs(rest)) / found.size)

    def nearest(corners: dict[str, Numbers]) -> dict[str, float]:
        """Distance of the nearest point from each corner, over the size."""
        return {
            name: float(np.min(np.linalg.norm(points - corner, axis=1)) / quasi_static.size)
            for name, corner in corners.items()
        }

    order = ("S1", "T2", "S2", "T1")
    near = nearest({name: quasi_static.corners[name] for name in order})
    near_constant = nearest(dict(zip(order, constant, strict=True)))
    outline = np.vstack([constant, constant[:1]])
    from_constant = distance_to_path(points, outline) / quasi_static.size
    from_quasi_static = distance_to_path(points, quasi_static.outline) / quasi_static.size
    beyond = quasi_static.outside(points) / quasi_static.size
    at_limit = min(float(table["amonton_margin"].min()), 0.0)
    edges = np.diff(constant, axis=0)
    angles = np.degrees(np.arctan2(edges[:, 1], edges[:, 0])) % 90.0
    return [
        Statement(
            "4.4",
            "the quasi-static region is asymmetric if the supports are tilted",
            f"from its mirror image: {reflected(quasi_static):.3f} of its size, without tilt {reflected(upright):.0e}",
            verdict(reflected(quasi_static) > 0.01 and reflected(upright) < 1e-12),
        ),
        Statement(
            "4.4",
            "with constant normal forces it is a parallelogram turned by 45 degrees, symmetric about the origin",
            f"edges at {', '.join(f'{a:.1f}' for a in angles)} degrees, asymmetry {skew(constant):.0e}",
            verdict(skew(constant) < 1e-12 and bool(np.all(np.abs(angles - 45.0) < 1e-6))),
        ),
        Statement(
            "4.4, 5.3.3",
            "vibrating supports reach S1, S2, T1 and T2",
            "nearest point, over the size: "
            + ", ".join(f"{name} {d:.3f}" for name, d in near.items())
            + "; from the corners with constant normal forces "
            + ", ".join(f"{name} {d:.3f}" for name, d in near_constant.items()),
            verdict(max(min(near[name], near_constant[name]) for name in order) < 0.05),
        ),
        Statement(
            "5.3.3",
            "normal forces at the sliding points are near those of equilibrium",
            f"no: of the points within a per cent of an outline {_share(from_constant, from_quasi_static)} follow the "
            "region of constant normal forces; the springs load faster than the centre can follow",
            verdict(bool(np.sum(from_constant < 0.01) < np.sum(from_quasi_static < 0.01))),
        ),
        Statement(
            "4.4",
            "accelerations of the centre move the region",
            f"{100 * float(np.mean(beyond > 1e-3)):.0f} % of the points lie outside the quasi-static one, at most "
            f"{beyond.max():.2f} of its size; smallest mu n - |tau| {at_limit:.0e} N",
            verdict(beyond.max() < 0.5 and at_limit > -1e-9),
        ),
    ]
