"""P Fig. 3.1: angular paths of a packing on the loudspeaker, and how they grow with Gamma."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from jostle_lab.plots.style import CLOCKWISE, COUNTER_CLOCKWISE, WIDTH
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Judgement, above, below, every, falls, near, vanish
from studies.thesis.laboratory.data import MOVED, PATH_SAMPLE, Data

ALIAS_LIMIT = 15.0
"""Fastest disk that one picture a second shows rightly [RPM]."""
PANELS = 6
STRONG = 2.09
"""Gamma from which the fastest disks of P Fig. 3.1 turn no faster."""


def product(schedule: Data, longer: Data) -> Product:
    """The figure: paths of the longer record, growth of the whole schedule."""
    return Product(
        "Figure 3.1: angular paths on the loudspeaker",
        _rows(longer),
        draw(schedule, longer),
        statements(schedule, longer),
        notes(schedule, longer),
    )


def notes(schedule: Data, longer: Data) -> list[str]:
    """Effort and settings, which all figures of the laboratory share."""
    cost = f"at P's length this takes {schedule.hours_of_the_thesis():.0f} h of one processor"
    return [effort_note(schedule), f"longer records: {effort_note(longer)}", f"{cost}: {FULL}"]


def effort_note(data: Data) -> str:
    """What was done."""
    seeds = data["seed"]
    return (
        f"{data.packings()} packings (seeds {seeds.min():.0f} to {seeds.max():.0f}) on the loudspeaker at 80 Hz, "
        f"{len(data.amplitudes())} amplitudes of {data.effort.seconds} s each, of which the last "
        f"{data.recording():g} s are recorded (P: 1200 and 900 s); one picture a second"
    )


FULL = "`python -m studies laboratory --seconds-per-amplitude 1200 --processes N`, resumable, a packing in each process"


def at_length(data: Data) -> str:
    """What P's protocol at its length would cost."""
    return (
        f"{data.packings()} packings (P: 25) for {data.recording():g} s (P: 900 s) at each amplitude; "
        f"P's length takes {data.hours_of_the_thesis():.0f} hours of one processor, {FULL}"
    )


def path_block(longer: Data) -> NDArray[np.float64]:
    """Angles [revolutions], shape (amplitudes, frames, disks), amplitudes as recorded."""
    frames = int(longer["path_frames"][0])
    first = longer["seed"] == longer["seed"][0]
    return longer["paths"].reshape(np.count_nonzero(first), frames, -1)


def _rows(longer: Data) -> list[dict[str, Any]]:
    block = path_block(longer)
    return [
        {
            "gamma": float(gamma),
            "time": float(PATH_SAMPLE * frame),
            **{f"disk_{i}": float(turns) for i, turns in enumerate(paths[frame], 1)},
        }
        for gamma, paths in zip(longer["gamma_measured"], block, strict=False)
        for frame in range(block.shape[1])
    ]


def over_packings(data: Data, value: Callable[[NDArray[np.intp]], NDArray[np.float64]]) -> list[Estimate]:
    """Mean over packings at each amplitude, from weak to strong."""
    return [Estimate.over_runs(value(data.rows_at(a))) for a in reversed(data.amplitudes())]


def mean_gammas(data: Data) -> NDArray[np.float64]:
    """Measured Gamma of each amplitude, from weak to strong."""
    return np.array([data["gamma_measured"][data.rows_at(a)].mean() for a in reversed(data.amplitudes())])


def draw(schedule: Data, longer: Data) -> Figure:
    """Six Gamma on one scale; below, the typical and the fastest disk of all packings."""
    figure = Figure(figsize=(WIDTH, 7.4), layout="constrained")
    parts: Any = figure.subfigures(2, 1, height_ratios=[1.75, 1.0])
    paths, growth = parts
    axes = paths.subplots(2, 3, sharex=True, sharey=True)
    block, gammas = path_block(longer), longer["gamma_measured"]
    order = np.argsort(gammas[: len(block)])
    chosen = order[np.unique(np.linspace(0, len(order) - 1, PANELS).round().astype(int))]
    time = PATH_SAMPLE * np.arange(block.shape[1])
    for panel, index in zip(axes.flat, chosen, strict=False):
        for path in block[index].T:
            forwards = path[-1] > 0.0
            colour, line = (COUNTER_CLOCKWISE, "-") if forwards else (CLOCKWISE, "--")
            panel.plot(time, path, line, lw=0.7, color=colour)
        panel.axhline(0.0, color="0.5", lw=0.4, zorder=0)
        panel.set_title(rf"$\Gamma$ = {gammas[index]:.2f}", pad=3.0)
        panel.margins(x=0.0)
    for panel in axes[:, 0]:
        panel.set_ylabel("angle [revolutions]")
    for panel in axes[-1]:
        panel.set_xlabel("time [s]")
    paths.suptitle(
        "by camera, one packing, one line a disk: full lines end counter-clockwise, broken ones clockwise", fontsize=8
    )
    _draw_growth(growth.subplots(1, 2), schedule)
    return figure


def _draw_growth(panels: NDArray[Any], data: Data) -> None:
    gammas = mean_gammas(data)
    for panel, eye, name in zip(panels, ("camera", "true"), ("by camera", "in truth"), strict=True):
        typical = over_packings(data, lambda rows, eye=eye: np.sqrt(data[f"square_{eye}"][rows]))  # type: ignore[misc]
        fastest = over_packings(data, lambda rows, eye=eye: data[f"fastest_{eye}"][rows])  # type: ignore[misc]
        _curve(panel, gammas, typical, "o", "0.1", "root mean square over the disks")
        _curve(panel, gammas, fastest, "s", "0.5", "fastest disk")
        panel.axhline(ALIAS_LIMIT, color="0.3", lw=0.8, ls=":", label="15 RPM: the camera shows no more")
        panel.set(xscale="log", yscale="log", xlabel=r"measured $\Gamma$", title=f"{name}, mean over packings")
        gamma_ticks(panel, gammas)
    low, high = (min if i == 0 else max for i in (0, 1))
    limits = [low(p.get_ylim()[0] for p in panels), high(p.get_ylim()[1] for p in panels)]
    for panel in panels:
        panel.set_ylim(*limits)
    panels[0].set_ylabel(r"$|\bar\omega|$ [RPM]")
    panels[0].legend(loc="lower right", fontsize=7)


def _curve(panel: Axes, x: NDArray[np.float64], y: list[Estimate], marker: str, colour: str, label: str) -> None:
    means, errors = [e.mean for e in y], [e.error for e in y]
    panel.errorbar(x, means, errors, fmt=marker, ms=3, color=colour, elinewidth=0.7, capsize=1.5, label=label)


def gamma_ticks(panel: Axes, gammas: NDArray[np.float64]) -> None:
    """Gamma as 0.2, 0.5, 1, 2, 5 instead of powers of ten."""
    ticks = [t for t in (0.1, 0.2, 0.5, 1.0, 1.6, 3.0, 5.0) if 0.8 * gammas.min() <= t <= 1.25 * gammas.max()]
    panel.set_xticks(ticks, [f"{t:g}" for t in ticks])
    panel.minorticks_off()


def statements(schedule: Data, longer: Data) -> list[Statement]:
    """What P 3.1 says of the figure."""
    return [
        symmetry(schedule),
        accumulation(longer),
        relative_noise(schedule),
        saturation(schedule),
        *reorganisations(schedule, longer),
    ]


def symmetry(data: Data) -> Statement:
    """Packing by packing, over all amplitudes: those of one packing are not independent."""
    share, ratio = [], []
    velocities = data.by_disk("disk_velocity")
    for seed in np.unique(data["seed"]):
        rows = data["seed"] == seed
        turning = velocities[rows]
        share.append(float(np.mean(turning > 0.0)) - 0.5)
        ratio.append(float(np.mean(turning.mean(axis=1) / np.sqrt(np.mean(turning**2, axis=1)))))
    skew, excess = Estimate.over_runs(np.array(ratio)), Estimate.over_runs(np.array(share))
    return Statement.judged(
        "3.1, Fig. 3.1",
        "velocities are symmetrically distributed around zero",
        f"mean velocity over rms velocity {skew}; share of disks that turn counter-clockwise, less one half, {excess}",
        vanish([skew, excess], 0.1),
        f"the errors allow for more than a tenth: {at_length(data)}",
    )


def accumulation(longer: Data) -> Statement:
    """The weakest drive of the longer record."""
    row = int(np.argmin(longer["gamma_measured"]))
    gamma = longer["gamma_measured"][row]
    rho = Estimate.over_runs(longer.by_disk("disk_correlation")[row])
    rule = "rho^2 of angle and time above 0.43, that of a walk without drift, and below 0.95, that of P's steady paths"
    return Statement.judged(
        "3.1, Fig. 3.1",
        "Gamma = 0.24: rotation accumulates, but paths are not linear on this time scale",
        f"<rho^2> at Gamma = {gamma:.2f} over {longer.recording():g} s: {rho} (scatter of the disks)",
        every([above(rho, 0.43), below(rho, 0.95)], rule),
        f"P's camera adds noise that paths without it lack, see the rows of P 2.4; records of 900 s would tell, {FULL}",
    )


def relative_noise(data: Data) -> Statement:
    """sigma_a from the weakest drive to 1, and from there to 1.6."""
    gammas = mean_gammas(data)
    noise = over_packings(data, lambda rows: data["deviation_camera"][rows])
    first = [e for g, e in zip(gammas, noise, strict=True) if g <= 1.05]
    second = [e for g, e in zip(gammas, noise, strict=True) if 0.95 <= g <= 1.7]
    parts = [falls(first), falls(second)] if min(len(first), len(second)) > 1 else [falls(noise)]
    return Statement.judged(
        "3.1, 3.3",
        "as Gamma grows the relative noise of each path falls, paths become more linear (up to Gamma = 1.6)",
        f"<sigma_a> {noise[0]} at Gamma = {gammas[0]:.2f}, {first[-1]} at {gammas[len(first) - 1]:.2f}, "
        f"{second[-1] if second else noise[-1]} at 1.5",
        every(parts, "sigma_a falls up to Gamma = 1, and from 1 to 1.6: " + parts[0].rule),
        "ours is steadiest at Gamma = 1, as P's own simulations are (Fig. 3.7), whose disks have the same k_n = "
        "1e4 N/m; "
        "from where the disks leave the bottom on, fluctuations grow faster than the drift",
    )


def _growth(data: Data, column: str, power: float = 1.0) -> Estimate:
    """Mean at Gamma from 4 on over that from `STRONG` to 2.8, packing by packing, and its error over packings."""
    ratios = []
    for seed in np.unique(data["seed"]):
        mine = data["seed"] == seed
        gamma, values = data["gamma_measured"][mine], data[column][mine] ** power
        weak, strong = (gamma >= STRONG) & (gamma <= 2.8), (gamma >= 4.0) & (gamma <= 4.6)
        if weak.any() and strong.any():
            ratios.append(math.log(values[strong].mean() / values[weak].mean()))
    if len(ratios) < 2:
        return Estimate(math.nan, math.nan)
    mean = Estimate.over_runs(np.array(ratios))
    return Estimate(math.exp(mean.mean), math.exp(mean.mean) * mean.error)


def saturation(data: Data) -> Statement:
    """The fastest disk against the typical one."""
    fastest, typical = _growth(data, "fastest_camera"), _growth(data, "square_camera", 0.5)
    truth, truth_typical = _growth(data, "fastest_true"), _growth(data, "square_true", 0.5)
    judgement = every(
        [near(fastest, 1.0, 0.2), above(typical, 1.0)],
        "from Gamma = 2.1 to 2.8 on to 4.0 to 4.6 the fastest disk by camera grows by less than 20 %, and the rms "
        "grows",
    )
    return Statement.judged(
        "3.1, Fig. 3.1",
        "from Gamma = 2.09 on the largest velocity seems to saturate, the rms grows",
        f"from Gamma 2.1-2.8 to 4.0-4.6 the fastest disk grows by a factor {fastest} by camera, {truth} in truth; "
        "the rms "
        f"by {typical} by camera, {truth_typical} in truth",
        judgement,
        "the saturation is the camera's: no disk can seem faster than 15 RPM, a quarter turn a picture; in truth the "
        f"fastest disks go on to turn faster. {at_length(data)}",
    )


def reorganisations(schedule: Data, longer: Data) -> list[Statement]:
    """Records in which centres move."""
    parts: list[Judgement] = []
    words = []
    for data in (schedule, longer):
        moved = data["moved"][data["gamma_measured"] < 2.5]
        any_ = moved[moved > 0]
        minutes = len(moved) * data.recording() / 60.0
        rate = Estimate(15.0 * len(any_) / minutes, 15.0 * math.sqrt(max(len(any_), 1)) / minutes)
        words.append(
            f"{data.recording():g} s records after {data.effort.seconds // 4} s of relaxation: centres moved in "
            f"{len(any_)} of {len(moved)}, that is {rate} records in 15 min"
        )
        parts.append(below(rate, 1.0))
    counts = np.concatenate([data["moved"][data["gamma_measured"] < 2.5] for data in (schedule, longer)])
    happened = counts[counts > 0]
    few = share_of(happened < 10) if len(happened) else Estimate(math.nan, math.nan)
    most = happened.max() if len(happened) else 0
    gammas = ", ".join(
        f"{g:.2f}: {n:.0f}" for g, n in zip(longer["gamma_measured"], longer["moved"], strict=True) if n > 0
    )
    return [
        Statement.judged(
            "3.1",
            "spontaneous reorganisation does occur, but is not frequent (once in the nine records of Fig. 3.1)",
            "; ".join(words) + f" (Gamma below 2.5; moved: by more than {1e3 * MOVED:g} mm)",
            every(
                parts, "fewer than one record with moved centres in 15 min, P's length of a record: " + parts[0].rule
            ),
            f"our packings rest for {schedule.effort.seconds // 4} and {longer.effort.seconds // 4} s at each new "
            "drive, P's "
            "for 300 s, and the rate falls with the time of rest: ours still settle. The rate after 300 s takes P's "
            f"protocol: {FULL}",
        ),
        Statement.judged(
            "3.1",
            "all reorganisations were limited to a small part of the packing, typically fewer than 10 disks",
            f"fewer than 10 disks moved in a share {few} of the {len(happened)} records with any, at most "
            f"{most:.0f}; in the "
            f"longer ones, Gamma: disks: {gammas or 'none'}",
            above(few, 0.8) if len(happened) else near(few, 1.0, 0.1),
            "where Gamma is above 1 many places shift a little in a record without a change of neighbours",
        ),
    ]


def share_of(holds: NDArray[np.bool_]) -> Estimate:
    """Share and its binomial error."""
    share, count = float(np.mean(holds)), len(holds)
    return Estimate(share, math.sqrt(max(share * (1.0 - share), 1.0 / (count + 2)) / count))
