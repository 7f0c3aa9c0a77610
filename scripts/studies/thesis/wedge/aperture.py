"""P Fig. 6.7: scaled angular velocity against relative tilt for seven apertures."""

from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve, shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, chi_square
from jostle_lab.verdicts import below, every, vanish
from studies.thesis.wedge.curves import Curve, Wedge, curves, effort, tilt_axes
from studies.thesis.wedge.rules import SMALL, symmetric

APERTURES = {90.0: "+", 91.0: "x", 100.0: (8, 2, 0), 120.0: "s", 140.0: "^", 160.0: "o", 179.0: "o"}
"""theta_W [degrees] and the symbols of the thesis' caption."""
FILLED = (179.0,)
RELATIVE = (0.0, 0.033, 0.067, *(round(0.1 * i, 2) for i in range(1, 10)), 0.35, 0.45, 0.55, 0.65, 0.75, 0.85, 0.95)
RELATIVE = (*sorted(RELATIVE), 0.98)
SUPPRESSED = 0.2
"""Strongly suppressed: below this part of the strongest aperture."""
QUICK_RELATIVE = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97)
"""theta_T / theta_0."""

Curves = dict[float, Curve]


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run all apertures."""
    chosen = effort(quick, seeds)
    relative = QUICK_RELATIVE if quick else RELATIVE
    wedges = {aperture: Wedge(aperture=aperture) for aperture in APERTURES}
    tilts = {wedge: tuple(share * wedge.critical_tilt for share in relative) for wedge in wedges.values()}
    by_wedge = curves(laboratory, "figure 6.7", tilts, chosen)
    found = {aperture: by_wedge[wedge] for aperture, wedge in wedges.items()}
    rows = [
        {**row, "relative_tilt": row["tilt_deg"] / curve.wedge.critical_tilt}
        for curve in found.values()
        for row in curve.rows()
    ]
    notes = ["map; mu = 0.1, e_n = 0.9, kappa = 0.773", *chosen.notes()]
    return Product("Figure 6.7: influence of the aperture", rows, draw(found), statements(found), notes)


def draw(found: Curves) -> Figure:
    """All curves in one panel."""
    figure = Figure(figsize=(0.9 * WIDTH, 4.2), layout="constrained")
    panel = figure.subplots()
    for (aperture, marker), colour in zip(APERTURES.items(), shades(len(APERTURES)), strict=True):
        curve = found[aperture]
        x = [tilt / curve.wedge.critical_tilt for tilt in curve.tilts]
        fill = colour if aperture in FILLED else "white"
        label = rf"$\theta_W$ = {aperture:g}$\degree$"
        draw_curve(panel, x, curve.points, label, marker=marker, color=colour, mfc=fill)
    tilt_axes(panel, None)
    panel.set(xlim=(-0.02, 1.0), xlabel=r"relative tilt $\theta_T/\theta_0$")
    figure.legend(loc="outside right center")
    return figure


def statements(found: Curves) -> list[Statement]:
    """What P 6.3.4 says of this figure."""
    largest = {aperture: max(curve.points, key=lambda p: abs(p.mean)) for aperture, curve in found.items()}
    sizes = {aperture: Estimate(abs(p.mean), p.error) for aperture, p in largest.items()}
    strongest = max(e.mean for e in sizes.values())
    flat = found[179.0].points
    ratio, p_value = chi_square([p.mean for p in flat], [p.error for p in flat])
    suppressed = [below(sizes[a], SUPPRESSED * strongest) for a in (90.0, 91.0)]
    return [
        Statement.judged(
            "6.3.4, Fig. 6.7",
            "no rotation in a flat wedge, theta_W = 179 degrees",
            f"largest {largest[179.0]}, {100 * sizes[179.0].mean / strongest:.1f} % of the strongest "
            "aperture; from zero: "
            f"chi^2 per point {ratio:.2f}, p = {p_value:.2g}",
            vanish(flat, SMALL * strongest),
            "at 179 degrees the wedge is not flat: a rotation of this size is real",
        ),
        Statement.judged(
            "6.3.4, Fig. 6.7",
            "rotation is strongly suppressed near theta_W = 90 degrees",
            "largest |R omega / (A omega_b)| by aperture [degrees]: "
            + "; ".join(f"{aperture:g}: {e}" for aperture, e in sizes.items()),
            every(suppressed, f"90 and 91 degrees: below {SUPPRESSED:.0%} of the strongest aperture by two errors"),
            "it is weaker there at most tilts, not at those close to the critical one",
        ),
        symmetric({f"theta_W = {a:g}": curve for a, curve in found.items()}),
    ]
