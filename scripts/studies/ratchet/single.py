"""F V: which way a single ball goes, dropped onto teeth at rest, and a single disk on shaken ones."""

import math
import time
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import Table as Columns
from jostle_lab.verdicts import above, below, every
from studies.ratchet.cases import Case
from studies.ratchet.falling_ball import Law, Tooth, fall
from studies.ratchet.observe import observe_runs
from studies.ratchet.study import Table, listed, stated

RADIUS = 1.1
"""Of the ball [mm]: the middle of those of F IV."""
TOOTH_WIDTH = 6.0
BALLS = 10_000
STEEPEST = 15.0
"""Angles are drawn evenly from this to both sides of the vertical [degrees]."""
OTHER_ANGLES = (5.0, 45.0, 70.0)
RESTITUTIONS = (0.5, 0.7, 0.8, 0.9)
SHAPE = (6.0, 0.25)
"""h [mm] and a of F's Figs 8, 10, 12 and 14: teeth of intermediate size and asymmetry."""
FORWARD_SHAPE = (3.0, 0.1)
"""h and a of F's Figs 9, 11 and 13: a dense layer or a thin one, the flow is positive."""
HEIGHTS = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 14.0, 20.0)
ASYMMETRIES = (0.0, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5)
ROTATING, FROZEN, SMOOTH = Law(), Law(inertia=math.inf), Law(friction=0.0)
ROUGH, ROUGH_FROZEN = Law(friction=0.5), Law(friction=0.5, inertia=math.inf)
LAWS = {
    "friction 0.1, the ball rotates": ROTATING,
    "friction 0.1, rotation frozen": FROZEN,
    "no friction": SMOOTH,
    "friction 0.5, the ball rotates": ROUGH,
    "friction 0.5, rotation frozen": ROUGH_FROZEN,
}
"""Restitution 0.8."""
SHAKEN = {
    friction: Case(*SHAPE, 30.0, 1, seconds=60.0).with_changes(collision__friction=friction)
    for friction in (0.0, 0.1, 0.5)
}
SHAKEN_FORWARD = Case(*FORWARD_SHAPE, 25.0, 1, seconds=60.0)
"""One disk for 60 s."""
RUNS = 60


class Drops:
    """Balls that are dropped at the same places and angles on every tooth, with every law, so that laws are paired."""

    def __init__(self, laboratory: Laboratory, balls: int) -> None:
        self.laboratory, self.balls = laboratory, balls

    def left(self, shape: tuple[float, float], law: Law, angle: float = STEEPEST) -> NDArray[np.float64]:
        """Shares of ten groups of the balls that leave to the left."""
        key = f"falling balls {self.balls} {shape[0]:g} {shape[1]:g} {law.restitution:g} {law.friction:g} "
        key += f"{law.inertia:g} {angle:g}"

        def compute() -> tuple[Columns, float]:
            begun = time.process_time()
            generator = np.random.default_rng(1)
            places = generator.uniform(0.0, TOOTH_WIDTH, self.balls)
            angles = np.radians(generator.uniform(-angle, angle, self.balls))
            falls = fall(Tooth(TOOTH_WIDTH, *shape), law, RADIUS, places, angles)
            shares = falls.to_the_left.reshape(GROUPS, -1).mean(axis=1)
            return {"left": shares}, time.process_time() - begun

        return self.laboratory.computed(key, compute)["left"]

    def share(self, shape: tuple[float, float], law: Law, angle: float = STEEPEST) -> Estimate:
        """Share of the balls that leave to the left."""
        return Estimate.over_runs(self.left(shape, law, angle))

    def gain(self, law: Law, than: Law) -> Estimate:
        """By how much the share is larger with one law than with another, ball by ball the same, on `SHAPE`."""
        return Estimate.over_runs(self.left(SHAPE, law) - self.left(SHAPE, than))


GROUPS = 10


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Both halves: dropped balls and shaken disks."""
    drops = Drops(laboratory, BALLS // 10 if quick else BALLS)
    heights, asymmetries = (HEIGHTS[::3], ASYMMETRIES[::3]) if quick else (HEIGHTS, ASYMMETRIES)
    runs = seeds or (10 if quick else RUNS)
    shaken = observe_runs(laboratory, {**dict.fromkeys(SHAKEN.values(), runs), SHAKEN_FORWARD: runs}, "single disk")
    points = shaken.points()
    by_friction = {friction: points[case].estimate for friction, case in SHAKEN.items()}
    rows = [
        {"height_mm": h, "asymmetry": a, "law": name, "share_to_the_left": e.mean, "error": e.error}
        for h, a in (*((h, SHAPE[1]) for h in heights), *((SHAPE[0], a) for a in asymmetries))
        for name, law in LAWS.items()
        for e in (drops.share((h, a), law),)
    ]
    notes = (
        "balls of 2.2 mm with the inertia of a ball, restitution 0.8, w = 6 mm, tip of 0.4 mm, at rest; straight "
        "flights between impacts, so that no speed matters; F's law of collision written anew, no code of the engine",
        f"{drops.balls} balls from even places and angles within {STEEPEST:g} degrees of the vertical, seed 1; errors "
        "over ten groups; the same balls with every law",
        f"single disk on shaken teeth: `run ratchet --disks 1`, {runs} seeds of 60 s after 1 s",
    )
    statements = [*_dropped(drops), *_shaken(by_friction, points[SHAKEN_FORWARD].estimate)]
    picture = _draw(drops, heights, asymmetries)
    return Product(
        "F V: a single ball", rows, picture, statements, notes, [_table(drops).markdown(), _elastic(drops).markdown()]
    )


def _dropped(drops: Drops) -> list[Statement]:
    share, forward = drops.share(SHAPE, ROTATING), drops.share(FORWARD_SHAPE, ROTATING)
    shares = listed_by_name({name: drops.share(SHAPE, law) for name, law in LAWS.items()})
    gains = [drops.gain(ROTATING, FROZEN), drops.gain(ROTATING, SMOOTH), drops.gain(ROUGH, ROUGH_FROZEN)]
    return [
        stated(
            "V",
            "on teeth of intermediate size and asymmetry a single ball from near-vertical angles bounces back to the "
            "left in most of the cases",
            f"h = 6 mm, a = 0.25: {share} of the balls leave to the left; h = 3 mm, a = 0.1, where the transport is "
            f"positive: {forward}",
            above(share, 0.5),
            "more balls decide",
        ),
        stated(
            "V",
            "this effect is enhanced by rotation, due to friction between ball and tooth",
            f"h = 6 mm, a = 0.25, shares: {shares}; more with rotation than with frozen rotation by {gains[0]}, than "
            f"without friction by {gains[1]}; at friction 0.5 more with rotation by {gains[2]}; "
            "not on every tooth (table)",
            every((above(gain, 0.0) for gain in gains), "each gain above 0 by two errors"),
            "more balls decide",
        ),
    ]


def listed_by_name(found: dict[str, Estimate]) -> str:
    """name: estimate, in a row."""
    return "; ".join(f"{name}: {e}" for name, e in found.items())


def _shaken(by_friction: dict[float, Estimate], forward: Estimate) -> list[Statement]:
    return [
        stated(
            "V",
            "so a single ball goes to the left",
            f"one disk on shaken teeth, h = 6 mm, a = 0.25, 30 Hz, velocity [cm/s] by friction: "
            f"{listed(by_friction.items())}; h = 3 mm, a = 0.1, 25 Hz, friction 0.1: {forward}",
            below(by_friction[0.1], 0.0),
            "more runs decide",
        )
    ]


def _table(drops: Drops) -> Table:
    """Shares by law, shape and range of angles."""
    shapes = (FORWARD_SHAPE, (5.0, 0.25), SHAPE, (6.0, 0.1), (9.0, 0.25), (6.0, 0.5))
    rows = [[f"h = {h:g} mm, a = {a:g}", *(str(drops.share((h, a), law)) for law in LAWS.values())] for h, a in shapes]
    rows += [
        [
            f"h = 6 mm, a = 0.25, within {angle:g} degrees",
            *(str(drops.share(SHAPE, law, angle)) for law in LAWS.values()),
        ]
        for angle in OTHER_ANGLES
    ]
    return Table("Share of dropped balls that leave to the left", ["teeth", *LAWS], rows)


def _elastic(drops: Drops) -> Table:
    """Shares by restitution, friction 0.1, for balls that come near the vertical or obliquely."""
    rows = [
        [f"{e:g}", *(str(drops.share(SHAPE, Law(restitution=e), angle)) for angle in (STEEPEST, *OTHER_ANGLES[1:]))]
        for e in RESTITUTIONS
    ]
    title = "Share of dropped balls that leave to the left, h = 6 mm, a = 0.25, by restitution and range of angles"
    header = ["restitution", *(f"within {angle:g} degrees" for angle in (STEEPEST, *OTHER_ANGLES[1:]))]
    return Table(title, header, rows)


def _draw(drops: Drops, heights: Sequence[float], asymmetries: Sequence[float]) -> Figure:
    """Share against height and against asymmetry, for each law."""
    figure = Figure(figsize=(WIDTH, 4.0), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    _panel(left, drops, heights, [(h, SHAPE[1]) for h in heights])
    _panel(right, drops, asymmetries, [(SHAPE[0], a) for a in asymmetries])
    left.set(xlabel="height h of the teeth [mm]", ylabel="share of balls that leave to the left")
    left.set_title("(a) a = 0.25")
    right.set(xlabel="asymmetry a", title="(b) h = 6 mm")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


STYLES = (
    ("o", "-", "#1f3f78"),
    ("s", "--", "#1f3f78"),
    ("^", ":", "0.35"),
    ("v", "-", "#c0272d"),
    ("D", "--", "#c0272d"),
)


def _panel(panel: Axes, drops: Drops, x: Sequence[float], shapes: Sequence[tuple[float, float]]) -> None:
    panel.axhline(0.5, color="0.6", lw=0.7, zorder=0)
    for (name, law), (marker, line, colour) in zip(LAWS.items(), STYLES, strict=True):
        shares = [drops.share(shape, law) for shape in shapes]
        filled = {"mfc": "white"} if line != "-" else {}
        draw_curve(panel, x, shares, name, marker=marker, linestyle=line, color=colour, **filled)
