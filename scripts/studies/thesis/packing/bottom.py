"""P 1.3 and Fig. 1.10: packings over a random bottom layer, small packings over a fixed row, three disks tilted."""

from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import CLOCKWISE, COUNTER_CLOCKWISE, WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product
from jostle_lab.statistics.estimates import Estimate
from studies.thesis.packing.bottom_found import Found, gather
from studies.thesis.packing.bottom_runs import (
    ALUMINIUM,
    OBSERVED,
    QUARTER,
    SECOND_NOISE,
    STEEL,
    UNOBSERVED,
    Shaken,
    Small,
    Tilted,
    equivalent_gamma,
    packings,
    tilted,
    velocities,
)
from studies.thesis.packing.bottom_statements import statements

EPSILONS = (1e-5, 3e-5, 1e-4, 3e-4, 1e-3)
"""Radii of the circles [m]."""
NOISY_AGAIN = (1e-4,)
"""Where each packing is shaken a second time, by other noise [m]."""
SINES = (3e-5, 1e-4, 3e-4)
"""Where the whole bottom also moves as the sine of the same rms velocity [m]."""
PACKINGS = 4
SMALL_GAMMAS = (0.9, 2.0, 3.0)
SMALL_SEEDS = 6
TILTS = (0.0, 6.0, 12.0)
"""[degrees]."""
PHASES = (0.0, 1.5, 3.0, 4.5)


@dataclass(frozen=True)
class Plan:
    """All runs."""

    packings: list[Shaken]
    small: list[Small]
    tilted: list[Tilted]


def plan(quick: bool) -> Plan:
    """Few or all."""
    seeds = range(1, (2 if quick else PACKINGS) + 1)
    epsilons = NOISY_AGAIN[:1] if quick else EPSILONS
    again = NOISY_AGAIN[:1] if quick else NOISY_AGAIN
    sines = NOISY_AGAIN[:1] if quick else SINES
    shaken = [Shaken(equivalent_gamma(e), s, e) for e in epsilons for s in seeds]
    shaken += [Shaken(equivalent_gamma(e), s, e, SECOND_NOISE) for e in again for s in seeds]
    shaken += [Shaken(equivalent_gamma(e), s) for e in sines for s in seeds]
    small_seeds = range(1, (3 if quick else SMALL_SEEDS) + 1)
    seconds = 20.0 if quick else 60.0
    small = [Small(g, n, s, seconds) for n in (3, 5) for g in SMALL_GAMMAS for s in small_seeds]
    length = 5.0 if quick else 10.0
    disks = [Tilted(m, t, p, seconds=length) for m in (ALUMINIUM, STEEL) for t in TILTS for p in PHASES]
    return Plan(shaken, small, disks)


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """P 1.3."""
    wanted = plan(quick)
    found = gather(
        packings(laboratory, wanted.packings, "1.3, packings"),
        velocities(laboratory, wanted.small, "1.3, small packings"),
        tilted(laboratory, wanted.tilted, "1.3, three disks"),
    )
    seeds, small_seeds = len(next(iter(found.random.values())).cases), len(next(iter(found.single.values())))
    notes = [
        f"60 disks of P 3.2, k_n = 1e4 N/m, {seeds} packings (seeds 1 to {seeds}), {UNOBSERVED * QUARTER:.0f} s "
        f"unobserved, then {OBSERVED * QUARTER:.0f} s; disks above the bottom row only, 49 or so",
        "random bottom: P gives the circle and no more; oscillators of 80 Hz and damping ratio 0.5, forced by white "
        "noise, anywhere in the circle alike; equivalent Gamma: the sine of the same rms displacement and velocity at "
        "80 Hz, A = epsilon / sqrt 2",
        f"small packings: plastic disks of 2 cm and 3.57 kg/m^2, 80 Hz, {small_seeds} seeds of "
        f"{wanted.small[0].seconds:g} s after 5 s",
        "three disks: 2.5 cm across, aluminium of 3 mm and steel of 10 mm, shaken up and down at 200 Hz with Gamma = "
        "1.2, at which the upper one hops without falling off, e_n = 0.9, mu = 0.1, kappa = 0.773, "
        f"{len(PHASES)} phases of {wanted.tilted[0].seconds:g} s",
        "the program has no bulk viscosity: the last row is its energy, by the velocities without it",
    ]
    title = "P 1.3, Fig. 1.10: a random bottom layer, a fixed bottom row"
    return Product(title, _rows(found), draw(found), statements(found), notes)


def _rows(found: Found) -> list[dict[str, Any]]:
    kinds = (("random", found.random), ("random, other noise", found.again), ("sine", found.sine))
    rows: list[dict[str, Any]] = [
        {
            "what": name,
            "epsilon": epsilon,
            "gamma": equivalent_gamma(epsilon),
            "mean_square_rpm": e.square.mean,
            "error": e.square.error,
            "share_same_way": e.over("faithful").mean,
            "share_steady": e.over("steady").mean,
        }
        for name, ensembles in kinds
        for epsilon, e in ensembles.items()
    ]
    rows += [
        {"what": f"{m.name}, three disks", "tilt": t, "velocity_rpm": e.mean, "error": e.error}
        for (m, t), e in found.tilted.items()
    ]
    for g, values in found.buttons.items():
        for name, numbers in (("left", values[:, 0]), ("right", values[:, 1]), ("one on two", found.single[g])):
            e = Estimate.over_runs(numbers)
            rows.append({"what": name, "gamma": g, "velocity_rpm": e.mean, "error": e.error})
    return rows


def draw(found: Found) -> Figure:
    """Rotation against the strength of shaking, shares, small packings, three disks."""
    figure = Figure(figsize=(WIDTH, 6.0), layout="constrained")
    (square, shares), (small, three) = figure.subplots(2, 2)
    _packings(square, shares, found)
    panels = (("left button", "v", CLOCKWISE), ("right button", "^", COUNTER_CLOCKWISE))
    gammas = list(found.buttons)
    for column, (name, marker, colour) in enumerate(panels):
        points = [Estimate.over_runs(found.buttons[g][:, column]) for g in gammas]
        draw_curve(small, gammas, points, name, marker=marker, color=colour, linestyle="-")
    points = [Estimate.over_runs(found.single[g]) for g in gammas]
    draw_curve(small, gammas, points, "one on two", marker="o", color="0.45", linestyle="--", mfc="white")
    small.set(xlabel=r"$\Gamma$", ylabel=r"$\bar\omega$ [RPM]", title="(c) fixed row, no tilt")
    for material, marker, line in ((ALUMINIUM, "o", "-"), (STEEL, "s", "--")):
        by_tilt = {t: e for (m, t), e in found.tilted.items() if m == material}
        style = {"marker": marker, "linestyle": line, "color": "black", "mfc": "white" if line == "--" else "black"}
        draw_curve(three, list(by_tilt), list(by_tilt.values()), material.name, **style)
    three.set(xlabel=r"tilt $\theta_T$ [degrees]", ylabel=r"$\bar\omega$ [RPM]", title="(d) three disks")
    for panel in (small, three):
        panel.axhline(0.0, color="0.6", lw=0.6, zorder=0)
        panel.legend()
    return figure


def _packings(square: Axes, shares: Axes, found: Found) -> None:
    """Both panels of packings of 60 disks, against the equivalent Gamma."""
    random = {"marker": "o", "color": "black", "linestyle": "-"}
    sine = {"marker": "s", "color": "0.5", "linestyle": "--", "mfc": "white"}
    for ensembles, name, style in ((found.random, "random bottom row", random), (found.sine, "sine", sine)):
        gammas = [equivalent_gamma(e) for e in ensembles]
        draw_curve(square, gammas, [e.square for e in ensembles.values()], name, **style)
        draw_curve(shares, gammas, [e.over("faithful") for e in ensembles.values()], f"same way, {name}", **style)
    gammas = [equivalent_gamma(e) for e in found.random]
    steady = [e.over("steady") for e in found.random.values()]
    draw_curve(shares, gammas, steady, r"$\rho^2 > 0.95$, random", marker="^", color=COUNTER_CLOCKWISE, linestyle=":")
    shares.axhline(0.125, color="0.6", lw=0.7, ls=":", label="same way by chance")
    label = r"$\Gamma$; random row: $\epsilon\omega_b^2/\sqrt{2}g$"
    square.set(xscale="log", yscale="log", xlabel=label, ylabel=r"$\langle\bar\omega^2\rangle$ [RPM$^2$]")
    shares.set(
        xscale="log",
        xlabel=label,
        ylabel="share of the free disks",
        ylim=(0.0, 1.35),
        yticks=(0, 0.2, 0.4, 0.6, 0.8, 1.0),
    )
    square.set_title("(a) 60 disks")
    shares.set_title("(b) 60 disks")
    square.legend(loc="lower right")
    shares.legend(ncols=2, fontsize=6.5, loc="upper center")
