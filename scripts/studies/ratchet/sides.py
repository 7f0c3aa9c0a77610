"""F V on Figs 13 and 14: which sides of the teeth the disks meet, counted impact by impact."""

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.verdicts import above, below
from studies.ratchet.cases import Case
from studies.ratchet.observe import CENTIMETRE, Observed
from studies.ratchet.quoted import CHANGES, DEFAULTS, NEGATIVE, PLACES
from studies.ratchet.study import Table, stated

DISK_MASS = 1e-5
"""[kg]"""
SIDES = {"left_side": "steeper side, left", "right_side": "flatter side, right", "tip": "tip"}
HALF = 0.5
"""`Most` disks that leave the flatter side meet the steeper one, or do not."""


def impacts(observed: Observed, case: Case, side: str) -> Numbers:
    """Impacts of each disk on a side in a period, in every run."""
    periods = case.seconds * case.frequency
    return observed.values(case, f"tooth.{side}_impacts") / (case.disks * periods)


def impulse(observed: Observed, case: Case, side: str) -> Numbers:
    """Horizontal impulse to each disk from a side in a period, over its mass [cm/s], in every run."""
    periods = case.seconds * case.frequency
    return CENTIMETRE * observed.values(case, f"tooth.{side}_impulse") / (case.disks * periods * DISK_MASS)


def statements(observed: Observed, case: Case) -> list[Statement]:
    """Whether a disk that leaves the flatter side meets the steeper one, which turns its horizontal impulse."""
    rate = {side: Estimate.over_runs(impacts(observed, case, side)) for side in SIDES}
    push = {side: Estimate.over_runs(impulse(observed, case, side)) for side in SIDES}
    ratio = Estimate.over_runs(impacts(observed, case, "left_side") / impacts(observed, case, "right_side"))
    counted = ", ".join(f"{name} {rate[side]}" for side, name in SIDES.items())
    given = ", ".join(f"{name} {push[side]}" for side, name in SIDES.items())
    text = (
        f"{ratio} impacts on the steeper side for each on the flatter one; impacts of a disk in a period: {counted}; "
        f"horizontal impulse over mass in a period [cm/s]: {given}"
    )
    if case == NEGATIVE:
        printed = "the off-bouncing particles collide with the opposite side of the sawtooth"
        judgement = above(ratio, HALF)
    else:
        printed = "most particles do not collide with the opposite side"
        judgement = below(ratio, HALF)
    return [stated(f"V, {PLACES[case]}", printed, text, judgement, "more runs decide")]


def tables(observed: Observed, case: Case) -> list[Table]:
    """Impacts and impulses by friction: why friction carries."""
    name = "collision.friction"
    frictions = sorted((*CHANGES[name], DEFAULTS[name]))
    cases = {v: case if v == DEFAULTS[name] else case.with_changes(collision__friction=v) for v in frictions}
    if not all(c in observed.seeds for c in cases.values()):
        return []
    rows = [
        [
            f"{v:g}",
            str(observed.mean(c, "transport_velocity", CENTIMETRE)),
            *(str(Estimate.over_runs(impacts(observed, c, side))) for side in SIDES),
            *(str(Estimate.over_runs(impulse(observed, c, side))) for side in SIDES),
        ]
        for v, c in cases.items()
    ]
    header = ["friction", "velocity [cm/s]"]
    header += [f"impacts, {name}" for name in SIDES.values()]
    header += [f"impulse, {name} [cm/s]" for name in SIDES.values()]
    title = f"Impacts of a disk in a period and their horizontal impulse over its mass, {PLACES[case]}, by friction"
    return [Table(title, header, rows)]
