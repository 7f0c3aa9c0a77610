"""F Fig. 2, an experiment: velocity against the number of layers of balls, for several teeth, as far as disks can.

The text of F names the teeth by w, h and a and prints none of their values but those of Fig. 3. So this is a family of
about the size of the balls, as F's were: the ring of Fig. 3, those of F IV, and these at the scale of the balls.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, shades, velocity_axes
from jostle_lab.plots.style import WIDTH
from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate, sign_changes
from jostle_lab.verdicts import Judgement, Verdict, above, below, every, falls, rises
from studies.ratchet.cases import Case, Plan, Points
from studies.ratchet.observe import CENTIMETRE, Observed
from studies.ratchet.ring import BALL_CHANGES, arithmetic, balls_of_layers
from studies.ratchet.study import Curve, Study, listed, stated

LAYERS = (0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0)
FREQUENCY = 25.0
"""f [Hz] of Fig. 2."""
TEETH = 10


@dataclass(frozen=True)
class Shape:
    """A tooth of Fig. 2."""

    width: float
    """w [mm]."""
    height: float
    """h [mm]."""
    asymmetry: float
    """a."""
    restitution: float = 0.8

    def __str__(self) -> str:
        """As in a legend."""
        text = f"w = {self.width:g} mm, h = {self.height:g} mm, a = {self.asymmetry:g}"
        return text + ("" if self.restitution == 0.8 else f", restitution {self.restitution:g}")

    def case(self, layers: float) -> Case:
        """Balls of n layers on these teeth."""
        changes = {"tooth.width": 1e-3 * self.width, **BALL_CHANGES}
        if self.restitution != 0.8:
            changes["collision.restitution"] = self.restitution
        disks = balls_of_layers(layers, TEETH, self.width)
        return Case(self.height, self.asymmetry, FREQUENCY, disks, TEETH, changes=tuple(sorted(changes.items())))


VERTICAL, LOW = Shape(12.0, 7.0, 0.0), Shape(6.0, 3.0, 0.0)
TALL, STEEP, FLAT = Shape(9.0, 9.0, 0.25), Shape(6.0, 6.0, 0.1), Shape(12.0, 9.0, 0.3)
SHAPES = (VERTICAL, LOW, TALL, STEEP, FLAT)
SOFTER, HARDER = Shape(9.0, 9.0, 0.25, 0.7), Shape(9.0, 9.0, 0.25, 0.9)
"""As TALL; restitution is that of all impacts, since disks have one for balls and base."""
ELASTICITIES = (SOFTER, TALL, HARDER)


def plan(quick: bool) -> Plan:
    """Runs of 30 s, more where few disks scatter."""
    if quick:
        return {shape.case(n): 2 for shape in SHAPES for n in (0.5, 2.0, 4.0)}
    return {shape.case(n): 8 if n < 1.0 else 4 if n < 3.0 else 2 for shape in (*SHAPES, SOFTER, HARDER) for n in LAYERS}


def found_curves(points: Points) -> dict[Shape, Curve]:
    """Velocity against n for each tooth."""
    found = {}
    for shape in (*SHAPES, SOFTER, HARDER):
        known = [(n, points[shape.case(n)]) for n in LAYERS if shape.case(n) in points]
        if known:
            found[shape] = Curve(tuple(n for n, _ in known), tuple(p for _, p in known))
    return found


def draw(points: Points) -> Figure:
    """Teeth on the left, restitution on the right, on one scale of velocities."""
    found = found_curves(points)
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    _panel(left, {shape: found[shape] for shape in SHAPES if shape in found})
    _panel(right, {shape: found[shape] for shape in ELASTICITIES if shape in found})
    right.set_ylabel("")
    left.set_title("(a) shapes of teeth")
    right.set_title("(b) restitution, w = 9 mm, h = 9 mm, a = 0.25")
    return figure


def _panel(panel: Axes, found: Mapping[Shape, Curve]) -> None:
    velocity_axes(panel, "layers n of balls side by side")
    styles = zip("osv^D", ("-", "--", "-.", ":", (0, (5, 1, 1, 1))), strict=True)
    for (shape, curve), colour, (marker, line) in zip(found.items(), shades(len(found)), styles, strict=False):
        label = str(shape) if found.keys() - set(ELASTICITIES) else f"restitution {shape.restitution:g}"
        draw_curve(panel, curve.x, curve.estimates, label, marker=marker, color=colour, linestyle=line)
    panel.legend(fontsize=7.0)


def top(curve: Curve) -> int:
    """Index of the largest velocity."""
    return max(range(len(curve.x)), key=lambda i: curve.estimates[i].mean)


def has_maximum(curve: Curve) -> Judgement:
    """Whether the largest velocity is inside of the curve and above both ends for certain."""
    rule = "the largest value above both ends by two joint errors"
    best, (first, *_, last) = curve.estimates[top(curve)], curve.estimates
    return every((above(_less(best, end), 0.0) for end in (first, last)), rule)


def _less(a: Estimate, b: Estimate) -> Estimate:
    if a is b:
        return Estimate(0.0, 1e-12)
    return Estimate(a.mean - b.mean, (a.error**2 + b.error**2) ** 0.5)


def fades(curve: Curve) -> Judgement:
    """Whether the magnitude falls from the depth on at which it is largest, among flows of the last sign."""
    return falls(tail(curve).estimates)


def tail(curve: Curve) -> Curve:
    """Magnitudes from the largest flow of the sign of the deepest layer on."""
    sign = 1.0 if curve.estimates[-1].mean >= 0.0 else -1.0
    best = max(range(len(curve.x)), key=lambda i: sign * curve.estimates[i].mean)
    return Curve(curve.x[best:], curve.points[best:]) if sign > 0.0 else curve


def statements(points: Points) -> list[Statement]:
    """F II B on Fig. 2, and F V on its maxima."""
    found = found_curves(points)
    shapes = {shape: curve for shape, curve in found.items() if shape in SHAPES}
    by = "; ".join(f"({shape}) {listed(zip(c.x, c.estimates, strict=True))}" for shape, c in shapes.items())
    return [
        _some("in certain cases the velocity changes sign with the layer thickness", shapes, _turns, f"by n: {by}"),
        _some(
            "in some cases the curves are monotonically decreasing", shapes, lambda c: falls(c.estimates), "as above"
        ),
        _some("others have well defined maxima", shapes, has_maximum, _maxima(shapes)),
        stated(
            "II B, Fig. 2; V",
            "common to all: beyond a certain layer thickness the velocity magnitude decreases; thick layers are slower",
            "largest at n, and at the deepest [cm/s]: "
            + "; ".join(f"({s}) {c.x[top(c)]:g}, {c.estimates[-1]}" for s, c in shapes.items()),
            every(
                (fades(c) for c in shapes.values()), f"for every tooth from the largest on: {falls([ONE, ONE]).rule}"
            ),
            "more runs, or deeper layers, decide",
        ),
        *_elasticity({s: found[s] for s in ELASTICITIES if s in found}),
        *arithmetic(),
    ]


ONE = Estimate(0.0, 1.0)


def _turns(curve: Curve) -> Judgement:
    rule = "below 0 at the thinnest layer, above 0 at a deeper one, by two errors"
    return every([below(curve.estimates[0], 0.0), above(curve.estimates[top(curve)], 0.0)], rule)


def _maxima(shapes: Mapping[Shape, Curve]) -> str:
    inside = {s: c for s, c in shapes.items() if has_maximum(c).verdict is Verdict.AGREES}
    return "largest value at n: " + ("; ".join(f"({s}) {c.x[top(c)]:g}" for s, c in inside.items()) or "none inside")


def _some(printed: str, shapes: Mapping[Shape, Curve], judge: Callable[[Curve], Judgement], found: str) -> Statement:
    """A statement that there are such curves: agrees if one of the family is one."""
    judged = {shape: judge(curve) for shape, curve in shapes.items()}
    such = [str(shape) for shape, j in judged.items() if j.verdict is Verdict.AGREES]
    rule = f"one tooth of the family at least: {next(iter(judged.values())).rule}"
    undecided = any(j.verdict is Verdict.OPEN for j in judged.values())
    judgement = Judgement(Verdict.AGREES if such else Verdict.OPEN if undecided else Verdict.DISAGREES, rule)
    text = f"{len(such)} of {len(judged)}: {'; '.join(such) or 'none'}; {found}"
    return stated("II B, Fig. 2", printed, text, judgement, "F's own teeth are not printed; other teeth may decide")


def _elasticity(found: Mapping[Shape, Curve]) -> list[Statement]:
    """Whether other restitutions keep what the curve of TALL does: backwards, then forwards, then slower."""
    if len(found) < len(ELASTICITIES):
        return []
    crossings = {s.restitution: c.crossings() for s, c in found.items()}
    text = "; ".join(f"{e:g}: {sign_changes(c, '', 'n')}" for e, c in crossings.items())
    rule = "at each restitution the thinnest layer below 0, a deeper one above 0 by two errors, then falling"
    return [
        stated(
            "II B, Fig. 2",
            "changing the elasticity of the base does not alter the curves qualitatively",
            f"{TALL}, by restitution of all impacts (the disks have one for balls and base): {text}",
            every([*map(_turns, found.values()), *map(fades, found.values())], rule),
            "restitution of the balls is changed along with that of the base, which is more than F did; more runs of "
            "thick layers, an hour of one processor, decide",
        )
    ]


def others(observed: Observed) -> list[Statement]:
    """F V: few particles move erratically, many coherently; thick layers are slow by inelastic damping."""
    shallow = [n for n in LAYERS if n <= 4.0 and VERTICAL.case(n) in observed.seeds]
    spreads = [observed.mean(VERTICAL.case(n), "transport_velocity.spread", CENTIMETRE) for n in shallow]
    found = [
        stated(
            "V",
            "few particles move erratically, with large jumps; with more of them they move coherently",
            f"{VERTICAL}: standard deviation over the balls of their mean velocities in 30 s [cm/s], by n: "
            + listed(zip(shallow, spreads, strict=True)),
            falls(spreads),
            "four times the runs, an hour of one processor, decide",
        )
    ]
    if all(s.case(DAMPED) in observed.seeds for s in ELASTICITIES):
        deep = {s.restitution: observed.mean(s.case(DAMPED), "transport_velocity", CENTIMETRE) for s in ELASTICITIES}
        found.append(
            stated(
                "V",
                "thick layers move more slowly because of inelastic damping",
                f"{TALL}, n = {DAMPED:g}, by restitution [cm/s]: {listed(deep.items())}",
                rises(list(deep.values())),
                DAMPING,
            )
        )
    return found


DAMPED = 6.0
"""Layers beyond the maximum."""
DAMPING = "four times the runs, an hour of one processor, decide"


DEPTH = Study(
    "F2",
    "F Fig. 2, an experiment: transport against the number of layers",
    plan,
    draw,
    statements,
    (
        "disks of 3.3 mm +- 2 % with the inertia of balls, A = 2 mm, f = 25 Hz, ten teeth, 30 s after 1 s",
        "teeth: that of Fig. 3, and others of the size of the balls, since F's text does not print its own",
        "n = N / k with k = width / 3.3 mm; restitution 0.8 and friction 0.1 of F's simulations where not said",
    ),
    others=others,
)
