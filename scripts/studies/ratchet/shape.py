"""F Figs 6 and 7: transport against asymmetry and height of the teeth."""

from dataclasses import replace

from matplotlib.figure import Figure

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate, sign_changes
from jostle_lab.verdicts import Judgement, above, below, every, falls, near, rises, true, vanish
from studies.ratchet.cases import SMALLEST_DIAMETER, TOOTH_WIDTH, Case, Plan, Points
from studies.ratchet.study import Curve, Study, Table, curves, listed, panel_of_curves, signed, stated

HEIGHTS = (3.0, 5.0, 7.0, 9.0)
"""[mm]; F names 3, 5 and 9 of its four."""
ASYMMETRIES = (0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5)
TWO_ASYMMETRIES = (0.05, 0.333)
TOOTH_HEIGHTS = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0)
MAP_HEIGHTS = (2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 18.0)
MAP_ASYMMETRIES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.45)
NOTES = (
    "n = 1 (69 disks), 25 Hz, 24 teeth, 50 s after 1 s",
    "three seeds a point where F has two runs, 12 at a = 0.5 and at the highest teeth",
    "error bars: standard error over seeds",
)


def tooth(height: float, asymmetry: float) -> Case:
    """F IV A: n = 1, 25 Hz, 24 teeth, 50 s."""
    return Case(height, asymmetry, 25.0, 69, 24, 50.0)


def small(height: float, asymmetry: float) -> Case:
    """The same in a cell of ten teeth, 30 s: for the map of shapes."""
    return Case(height, asymmetry, 25.0, 29)


def asymmetry_plan(quick: bool) -> Plan:
    """F takes two runs."""
    chosen = ASYMMETRIES[::2] if quick else ASYMMETRIES
    heights = (3.0, 5.0, 9.0) if quick else HEIGHTS
    runs = {a: 2 if quick else 12 if a == 0.5 else 3 for a in chosen}
    trial = {} if quick else {_changed(a, change): 4 for a in STEEP for change in CHANGES}
    return {**trial, **{tooth(h, a): runs[a] for h in heights for a in chosen}}


def _by_height(points: Points) -> dict[float, Curve]:
    return curves(points, lambda c: c.height, lambda c: c.asymmetry, lambda c: c.teeth == 24)


def asymmetry_draw(points: Points) -> Figure:
    """One curve for each height."""
    figure = panel_of_curves(_by_height(points), lambda h: f"h = {h:g} mm", "asymmetry a")
    panel = figure.axes[0]
    panel.axvline(0.25, color="0.4", lw=0.8, ls=":", label="F: minimum of h = 5 mm", zorder=0)
    panel.legend()
    return figure


def asymmetry_statements(points: Points) -> list[Statement]:
    """F IV A on Fig. 6."""
    found = _by_height(points)
    symmetric = [(h, curve.at(0.5)) for h, curve in found.items()]
    low, middle, high = (found[h] for h in (3.0, 5.0, 9.0))
    largest = max(abs(e.mean) for curve in found.values() for e in curve.estimates)
    lowest = middle.between(0.1, 0.4).extremum()
    return [
        stated(
            "IV A, Fig. 6; V",
            "<v_x> tends to zero as a tends to 0.5; no net current for symmetric teeth",
            "a = 0.5, by h [mm]: " + listed((h, p.estimate) for h, p in symmetric),
            vanish([p.estimate for _, p in symmetric], TENTH * largest),
            "the errors are too large; ten times the runs take a minute",
        ),
        *_trend("h = 3 mm", low, 1, falls(low.estimates), "decreases"),
        stated(
            "IV A, Fig. 6",
            "h = 5 mm: negative",
            _by(middle),
            signed(middle.between(0.0, 0.45).estimates, -1),
            "the steepest teeth, a = 0 and perhaps 0.05, still carry forwards at 5 mm: at a = 0.05 the negative flow "
            "begins at 5.4 mm (Fig. 7), as F says itself of small h. Of all that the table changes only friction turns "
            "them: without it a = 0 flows backwards. F does not say where its curve begins",
        ),
        stated(
            "IV A, Fig. 6",
            "h = 5 mm: a minimum at a = 0.25 or so",
            f"minimum at a = {lowest} (parabola from 0.1 to 0.4)",
            near(lowest, 0.25, STEP),
            "more runs decide: an error of half a step of a",
        ),
        *_trend("h = 9 mm", high, -1, rises(high.estimates), "increases"),
        *_by_friction(points),
        layer_of_the_cell(),
    ]


def layer_of_the_cell() -> Statement:
    """F IV A on its cell, which follows from F's radii."""
    disks = 24 * TOOTH_WIDTH / SMALLEST_DIAMETER
    return stated(
        "IV A",
        "a cell of 24 w = 144 mm, one layer of about 70 particles",
        f"{24e3 * TOOTH_WIDTH:g} mm; {disks:.1f} disks of 2.1 mm side by side",
        near(Estimate(disks, 0.0), 70.0, 5.0),
    )


def _by_friction(points: Points) -> list[Statement]:
    """F IV on friction, where the sign is about to turn."""
    frictions: tuple[tuple[str, float], ...] = (("collision.friction", 0.0), ("", 0.1), ("collision.friction", 0.3))
    cases = {a: [_changed(a, change) for change in frictions] for a in STEEP}
    if not all(case in points for found in cases.values() for case in found):
        return []
    velocities = {a: [points[case].estimate for case in found] for a, found in cases.items()}
    text = "; ".join(
        f"a = {a:g}: {listed(zip((v for _, v in frictions), found, strict=True))}" for a, found in velocities.items()
    )
    first = {a: -1 if found[0].mean < 0.0 else 1 for a, found in velocities.items()}
    return [
        stated(
            "IV, at Fig. 6",
            "the direction hardly depends on friction (h = 5 mm)",
            f"by friction: {text}",
            every(
                (signed(found, first[a]) for a, found in velocities.items()),
                "at each a the same sign at every friction, by two errors",
            ),
            "near the border between both directions, as on the steepest teeth of 5 mm, friction decides; away from "
            "it (a = 0.25, and Figs 13 and 14) it does not",
        )
    ]


def _by(curve: Curve) -> str:
    return "by a: " + listed(zip(curve.x, curve.estimates, strict=True))


def _trend(name: str, curve: Curve, sign: int, monotone: Judgement, how: str) -> list[Statement]:
    """Sign and trend of a curve of Fig. 6; at a = 0.45 and 0.5 it is at zero, or nearly."""
    word = "positive" if sign > 0 else "negative"
    more = "more runs decide: the errors are those of three runs"
    return [
        stated(
            "IV A, Fig. 6",
            f"{name}: {word}",
            f"{_by(curve)}; judged up to a = 0.4",
            signed(curve.between(0.0, 0.4).estimates, sign),
            more,
        ),
        stated("IV A, Fig. 6", f"{name}: {how} monotonically with a", "as above", monotone, more),
    ]


TENTH = 0.1
"""A velocity below this share of the largest of a figure is no flow on its scale."""
STEP = 0.05
"""Of a in Fig. 6: to this we take `or so`."""
STEEP = (0.0, 0.05, 0.25)
"""Asymmetries at which the table changes other things, h = 5 mm."""
CHANGES: tuple[tuple[str, float], ...] = (
    ("", 0.0),
    ("tooth.tip_radius", 1e-4),
    ("tooth.tip_radius", 2e-4),
    ("tooth.tip_radius", 6e-4),
    ("collision.restitution", 0.7),
    ("collision.restitution", 0.9),
    ("collision.friction", 0.0),
    ("collision.friction", 0.3),
    ("disks", 20),
    ("disks", 40),
)
"""Parameter and its value; empty: nothing changed."""


def _changed(asymmetry: float, change: tuple[str, float]) -> Case:
    case, (name, value) = small(5.0, asymmetry), change
    if name == "disks":
        return replace(case, disks=int(value))
    return case.with_changes(**{name: value}) if name else case


def asymmetry_tables(points: Points) -> list[Table]:
    """What could turn the sign where it is not F's."""
    if not all(_changed(a, change) in points for a in STEEP for change in CHANGES):
        return []
    rows = [
        [
            f"{name} = {value:g}" if name else "nothing",
            *(str(points[_changed(a, (name, value))].estimate) for a in STEEP),
        ]
        for name, value in CHANGES
    ]
    title = "Velocity [cm/s] at h = 5 mm with one thing changed (29 disks, ten teeth, 30 s, four seeds)"
    return [Table(title, ["changed", *(f"a = {a:g}" for a in STEEP)], rows)]


def height_plan(quick: bool) -> Plan:
    """The two curves, and a coarser map of both parameters."""
    heights = TOOTH_HEIGHTS[:: 2 if quick else 1]
    two = {tooth(h, a): 2 if quick else 12 if h >= 18.0 else 3 for a in TWO_ASYMMETRIES for h in heights}
    coarse = {} if quick else {small(h, a): 4 for h in MAP_HEIGHTS for a in MAP_ASYMMETRIES}
    return {**coarse, **two}


def _two(points: Points) -> dict[float, Curve]:
    return curves(
        points, lambda c: c.asymmetry, lambda c: c.height, lambda c: c.asymmetry in TWO_ASYMMETRIES and c.teeth == 24
    )


def height_draw(points: Points) -> Figure:
    """The two curves of F."""
    return panel_of_curves(_two(points), lambda a: f"a = {a:g}", "height h of the teeth [mm]")


def height_statements(points: Points) -> list[Statement]:
    """F IV A on Fig. 7, and its conclusion for all shapes."""
    return [*(s for a, curve in _two(points).items() for s in _along_height(a, curve)), *_everywhere(points)]


def _along_height(asymmetry: float, curve: Curve) -> list[Statement]:
    crossings = curve.crossings()
    deepest = min(curve.estimates, key=lambda e: e.mean)
    last = curve.estimates[-1]
    by = "by h [mm]: " + listed(zip(curve.x, curve.estimates, strict=True))
    return [
        stated(
            "IV A, Fig. 7",
            f"a = {asymmetry:g}: positive for small h, turns negative as h grows",
            f"{sign_changes(crossings, 'mm', 'h')}; {by}",
            every(
                [above(curve.estimates[0], 0.0), below(deepest, 0.0), true(len(crossings) == 1, "")],
                "the lowest teeth above 0, the most negative below 0 by two errors, one sign change in between",
            ),
        ),
        stated(
            "IV A, Fig. 7",
            f"a = {asymmetry:g}: zero in the end for high h",
            f"h = {curve.x[-1]:g} mm: {last}; most negative {deepest}",
            vanish([last], TENTH * abs(deepest.mean)),
            "the flow fades gradually; F does not say at which height it calls it zero",
        ),
    ]


def _everywhere(points: Points) -> list[Statement]:
    """The rule for all shapes; symmetric teeth are left out."""
    inside = {c: p for c, p in points.items() if 4.0 <= c.height <= 16.0 and c.asymmetry < 0.4}
    outside = {c: p for c, p in points.items() if c not in inside}
    against = [c for c, p in inside.items() if p.sign() == 1], [c for c, p in outside.items() if p.sign() == -1]

    def names(cases: list[Case]) -> str:
        return ", ".join(f"({c.height:g}, {c.asymmetry:g}): {points[c].estimate}" for c in cases) or "none"

    negative = sum(p.sign() == -1 for p in inside.values())
    return [
        stated(
            "IV A",
            "transport can be negative if h is between 4 and 16 mm and a below about 0.4",
            f"{negative} of {len(inside)} shapes there negative, {len(against[0])} positive, beyond three errors; "
            f"positive ones (h [mm], a): {names(against[0])}",
            every(
                [true(negative > 0, ""), true(not against[0], "")],
                "some shapes there negative, none positive, by three errors",
            ),
            "the lower bound depends on a: 4.3 mm at a = 0.333, 5.4 mm at a = 0.05 (row of Fig. 7), so that the "
            "steepest teeth of 4 and 5 mm still carry forwards; 4 mm is the bound of the flattest. Within one step of "
            "the map the rule holds",
        ),
        stated(
            "IV A",
            "in other cases it is positive, or zero",
            f"of {len(outside)} other shapes {len(against[1])} negative beyond three errors (h [mm], a): "
            f"{names(against[1])}",
            every(
                [true(any(p.sign() == 1 for p in outside.values()), ""), true(not against[1], "")],
                "some of the others positive, none negative, by three errors",
            ),
            "the upper bounds are soft: towards a = 0.5 and towards high teeth the negative flow fades and does not "
            "end; F's `about 0.4` and 16 mm are where it is lost in the scatter of two runs",
        ),
    ]


def height_tables(points: Points) -> list[Table]:
    """The map of shapes."""
    shapes = {(c.height, c.asymmetry): p for c, p in points.items() if c.teeth == 10}
    rows = [
        [f"{h:g}", *(str(shapes[h, a].estimate) if (h, a) in shapes else "" for a in MAP_ASYMMETRIES)]
        for h in MAP_HEIGHTS
        if any((h, a) in shapes for a in MAP_ASYMMETRIES)
    ]
    title = "Velocity [cm/s] by height and asymmetry, n = 1, 25 Hz"
    return [Table(title, ["h [mm]", *(f"a = {a:g}" for a in MAP_ASYMMETRIES)], rows)] if rows else []


ASYMMETRY = Study(
    "F6",
    "F Fig. 6: transport against asymmetry",
    asymmetry_plan,
    asymmetry_draw,
    asymmetry_statements,
    NOTES,
    asymmetry_tables,
)
HEIGHT = Study(
    "F7",
    "F Fig. 7: transport against the height of the teeth",
    height_plan,
    height_draw,
    height_statements,
    (*NOTES, "map of shapes: ten teeth (29 disks), 30 s, four seeds"),
    height_tables,
)
