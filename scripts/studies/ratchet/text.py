"""F II to V: what the text says beside its figures. Masses, crystals, solid and fluid bed, jumps, kinds of onset."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.curves import draw_curve
from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.tables import Table
from studies.ratchet.cases import AMPLITUDE, TOOTH_WIDTH, Case, frequency_of
from studies.ratchet.text_found import Found, hexagonal, jumps, moved
from studies.ratchet.text_statements import statements

FORWARD = Case(3.0, 0.1, 25.0, 20, seconds=10.0)
"""Teeth and layer of F Figs 11 and 13."""
HEAVIER = 1024.0
"""A power of two: a mass that is scaled by it changes no digit of a velocity."""
BED_GAMMAS = (0.9, 1.1, 1.2, 1.3, 1.5, 2.0, 3.0)
BED_SECONDS, BED_LAST, BED_SAMPLE = 6.0, 2.0, 0.01
MONO, POLY = (1.05e-3, 1.05e-3), (1.05e-3, 1.155e-3)
"""Radii [m]."""
FROZEN = Case(3.0, 0.1, frequency_of(1.15), 116, warm_up=0.0)
"""Four layers that are shaken so little that they come to rest."""
FREEZING = (4.0, 10.0)
"""For so long [s]."""
SOFT_LANDING = 1e-3
"""A lower velocity floor than F's 5 mm/s [m/s]."""
REPEATED = 5
"""Runs of the bed whose scatter is a result."""
DENSE = Case(6.0, 0.25, 25.0, 140, seconds=6.0)
"""Many particles on the teeth of F Figs 8 and 10."""
WHOLE = Case(3.0, 0.1, 25.0, 116, seconds=15.0)
"""Four layers that flow."""
CRITICAL = {"h = 3 mm, a = 0.1, n = 0.7": (3.0, 0.1, 20, 12.76), "h = 6 mm, a = 0.25, n = 1.75": (6.0, 0.25, 50, 13.47)}
"""Teeth of Figs 11 and 12, and the critical frequency [Hz]: F's Gamma_c = 1.31; ours of Fig. 12, F gives none."""
BEYOND = (1.05, 1.1)
"""Frequencies over the critical one."""


class Runs:
    """Runs of this study; of those that are sampled often only a few numbers are kept."""

    def __init__(self, laboratory: Laboratory, quick: bool) -> None:
        self.laboratory = laboratory
        self.seeds = range(1, 3 if quick else 4)

    def last(self, case: Case, output: str, seeds: Sequence[int]) -> Numbers:
        """Last value of an output by every seed."""
        runs = [case.run(seed) for seed in seeds]
        tables = self.laboratory.run(runs, "F, text")
        return np.array([float(tables[run][output][-1]) for run in runs])

    def by_mass(self, seed: int) -> Numbers:
        """Transport velocity, and how it differs with 1024 times the mass, before records round it [m/s]."""
        light, heavy = FORWARD.run(seed), FORWARD.with_changes(disk__mass=1e-5 * HEAVIER).run(seed)

        def compute() -> tuple[Table, float]:
            plain = replace(self.laboratory, records=None)
            tables = plain.run([light, heavy], "F, text")
            first, second = (tables[run]["transport_velocity"][-1] for run in (light, heavy))
            return {"velocity": np.array([first, second - first])}, plain.spent

        return self.laboratory.computed(f"{light.key()}; heavier by {HEAVIER:g}", compute)["velocity"]

    def reduced(self, case: Case, seed: int, sample: float, name: str) -> Numbers:
        """What `REDUCTIONS[name]` makes of a run that is sampled each `sample` seconds."""
        run = replace(case.run(seed), sample=sample)

        def compute() -> tuple[Table, float]:
            plain = replace(self.laboratory, records=None)
            return {name: self._reduce(name, plain.run([run], "F, text")[run], case)}, plain.spent

        return self.laboratory.computed(run.key(), compute)[name]

    @staticmethod
    def _reduce(name: str, table: Table, case: Case) -> Numbers:
        def each(axis: str) -> Numbers:
            return np.column_stack([table[f"disk.{axis}[{disk}]"] for disk in range(1, case.disks + 1)])

        if name == "moved":
            last = table["time"] > table["time"][-1] - BED_LAST
            return moved(each("y")[last] - table["base.position"][last, None])
        if name == "jumps":
            return jumps(each("x"), TOOTH_WIDTH)
        width = case.teeth * TOOTH_WIDTH
        return hexagonal(each("x")[-1], each("y")[-1], width)


def observe(laboratory: Laboratory, quick: bool) -> Found:
    """All runs."""
    runs = Runs(laboratory, quick)
    masses = np.array([runs.by_mass(seed) for seed in runs.seeds])
    beds = {
        g: np.array([runs.reduced(_bed(g), seed, BED_SAMPLE, "moved") for seed in runs.seeds]) / AMPLITUDE
        for g in BED_GAMMAS
    }
    order = {
        radii: {
            seconds: np.array([runs.reduced(_frozen(radii, seconds), seed, seconds, "order") for seed in runs.seeds])
            for seconds in (FREEZING[:1] if quick else FREEZING)
        }
        for radii in (MONO, POLY)
    }
    level = replace(FROZEN, height=0.0)
    flat = tuple(
        np.array(
            [runs.reduced(_frozen(radii, FREEZING[0], level), seed, FREEZING[0], "order")[1] for seed in runs.seeds]
        )
        for radii in (MONO, POLY)
    )
    soft = _bed(BED_GAMMAS[0]).with_changes(collision__minimum_normal_velocity=SOFT_LANDING)
    landed = runs.reduced(soft, 1, BED_SAMPLE, "moved") / AMPLITUDE
    repeated = runs.seeds if quick else range(1, REPEATED + 1)
    hops = np.array([runs.reduced(DENSE, seed, 1.0 / DENSE.frequency, "jumps") for seed in runs.seeds])
    whole = runs.last(WHOLE, "transport_velocity", repeated)
    spread = runs.last(WHOLE, "transport_velocity.spread", repeated)
    onsets = {
        name: tuple(
            Estimate.over_runs(
                100.0 * runs.last(Case(h, a, part * critical, n, seconds=20.0), "transport_velocity", runs.seeds)
            )
            for part in BEYOND
        )
        for name, (h, a, n, critical) in CRITICAL.items()
    }
    return Found(masses, beds, landed, order[MONO], order[POLY], flat, hops, 100.0 * whole, 100.0 * spread, onsets)


def _bed(gamma: float) -> Case:
    return replace(FORWARD, frequency=frequency_of(gamma), seconds=BED_SECONDS)


def _frozen(radii: tuple[float, float], seconds: float, case: Case = FROZEN) -> Case:
    return replace(case, seconds=seconds).with_changes(disk__radius_min=radii[0], disk__radius_max=radii[1])


class Text:
    """The study, as the others of F are."""

    def make(self, laboratory: Laboratory, quick: bool, _seeds: int | None = None) -> Product:
        """Runs, picture and statements."""
        found = observe(laboratory, quick)
        seeds = len(found.masses)
        notes = [
            f"{seeds} seeds each, {len(found.whole)} of the bed of four layers; A = 2 mm, ten teeth, parameters of "
            "F IV where not said",
            f"bed: h = 3 mm, a = 0.1, n = 0.7; heights above the base, the last {BED_LAST:g} of {1 + BED_SECONDS:g} s",
            "crystals: 116 disks on h = 3 mm, a = 0.1 after 4 and 10 s at Gamma = 1.15, where they come to rest; bonds "
            "of up to 1.15 mean diameters; bulk: five neighbours and more",
            "jumps: 140 disks (n = 4.9) on h = 6 mm, a = 0.25, 25 Hz, looked at once a period for 6 s",
            "kinds of onset: 20 s after 1 s; critical frequencies of F Fig. 11 (Gamma_c = 1.31) and of our Fig. 12",
        ]
        rows = [{"gamma": g, "share_flying": e.mean, "error": e.error} for g, e in found.flying().items()]
        title = "F II to V: the text beside the figures"
        return Product(title, rows, draw(found), statements(found), notes)


def draw(found: Found) -> Figure:
    """Share of flying disks against Gamma, and hexagons of equal and of unequal disks."""
    figure = Figure(figsize=(WIDTH, 3.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    flying = found.flying()
    draw_curve(left, list(flying), list(flying.values()), "", marker="o", color="black", linestyle="-")
    left.axvline(1.0, color="0.6", lw=0.7, ls=":")
    left.set(xlabel=r"$\Gamma$", ylabel="share of the disks that fly", title="(a) bed of 0.7 layers", ylim=(-0.05, 1.1))
    for kind, (by_time, flat) in enumerate(zip((found.mono, found.poly), found.flat, strict=True)):
        shares = [Estimate.over_runs(values) for values in (by_time[max(by_time)][:, 1], flat)]
        places = [0.0 + 0.35 * kind, 1.0 + 0.35 * kind]
        style = {"color": ("0.35", "0.75")[kind], "capsize": 3.0, "label": ("equal radii", "1.05 to 1.155 mm")[kind]}
        right.bar(places, [e.mean for e in shares], 0.33, yerr=[e.error for e in shares], **style)
    right.set(xticks=[0.175, 1.175], xticklabels=["teeth of 3 mm", "flat base"], title="(b) four layers at rest")
    right.set(ylabel=r"share in hexagons, $|\psi_6|$ > 0.9", ylim=(0.0, 0.6))
    right.legend(loc="upper left")
    return figure


TEXT = Text()
