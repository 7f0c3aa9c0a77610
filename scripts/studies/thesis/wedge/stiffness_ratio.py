"""P Fig. 6.9: scaled angular velocity against tilt, five stiffness ratios and the limit of rigid springs."""

from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import pooled
from jostle_lab.verdicts import Verdict, below, falls, rises, true
from studies.thesis.wedge.curves import QUICK_TILTS, TILTS, Curve, Effort, Wedge, curves, effort, other_law, tilt_axes
from studies.thesis.wedge.rules import alike, changes_sense, less, peak, rms, symmetric

RATIOS = {0.01: "^", 0.1: "D", 1.0: "s", 10.0: "s", 100.0: "o"}
"""kappa and the symbols of the thesis' caption."""
FILLED = (0.01, 10.0)
ALMOST = 0.05
"""Almost indistinguishable: within this part of the strongest rotation."""
BEYOND = 1000.0
"""One stiffness ratio more, to see where the limit goes."""

Curves = dict[float, Curve]


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run all stiffness ratios and the limit."""
    chosen = effort(quick, seeds)
    tilts = QUICK_TILTS if quick else TILTS
    wedges = {kappa: Wedge(stiffness_ratio=kappa) for kappa in (*RATIOS, BEYOND)}
    by_wedge = curves(laboratory, "figure 6.9", dict.fromkeys(wedges.values(), tilts), chosen)
    found = {kappa: by_wedge[wedge] for kappa, wedge in wedges.items()}
    limit = rigid_skin(laboratory, tilts, chosen)
    rows = [row for curve in (*found.values(), limit) for row in curve.rows()]
    notes = [
        "map; theta_W = 120 degrees, mu = 0.1, e_n = 0.9",
        "stiffness ratio inf: e_t = max(0, 1 - 3 mu (1 + e_n) |u_n/u_t|)",
        *chosen.notes(),
    ]
    return Product(
        "Figure 6.9: influence of the stiffness ratio", rows, draw(found, limit), statements(found, limit), notes
    )


def rigid_skin(laboratory: Laboratory, tilts: tuple[float, ...], effort: Effort) -> Curve:
    """The map with the limit of infinite kappa, by a Rust example."""
    wedge = Wedge(stiffness_ratio=float("inf"))
    tables = [
        other_law(laboratory, "rigid", wedge, effort.duration, seed, tilts) for seed in range(1, effort.seeds + 1)
    ]
    points = [
        pooled([t["scaled"][i] for t in tables], [t["standard_error"][i] for t in tables]) for i in range(len(tilts))
    ]
    return Curve(wedge, tuple(tilts), tuple(points), 1.0)


def draw(found: Curves, limit: Curve) -> Figure:
    """All curves in one panel."""
    figure = Figure(figsize=(0.9 * WIDTH, 4.2), layout="constrained")
    panel = figure.subplots()
    for (kappa, marker), colour in zip(RATIOS.items(), shades(len(RATIOS)), strict=True):
        fill = colour if kappa in FILLED else "white"
        draw_curve(
            panel, limit.tilts, found[kappa].points, rf"$\kappa$ = {kappa:g}", marker=marker, color=colour, mfc=fill
        )
    draw_curve(
        panel,
        limit.tilts,
        limit.points,
        r"$\kappa \to \infty$",
        marker="^",
        color="0.1",
        mfc="white",
        linestyle="--",
    )
    tilt_axes(panel)
    figure.legend(loc="outside right center")
    return figure


def statements(found: Curves, limit: Curve) -> list[Statement]:
    """What P 6.3.4 says of this figure."""
    strongest = peak([limit])
    compared = {kappa: alike(less(found[kappa], limit), strongest) for kappa in (10.0, 100.0, BEYOND)}
    named = {f"kappa = {k:g}": curve for k, curve in found.items()}
    return [
        Statement.judged(
            "6.3.4, Fig. 6.9",
            "the limit kappa -> inf is almost indistinguishable from kappa = 100",
            "less the limit: " + "; ".join(f"kappa = {k:g}: {text}" for k, (text, _) in compared.items()),
            below(rms(less(found[100.0], limit)), ALMOST * strongest),
            "the approximation leaves out the velocity that the tangential spring gives back; with kappa ten "
            "times larger "
            "the difference falls as shown",
        ),
        _tendency(found),
        changes_sense(named),
        symmetric(named),
    ]


def _tendency(found: Curves) -> Statement:
    """Whether the velocity rises or falls with kappa, at each tilt and in its largest value."""
    counts = {Verdict.AGREES: 0, Verdict.DISAGREES: 0, Verdict.OPEN: 0}
    tilts = found[1.0].tilts
    for i, tilt in enumerate(tilts):
        if tilt == 0.0:
            continue
        points = [found[kappa].points[i] for kappa in RATIOS]
        monotonic = {rises(points).verdict, falls(points).verdict}
        best = Verdict.AGREES if Verdict.AGREES in monotonic else Verdict.OPEN
        counts[best if Verdict.AGREES in monotonic or Verdict.OPEN in monotonic else Verdict.DISAGREES] += 1
    largest = {kappa: max(abs(p.mean) for p in found[kappa].points) for kappa in RATIOS}
    values = list(largest.values())
    ordered = values in (sorted(values), sorted(values, reverse=True))
    return Statement.judged(
        "6.3.4",
        "no simple tendency with kappa",
        f"rising or falling with kappa for certain at {counts[Verdict.AGREES]} of {len(tilts) - 1} tilts, neither at "
        f"{counts[Verdict.DISAGREES]}; largest |R omega / (A omega_b)|: "
        + ", ".join(f"{kappa:g}: {value:.3f}" for kappa, value in largest.items()),
        true(
            counts[Verdict.DISAGREES] > 0 and not ordered,
            "at some tilts no monotonic curve fits (p <= 0.01), and the largest values are not in order",
        ),
    )
