"""P Figs 5.8 and 5.9: mean angular velocity on supports that vibrate randomly, against amplitude and tilt.

Each seed is run twice, its noise as drawn and mirrored. Both are equally likely; a disk without tilt turns
the other way in the mirror, so that the mean of the two keeps what the tilt does and loses most of the chance.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.curves import shades
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import Table
from studies.thesis.two_supports.runs import ENGINE, MARKERS, SCENE, TIME_STEP

SETTLING = 0.5
"""Time unobserved at the start of a run [s]; noise is forgotten in 1 / (c omega_b) = 0.03 s."""
AS_DRAWN, MIRRORED = 1, 3
POINTS = ("s1", "s2", "t1", "t2")
TILTS_58 = tuple(share * math.pi for share in (0.0, 0.02, 0.04, 0.06, 0.08))
AMPLITUDES_59 = (2e-5, 4e-5, 6e-5, 8e-5, 1e-4)
"""As in the captions."""
AMPLITUDES_58 = (1e-5, 2e-5, 4e-5, 6e-5, 8e-5, 1e-4)
TILTS_59 = tuple(share * math.pi for share in (0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.12))


@dataclass(frozen=True)
class Effort:
    """How long each point is run."""

    seconds: float
    """Of each run, after SETTLING."""
    seeds: int


QUICK, FULL = Effort(3.0, 4), Effort(20.0, 8)


@dataclass(frozen=True)
class Place:
    """A tilt and an amplitude of the supports."""

    tilt: float
    """theta_T [rad]."""
    amplitude: float
    """A_b [m]."""

    def run(self, seed: int, noise: int, effort: Effort) -> Run:
        """One run."""
        settings = (
            ("tilt", self.tilt),
            ("support.amplitude", self.amplitude),
            ("seed", seed),
            ("support.noise", noise),
            ("time_step", TIME_STEP),
            ("measure.start", SETTLING),
        )
        seconds = SETTLING + effort.seconds
        return Run(SCENE, ENGINE, seconds, seconds, settings, drive="random-supports")


@dataclass(frozen=True)
class Measured:
    """What pairs of runs show at a place."""

    place: Place
    paired: Estimate
    """Mean angular velocity and its standard error from pair to pair [rad/s]."""
    single: float
    """Standard error that as many runs without pairs would have [rad/s]."""
    opened: float
    """Share of the runs in which a contact opened."""
    shares: dict[str, float]
    """Share of the time at S1, S2, T1, T2."""

    def row(self) -> dict[str, Any]:
        """Data."""
        return {
            "tilt_over_pi": self.place.tilt / math.pi,
            "support_amplitude": self.place.amplitude,
            "angular_velocity": self.paired.mean,
            "standard_error": self.paired.error,
            "standard_error_without_pairs": self.single,
            "runs_with_open_contacts": self.opened,
            **{f"share_{name}": share for name, share in self.shares.items()},
        }


def measure(laboratory: Laboratory, title: str, places: Sequence[Place], effort: Effort) -> dict[Place, Measured]:
    """Run all places, each seed as drawn and mirrored."""
    seeds = range(1, effort.seeds + 1)
    runs = [place.run(seed, noise, effort) for place in places for seed in seeds for noise in (AS_DRAWN, MIRRORED)]
    tables = laboratory.run(runs, title)
    return {
        place: _measured(
            place,
            [[tables[place.run(seed, noise, effort)] for noise in (AS_DRAWN, MIRRORED)] for seed in seeds],
            effort,
        )
        for place in places
    }


def _measured(place: Place, pairs: list[list[Table]], effort: Effort) -> Measured:
    values = np.array([[table["time_averaged_angular_velocity"][-1] for table in pair] for pair in pairs])
    means = values.mean(axis=1)
    tables = [table for pair in pairs for table in pair]
    return Measured(
        place,
        Estimate.over_runs(means),
        float(values.std(ddof=1) / math.sqrt(values.size)),
        float(np.mean([table["detachments"][-1] > 0 for table in tables])),
        {
            name: float(np.mean([table[f"sliding.{name}.time"][-1] for table in tables])) / effort.seconds
            for name in POINTS
        },
    )


def _effort(quick: bool, seeds: int | None) -> Effort:
    chosen = QUICK if quick else FULL
    return Effort(chosen.seconds, seeds or chosen.seeds)


def _notes(effort: Effort) -> list[str]:
    return [
        "omega_b = 20 pi rad/s, c = 0.5, k_n = 1e3 N/m, k_t = 1e6 N/m, gamma_n = 10 kg/s, mu = 0.1, g = 10 m/s^2",
        f"each point: {effort.seeds} seeds (1 to {effort.seeds}), each as drawn and mirrored, {effort.seconds:g} s "
        f"after {SETTLING:g} s; error bars: standard error from pair to pair",
        "points at which a contact opened in some run are drawn pale; the thesis leaves them out",
    ]


def _draw(panel: Axes, points: Sequence[Measured], at: Sequence[float], label: str, style: dict[str, Any]) -> None:
    means, errors = [p.paired.mean for p in points], [p.paired.error for p in points]
    lasting = [p.opened == 0.0 for p in points]
    panel.errorbar(
        at, means, yerr=errors, fmt="-", lw=0.7, capsize=1.5, elinewidth=0.7, color=style["color"], alpha=0.6
    )
    for chosen, alpha, name in ((True, 1.0, label), (False, 0.3, None)):
        inside = [(x, m) for x, m, keep in zip(at, means, lasting, strict=True) if keep is chosen]
        if inside or name:
            x, y = zip(*inside, strict=True) if inside else ((), ())
            panel.plot(x, y, style["marker"], color=style["color"], mfc="white", ms=4.5, alpha=alpha, label=name)
    panel.axhline(0.0, color="0.5", lw=0.5, zorder=0)


def against_amplitude(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Figure 5.8."""
    effort = _effort(quick, seeds)
    tilts = TILTS_58[::2] if quick else TILTS_58
    amplitudes = AMPLITUDES_58[1::2] if quick else AMPLITUDES_58
    found = measure(laboratory, "figure 5.8", [Place(t, a) for t in tilts for a in amplitudes], effort)
    figure = Figure(figsize=(0.8 * WIDTH, 3.8), layout="constrained")
    panel = figure.subplots()
    for tilt, colour in zip(tilts, shades(len(tilts)), strict=True):
        line = [found[Place(tilt, amplitude)] for amplitude in amplitudes]
        label = rf"$\theta_T$ = {tilt / math.pi:.2f} $\pi$"
        style = {"color": colour, "marker": MARKERS[TILTS_58.index(tilt)]}
        _draw(panel, line, [1e5 * a for a in amplitudes], label, style)
    panel.set(xlabel="$A_b$ [$10^{-5}$ m]", ylabel=r"$\bar\omega$ [rad/s]")
    panel.legend()
    stated = _amplitude_statements(found, tilts, amplitudes)
    rows = [measured.row() for measured in found.values()]
    return Product("Figure 5.8: random supports, against amplitude", rows, figure, stated, _notes(effort))


def _amplitude_statements(
    found: dict[Place, Measured], tilts: Sequence[float], amplitudes: Sequence[float]
) -> list[Statement]:
    upright = [found[Place(0.0, a)] for a in amplitudes]
    tilted = [m for m in found.values() if m.place.tilt > 0.0 and m.opened == 0.0]
    strongest = min(tilted, key=lambda m: m.paired.mean / m.paired.error)
    falling, opening = [], {}
    for tilt in tilts[1:]:
        line = [found[Place(tilt, a)] for a in amplitudes if found[Place(tilt, a)].opened == 0.0]
        falling += [
            a.paired.mean - b.paired.mean > -2.0 * math.hypot(a.paired.error, b.paired.error) for a, b in pairwise(line)
        ]
    for tilt in tilts:
        opening[tilt] = min((a for a in amplitudes if found[Place(tilt, a)].opened > 0.0), default=math.inf)
    gain = float(np.mean([(m.single / m.paired.error) ** 2 for m in tilted]))
    return [
        Statement(
            "5.3.2",
            "without tilt the disk does not rotate",
            "; ".join(f"{m.place.amplitude:.0e}: {m.paired}" for m in upright)
            + " rad/s (mirrored pairs cancel there by symmetry)",
            verdict(all(abs(m.paired.mean) <= 3.5 * m.paired.error + 1e-12 for m in upright)),
        ),
        Statement(
            "5.3.2",
            "for positive tilt the rotation is negative, opposite to that under a torque",
            _counted(tilted) + f"; most certain: {strongest.paired} rad/s at {strongest.place.tilt / math.pi:.2f} pi, "
            f"{strongest.place.amplitude:.0e} m; pairs save a factor {gain:.1f} of runs",
            _sign(tilted),
        ),
        Statement(
            "5.3.2",
            "the velocity is monotonic in the amplitude until a contact opens",
            f"{sum(falling)} of {len(falling)} steps fall, or hold within 2 errors",
            verdict(all(falling)),
        ),
        Statement(
            "5.3.2",
            "with tilt contacts open at smaller amplitudes",
            "first amplitude with an open contact: "
            + ", ".join(f"{t / math.pi:.2f} pi: {a:.0e}" for t, a in opening.items()),
            verdict(list(opening.values()) == sorted(opening.values(), reverse=True)),
        ),
        Statement(
            "5.3.3",
            "S1, S2, T1 and T2 are all accessible; each is visited as often (N/4)",
            "shares of the time, means over all tilted points: "
            + ", ".join(f"{n.upper()} {np.mean([m.shares[n] for m in tilted]):.2f}" for n in POINTS),
            _alike(tilted),
        ),
    ]


def _alike(tilted: Sequence[Measured]) -> Verdict:
    shares = [float(np.mean([m.shares[name] for m in tilted])) for name in POINTS]
    if min(shares) < 0.005:
        return Verdict.DISAGREES
    return Verdict.AGREES if max(shares) < 2.0 * min(shares) else Verdict.PARTLY


def _counted(tilted: Sequence[Measured]) -> str:
    below = sum(m.paired.mean < -2.0 * m.paired.error for m in tilted)
    above = sum(m.paired.mean > 2.0 * m.paired.error for m in tilted)
    return f"{below} of {len(tilted)} points below zero by 2 errors, {above} above"


def _sign(tilted: Sequence[Measured]) -> Verdict:
    below = sum(m.paired.mean < -2.0 * m.paired.error for m in tilted)
    above = sum(m.paired.mean > 3.0 * m.paired.error for m in tilted)
    if above:
        return Verdict.DISAGREES if above > below else Verdict.PARTLY
    return Verdict.AGREES if below > len(tilted) // 3 else Verdict.OPEN


def against_tilt(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Figure 5.9."""
    effort = _effort(quick, seeds)
    amplitudes = AMPLITUDES_59[1::2] if quick else AMPLITUDES_59
    tilts = TILTS_59[::2] if quick else TILTS_59
    found = measure(laboratory, "figure 5.9", [Place(t, a) for a in amplitudes for t in tilts], effort)
    figure = Figure(figsize=(WIDTH, 3.8), layout="constrained")
    panel, torque = figure.subplots(1, 2, width_ratios=(2, 1))
    for amplitude, colour in zip(amplitudes, shades(len(amplitudes)), strict=True):
        line = [found[Place(tilt, amplitude)] for tilt in tilts]
        style = {"color": colour, "marker": MARKERS[AMPLITUDES_59.index(amplitude)]}
        _draw(panel, line, [tilt / math.pi for tilt in tilts], f"$A_b$ = {amplitude:.0e}", style)
    panel.set(xlabel=r"$\theta_T$ [$\pi$]", ylabel=r"$\bar\omega$ [rad/s]")
    panel.legend()
    dense = [float(tilt) for tilt in np.linspace(0.0, 0.134 * math.pi, 50)]
    means = laboratory.theory(SCENE, "torques", tilt=dense)
    torque.plot(np.array(dense) / math.pi, 1e3 * means["mean"], "k-", lw=1.0, label="S and T, 5.21")
    torque.plot(np.array(dense) / math.pi, 1e3 * means["mean_of_S"], "k--", lw=1.0, label="S alone")
    torque.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    torque.set(xlabel=r"$\theta_T$ [$\pi$]", ylabel=r"mean torque [$10^{-3}$ N m]", title="theory")
    torque.legend()
    stated = _tilt_statements(found, tilts, amplitudes, float(means["mean"][-1]), float(means["mean_of_S"][-1]))
    rows = [measured.row() for measured in found.values()]
    return Product("Figure 5.9: random supports, against tilt", rows, figure, stated, _notes(effort))


def _tilt_statements(
    found: dict[Place, Measured], tilts: Sequence[float], amplitudes: Sequence[float], mean: float, alone: float
) -> list[Statement]:
    lines = {a: [found[Place(t, a)] for t in tilts if found[Place(t, a)].opened == 0.0] for a in amplitudes}
    lowest = {a: min(line, key=lambda m: m.paired.mean) for a, line in lines.items()}
    back = {
        a: any(
            m.paired.mean - lowest[a].paired.mean > 2.0 * math.hypot(m.paired.error, lowest[a].paired.error)
            for m in line
            if m.place.tilt > lowest[a].place.tilt
        )
        for a, line in lines.items()
    }
    tilted = [m for line in lines.values() for m in line if m.place.tilt > 0.0]
    return [
        Statement(
            "5.3.2",
            "as the tilt grows the velocity falls to a minimum and comes back towards zero",
            "; ".join(
                f"{a:.0e}: {m.paired} rad/s at {m.place.tilt / math.pi:.2f} pi, "
                f"back for certain: {'yes' if back[a] else 'no'}"
                for a, m in lowest.items()
            ),
            Verdict.AGREES if all(back.values()) else (Verdict.PARTLY if any(back.values()) else Verdict.OPEN),
        ),
        Statement(
            "5.3.2",
            "negative rotation for positive tilt",
            _counted(tilted),
            _sign(tilted),
        ),
        Statement(
            "5.3.3",
            "the mean torque of S1, S2, T1, T2 (5.21) is negative, that of S1, S2 alone positive",
            f"at 0.134 pi {mean:.2e} and {alone:.2e} N m",
            verdict(mean < 0.0 < alone),
        ),
    ]
