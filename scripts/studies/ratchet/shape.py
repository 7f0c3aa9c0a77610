"""F Figs 6 and 7: transport against asymmetry and height of the teeth."""

from matplotlib.figure import Figure

from jostle_lab.statements import Statement, verdict
from jostle_lab.statistics.estimates import sign_changes
from studies.ratchet.cases import Case, Plan, Points
from studies.ratchet.study import Curve, Study, Table, curves, listed, panel_of_curves, share

HEIGHTS = (3.0, 5.0, 7.0, 9.0)
"""[mm]; F names 3, 5 and 9 of its four."""
ASYMMETRIES = (0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5)
TWO_ASYMMETRIES = (0.05, 0.333)
TOOTH_HEIGHTS = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0)
MAP_HEIGHTS = (2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 18.0)
MAP_ASYMMETRIES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.45)
MONOTONE = 0.01
"""p-value from which on a curve counts as monotone."""
NOTES = (
    "n = 1 (69 disks), 25 Hz, 24 teeth, 50 s after 1 s; three seeds a point where F has two runs, 12 at a = 0.5",
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
    tips = {} if quick else {_with_tip(a, tip): 4 for a in STEEP for tip in (*TIPS, None)}
    runs = {a: 2 if quick else 12 if a == 0.5 else 3 for a in chosen}
    return {**tips, **{tooth(h, a): runs[a] for h in heights for a in chosen}}


def _by_height(points: Points) -> dict[float, Curve]:
    return curves(points, lambda c: c.height, lambda c: c.asymmetry, lambda c: c.teeth == 24)


def asymmetry_draw(points: Points) -> Figure:
    """One curve for each height."""
    found = _by_height(points)
    return panel_of_curves(found, lambda h: f"h = {h:g} mm", "asymmetry a")


def asymmetry_statements(points: Points) -> list[Statement]:
    """F IV A on Fig. 6."""
    found = _by_height(points)
    symmetric = [(h, curve.at(0.5)) for h, curve in found.items()]
    low, middle, high = (found[h] for h in (3.0, 5.0, 9.0))
    lowest = middle.between(0.1, 0.4).extremum()
    return [
        Statement(
            "IV A, Fig. 6",
            "<v_x> tends to zero as a tends to 0.5",
            "a = 0.5, by h [mm]: " + listed((h, p.estimate) for h, p in symmetric),
            verdict(all(p.sign() == 0 for _, p in symmetric)),
        ),
        _trend("IV A, Fig. 6", "h = 3 mm: positive, decreases monotonically with a", low, 1, rising=False),
        Statement(
            "IV A, Fig. 6",
            "h = 5 mm: negative, with a minimum at a = 0.25 or so",
            f"minimum at a = {lowest} (parabola from 0.1 to 0.4); {_by(middle)}",
            share([_one_sign(middle, -1), abs(lowest.mean - 0.25) < 0.05 + 2.0 * lowest.error]),
        ),
        _trend("IV A, Fig. 6", "h = 9 mm: negative, increases monotonically with a", high, -1, rising=True),
    ]


def _by(curve: Curve) -> str:
    return "by a: " + listed(zip(curve.x, curve.estimates, strict=True))


def _one_sign(curve: Curve, sign: int) -> bool:
    """No point has the other sign for certain, and some have this one."""
    signs = [point.sign() for point in curve.points]
    return -sign not in signs and sign in signs


def _trend(place: str, printed: str, curve: Curve, sign: int, rising: bool) -> Statement:
    p_value = curve.monotone(rising)
    found = f"{_by(curve)}; monotone with p = {p_value:.2g}"
    return Statement(place, printed, found, share([_one_sign(curve, sign), p_value > MONOTONE]))


TIPS = (1e-4, 2e-4, 6e-4)
"""[m]."""
STEEP = (0.0, 0.05, 0.25)
"""Asymmetries at which the table has other tips, h = 5 mm."""


def _with_tip(asymmetry: float, tip: float | None) -> Case:
    case = small(5.0, asymmetry)
    return case if tip is None else case.with_changes(tooth__tip_radius=tip)


def asymmetry_tables(points: Points) -> list[Table]:
    """Tips, where the sign is not F's."""
    tips = (*TIPS[:2], None, *TIPS[2:])
    if not all(_with_tip(a, tip) in points for a in STEEP for tip in tips):
        return []
    rows = [[f"{1e3 * (tip or 4e-4):g} mm", *(str(points[_with_tip(a, tip)].estimate) for a in STEEP)] for tip in tips]
    title = "Velocity [cm/s] at h = 5 mm by the radius of the tip, ten teeth, 30 s, four seeds"
    return [Table(title, ["tip radius", *(f"a = {a:g}" for a in STEEP)], rows)]


def height_plan(quick: bool) -> Plan:
    """The two curves, and a coarser map of both parameters."""
    two = {tooth(h, a): 2 if quick else 3 for a in TWO_ASYMMETRIES for h in TOOTH_HEIGHTS[:: 2 if quick else 1]}
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
    last = curve.estimates[-2:]
    by = "by h [mm]: " + listed(zip(curve.x, curve.estimates, strict=True))
    return [
        Statement(
            "IV A, Fig. 7",
            f"a = {asymmetry:g}: positive for small h, turns negative as h grows",
            f"{sign_changes(crossings, 'mm', 'h')}; {by}",
            verdict(len(crossings) >= 1 and curve.points[1].sign() == 1 and deepest.mean < -3.0 * deepest.error),
        ),
        Statement(
            "IV A, Fig. 7",
            f"a = {asymmetry:g}: zero in the end for high h",
            f"h = {curve.x[-2]:g} and {curve.x[-1]:g} mm: {last[0]}, {last[1]}; most negative {deepest}",
            share([abs(e.mean) < max(3.0 * e.error, 0.1 * abs(deepest.mean)) for e in last]),
        ),
    ]


def _everywhere(points: Points) -> list[Statement]:
    """The rule for all shapes, where the sign is beyond the errors."""
    inside = {c: p.sign() for c, p in points.items() if 4.0 <= c.height <= 16.0 and c.asymmetry < 0.4}
    outside = {c: p.sign() for c, p in points.items() if c not in inside}
    against = [c for c, sign in inside.items() if sign == 1], [c for c, sign in outside.items() if sign == -1]

    def names(cases: list[Case]) -> str:
        return ", ".join(f"({c.height:g}, {c.asymmetry:g}): {points[c].estimate}" for c in cases) or "none"

    return [
        Statement(
            "IV A",
            "transport can be negative if h is between 4 and 16 mm and a below about 0.4",
            f"{sum(s == -1 for s in inside.values())} of {len(inside)} shapes there negative, "
            f"{len(against[0])} positive, beyond three errors; positive ones (h [mm], a): {names(against[0])}",
            share([any(s == -1 for s in inside.values()), not against[0]]),
        ),
        Statement(
            "IV A",
            "in other cases it is positive, or zero",
            f"of {len(outside)} other shapes {len(against[1])} negative beyond three errors (h [mm], a): "
            f"{names(against[1])}",
            share([any(s >= 0 for s in outside.values()), not against[1]]),
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
