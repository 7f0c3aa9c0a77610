"""Runs of one disk in a wedge (P 6), and curves of its scaled angular velocity against tilt."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statistics.estimates import Estimate, chi_square, pooled
from jostle_lab.tables import Table
from studies.examples import example

GRAVITY = 9.81
RADIUS = 0.02
NORMAL_STIFFNESS, NORMAL_DAMPING, MASS = 4.5e6, 9.84, 4.5e-3
"""k_n [N/m], gamma_n [kg/s] and m [kg] of the molecular dynamics; e_n is 0.89916."""
UNOBSERVED = 0.1
"""Fraction of a run that is left out at its start."""

TILTS: tuple[float, ...] = (0.0, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0)
TILTS += (19.0, 20.0, 21.0, 22.0, 23.0, 24.0, 25.0, 26.0, 27.0, 28.0, 28.5, 29.0, 29.5)
QUICK_TILTS = (0.0, 4.0, 8.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0, 24.0, 26.0, 28.0, 29.0)
"""Tilts [degrees] of a wedge of 120 degrees, whose critical tilt is 30."""


@dataclass(frozen=True)
class Wedge:
    """Wedge, contact, drive and engine; the tilt comes with the run."""

    engine: str = "map"
    gamma: float = 2.0
    """A omega_b^2 / g."""
    angular_frequency: float = math.tau * 80.0
    """omega_b [1/s]."""
    aperture: float = 120.0
    """theta_W [degrees]."""
    friction: float = 0.1
    stiffness_ratio: float = 0.773
    restitution: float = 0.9
    """e_n; molecular dynamics have k_n and gamma_n instead."""

    @property
    def base_velocity(self) -> float:
        """A omega_b [m/s]."""
        return self.gamma * GRAVITY / self.angular_frequency

    @property
    def time(self) -> float:
        """Time scale A omega_b / g [s]."""
        return self.base_velocity / GRAVITY

    @property
    def critical_tilt(self) -> float:
        """Tilt at which a wall is horizontal [degrees]."""
        return 90.0 - 0.5 * self.aperture

    def columns(self) -> dict[str, Any]:
        """Parameters for a row of data."""
        return {
            "engine": self.engine,
            "gamma": self.gamma,
            "angular_frequency": self.angular_frequency,
            "aperture_deg": self.aperture,
            "friction": self.friction,
            "stiffness_ratio": self.stiffness_ratio,
            "restitution": self.restitution,
        }

    def run(self, tilt: float, seed: int, seconds: float) -> Run:
        """A run at `tilt` [degrees]."""
        settings: list[tuple[str, float]] = [
            ("seed", seed),
            ("gravity", GRAVITY),
            ("wedge.aperture", math.radians(self.aperture)),
            ("wedge.tilt", math.radians(tilt)),
            ("disk.radius", RADIUS),
            ("disk.mass", MASS),
            ("disk.drop_height", min(self.base_velocity * self.time, 1e3)),
            ("measure.start", UNOBSERVED * seconds),
            ("contact.stiffness_ratio", self.stiffness_ratio),
            ("contact.friction", self.friction),
            ("drive.amplitude", self.base_velocity / self.angular_frequency),
            ("drive.frequency", self.angular_frequency / math.tau),
        ]
        if self.engine == "molecular-dynamics":
            settings += [("contact.normal_stiffness", NORMAL_STIFFNESS), ("contact.normal_damping", NORMAL_DAMPING)]
        else:
            settings.append(("collision.restitution", self.restitution))
        return Run("wedge", self.engine, seconds, seconds, tuple(settings))


@dataclass(frozen=True)
class Effort:
    """How long each point is run."""

    duration: float
    """In units of A omega_b / g."""
    seeds: int

    def notes(self) -> list[str]:
        """For the page of statements."""
        return [
            f"each point: {self.seeds} seeds (1 to {self.seeds} unless said otherwise), each of {self.duration:g} "
            f"A omega_b / g, the first {100 * UNOBSERVED:g} % unobserved; error bars: standard error by batch means"
        ]


QUICK, FULL = Effort(5e5, 2), Effort(2e6, 2)
"""Of the map. The thesis' 300 s at Gamma = 2 and 80 Hz are 7.5e4 in these units."""


def effort(quick: bool, seeds: int | None) -> Effort:
    """The map's effort, with another number of seeds if asked for."""
    chosen = QUICK if quick else FULL
    return Effort(chosen.duration, seeds or chosen.seeds)


@dataclass(frozen=True)
class Curve:
    """R omega / (A omega_b) against tilt."""

    wedge: Wedge
    tilts: tuple[float, ...]
    """[degrees]."""
    points: tuple[Estimate, ...]
    agreement: float
    """p-value of the seeds' agreement with each other; 1 if there is one seed only."""

    def at(self, tilt: float) -> Estimate:
        """The point at a tilt that was run."""
        return self.points[self.tilts.index(tilt)]

    def rows(self) -> list[dict[str, Any]]:
        """Rows of data."""
        return [
            {**self.wedge.columns(), "tilt_deg": tilt, "scaled_angular_velocity": point.mean, "error": point.error}
            for tilt, point in zip(self.tilts, self.points, strict=True)
        ]


def curves(
    laboratory: Laboratory,
    title: str,
    wedges: Mapping[Wedge, tuple[float, ...]],
    effort: Effort,
    seed_stride: int = 0,
    first_seed: int = 1,
) -> dict[Wedge, Curve]:
    """A curve for each wedge, at its own tilts [degrees]; wedge number i has seeds from `seed_stride` i + first on."""
    seeds = range(first_seed, first_seed + effort.seeds)
    runs = {
        (wedge, tilt, seed): wedge.run(tilt, seed_stride * number + seed, effort.duration * wedge.time)
        for number, (wedge, tilts) in enumerate(wedges.items())
        for tilt in tilts
        for seed in seeds
    }
    tables = laboratory.run(list(runs.values()), title)
    found = {}
    for wedge, tilts in wedges.items():
        points, differences, errors = [], [], []
        for tilt in tilts:
            ends = [tables[runs[wedge, tilt, seed]] for seed in seeds]
            means = [float(end["scaled_angular_velocity"][-1]) for end in ends]
            deviations = [float(end["scaled_angular_velocity.standard_error"][-1]) for end in ends]
            point = pooled(means, deviations)
            points.append(point)
            differences += [mean - point.mean for mean in means]
            errors += deviations
        agreement = chi_square(differences, errors, lost=len(tilts))[1] if effort.seeds > 1 else 1.0
        found[wedge] = Curve(wedge, tuple(tilts), tuple(points), agreement)
    return found


def other_law(
    laboratory: Laboratory, law: str, wedge: Wedge, duration: float, seed: int, tilts: Sequence[float]
) -> Table:
    """The map with a law that no scene has, `rigid` or `recipe` of the example wedge_other_laws; rows by tilt."""
    numbers = (wedge.friction, wedge.stiffness_ratio, wedge.aperture, duration * wedge.time)
    return example(laboratory, "wedge_other_laws", law, *map(repr, numbers), str(seed), *map(repr, tilts))


def tilt_axes(panel: Axes, critical: float | None = 30.0) -> None:
    """Labels, the line of no rotation and the critical tilt."""
    panel.axhline(0.0, color="0.5", lw=0.6, zorder=0)
    if critical is not None:
        panel.set_xlim(-0.02 * critical, critical)
        panel.set_xlabel(r"tilt $\theta_T$ [degrees]")
    panel.set_ylabel(r"$R\bar\omega/A\omega_b$")
