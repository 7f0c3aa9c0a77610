"""F Fig. 11: the onset of transport, and what its threshold and exponent depend on."""

from collections.abc import Callable, Sequence
from functools import partial

from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.statements import Statement
from jostle_lab.verdicts import compatible, every, near, vanish
from studies.ratchet.cases import Case, Plan, Points, frequency_of
from studies.ratchet.onset import CONFIDENCE, Fitted, Onset, fit_onset, with_window
from studies.ratchet.onset_picture import draw_onset
from studies.ratchet.study import Curve, Study, Table, curves, listed, stated

GAMMAS: tuple[float, ...] = (
    0.9,
    1.0,
    1.1,
    1.15,
    1.2,
    1.25,
    1.3,
    1.35,
    1.4,
    1.45,
    1.5,
    1.55,
    1.6,
    1.7,
    1.8,
    1.9,
    2.0,
    2.2,
    2.4,
    2.6,
    2.8,
)
GAMMAS += (3.0, 3.25, 3.5, 3.75, 4.0, 4.5, 5.0, 5.5, 6.0)
RESTING = 1.2
"""Up to here the bed comes to rest on its velocity floor, where a run costs ten times as much and all agree."""
NEAR = (1.3, 1.35, 1.4, 1.45, 1.5, 1.6, 1.8)
"""Where the mean may depend on the length of the run."""
COARSE = (1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2.0, 2.4, 2.8, 3.25, 4.0)
TIPS = (1e-4, 2e-4, 6e-4)
LONG = 300.0
"""[s]."""
WINDOWS = (1.8, 2.0, 2.4, 2.8, 3.5, 4.0, 5.0, 6.0)
"""Largest Gamma of a fit."""
SHOWN = 4.0
"""The window that the statements quote; the table has the others."""
THRESHOLD, THRESHOLD_ERROR = 1.31, 0.03
EXPONENT, EXPONENT_ERROR = 0.27, 0.05
"""F's."""
LEAST_ERROR = 0.02
"""Smallest standard error that a weight takes for true [cm/s]: at rest all runs agree."""


def case(gamma: float, seconds: float = 30.0, warm_up: float = 1.0) -> Case:
    """Teeth and layer of Fig. 11."""
    return Case(3.0, 0.1, frequency_of(gamma), 20, seconds=seconds, warm_up=warm_up)


def plan(quick: bool) -> Plan:
    """The curve; longer runs near the onset; later starts; other tips."""
    if quick:
        return {case(g): 3 for g in (GAMMAS[0], *COARSE)}
    longer = {case(g, LONG): 5 for g in NEAR}
    later = {case(g, 30.0, 60.0): 6 for g in NEAR}
    tips = {case(g).with_changes(tooth__tip_radius=tip): 8 for g in COARSE for tip in TIPS}
    return {**{case(g): 5 if g <= RESTING else 30 for g in GAMMAS}, **longer, **later, **tips}


def _curve(points: Points, where: Callable[[Case], bool]) -> Curve | None:
    """Velocity against Gamma, which is shown as it was asked for."""
    found = curves(points, lambda _: 0.0, lambda c: round(c.gamma, 6), where)
    return found.get(0.0)


def main_curve(points: Points) -> Curve:
    """Runs of 30 s after 1 s, tip of 0.4 mm."""
    curve = _curve(points, lambda c: c.seconds == 30.0 and c.warm_up == 1.0 and not c.changes)
    assert curve is not None, "every plan has the main curve"
    return curve


def fit(curve: Curve, largest: float = SHOWN, weighted: bool = False) -> Onset:
    """The onset up to a Gamma."""
    part = curve.between(0.0, largest)
    weights = [1.0 / max(e.error, LEAST_ERROR) ** 2 for e in part.estimates] if weighted else None
    return fit_onset(part.x, [p.velocities for p in part.points], weights)


def draw(points: Points) -> Figure:
    """The curve with the fit and F's; beside it log-log against the distance from the threshold."""
    curve = main_curve(points)
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    runs = [p.runs for p in curve.points]
    label = f"ours, {min(runs)} to {max(runs)} runs of 30 s each" if min(runs) < max(runs) else f"ours, {runs[0]} runs"
    draw_onset(figure, curve, fit(curve), SHOWN, (THRESHOLD, EXPONENT), label)
    return figure


def statements(points: Points) -> list[Statement]:
    """F IV D on Fig. 11."""
    curve = main_curve(points)
    rest, below_threshold = curve.between(0.0, 0.999), curve.between(1.0, 1.2)
    onset = fit(curve)
    others = [fit(curve, largest) for largest in WINDOWS if largest <= max(curve.x)]
    biggest = max(e.mean for e in curve.estimates)
    found = [
        stated(
            "IV D",
            "<v_x> = 0 for Gamma < 1",
            "by Gamma [cm/s]: " + listed(zip(rest.x, rest.estimates, strict=True)),
            vanish(rest.estimates, 0.01 * biggest),
            "more runs decide",
        ),
        stated(
            "IV D",
            "may remain zero for Gamma > 1, until a critical acceleration",
            "by Gamma [cm/s]: " + listed(zip(below_threshold.x, below_threshold.estimates, strict=True)),
            every(
                (near(e, 0.0, 0.01 * biggest) for e in below_threshold.estimates),
                f"every one within {0.01 * biggest:.2g} of 0, a hundredth of the largest, with two errors",
            ),
            "more runs decide",
        ),
    ]
    for name, pick, printed, error in (
        ("Gamma_c", _threshold, THRESHOLD, THRESHOLD_ERROR),
        ("exponent", _exponent, EXPONENT, EXPONENT_ERROR),
    ):
        over = [pick(o) for o in others]
        whole = with_window(pick(onset), over)
        found.append(
            stated(
                "IV D, Fig. 11",
                f"{name} = {printed} +- {error}",
                f"{whole}; {pick(onset)} for Gamma up to {SHOWN:g} by chance alone, 68 %; "
                f"{min(f.value for f in over):.2f} to {max(f.value for f in over):.2f} over the windows of the table",
                compatible(whole, printed, error, widest=WIDEST),
                "the window of F's fit, which it does not give, is the larger part of the error",
            )
        )
    return found


WIDEST = 0.1
"""Largest error of ours with which agreement says something."""


def _threshold(onset: Onset) -> Fitted:
    return onset.threshold


def _exponent(onset: Onset) -> Fitted:
    return onset.exponent


HEADER = ("fitted", "Gamma_c", "exponent", "residual [cm/s]")


def _fit_row(name: str, onset: Onset) -> list[str]:
    return [name, str(onset.threshold), str(onset.exponent), f"{onset.residual:.2f}"]


def tables(points: Points) -> list[Table]:
    """Window, weights, tips, length and start of the runs."""
    curve = main_curve(points)
    windows = [
        _fit_row(
            f"up to {largest:g}, {'inverse square errors' if weighted else 'equal weights'}",
            fit(curve, largest, weighted),
        )
        for weighted in (False, True)
        for largest in WINDOWS
        if largest <= max(curve.x)
    ]
    interval = f"{100 * CONFIDENCE:.0f} % intervals by bootstrap over the runs"
    found = [Table(f"Onset against the window and the weights of the fit, {interval}", HEADER, windows)]
    tips = []
    for tip in TIPS:
        other = _curve(points, partial(_has_tip, tip))
        if other is not None:
            tips.append(_fit_row(f"tip radius {1e3 * tip:g} mm", fit(other)))
    if tips:
        same = Curve(*zip(*((x, p) for x, p in zip(curve.x, curve.points, strict=True) if x in COARSE), strict=True))
        tips.insert(2, _fit_row("tip radius 0.4 mm, 30 runs, the same Gamma", fit(same)))
        found.append(Table("Onset against the tip radius, eight runs, Gamma up to 4, equal weights", HEADER, tips))
    lengths = _lengths(points)
    return [*found, lengths] if lengths else found


def _has_tip(tip: float, case: Case) -> bool:
    return dict(case.changes).get("tooth.tip_radius") == tip


def _lengths(points: Points) -> Table | None:
    """Velocities near the onset by the length and the start of the runs."""
    kinds: Sequence[tuple[str, float, float]] = (
        ("1 to 31 s", 30.0, 1.0),
        ("60 to 90 s", 30.0, 60.0),
        ("1 to 301 s", LONG, 1.0),
    )
    cases = {(g, kind): case(g, seconds, start) for g in NEAR for kind, seconds, start in kinds}
    if not all(c in points for c in cases.values()):
        return None
    rows = [[f"{g:g}", *(str(points[cases[g, kind]].estimate) for kind, _, _ in kinds)] for g in NEAR]
    title = "Velocity [cm/s] near the onset by the time over which it is averaged, 30, 6 and 5 runs"
    return Table(title, ["Gamma", *(kind for kind, _, _ in kinds)], rows)


ONSET = Study(
    "F11",
    "F Fig. 11: the onset of transport",
    plan,
    draw,
    statements,
    (
        "h = 3 mm, a = 0.1, n = 0.7, A = 2 mm, ten teeth; 30 seeds of 30 s after 1 s, 5 up to Gamma = 1.2",
        "v = c ((Gamma - Gamma_c)/Gamma_c)^gamma above Gamma_c, 0 below; least squares over the means",
    ),
    tables,
)
