"""F Figs 10 and 12: transport against the driving frequency."""

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate, chi_square, sign_changes
from jostle_lab.verdicts import LEAST_PROBABILITY, Judgement, Verdict, above, below, every, falls, rises, true
from studies.ratchet.cases import GRAVITY, Case, Plan, Point, Points
from studies.ratchet.observe import Observed
from studies.ratchet.study import Curve, Study, curves, listed, panel_of_curves, reverses, stated

RUNS = {10: 30, 20: 18, 30: 12, 50: 7, 80: 7, 120: 5}
"""Disks (n = 0.35, 0.7, 1.05, 1.75, 2.8, 4.2) and the runs; F takes 7 of the last."""
RESTING = {10: 0.0, 20: 0.0, 30: 0.0, 50: 14.5, 80: 15.5, 120: 16.5}
"""Below this frequency [Hz] a deep bed is at rest, on its velocity floor: a run costs ten times as much."""
REVERSING = (1.05, 1.75, 2.8)
"""The layer depths that F says reverse."""
FREQUENCIES = (13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 20.0, 22.0, 25.0, 28.0, 30.0, 32.5, 35.0, 40.0)
"""[Hz]; the range of F's figure is not given."""
ONSET: tuple[float, ...] = (
    13.0,
    13.5,
    13.75,
    14.0,
    14.25,
    14.5,
    14.75,
    15.0,
    15.5,
    16.0,
    16.5,
    17.0,
    17.5,
    18.0,
    19.0,
    20.0,
    21.0,
    22.0,
)
ONSET += (24.0, 26.0, 28.0, 30.0)
"""[Hz] of Fig. 12."""


def case(frequency: float, disks: int) -> Case:
    """The teeth of F IV C."""
    return Case(6.0, 0.25, frequency, disks)


def layers_plan(quick: bool) -> Plan:
    """Fig. 10, with F's numbers of runs."""
    if quick:
        return {case(f, n): 2 for n in list(RUNS)[:5] for f in FREQUENCIES[::3]}
    return {case(f, n): runs for n, runs in RUNS.items() for f in FREQUENCIES if f >= RESTING[n]}


def layers_draw(points: Points) -> Figure:
    """One curve for each depth."""
    found = curves(points, lambda c: c.layers, lambda c: c.frequency)
    return panel_of_curves(found, lambda n: f"n = {n:.3g}", "driving frequency f [Hz]")


def layers_statements(points: Points) -> list[Statement]:
    """F IV C."""
    found = {round(n, 2): c for n, c in curves(points, lambda c: c.layers, lambda c: c.frequency).items()}
    falling = {n: falls(_from_the_top(curve).estimates) for n, curve in found.items()}
    rule = next(iter(falling.values())).rule
    return [
        stated(
            "IV C, Fig. 10",
            "negative transport becomes stronger with frequency",
            "velocities of the rows below, from the largest on",
            every(falling.values(), f"at each of six depths: {rule}"),
            "more runs decide",
        ),
        *(_reversal(n, curve) for n, curve in found.items()),
    ]


def _from_the_top(curve: Curve) -> Curve:
    """The part from the largest velocity on."""
    top = int(np.argmax([e.mean for e in curve.estimates][:-2]))
    return Curve(curve.x[top:], curve.points[top:])


def _reversal(n: float, curve: Curve) -> Statement:
    """Whether one depth reverses."""
    crossings, first = curve.crossings(), next((f for f, p in _pairs(curve) if p.sign() == 1), None)
    positive = f", positive from {first:g} Hz" if first else ""
    found = (
        f"{sign_changes(crossings, 'Hz')}{positive}; by f [Hz]: {listed(zip(curve.x, curve.estimates, strict=True))}"
    )
    if n in REVERSING:
        judgement = every([reverses(curve), below(curve.estimates[-1], 0.0)], f"{reverses(curve).rule}, below 0")
        return stated("IV C, Fig. 10", f"n = {n:g}: reverses, from positive to negative", found, judgement, MORE)
    judgement = true(not crossings, "no sign change between points that are three errors from 0")
    if crossings and crossings[0].mean > KNOWN:
        judgement = Judgement(Verdict.OPEN, f"{judgement.rule}, below {KNOWN:g} Hz, where all of F's named figures lie")
    cause = (
        f"reverses here at {crossings[0]} Hz; whether that is inside of F's figure, whose frequencies are not in its "
        "text, only its axis can tell; no run decides"
        if crossings
        else ""
    )
    return stated("IV C, Fig. 10", f"n = {n:g}: not among the three that reverse", found, judgement, cause)


MORE = "more runs decide"
KNOWN = 28.0
"""[Hz]; a reversal at 30 Hz, the highest frequency that F names, would not be seen in its figure."""


def _pairs(curve: Curve) -> list[tuple[float, Point]]:
    return list(zip(curve.x, curve.points, strict=True))


def onset_plan(quick: bool) -> Plan:
    """Fig. 12."""
    if quick:
        return {case(f, 50): 2 for f in ONSET[3::3]}
    return {case(f, 50): 12 if f >= 14.5 else 8 for f in ONSET}


def onset_draw(points: Points) -> Figure:
    """The one curve."""
    found = curves(points, lambda c: c.layers, lambda c: c.frequency)
    return panel_of_curves(found, lambda n: f"h = 6 mm, a = 0.25, n = {n:.3g}", "driving frequency f [Hz]")


def onset_statements(points: Points) -> list[Statement]:
    """F IV D on Fig. 12."""
    (curve,) = curves(points, lambda c: c.layers, lambda c: c.frequency).values()
    means = [e.mean for e in curve.estimates]
    top = int(np.argmax(means))
    resting = [i for i, p in enumerate(curve.points[:top]) if p.sign() != 1 or p.estimate.mean < AT_REST]
    start = resting[-1] if resting else 0
    rise = Curve(curve.x[start : top + 1], curve.points[start : top + 1])
    by = listed(zip(curve.x, curve.estimates, strict=True))
    return [
        *_linear(rise),
        stated(
            "IV D, Fig. 12",
            "with rising frequency it turns back, and the transport reverses",
            f"largest {curve.estimates[top]} cm/s at {curve.x[top]:g} Hz; "
            f"{sign_changes(curve.crossings(), 'Hz')}; by f [Hz]: {by}",
            every([reverses(curve), below(curve.estimates[-1], 0.0)], f"{reverses(curve).rule}, below 0"),
            MORE,
        ),
    ]


def _linear(rise: Curve) -> list[Statement]:
    """A straight line through the points from the last at rest to the largest."""
    place, printed = "IV D, Fig. 12", "above the critical frequency the velocity becomes positive"
    x, y = np.array(rise.x), np.array([e.mean for e in rise.estimates])
    errors = np.array([max(e.error, LEAST_ERROR) for e in rise.estimates])
    (slope, offset), covariance = np.polyfit(x, y, 1, w=1.0 / errors, cov="unscaled")
    critical = -offset / slope
    gradient = np.array([offset / slope**2, -1.0 / slope])
    error = float(np.sqrt(gradient @ covariance @ gradient))
    ratio, p_value = chi_square((y - slope * x - offset).tolist(), errors.tolist(), lost=2)
    line = f"line from {x[0]:g} to {x[-1]:g} Hz: critical frequency {Estimate(float(critical), error)} Hz, slope "
    line += f"{Estimate(float(slope), float(np.sqrt(covariance[0, 0])))} cm/s per Hz"
    return [
        stated(place, printed, line, above(rise.estimates[-1], 0.0), MORE),
        stated(
            place,
            "it does so linearly",
            f"chi^2 of the line per degree of freedom {ratio:.2g}, p = {p_value:.2g}; by f [Hz]: "
            + listed(zip(rise.x, rise.estimates, strict=True)),
            true(p_value > LEAST_PROBABILITY, f"chi^2 from the straight line has p > {LEAST_PROBABILITY:g}"),
            "the rise is S-shaped within 1 Hz: near its foot beds freeze for a part of the 30 s, so that the mean over "
            "the run bends; a line through points as far apart as F's, with an error of 0.1 cm/s, could not be "
            "refuted",
        ),
    ]


AT_REST = 0.02
"""[cm/s]: a bed that creeps more slowly is at rest."""
LEAST_ERROR = 0.005
"""Smallest error that a weight takes for true [cm/s]: at rest all runs agree."""


def onset_others(observed: Observed) -> list[Statement]:
    """F V on the reversal: the granular state at the frequencies of either sign."""
    heights = {f: observed.mean(case(f, 50), "energy.potential", 1e3 / WEIGHT) for f in STATES}
    return [
        stated(
            "V",
            "at smaller frequencies many particles are close to the base; at larger ones the density decays, and the "
            "current reverses",
            f"mean height of the centres above the valleys at rest, by f [Hz]: {listed(heights.items())} mm; positive "
            "and negative flow in the row above",
            rises(list(heights.values())),
            MORE,
        )
    ]


STATES = (14.5, 16.0, 18.0, 21.0, 24.0, 28.0, 30.0)
"""Frequencies [Hz] of Fig. 12, from positive to negative flow."""
WEIGHT = 50 * 1e-5 * GRAVITY
"""Of the 50 disks of Fig. 12 [N]."""


LAYERS = Study(
    "F10",
    "F Fig. 10: transport against frequency, six layer depths",
    layers_plan,
    layers_draw,
    layers_statements,
    ("h = 6 mm, a = 0.25, A = 2 mm, ten teeth, 30 s after 1 s; 30, 18, 12, 7, 7 and 5 runs",),
)
TRANSITION = Study(
    "F12",
    "F Fig. 12: transport against frequency near the onset, n = 1.75",
    onset_plan,
    onset_draw,
    onset_statements,
    ("h = 6 mm, a = 0.25, A = 2 mm, ten teeth, 12 seeds of 30 s after 1 s, 8 below 14.5 Hz",),
    others=onset_others,
)
