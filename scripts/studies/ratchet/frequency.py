"""F Figs 10 and 12: transport against the driving frequency."""

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.statements import Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Estimate, chi_square, sign_changes
from studies.ratchet.cases import Case, Plan, Points
from studies.ratchet.study import Curve, Study, curves, listed, panel_of_curves, share

RUNS = {10: 30, 20: 18, 30: 12, 50: 7, 80: 7, 120: 5}
"""Disks (n = 0.35, 0.7, 1.05, 1.75, 2.8, 4.2) and the runs; F takes 7 of the last."""
RESTING = {10: 0.0, 20: 0.0, 30: 0.0, 50: 14.5, 80: 15.5, 120: 16.5}
"""Below this frequency [Hz] a deep bed is at rest, on its velocity floor: a run costs ten times as much."""
REVERSING = (1.05, 1.75, 2.8)
"""The layer depths that F says reverse."""
FREQUENCIES = (13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 20.0, 22.0, 25.0, 28.0, 30.0, 32.5, 35.0, 40.0)
"""[Hz]; the range of F's figure is not given."""
ONSET: tuple[float, ...] = (13.0, 13.5, 14.0, 14.5, 15.0, 15.5, 16.0, 16.5, 17.0, 17.5, 18.0, 19.0, 20.0, 21.0, 22.0)
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
    strengths = {n: _strengthens(curve) for n, curve in found.items()}
    crossings = {n: curve.crossings() for n, curve in found.items()}
    return [
        Statement(
            "IV C, Fig. 10",
            "negative transport becomes stronger with frequency",
            "correlation of velocity and frequency from the largest velocity on, by n: "
            + ", ".join(f"{n:g}: {r:.2f}" for n, r in strengths.items()),
            share([r < -0.8 for r in strengths.values()]),
        ),
        *(_reversal(n, found[n], crossings[n]) for n in found),
    ]


def _strengthens(curve: Curve) -> float:
    means = np.array([e.mean for e in curve.estimates])
    top = int(np.argmax(means[:-2]))
    return float(np.corrcoef(curve.x[top:], means[top:])[0, 1])


def _reversal(n: float, curve: Curve, crossings: list[Estimate]) -> Statement:
    reverses = n in REVERSING
    printed = "reverses, from positive to negative" if reverses else "not among the three that reverse"
    signs = [point.sign() for point in curve.points]
    turned = len(crossings) == 1 and signs[-1] == -1
    first = next((f for f, s in zip(curve.x, signs, strict=True) if s == 1), None)
    positive = f", positive from {first:g} Hz" if first else ""
    by = listed(zip(curve.x, curve.estimates, strict=True))
    # F does not say where its frequencies end: a reversal beyond those of its other figures may lie outside.
    late = "; F does not say where its frequencies end" if crossings and crossings[0].mean > 28.0 else ""
    return Statement(
        "IV C, Fig. 10",
        f"n = {n:g}: {printed}",
        f"{sign_changes(crossings, 'Hz')}{positive}; by f [Hz]: {by}{late}",
        verdict(turned) if reverses else Verdict.OPEN if late else verdict(not crossings),
    )


def onset_plan(quick: bool) -> Plan:
    """Fig. 12."""
    if quick:
        return {case(f, 50): 2 for f in ONSET[3::3]}
    return {case(f, 50): 3 if f < 14.5 else 12 for f in ONSET}


def onset_draw(points: Points) -> Figure:
    """The one curve."""
    found = curves(points, lambda c: c.layers, lambda c: c.frequency)
    return panel_of_curves(found, lambda n: f"h = 6 mm, a = 0.25, n = {n:.3g}", "driving frequency f [Hz]")


def onset_statements(points: Points) -> list[Statement]:
    """F IV D on Fig. 12."""
    (curve,) = curves(points, lambda c: c.layers, lambda c: c.frequency).values()
    means = [e.mean for e in curve.estimates]
    top = int(np.argmax(means))
    resting = [i for i, p in enumerate(curve.points[:top]) if p.sign() != 1]
    start = resting[-1] if resting else 0
    rise = Curve(curve.x[start : top + 1], curve.points[start : top + 1])
    crossings = curve.crossings()
    by = listed(zip(curve.x, curve.estimates, strict=True))
    return [
        _linear(rise),
        Statement(
            "IV D, Fig. 12",
            "with rising frequency it turns back, and the transport reverses",
            f"largest {curve.estimates[top]} cm/s at {curve.x[top]:g} Hz; "
            f"{sign_changes(crossings, 'Hz')}; by f [Hz]: {by}",
            verdict(len(crossings) == 1 and curve.points[-1].sign() == -1),
        ),
    ]


def _linear(rise: Curve) -> Statement:
    """A straight line through the points from the last at rest to the largest."""
    x, y = np.array(rise.x), np.array([e.mean for e in rise.estimates])
    errors = np.array([max(e.error, 1e-3) for e in rise.estimates])
    printed = "above the critical frequency the velocity becomes positive, linearly"
    if len(x) < 3:
        return Statement("IV D, Fig. 12", printed, f"only {len(x)} points on the rising side", Verdict.OPEN)
    (slope, offset), covariance = np.polyfit(x, y, 1, w=1.0 / errors, cov="unscaled")
    critical = -offset / slope
    gradient = np.array([offset / slope**2, -1.0 / slope])
    error = float(np.sqrt(gradient @ covariance @ gradient))
    ratio, p_value = chi_square((y - slope * x - offset).tolist(), errors.tolist(), lost=2)
    found = (
        f"line from {x[0]:g} to {x[-1]:g} Hz: critical frequency {Estimate(float(critical), error)} Hz, slope "
        f"{slope:.2g} cm/s per Hz, correlation {np.corrcoef(x, y)[0, 1]:.2f}; chi^2 per degree of freedom {ratio:.2g}, "
        f"p = {p_value:.2g}"
    )
    return Statement("IV D, Fig. 12", printed, found, share([slope > 0.0, p_value > 0.01]))


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
    ("h = 6 mm, a = 0.25, A = 2 mm, ten teeth, 12 seeds of 30 s after 1 s, 3 below 14.5 Hz",),
)
