"""F eq. 1 and Fig. 3, an experiment: the onset of a layer of balls on vertical teeth, as far as disks can say."""

from matplotlib.figure import Figure

from jostle_lab.statements import Statement, Verdict, verdict
from studies.ratchet.cases import Case, Plan, Points, frequency_of
from studies.ratchet.onset import Onset, fit_onset
from studies.ratchet.study import Curve, Study, Table, curves, listed, panel_of_curves

GAMMAS = (1.6, 1.8, 2.0, 2.2, 2.5, 3.0, 3.5, 4.0)
BALLS = {"tooth.width": 12e-3, "disk.radius_min": 1.617e-3, "disk.radius_max": 1.683e-3, "disk.inertia_factor": 0.4}
"""w = 12 mm, balls of 3.3 mm +- 2 %, inertia of a ball."""
DISKS = 148
"""Four layers in a cell of ten teeth."""
THRESHOLD, EXPONENT = 1.7, 0.48
"""F's, without errors."""
WINDOWS = (3.0, 4.0)
SHOWN = 4.0


def case(gamma: float) -> Case:
    """Vertical teeth, h = 7 mm."""
    return Case(7.0, 0.0, frequency_of(gamma), DISKS, changes=tuple(sorted(BALLS.items())))


def plan(quick: bool) -> Plan:
    """Few runs: each costs a second or more."""
    return {case(g): 2 if quick or g < 1.8 else 3 for g in GAMMAS}


def _curve(points: Points) -> Curve:
    (curve,) = curves(points, lambda _: 0.0, lambda c: round(c.gamma, 6)).values()
    return curve


def fit(curve: Curve, largest: float) -> Onset:
    """The onset up to a Gamma."""
    part = curve.between(0.0, largest)
    return fit_onset(part.x, [p.velocities for p in part.points])


def draw(points: Points) -> Figure:
    """The curve."""
    return panel_of_curves({0.0: _curve(points)}, lambda _: "disks, four layers, h = 7 mm, a = 0", r"$\Gamma$")


def statements(points: Points) -> list[Statement]:
    """Eq. 1: a threshold well above 1, and an exponent near one half."""
    curve = _curve(points)
    onset = fit(curve, SHOWN)
    by = "by Gamma [cm/s]: " + listed(zip(curve.x, curve.estimates, strict=True))
    return [
        Statement(
            "II B, eq. 1, experiment",
            "flow only above a critical acceleration, Gamma_c = 1.7",
            f"{onset.threshold}; {by}",
            verdict(onset.threshold.within(THRESHOLD, 0.1)),
        ),
        Statement(
            "II B, eq. 1, experiment",
            f"exponent {EXPONENT}",
            f"{onset.exponent} up to Gamma = {SHOWN:g}; glass walls, aluminium and balls are not in the simulation",
            Verdict.OPEN,
        ),
    ]


def tables(points: Points) -> list[Table]:
    """The window."""
    curve = _curve(points)
    rows = []
    for largest in WINDOWS:
        if len(curve.between(0.0, largest).x) >= 6:
            onset = fit(curve, largest)
            rows.append([f"up to {largest:g}", str(onset.threshold), str(onset.exponent), f"{onset.residual:.2f}"])
    return [Table("Onset against the window of the fit", ["fitted", "Gamma_c", "exponent", "residual [cm/s]"], rows)]


EXPERIMENT = Study(
    "F3",
    "F eq. 1 and Fig. 3, an experiment: the onset on vertical teeth",
    plan,
    draw,
    statements,
    (
        "w = 12 mm, h = 7 mm, a = 0, A = 2 mm as in the experiment; disks of 3.3 mm +- 2 % with the inertia of balls",
        "four layers (148 disks) on ten teeth, three seeds (two below Gamma = 1.8)",
        "restitution 0.8 and friction 0.1 of F's simulations",
    ),
    tables,
)
