"""P 6, 6.2 and 6.3.2: a disk on two vibrating disks beside one in a vibrating wedge, as the excitation grows.

Both by molecular dynamics of the same scene, which differ in the shape of the supports only. The frequency falls at a
fixed Gamma, so that the flights grow beside the disks; contacts soften with the square of the frequency, so that they
take the same part of a period. A wedge has no length: its scaled velocity must not change.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.errors import LabError
from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import Table
from jostle_lab.verdicts import Judgement, Verdict, every, near, true

GRAVITY, RADIUS, MASS, GAMMA = 9.81, 0.02, 4.5e-3, 2.0
REFERENCE_FREQUENCY, REFERENCE_STIFFNESS, REFERENCE_DAMPING = 80.0, 1e6, 4.64
"""k_n [N/m] and gamma_n [kg/s] at 80 Hz: e_n = 0.9, contacts of 0.2 ms."""
FREQUENCIES = (320.0, 160.0, 113.0, 80.0, 57.0, 40.0)
"""l_0 / R from 5e-4 to 3e-2: beyond, the disk falls off within some hundred periods."""
WALLS_AT = (320.0, 40.0)
TILTS = (8.0, 20.0)
"""[degrees]: on both sides of the change of sense."""
PERIODS, UNOBSERVED = 3000, 0.1
PHASES = (0.0, 2.1, 4.2)
"""Of the drive at the start [rad]: runs that chaos makes independent; the scene has no seed."""
DISKS, WALLS = 1, 2
HALF_ANGLE = 30.0
"""theta_0 of three equal disks [degrees]."""
SAME = 0.1
"""Velocities within this part of the largest are the same."""
TRIAL_FREQUENCY = 250.0
"""Of a trial [Hz]: the way over the lower disk is as high in flights as the lowest at which no disk fell off."""


@dataclass(frozen=True)
class Place:
    """Shape of the supports, tilt and frequency."""

    shape: int
    tilt: float
    """[degrees]."""
    frequency: float
    """[Hz]."""

    @property
    def speed(self) -> float:
        """A omega_b [m/s]."""
        return GAMMA * GRAVITY / (math.tau * self.frequency)

    @property
    def size(self) -> float:
        """l_0 / R: height of the flights over the radius."""
        return self.speed**2 / GRAVITY / RADIUS

    @property
    def barrier(self) -> float:
        """Height to be climbed over the lower of two supporting disks, over the height of the flights.

        The centre moves on a circle of 2 R about that of the support, theta_0 - theta_T away from its top.
        """
        return 2.0 * (1.0 - math.cos(math.radians(HALF_ANGLE - self.tilt))) / self.size

    def run(self, phase: float, periods: int) -> Run:
        """One run."""
        slower = self.frequency / REFERENCE_FREQUENCY
        seconds = periods / self.frequency
        settings = (
            ("gravity", GRAVITY),
            ("tilt", math.radians(self.tilt)),
            ("support.shape", self.shape),
            ("disk.radius", RADIUS),
            ("disk.mass", MASS),
            ("disk.drop_height", self.speed**2 / GRAVITY),
            ("contact.normal_stiffness", REFERENCE_STIFFNESS * slower**2),
            ("contact.stiffness_ratio", 0.773),
            ("contact.normal_damping", REFERENCE_DAMPING * slower),
            ("contact.friction", 0.1),
            ("drive.frequency", self.frequency),
            ("drive.amplitude", self.speed / (math.tau * self.frequency)),
            ("drive.phase", phase),
            ("measure.start", UNOBSERVED * seconds),
        )
        return Run("three_disk", "molecular-dynamics", seconds, seconds, settings)


@dataclass(frozen=True)
class Measured:
    """Runs of a place."""

    place: Place
    velocity: Estimate
    """R omega / (A omega_b)."""
    fallen: int
    """Runs whose disk has left the supports."""
    runs: int


def observed(laboratory: Laboratory, run: Run) -> Table:
    """Last angular velocity of a run [rad/s], and whether its disk has fallen off, which ends the run with an error."""

    def compute() -> tuple[Table, float]:
        plain, begun = replace(laboratory, records=None), time.perf_counter()
        try:
            table = plain.run([run], "three disks")[run]
        except LabError as error:
            if "has fallen off its supports" not in str(error):
                raise
            return {"velocity": np.array([math.nan]), "fallen": np.array([1.0])}, time.perf_counter() - begun
        return {"velocity": table["time_averaged_angular_velocity"][-1:], "fallen": np.array([0.0])}, plain.spent

    return laboratory.computed(run.key(), compute)


def measured(place: Place, tables: Sequence[Table]) -> Measured:
    """Runs of a place; NaN if some disk has fallen off."""
    values = np.array([float(t["velocity"][0]) * RADIUS / place.speed for t in tables])
    return Measured(place, Estimate.over_runs(values), sum(int(t["fallen"][0]) for t in tables), len(values))


def make(laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
    """Disks at five frequencies, walls at two, two tilts."""
    periods = PERIODS // 10 if quick else PERIODS
    places = [Place(DISKS, t, f) for t in TILTS for f in FREQUENCIES] + [
        Place(WALLS, t, f) for t in TILTS for f in WALLS_AT
    ]
    found = {p: measured(p, [observed(laboratory, p.run(phase, periods)) for phase in PHASES]) for p in places}
    trial = Place(DISKS, TILTS[1], TRIAL_FREQUENCY)
    tried = measured(trial, [observed(laboratory, trial.run(phase, periods)) for phase in PHASES])
    rows: list[dict[str, Any]] = [
        {
            "shape": "disks" if p.shape == DISKS else "walls",
            "tilt_deg": p.tilt,
            "frequency": p.frequency,
            "flight_over_radius": p.size,
            "scaled_angular_velocity": m.velocity.mean,
            "error": m.velocity.error,
            "fallen_off": m.fallen,
        }
        for p, m in found.items()
    ]
    notes = [
        f"scene three_disk, supports shaken up and down, disks or walls of 120 degrees; Gamma = {GAMMA:g}, R = 0.02 m, "
        "m = 4.5 g, e_n = 0.9, mu = 0.1, kappa = 0.773, k_n = 1e6 N/m at 80 Hz and as the square of the frequency",
        f"each point: {len(PHASES)} runs of {periods} periods from different phases, the first "
        f"{UNOBSERVED:.0%} unobserved",
        "excitation: l_0 / R = (A omega_b)^2 / (g R)",
    ]
    return Product("Three disks beside a wedge", rows, draw(found), statements(found, tried), notes)


def draw(found: dict[Place, Measured]) -> Figure:
    """Scaled velocity against the size of the flights."""
    figure = Figure(figsize=(0.85 * WIDTH, 3.8), layout="constrained")
    panel = figure.subplots()
    for tilt, colour, marker in zip(TILTS, ("#14406f", "#c0272d"), "os", strict=True):
        for shape, line, fill, name in ((DISKS, "-", "white", "disks"), (WALLS, "--", colour, "wedge")):
            chosen = [m for p, m in found.items() if p.tilt == tilt and p.shape == shape and m.fallen == 0]
            label = rf"{name}, $\theta_T$ = {tilt:g}$\degree$"
            style = {"marker": marker, "color": colour, "mfc": fill, "linestyle": line}
            draw_curve(panel, [m.place.size for m in chosen], [m.velocity for m in chosen], label, **style)
    lost = [p.size for p, m in found.items() if m.fallen > 0]
    if lost:
        panel.axvspan(min(lost) / 1.1, max(lost) * 1.1, color="0.85", label="the disk falls off")
    panel.axhline(0.0, color="0.5", lw=0.6, zorder=0)
    panel.set(xscale="log", xlabel=r"$\ell_0/R = (A\omega_b)^2/gR$", ylabel=r"$R\bar\omega/A\omega_b$")
    figure.legend(loc="outside upper center", ncols=3)
    return figure


def _near(
    found: dict[Place, Measured], frequencies: Sequence[float], scale: float
) -> tuple[list[str], list[Judgement]]:
    """Disks less walls at these frequencies."""
    text, judged = [], []
    for tilt in TILTS:
        wall = found[Place(WALLS, tilt, WALLS_AT[0])].velocity
        for f in frequencies:
            disk = found[Place(DISKS, tilt, f)]
            if disk.fallen:
                text.append(f"{tilt:g} degrees, l_0 / R = {disk.place.size:.2g}: {disk.fallen} of {disk.runs} fell off")
                judged.append(true(False, ""))
                continue
            rest = Estimate(disk.velocity.mean - wall.mean, math.hypot(disk.velocity.error, wall.error))
            text.append(f"{tilt:g} degrees, l_0 / R = {disk.place.size:.2g}: {rest}")
            judged.append(near(rest, 0.0, SAME * scale))
    return text, judged


def cause(found: dict[Place, Measured], trial: Measured) -> str:
    """Why they differ at the second smallest intensity."""
    disks = [m for p, m in found.items() if p.shape == DISKS]
    gone = [m.place.barrier for m in disks if m.fallen]
    stayed = [m.place.barrier for m in disks if not m.fallen]
    slopes = []
    for m in disks:
        if m.place.tilt == TILTS[0] and not m.fallen and m.place.frequency < FREQUENCIES[0]:
            wall = found[Place(WALLS, TILTS[0], WALLS_AT[0])].velocity
            error = math.hypot(m.velocity.error, wall.error)
            slope = Estimate((m.velocity.mean - wall.mean) / m.place.size, error / m.place.size)
            slopes.append(f"{slope} at {m.place.size:.2g}")
    return (
        "small is small beside what keeps the disk in its place: the way over the lower disk is 2 R (1 - cos(theta_0 - "
        f"theta_T)) high, at {TILTS[1]:g} degrees a fifth of that at {TILTS[0]:g}. Runs fell off where that is up to "
        f"{max(gone, default=math.nan):.0f} l_0 and none where it is {min(stayed, default=math.nan):.0f} l_0 or more; "
        f"at {TILTS[1]:g} degrees l_0 / R = {Place(DISKS, TILTS[1], FREQUENCIES[1]).size:.2g} is "
        f"{Place(DISKS, TILTS[1], FREQUENCIES[1]).barrier:.0f} l_0. Trial at {trial.place.barrier:.0f} l_0, l_0 / R = "
        f"{trial.place.size:.2g}: {trial.fallen} of {trial.runs} fell off, R omega / (A omega_b) = {trial.velocity}. "
        f"At {TILTS[0]:g} degrees the difference over l_0 / R is {', '.join(slopes)}: proportional to it, so that it "
        "goes to zero as P says, and no number says how soon"
    )


def statements(found: dict[Place, Measured], trial: Measured) -> list[Statement]:
    """What P 6, 6.2 and 6.3.2 say of the two; `trial` is a place between."""
    scale = max(abs(m.velocity.mean) for p, m in found.items() if p.shape == WALLS)
    small, equal = _near(found, FREQUENCIES[:2], scale)
    large, differ = _near(found, FREQUENCIES[2:], scale)
    rule = f"disks less wedge within {SAME:.0%} of the strongest rotation"
    lost = [m for m in found.values() if m.fallen]
    walls = [
        (found[Place(WALLS, t, WALLS_AT[0])].velocity, found[Place(WALLS, t, WALLS_AT[1])].velocity) for t in TILTS
    ]
    rests = [Estimate(a.mean - b.mean, math.hypot(a.error, b.error)) for a, b in walls]
    return [
        Statement.judged(
            "6, 6.2, 6.3.2",
            "at small intensity the three disks and the wedge are the same",
            "R omega / (A omega_b), disks less wedge: " + "; ".join(small),
            every(equal, f"{rule}, with the interval of two errors"),
            cause(found, trial),
        ),
        Statement.judged(
            "6.2, 6.3.2",
            "they differ for high intensity, where the disk feels the curvature: no scaling with v_b for three disks",
            "R omega / (A omega_b), disks less wedge: " + "; ".join(large),
            _differs(differ, rule),
            "four times as long runs, half an hour of one processor, would tell",
        ),
        Statement.judged(
            "6.2",
            "the upper disk falls out of place if the excitation is too large",
            f"{sum(m.fallen for m in lost)} runs fell off, from l_0 / R = "
            f"{min((m.place.size for m in lost), default=math.inf):.2g} on",
            Judgement(Verdict.AGREES if lost else Verdict.OPEN, "some run does, none in a wedge; no chance"),
            "larger excitations were not run",
        ),
        Statement.judged(
            "6.2, 6.3.2",
            "the wedge is scale invariant",
            f"wedge at {WALLS_AT[0]:g} less {WALLS_AT[1]:g} Hz: "
            + "; ".join(f"{t:g} degrees: {e}" for t, e in zip(TILTS, rests, strict=True)),
            every([near(e, 0.0, SAME * scale) for e in rests], f"within {SAME:.0%} of the strongest, with two errors"),
            "four times as long runs, half an hour of one processor, would tell",
        ),
    ]


def _differs(judged: Sequence[Judgement], rule: str) -> Judgement:
    """At the largest intensity of each tilt the two are not the same."""
    last = judged[len(judged) // 2 - 1 :: len(judged) // 2]
    found = {j.verdict for j in last}
    text = f"at the largest intensity, at each tilt, not {rule}"
    if found == {Verdict.DISAGREES}:
        return Judgement(Verdict.AGREES, text)
    return Judgement(Verdict.DISAGREES if found == {Verdict.AGREES} else Verdict.OPEN, text)
