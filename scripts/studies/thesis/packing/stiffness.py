"""P Fig. 3.9: <omega^2> against Gamma for three stiffnesses by molecular dynamics."""

from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, bootstrap_ratio
from jostle_lab.verdicts import Judgement, above, below, every
from studies.thesis.packing.ensemble import STIFFNESSES, Ensemble, Point, effort, observe, soft_points

MARKERS = {1e4: ("o", "-", "black"), 1e5: ("s", "--", "#1f5fa8"), 1e6: ("^", ":", "#c0272d")}
"""As in P's legend; its captions swap those of 1e5 and 1e6."""

Found = dict[tuple[float, float], Ensemble]
"""By stiffness and Gamma."""


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Figure 3.9."""
    points = [p for k in STIFFNESSES for p in soft_points(k)]
    if quick:
        kept = (0.4, 0.9, 2.0)
        points = [Point(p.method, p.stiffness, p.gamma, 2, 4, 2) for p in points if p.gamma in kept]
    found = {(p.stiffness, p.gamma): e for p, e in observe(laboratory, points, "figure 3.9").items()}
    efforts = [f"k_n = {k:.0e} N/m: {effort([p for p in points if p.stiffness == k])}" for k in STIFFNESSES]
    return Product(
        "Figure 3.9: mean squared angular velocity for three stiffnesses",
        [_row(e) for e in found.values()],
        draw(found),
        statements(found),
        [
            "kappa = 0.77, gamma_n = 0.1 kg/s, mu = 0.1, 3.57 kg/m^2; the same packings for every stiffness",
            *efforts,
            "errors by drawing packings; ratios packing by packing",
        ],
    )


def _row(e: Ensemble) -> dict[str, Any]:
    square = e.estimate("mean_square")
    return {
        "normal_stiffness": e.point.stiffness,
        "gamma": e.point.gamma,
        "mean_square_rpm": square.mean,
        "error": square.error,
    }


def gammas(found: Found, stiffness: float) -> list[float]:
    """Gamma at which there are runs of a stiffness."""
    return [g for k, g in found if k == stiffness]


def draw(found: Found) -> Figure:
    """Linear and logarithmic."""
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    for panel, scale in zip(figure.subplots(1, 2), ("linear", "log"), strict=True):
        for k, (marker, line, colour) in MARKERS.items():
            at = gammas(found, k)
            points = [found[k, g].estimate("mean_square") for g in at]
            style = {"marker": marker, "ls": line, "color": colour, "ms": 3.5, "mfc": "white"}
            draw_curve(panel, at, points, rf"$k_n = 10^{{{round(np.log10(k))}}}$ N/m", **style)
        panel.set(xscale=scale, yscale=scale, xlabel=r"$\Gamma$")
        panel.axvline(1.0, color="0.7", lw=0.7, ls=":")
    figure.axes[0].set_ylabel(r"$\langle\bar\omega^2\rangle$ [RPM$^2$]")
    figure.axes[0].legend()
    return figure


def ratio(found: Found, above_k: float, below_k: float, gamma: float) -> Estimate:
    """<omega^2> at one stiffness over that at another, packing by packing the same."""
    one, other = found[above_k, gamma].mean_square, found[below_k, gamma].mean_square
    count = min(len(one), len(other))
    return bootstrap_ratio(one[:count], other[:count])


def ratios(found: Found, above_k: float, below_k: float) -> dict[float, Estimate]:
    """The ratio at every Gamma that both stiffnesses have."""
    shared = [g for g in gammas(found, above_k) if (below_k, g) in found]
    return {g: ratio(found, above_k, below_k, g) for g in shared}


def statements(found: Found) -> list[Statement]:
    """What P 3.2 says of this figure."""
    softer, stiffer, whole = (ratios(found, *pair) for pair in ((1e5, 1e4), (1e6, 1e5), (1e6, 1e4)))
    low = [g for g in stiffer if g < 1.0]

    def text(ratios: dict[float, Estimate]) -> str:
        return ", ".join(f"{g:g}: {e}" for g, e in ratios.items())

    before = [g for g in low if g >= 0.8]
    falling = [below(e, 1.0) for g, e in (*softer.items(), *stiffer.items()) if g not in before]
    steepest = {k: _steepest(found, k) for k in STIFFNESSES}
    return [
        Statement.judged(
            "3.2, Fig. 3.9",
            "the rotation decreases as the stiffness grows",
            f"1e5 over 1e4: {text(softer)}; 1e6 over 1e5: {text(stiffer)}",
            every(falling, "every ratio below 1 for certain, but just before Gamma = 1"),
            CAUSES["decreases"],
        ),
        Statement.judged(
            "3.2, Fig. 3.9",
            "below Gamma = 1 by several orders of magnitude",
            f"1e6 over 1e4: {text({g: whole[g] for g in low})}",
            every([below(whole[g], 1e-2) for g in low if g < 0.8], "below Gamma = 0.8 less than a hundredth"),
            CAUSES["orders"],
        ),
        Statement.judged(
            "3.2, Fig. 3.9",
            "just before Gamma = 1 the disks with k_n = 1e5 rotate faster than the others; likely a numerical error",
            f"1e5 over 1e4: {text({g: softer[g] for g in before})}; 1e6 over 1e5: "
            f"{text({g: stiffer[g] for g in before})}",
            anomaly([softer[g] for g in before], [stiffer[g] for g in before]),
            CAUSES["anomaly"],
        ),
        Statement.judged(
            "3.2",
            "the stiffer the disks, the sooner they bounce; very stiff ones very close to Gamma = 1",
            "steepest growth of <omega^2> in log-log at "
            + ", ".join(f"{g:.2f} (exponent {s}) for {k:.0e}" for k, (g, s) in steepest.items()),
            every(
                [above(steepest[1e6][1], steepest[1e4][1].mean)],
                "the largest exponent between neighbouring points is larger for 1e6 than for 1e4",
            ),
            CAUSES["onset"],
        ),
    ]


def anomaly(softer: list[Estimate], stiffer: list[Estimate]) -> Judgement:
    """Whether the middle stiffness is above both others somewhere in the interval."""
    rule = "at some Gamma from 0.8 to 0.9 above both others for certain"
    places = [every([above(a, 1.0), below(b, 1.0)], rule) for a, b in zip(softer, stiffer, strict=True)]
    return min(places, key=lambda j: ("agrees", "open", "partly", "disagrees").index(j.verdict))


def _steepest(found: Found, stiffness: float) -> tuple[float, Estimate]:
    """Middle and exponent of the steepest piece between neighbouring Gamma from 0.3 to 3."""
    at = [g for g in gammas(found, stiffness) if 0.3 <= g <= 3.0]
    pieces = []
    for a, b in pairwise(at):
        one, two = (found[stiffness, g].estimate("mean_square") for g in (a, b))
        width = np.log(b / a)
        rise = Estimate(
            float(np.log(two.mean / one.mean) / width),
            float(np.hypot(one.error / one.mean, two.error / two.mean) / width),
        )
        pieces.append((float(np.sqrt(a * b)), rise))
    return max(pieces, key=lambda piece: piece[1].mean)


CAUSES = dict.fromkeys(("decreases", "orders", "anomaly", "onset"), "")
"""Why ours differs, by statement."""
