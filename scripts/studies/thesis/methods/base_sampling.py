"""P 2.3.3: the base that stays in place and moves at impacts only, sinusoidal or sawtooth, and its rejected draws."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.integrate import quad
from scipy.optimize import brentq

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate, chi_square
from jostle_lab.statistics.rotation import RPM
from jostle_lab.verdicts import Judgement, Verdict, below, every, exact, true
from studies.thesis.packing.runs import RANDOM_PHASE, shaken
from studies.thesis.wedge.curves import Wedge

SINE, SAWTOOTH = 1, 2
"""Values of base.profile."""
TILTS = (2.0, 5.0, 8.0, 11.0, 17.0, 20.0, 23.0, 26.0)
"""[degrees]; not near 14, where the rotation changes its sense."""
LONG, SHORT = 1e6, 2e5
"""Of a run of the map, in units of A omega_b / g."""
SEEDS = 4
GAMMAS = (2.0, 5.0, 10.0)
PACKINGS, SECONDS, SETTLING = 10, 30, 5


@dataclass(frozen=True)
class Sampled:
    """A tilt with both profiles."""

    tilt: float
    sine: Estimate
    """R omega / (A omega_b)."""
    sawtooth: Estimate
    rejected: float
    """Share of the draws of the sine that are rejected."""

    @property
    def ratio(self) -> Estimate:
        """Sawtooth over sine."""
        mean = self.sawtooth.mean / self.sine.mean
        parts = (self.sawtooth.error / self.sawtooth.mean, self.sine.error / self.sine.mean)
        return Estimate(mean, abs(mean) * math.hypot(*parts))


@dataclass(frozen=True)
class Shaken:
    """Packings at a Gamma with both profiles."""

    gamma: float
    ratio: Estimate
    """<omega^2> with the sawtooth over that with the sine, packing by packing the same."""
    rejected: Estimate
    """Share of the draws of the sine that are rejected."""


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """The map of the wedge and packings, with both profiles; moments of the density by quadrature."""
    duration = SHORT if quick else LONG
    wedge = _wedge(laboratory, TILTS[::3] if quick else TILTS, duration)
    packings = _packings(laboratory, GAMMAS[:1] if quick else GAMMAS, 3 if quick else PACKINGS)
    rows: list[dict[str, Any]] = [
        {
            "tilt_deg": s.tilt,
            "sine": s.sine.mean,
            "sine_error": s.sine.error,
            "sawtooth": s.sawtooth.mean,
            "sawtooth_error": s.sawtooth.error,
            "rejected": s.rejected,
        }
        for s in wedge
    ]
    return Product(
        "P 2.3.3: base of random phase, sinusoidal and sawtooth",
        rows,
        draw(wedge),
        [*_profiles(wedge, packings), *_rejections(wedge, packings), *_moments()],
        [
            f"map of the wedge: theta_W = 120 degrees, mu = 0.1, e_n = 0.9, kappa = 0.773, {SEEDS} seeds of "
            f"{duration:g} A omega_b / g; packings: event-driven, k_n = 1e4 N/m, {PACKINGS} seeds of {SECONDS} s after "
            f"{SETTLING} s",
            "moments: quadrature of 2.40 as corrected, over the phases at which a ray first meets the base",
        ],
    )


def _wedge(laboratory: Laboratory, tilts: Sequence[float], duration: float) -> list[Sampled]:
    shape = Wedge()

    def run(tilt: float, profile: int, seed: int) -> Run:
        plain = shape.run(tilt, seed, duration * shape.time)
        return replace(plain, settings=(*plain.settings, ("base.profile", profile)))

    seeds = range(1, SEEDS + 1)
    runs = {(t, p, s): run(t, p, s) for t in tilts for p in (SINE, SAWTOOTH) for s in seeds}
    tables = laboratory.run(list(runs.values()), "2.3.3, wedge")

    def scaled(tilt: float, profile: int) -> Estimate:
        ends = [tables[runs[tilt, profile, seed]]["scaled_angular_velocity"][-1] for seed in seeds]
        return Estimate.over_runs(np.array(ends))

    def rejected(tilt: float) -> float:
        ends = [tables[runs[tilt, SINE, seed]] for seed in seeds]
        return float(sum(e["base.rejected_draws"][-1] for e in ends) / sum(e["base.draws"][-1] for e in ends))

    return [Sampled(t, scaled(t, SINE), scaled(t, SAWTOOTH), rejected(t)) for t in tilts]


def _packings(laboratory: Laboratory, gammas: Sequence[float], packings: int) -> list[Shaken]:
    def run(gamma: float, profile: int, seed: int) -> Run:
        settings = (*shaken(RANDOM_PHASE, 1e4, gamma, seed, SETTLING), ("base.profile", profile))
        whole = float(SETTLING + SECONDS)
        return Run("packing", RANDOM_PHASE.engine, whole, whole, settings)

    seeds = range(1, packings + 1)
    runs = {(g, p, s): run(g, p, s) for g in gammas for p in (SINE, SAWTOOTH) for s in seeds}
    tables = laboratory.run(list(runs.values()), "2.3.3, packings")
    found = []
    for gamma in gammas:
        squares = {
            p: np.array([tables[runs[gamma, p, s]]["rotation.mean_square"][-1] for s in seeds]) / RPM**2
            for p in (SINE, SAWTOOTH)
        }
        ends = [tables[runs[gamma, SINE, s]] for s in seeds]
        shares = np.array([e["base.rejected_draws"][-1] / e["base.draws"][-1] for e in ends])
        ratio = Estimate.over_runs(squares[SAWTOOTH] / squares[SINE])
        found.append(Shaken(gamma, ratio, Estimate.over_runs(shares)))
    return found


def draw(wedge: Sequence[Sampled]) -> Figure:
    """Both curves, and their ratio."""
    figure = Figure(figsize=(WIDTH, 3.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    tilts = [s.tilt for s in wedge]
    draw_curve(left, tilts, [s.sine for s in wedge], "sinusoidal base", marker="o", color="black")
    draw_curve(left, tilts, [s.sawtooth for s in wedge], "sawtooth base", marker="s", color="0.5", mfc="white")
    draw_curve(right, tilts, [s.ratio for s in wedge], "ratio", marker="^", color="black")
    for panel in (left, right):
        panel.set_xlabel(r"tilt $\theta_T$ [degrees]")
    left.axhline(0.0, color="0.6", lw=0.6)
    left.set_ylabel(r"$R\bar\omega/A\omega_b$")
    right.set_ylabel("sawtooth over sinusoidal")
    left.legend()
    return figure


def constant(ratios: Sequence[Estimate], margin: float) -> tuple[Estimate, float, Judgement]:
    """Weighted mean of ratios, chi^2 per degree of freedom, and whether all are that mean to a margin."""
    weights = np.array([1.0 / r.error**2 for r in ratios])
    mean = Estimate(float(np.sum(weights * [r.mean for r in ratios]) / weights.sum()), float(weights.sum()) ** -0.5)
    chi, _ = chi_square([r.mean - mean.mean for r in ratios], [r.error for r in ratios], lost=1)
    rule = f"every ratio within {100.0 * margin:.0f} % of the common one, with its interval of two errors"
    inside = [abs(r.mean - mean.mean) + 2.0 * r.error <= margin * mean.mean for r in ratios]
    outside = [abs(r.mean - mean.mean) - 2.0 * r.error > margin * mean.mean for r in ratios]
    if any(outside):
        return mean, chi, Judgement(Verdict.DISAGREES, rule)
    return mean, chi, Judgement(Verdict.AGREES if all(inside) else Verdict.OPEN, rule)


def _profiles(wedge: Sequence[Sampled], packings: Sequence[Shaken]) -> list[Statement]:
    ratios = [s.ratio for s in wedge]
    mean, chi, judgement = constant(ratios, 0.2)
    text = ", ".join(f"{s.tilt:g}: {s.ratio}" for s in wedge)
    return [
        Statement.judged(
            "2.3.3",
            "a sawtooth base gives the same wedge results as the sinusoidal one but for a constant factor",
            f"by tilt [degrees]: {text}; common {mean}, chi^2 per degree of freedom {chi:.1f}",
            judgement,
            CAUSES["factor"],
        ),
        Statement.judged(
            "2.3.3",
            "other distributions of the base velocity do not change results qualitatively",
            "the sense of rotation is the same at "
            f"{sum(s.ratio.mean > 0.0 for s in wedge)} of {len(wedge)} tilts; packings, <omega^2> with the sawtooth "
            "over that with the sine: " + ", ".join(f"Gamma = {p.gamma:g}: {p.ratio}" for p in packings),
            every(
                [true(r.mean - 2.0 * r.error > 0.0, "") for r in ratios], "the same sense at every tilt, by two errors"
            ),
            CAUSES["sense"],
        ),
    ]


def _rejections(wedge: Sequence[Sampled], packings: Sequence[Shaken]) -> list[Statement]:
    shares = [s.rejected for s in wedge]
    return [
        Statement.judged(
            "2.3.3",
            "draws are rejected rarely where ED is valid",
            "share of the draws: wedge "
            + ", ".join(f"{s.tilt:g} degrees: {s.rejected:.3f}" for s in wedge)
            + "; packings "
            + ", ".join(f"Gamma = {p.gamma:g}: {p.rejected}" for p in packings),
            every(
                [below(Estimate(max(shares), 0.002), 0.05), *(below(p.rejected, 0.05) for p in packings)], "below 5 %"
            ),
            CAUSES["rejected"],
        )
    ]


def first_met(x: float) -> tuple[float, float]:
    """Phases between which a ray that falls with x = |v_n| / (A omega_b) first meets the sine.

    The last is where the base recedes as fast as the ray falls. A ray just above passes the base there and meets its
    next rise, which is the first phase; P fits a line to it (2.41), here it is solved for.
    """
    if x >= 1.0:
        return -math.pi, math.pi
    last = math.acos(-x)
    level = math.sin(last) + x * (last - math.tau)
    first = brentq(lambda tau: math.sin(tau) + x * tau - level, -last, last - 1e-9)
    return float(first), last


def moments(x: float) -> tuple[float, float]:
    """<v_b> and <v_b^2> in units of A omega_b and its square: means of the phases weighted by cos tau + x."""
    low, high = first_met(x)

    def mean(power: int) -> float:
        return float(quad(lambda t: math.cos(t) ** power * (math.cos(t) + x), low, high, epsabs=1e-12)[0])

    return mean(1) / mean(0), mean(2) / mean(0)


def _moments() -> list[Statement]:
    beyond = {x: moments(x) for x in (1.5, 3.0, 10.0)}
    slow = {x: moments(x) for x in (0.1, 0.01, 0.001)}
    first = max(abs(m[0] - 0.5 / x) for x, m in beyond.items())
    second = max(abs(m[1] - 0.5) for m in beyond.values())
    return [
        Statement.judged(
            "2.45",
            "fast disks: <v_b> = A omega_b / (2 beta), beta = |v_n| / (A omega_b) > 1",
            f"largest difference at beta = 1.5, 3, 10: {first:.0e} A omega_b",
            exact(first, 1e-9),
        ),
        Statement.judged(
            "2.46",
            "fast disks: <v_b^2> = (A omega_b)^2 / 2",
            f"largest difference at beta = 1.5, 3, 10: {second:.0e}",
            exact(second, 1e-9),
        ),
        Statement.judged(
            "2.3.3",
            "at zero normal velocity the disk always meets the base at its largest velocity",
            "<v_b> / (A omega_b): " + ", ".join(f"beta = {x:g}: {m[0]:.3f}" for x, m in slow.items()),
            true(slow[0.001][0] > 0.9, "<v_b> above 0.9 A omega_b at beta = 0.001; no chance"),
            CAUSES["slow"],
        ),
    ]


CAUSES = {
    "factor": "",
    "sense": "",
    "rejected": "",
    "slow": "a slip in P: a slow disk is met by the base where it is highest, and there it is at rest; v_b goes to 0",
}
"""Why ours differs, by statement."""
