"""P Fig. 3.4: distribution of rho^2 over the disks of the packings nearest to Gamma = 0.3 and 4.0."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from jostle_lab.plots.style import WIDTH
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import above, every
from studies.thesis.laboratory.data import Data
from studies.thesis.laboratory.paths import FULL, at_length, notes, share_of

WEAK, STRONG = 0.3, 4.0
BINS = np.linspace(0.0, 1.0, 21)
LOW, HIGH = 0.1, 0.9
"""Near zero, and near one."""
NEARLY_ALL = 0.9
PEAK = 0.2
"""By how much a density exceeds another one at a peak; 1 is the density of an even distribution."""


def product(schedule: Data, longer: Data) -> Product:
    """The figure."""
    found = {gamma: nearest(schedule, gamma) for gamma in (WEAK, STRONG)}
    return Product(
        "Figure 3.4: distribution of rho^2 over the disks, measured",
        _rows(found),
        draw(found),
        statements(found, schedule, longer),
        [
            *notes(schedule, longer),
            f"the {schedule.packings()} records of the schedule whose measured Gamma is nearest",
        ],
    )


def nearest(data: Data, gamma: float) -> NDArray[np.float64]:
    """rho^2 of the disks by camera in the K records nearest to a Gamma, shape (K, disks)."""
    order = np.argsort(np.abs(data["gamma_measured"] - gamma), kind="stable")[: data.packings()]
    return data.by_disk("disk_correlation")[order]


def density(rho: NDArray[np.float64], low: float, high: float) -> Estimate:
    """Probability density between two values, its error over packings."""
    inside = (rho >= low) & ((rho < high) | (high >= 1.0))
    share = Estimate.over_runs(inside.mean(axis=1))
    return Estimate(share.mean / (high - low), share.error / (high - low))


def _rows(found: dict[float, NDArray[np.float64]]) -> list[dict[str, Any]]:
    rows = []
    for gamma, rho in found.items():
        for low, high in pairwise(BINS):
            e = density(rho, low, high)
            rows.append({"gamma": gamma, "from": float(low), "to": float(high), "density": e.mean, "error": e.error})
    return rows


def draw(found: dict[float, NDArray[np.float64]]) -> Figure:
    """Both histograms with errors over packings, and where the mean lies."""
    figure = Figure(figsize=(WIDTH, 3.4), layout="constrained")
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    middles, width = 0.5 * (BINS[:-1] + BINS[1:]), BINS[1] - BINS[0]
    for panel, (gamma, rho) in zip(panels, found.items(), strict=True):
        points = [density(rho, low, high) for low, high in pairwise(BINS)]
        panel.bar(
            middles, [p.mean for p in points], width, color="0.75", edgecolor="0.2", lw=0.6, label="disks by camera"
        )
        panel.errorbar(
            middles, [p.mean for p in points], [p.error for p in points], fmt="none", ecolor="0.1", elinewidth=0.8,
            capsize=1.5, label="standard error over packings",
        )  # fmt: skip
        panel.axvline(rho.mean(), color="#c0272d", lw=1.0, ls="--", label=f"mean {rho.mean():.2f}")
        panel.set(xlabel=r"$\rho^2_{\theta,t}$ of a disk", xlim=(0.0, 1.0), title=rf"$\Gamma$ nearest to {gamma:g}")
    panels[0].set_ylabel("probability density")
    panels[0].legend(loc="upper left")
    panels[1].legend(loc="upper left", handlelength=1.5)
    return figure


def statements(found: dict[float, NDArray[np.float64]], schedule: Data, longer: Data) -> list[Statement]:
    """What P 3.1 says of the figure."""
    return [bimodal(found[WEAK], schedule), nearly_all(found[STRONG], schedule, longer)]


def bimodal(rho: NDArray[np.float64], data: Data) -> Statement:
    """More disks near zero and near one than in between."""
    ends = [density(rho, 0.0, LOW), density(rho, HIGH, 1.0)]
    middle = density(rho, 0.2, 0.8)
    over = [Estimate(e.mean - middle.mean, math.hypot(e.error, middle.error)) for e in ends]
    most = Estimate.over_runs(((rho < LOW) | (rho > HIGH)).mean(axis=1))
    return Statement.judged(
        "3.1, Fig. 3.4",
        "Gamma = 0.3: most disks have rho^2 near 0 or near 1",
        f"density below {LOW:g}: {ends[0]}, from 0.2 to 0.8: {middle}, above {HIGH:g}: {ends[1]}; share of disks at "
        f"either end: {most}",
        every(
            [*(above(e, PEAK) for e in over), above(most, 0.5)],
            f"density near 0 and near 1 above that in between by {PEAK:g}, and more than half of the disks there, "
            "each by "
            "two errors",
        ),
        f"longer records part the densities: {at_length(data)}",
    )


def nearly_all(rho: NDArray[np.float64], schedule: Data, longer: Data) -> Statement:
    """Share of the disks near one, in the longer records, which are nearer to P's 900 s."""
    share = Estimate.over_runs((rho > HIGH).mean(axis=1))
    row = int(np.argmin(np.abs(longer["gamma_measured"] - STRONG)))
    long = share_of(longer.by_disk("disk_correlation")[row] > HIGH)
    return Statement.judged(
        "3.1, Fig. 3.4",
        "Gamma = 4.0: practically all disks have rho^2 near 1",
        f"share of disks above {HIGH:g}: {long} in a record of {longer.recording():g} s (one packing); {share} in "
        "records of "
        f"{schedule.recording():g} s",
        above(long, NEARLY_ALL),
        f"60 disks; the share grows with the length of the record, P's is 900 s: {FULL}",
    )
