"""F Figs 8 and 9: transport against the depth of the layer."""

from collections.abc import Callable
from functools import partial

from matplotlib.figure import Figure

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import sign_changes
from jostle_lab.verdicts import above, below, every, falls, true
from studies.ratchet.cases import Case, Plan, Points
from studies.ratchet.study import Curve, Study, Table, curves, listed, panel_of_curves, reverses, signed, stated

FREQUENCIES = (20.0, 25.0, 30.0)
"""[Hz]; F does not name its three."""
DISKS = (10, 20, 30, 40, 50, 60, 80, 100, 120, 140)
DEEPEST = 170
"""At the highest frequency only."""
THICK = 140
"""n = 4.9, about the most that F could run."""
SHAPES = ((5.0, 0.05), (5.0, 0.25), (6.0, 0.1), (9.0, 0.1), (9.0, 0.3), (12.0, 0.2), (16.0, 0.1))
"""Height [mm] and asymmetry of teeth whose transport is negative at n = 1, Figs 6 and 7."""
NOTES = (
    "60 mm wide (ten teeth), seven seeds (three beyond n = 3) of 30 s after 1 s",
    "20, 25 and 30 Hz: F does not name its three",
    "n = N / k, k = 60 mm / 2.1 mm",
)


def plan_of(height: float, asymmetry: float, quick: bool) -> Plan:
    """F takes seven runs of 30 s."""
    disks = (10, 40, 80, 120) if quick else DISKS
    runs = {n: 2 if quick else 7 if n <= 80 else 3 for n in disks}
    deepest = {} if quick else {Case(height, asymmetry, FREQUENCIES[-1], DEEPEST): 3}
    return {**{Case(height, asymmetry, f, n): runs[n] for f in FREQUENCIES for n in disks}, **deepest}


def negative_plan(quick: bool) -> Plan:
    """Fig. 8, and thin and thick layers on other teeth."""
    if quick:
        return plan_of(6.0, 0.25, quick)
    others = {Case(h, a, 25.0, n): 3 for h, a in SHAPES for n in (29, THICK)}
    return {**others, **plan_of(6.0, 0.25, quick)}


def positive_plan(quick: bool) -> Plan:
    """Fig. 9."""
    return plan_of(3.0, 0.1, quick)


def _curves(points: Points, height: float, asymmetry: float) -> dict[float, Curve]:
    def ours(case: Case) -> bool:
        return (case.height, case.asymmetry) == (height, asymmetry) and case.disks in (*DISKS, DEEPEST)

    return curves(points, lambda c: c.frequency, lambda c: c.layers, ours)


def draw(points: Points, height: float, asymmetry: float) -> Figure:
    """One curve for each frequency."""
    found = _curves(points, height, asymmetry)
    return panel_of_curves(found, lambda f: f"f = {f:g} Hz", "layer depth n")


def negative_statements(points: Points) -> list[Statement]:
    """F IV B on Fig. 8, and the claim of IV A for all shapes."""
    found = [_turns_positive(f, curve) for f, curve in _curves(points, 6.0, 0.25).items()]
    found += _depths(_curves(points, 6.0, 0.25))
    shapes = {(h, a): points[Case(h, a, 25.0, THICK)] for h, a in SHAPES if Case(h, a, 25.0, THICK) in points}
    if shapes:
        thin = [points[Case(h, a, 25.0, 29)].estimate for h, a in shapes]
        text = ", ".join(f"({h:g}, {a:g}): {p.estimate}" for (h, a), p in shapes.items())
        found.append(
            stated(
                "IV A",
                "with more particles negative transport turns positive in all cases",
                f"teeth with negative transport at n = 1, here at n = 4.9, 25 Hz, by (h [mm], a): {text}",
                signed([p.estimate for p, t in zip(shapes.values(), thin, strict=True) if t.mean < 0.0], 1),
                "more runs decide",
            )
        )
    return found


def _depths(found: dict[float, Curve]) -> list[Statement]:
    """How deep a layer may be that flows backwards, and how deep one can be simulated."""
    places = {f: curve.crossings() for f, curve in found.items()}
    known = {f: crossings[0] for f, crossings in places.items() if crossings}
    deepest = max(curve.x[-1] for curve in found.values())
    return [
        stated(
            "IV A",
            "negative transport occurs only for a few layers, n = 0 to 3 (by F's experiments)",
            f"positive beyond n, by f [Hz]: {listed(known.items())}",
            every((below(e, SHALLOW) for e in known.values()), f"every one below {SHALLOW:g} by two errors"),
            "where it turns depends on the frequency, by two layers from 20 to 30 Hz, and on the teeth; F's 3 is that "
            "of its experiment, at 25 Hz with other teeth and balls",
        ),
        stated(
            "IV B",
            "event-driven simulation is feasible up to n = 5 or so",
            f"n = {deepest:.3g} ran, over the whole time",
            true(deepest < DEEP, f"no deeper layer than n = {DEEP:g} was run; no chance"),
            "a limit of the computer, not of the physics: a deep bed costs more impacts, of which a processor now does "
            "about a million a second",
        ),
    ]


SHALLOW = 3.0
DEEP = 5.5
"""`n = 5 or so` ends here."""


def _turns_positive(frequency: float, curve: Curve) -> Statement:
    crossings = curve.crossings()
    return stated(
        "IV B, Fig. 8; abstract",
        f"{frequency:g} Hz: negative transport becomes zero and turns positive as the layer gets deeper",
        f"{sign_changes(crossings, '', 'n')}; {_by(curve)}",
        every([below(curve.estimates[0], 0.0), reverses(curve), above(curve.estimates[-1], 0.0)], TURNS),
        "deeper layers decide",
    )


TURNS = "the thinnest layer below 0, the deepest above 0 by two errors, one sign change between points beyond three"


def _by(curve: Curve) -> str:
    pairs = zip((round(x, 2) for x in curve.x), curve.estimates, strict=True)
    return "by n: " + listed(pairs)


def positive_statements(points: Points) -> list[Statement]:
    """F IV B on Fig. 9."""
    return [
        stated(
            "IV B, Fig. 9",
            f"{frequency:g} Hz: where few particles flow forwards, the transport decreases with their number",
            _by(curve),
            every(
                [above(curve.estimates[0], 0.0), falls(curve.estimates)],
                "the thinnest layer above 0 by two errors; " + falls(curve.estimates).rule,
            ),
            "the curve is not monotone within the errors; more runs decide",
        )
        for frequency, curve in _curves(points, 3.0, 0.1).items()
    ]


def tables(points: Points) -> list[Table]:
    """Thin against thick layers on other teeth."""
    rows = [
        [f"{h:g}", f"{a:g}", str(points[thin].estimate), str(points[thick].estimate)]
        for h, a in SHAPES
        if (thin := Case(h, a, 25.0, 29)) in points and (thick := Case(h, a, 25.0, THICK)) in points
    ]
    title = "Velocity [cm/s] of a thin and of a thick layer on other teeth, 25 Hz, three or four seeds"
    return [Table(title, ["h [mm]", "a", "n = 1.02", "n = 4.9"], rows)] if rows else []


def _draw(height: float, asymmetry: float) -> Callable[[Points], Figure]:
    return partial(draw, height=height, asymmetry=asymmetry)


NEGATIVE = Study(
    "F8",
    "F Fig. 8: transport against layer depth, h = 6 mm, a = 0.25",
    negative_plan,
    _draw(6.0, 0.25),
    negative_statements,
    NOTES,
    tables,
)
POSITIVE = Study(
    "F9",
    "F Fig. 9: transport against layer depth, h = 3 mm, a = 0.1",
    positive_plan,
    _draw(3.0, 0.1),
    positive_statements,
    NOTES,
)
