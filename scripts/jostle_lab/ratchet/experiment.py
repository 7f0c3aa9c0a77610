"""F eq. 1 and Fig. 3, an experiment: the onset of a layer of balls on vertical teeth, as far as disks can say."""

from jostle_lab.ratchet.cases import Case, Plan, frequency_of

GAMMAS = (1.0, 1.2, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0, 2.2, 2.5, 3.0, 3.5, 4.0)
BALLS = {"tooth.width": 12e-3, "disk.radius_min": 1.617e-3, "disk.radius_max": 1.683e-3, "disk.inertia_factor": 0.4}
"""w = 12 mm, balls of 3.3 mm +- 2 %, inertia of a ball."""
LAYERS = 4
DISKS = 148
"""Four layers in a cell of ten teeth."""


def case(gamma: float) -> Case:
    """h = 7 mm, a = 0."""
    return Case(7.0, 0.0, frequency_of(gamma), DISKS, changes=tuple(sorted(BALLS.items())))


def plan(quick: bool) -> Plan:
    """Few runs: each costs a second or more."""
    return {case(g): 2 if quick else 4 for g in GAMMAS[:: 2 if quick else 1]}
