"""The two velocities that F quotes (captions of Figs 13 and 14), and what they depend on."""

import math
from dataclasses import replace

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import compatible, falls, vanish
from studies.ratchet.cases import Case, Plan, Points
from studies.ratchet.study import Table, listed, signed, stated

POSITIVE = Case(3.0, 0.1, 25.0, 20)
"""Fig. 13: 3.9 +- 0.3 cm/s."""
NEGATIVE = Case(6.0, 0.25, 30.0, 10)
"""Fig. 14: -3.2 +- 0.3 cm/s."""
BOTH = (POSITIVE, NEGATIVE)
PRINTED = {POSITIVE: (3.9, 0.3), NEGATIVE: (-3.2, 0.3)}
"""Velocity and its error [cm/s]."""
PLACES = {POSITIVE: "Fig. 13", NEGATIVE: "Fig. 14"}
CHANGES: dict[str, tuple[float, ...]] = {
    "tooth.tip_radius": (5e-5, 1e-4, 2e-4, 3e-4, 5e-4, 6e-4),
    "collision.restitution": (0.5, 0.7, 0.9),
    "collision.friction": (0.0, 0.05, 0.2, 0.5),
    "collision.minimum_normal_velocity": (1e-3, 2e-2),
    "drive.phase": (0.5 * math.pi, math.pi),
    "cell.height": (0.03, 0.1, 2.0),
}
"""Parameters that F leaves open or says not to matter, and other values of them."""
DEFAULTS = {
    "tooth.tip_radius": 4e-4,
    "collision.restitution": 0.8,
    "collision.friction": 0.1,
    "collision.minimum_normal_velocity": 5e-3,
    "drive.phase": 0.0,
    "cell.height": 0.6,
}
WARM_UPS = (0.0, 10.0)


def plan(case: Case, quick: bool) -> Plan:
    """Many runs of one of the two, fewer with one parameter changed, other starts."""
    if quick:
        return {case: 10}
    changed = {_changed(case, name, value): 30 for name, values in CHANGES.items() for value in values}
    later = {replace(case, warm_up=warm_up): 30 for warm_up in WARM_UPS}
    return {case: 100, **changed, **later}


def _changed(case: Case, name: str, value: float) -> Case:
    return case.with_changes(**{name.replace(".", "__"): value})


def statements(points: Points, case: Case) -> list[Statement]:
    """The velocity; then what F says of dissipation, of the floor of velocities."""
    value, error = PRINTED[case]
    found = points[case].estimate
    quoted = stated(
        PLACES[case],
        f"<v_x> = {value} +- {error} cm/s (h = {case.height:g} mm, a = {case.asymmetry:g}, f = {case.frequency:g} Hz, "
        f"n = {case.layers:.2g})",
        f"{found} cm/s ({points[case].runs} runs; one scatters by {points[case].scatter:.2g}); "
        f"{joint(found, value, error):+.1f} joint errors away",
        compatible(found, value, error, widest=error),
        "the radius of the tips, which F does not give, moves it (table)",
    )
    return [quoted, *_dissipation(points, case), *_floor(points, case)]


DISSIPATION = {
    (POSITIVE, "restitution"): "more runs decide",
    (
        NEGATIVE,
        "restitution",
    ): "from 0.8 down F is right; between 0.8 and 0.9 the flow weakens again. Of balls that are "
    "dropped on these teeth (section FV) as many bounce to the left at 0.9 as at 0.8, but the fewer the more oblique "
    "they come; disks that lose less fly higher and come more obliquely",
    (POSITIVE, "friction"): "friction damps what works against the flow: with more of it the disks bounce less and "
    "meet the base more often, and the steeper side throws them back with less impulse (table of impacts by "
    "friction). F refers to a diploma thesis and shows nothing",
    (NEGATIVE, "friction"): "the velocity is the same at any friction within the errors; to see a tenth of it by "
    "three errors takes ten times the runs, a quarter of an hour of one processor",
}
"""Why the flow is not weaker with more dissipation where it is not."""


def _dissipation(points: Points, case: Case) -> list[Statement]:
    """Whether the sign stays with other restitution and friction, and whether dissipation weakens the flow."""
    found = []
    for name, printed_name in (("collision.restitution", "restitution"), ("collision.friction", "friction")):
        values = sorted((*CHANGES[name], DEFAULTS[name]))
        cases = [case if v == DEFAULTS[name] else _changed(case, name, v) for v in values]
        if not all(c in points for c in cases):
            continue
        velocities = [points[c].estimate for c in cases]
        sign = 1 if points[case].estimate.mean > 0.0 else -1
        found.append(
            stated(
                f"IV, at {PLACES[case]}",
                f"the direction hardly depends on {printed_name}",
                f"by {printed_name} [cm/s]: {listed(zip(values, velocities, strict=True))}",
                signed(velocities, sign),
                "more runs decide",
            )
        )
        ordered = velocities if printed_name == "friction" else velocities[::-1]
        found.append(
            stated(
                f"IV, at {PLACES[case]}",
                f"the flow is weaker with more dissipation, by {printed_name}",
                "as above",
                falls([Estimate(sign * e.mean, e.error) for e in ordered]),
                DISSIPATION[case, printed_name],
            )
        )
    return found


def _floor(points: Points, case: Case) -> list[Statement]:
    """F III: the smallest normal velocity does not influence the dynamics."""
    name = "collision.minimum_normal_velocity"
    cases = [_changed(case, name, v) for v in CHANGES[name]]
    if not all(c in points for c in cases):
        return []
    differences = [_difference(points[c].estimate, points[case].estimate) for c in cases]
    by = listed((1e3 * v, points[c].estimate) for v, c in zip(CHANGES[name], cases, strict=True))
    return [
        stated(
            f"III, at {PLACES[case]}",
            "v_n^min = 5 mm/s ends inelastic collapse and does not influence the dynamics",
            f"no run collapsed; by v_n^min [mm/s]: {by}; at 5: {points[case].estimate} cm/s",
            vanish(differences, 0.25 * abs(points[case].estimate.mean)),
            "more runs decide",
        )
    ]


def _difference(a: Estimate, b: Estimate) -> Estimate:
    return Estimate(a.mean - b.mean, math.hypot(a.error, b.error))


def joint(estimate: Estimate, value: float, error: float) -> float:
    """Difference from a printed value, in joint standard errors."""
    return (estimate.mean - value) / math.hypot(estimate.error, error)


def tables(points: Points, case: Case) -> list[Table]:
    """What F leaves open, one parameter at a time."""
    value, error = PRINTED[case]
    rows = []
    for name, values in CHANGES.items():
        for v in sorted((*values, DEFAULTS[name])):
            changed = case if v == DEFAULTS[name] else _changed(case, name, v)
            if changed not in points:
                return []
            mark = " (default)" if v == DEFAULTS[name] else ""
            estimate = points[changed].estimate
            rows.append([f"`{name}` = {v:.3g}{mark}", str(estimate), f"{joint(estimate, value, error):+.1f}"])
    for warm_up in WARM_UPS:
        estimate = points[replace(case, warm_up=warm_up)].estimate
        rows.append([f"averaged from {warm_up:g} s on", str(estimate), f"{joint(estimate, value, error):+.1f}"])
    counts = [p.runs for c, p in points.items() if c != case]
    each = f"{min(counts)} runs each (default: {points[case].runs})"
    title = f"Velocity [cm/s] of {PLACES[case]} with one thing changed, {each}; F: {value} +- {error}"
    return [Table(title, ["changed", "ours", "joint errors from F"], rows)]
