"""A results folder in, four pictures out. Reads the CSV files only, so that pictures can be drawn again."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray

from jostle_lab.demos.packing.power_laws import ENOUGH, regression_of, slope_of, slope_text
from jostle_lab.plots.style import SENSE, WIDTH, house_style, save
from jostle_lab.protocol.now import Now
from jostle_lab.protocol.results import Results
from jostle_lab.sensors.spectral_amplitude import spectral_amplitude
from jostle_lab.statistics.regression import THESIS_SLOPES, Regression, within
from jostle_lab.statistics.rotation import RPM
from jostle_lab.tables import Row

GAMMA_DRAWN = 2.0
"""Of the picture of a packing, as near as there is one."""


def draw_all(results: Results) -> list[Path]:
    """Draw every picture of a results folder; return their paths."""
    return [draw(name, results) for name in PICTURES]


def draw(name: str, results: Results) -> Path:
    """Draw one of `PICTURES`; return its path."""
    path = results.folder / name
    with house_style():
        save(PICTURES[name](results), path)
    return path


def _sense_norm(velocities: NDArray[np.float64]) -> Normalize:
    """Colour scale [RPM], symmetric; saturates at the 90th percentile so that slow disks still show their sense."""
    limit = max(float(np.percentile(np.abs(velocities), 90)), 1e-9)
    return Normalize(-limit, limit)


def _line_colours(velocities: NDArray[np.float64], norm: Normalize) -> NDArray[np.float64]:
    """Colours by sense, shape (disks, 4), kept off white so that lines of slow disks stay visible."""
    share = np.clip(velocities / norm.vmax if norm.vmax else velocities, -1.0, 1.0)
    share = np.sign(share) * (0.35 + 0.65 * np.abs(share))
    return np.asarray(SENSE(0.5 + 0.5 * share))


def angular_paths(results: Results) -> Figure:
    """Angle of every disk against time, one panel for each Gamma, as in P Fig. 3.1 (first packing)."""
    rows = sorted(results.amplitudes_of(results.seeds[0]), key=lambda row: row["gamma_true"])
    rows = [rows[i] for i in np.unique(np.linspace(0, len(rows) - 1, 9).round().astype(int))]
    columns = {1: 1, 2: 2, 4: 2, 8: 4}.get(len(rows), 3)
    lines = math.ceil(len(rows) / columns)
    figure = Figure(figsize=(WIDTH, 0.5 + 1.95 * lines), layout="constrained")
    axes = figure.subplots(lines, columns, squeeze=False, sharex=True)
    for panel in axes.flat[len(rows) :]:
        panel.set_visible(False)
    for panel, row in zip(axes.flat, rows, strict=False):
        time, angles = results.angles(results.seeds[0], row["amplitude"])
        turns = (angles - angles[0]) / math.tau
        velocities = (angles[-1] - angles[0]) / (time[-1] - time[0]) / RPM
        for path, colour in zip(turns.T, _line_colours(velocities, _sense_norm(velocities)), strict=True):
            panel.plot(time, path, color=colour, linewidth=0.7)
        panel.axhline(0.0, color="0.5", linewidth=0.4, zorder=0)
        panel.set_title(rf"$\Gamma$ = {row['gamma_true']:.2f}", pad=3.0)
        panel.margins(x=0.0)
        limit = 1.08 * float(np.max(np.abs(turns))) or 1.0
        panel.set_ylim(-limit, limit)
        panel.locator_params(axis="y", nbins=5)
    for panel in axes[:, 0]:
        panel.set_ylabel("angle [revolutions]")
    figure.align_ylabels(axes[:, 0])
    for column in range(columns):
        shown = [panel for panel in axes[:, column] if panel.get_visible()]
        shown[-1].set_xlabel("time [s]")
        shown[-1].tick_params(labelbottom=True)
    return figure


def packing(results: Results) -> Figure:
    """The first packing at the Gamma nearest to `GAMMA_DRAWN`, disks coloured by the sense of rotation."""
    row = packing_drawn(results)
    disks = results.disks_of(results.seeds[0], row["amplitude"])
    return packing_of(
        results.box_width(),
        np.array([(disk["x"], disk["y"]) for disk in disks]),
        np.array([disk["radius"] for disk in disks]),
        np.array([disk["mean_velocity"] for disk in disks]),
        rf"$\Gamma$ = {row['gamma_true']:.2f}, packing of seed {results.seeds[0]}",
    )


def packing_drawn(results: Results) -> Row:
    """The amplitude that `packing` draws."""
    return min(results.amplitudes_of(results.seeds[0]), key=lambda row: abs(row["gamma_true"] - GAMMA_DRAWN))


def packing_now(now: Now, gamma: float) -> Figure:
    """A packing in the middle of an interval; `gamma` is that of the empty base."""
    title = rf"A = {now.amplitude:.2f}, $\Gamma$ near {gamma:.2g}: {now.doing}, mean of the last {now.seconds} s"
    return packing_of(now.box_width, now.positions, now.radii, now.velocities, title)


def packing_of(
    box_width: float,
    positions: NDArray[np.float64],
    radii: NDArray[np.float64],
    mean_velocities: NDArray[np.float64],
    title: str,
) -> Figure:
    """Disks in their box [m], coloured by mean angular velocity [rad/s]."""
    velocities = mean_velocities / RPM
    norm = _sense_norm(velocities)
    half = 100.0 * 0.5 * box_width
    top = 100.0 * float(np.max(positions[:, 1] + radii)) + 1.5
    drawn = 0.68 * WIDTH
    figure = Figure(figsize=(WIDTH * 0.92, drawn * (top + 1.0) / (2.0 * half + 2.0) + 0.75), layout="constrained")
    axes = figure.subplots()
    for place, radius, velocity in zip(100.0 * positions, 100.0 * radii, velocities, strict=True):
        centre = (float(place[0]), float(place[1]))
        axes.add_patch(Circle(centre, radius, facecolor=SENSE(norm(velocity)), edgecolor="0.15", linewidth=0.6))
        _turning_arrow(axes, centre, radius, velocity / norm.vmax if norm.vmax else 0.0)
    axes.plot([-half, -half, half, half], [top, 0.0, 0.0, top], color="0.1", linewidth=1.6, solid_joinstyle="miter")
    axes.set(xlim=(-half - 1.0, half + 1.0), ylim=(-1.0, top), aspect="equal", xlabel="x [cm]", ylabel="y [cm]")
    axes.set_title(title)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    scale = ScalarMappable(norm, SENSE)
    bar = figure.colorbar(scale, ax=axes, shrink=0.72, aspect=28, pad=0.02, extend="both")
    bar.set_label("mean angular velocity [RPM]\nred clockwise, blue counter-clockwise")
    bar.outline.set_linewidth(0.5)
    return figure


def _turning_arrow(axes: Any, centre: tuple[float, float], radius: float, share: float) -> None:
    """An arc with a head inside a disk, in the sense of rotation; none for disks that hardly turn."""
    if abs(share) < 0.05:
        return
    sense = math.copysign(1.0, share)
    arc = math.radians(90.0) + sense * np.linspace(math.radians(-60.0), math.radians(60.0), 40)
    x, y = centre[0] + 0.55 * radius * np.cos(arc), centre[1] + 0.55 * radius * np.sin(arc)
    axes.plot(x, y, color="0.1", linewidth=0.7, solid_capstyle="butt")
    head = {"arrowstyle": "-|>", "color": "0.1", "linewidth": 0.0, "mutation_scale": 6.0, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", xy=(x[-1], y[-1]), xytext=(x[-6], y[-6]), arrowprops=head)


def accelerometer_spectrum(results: Results) -> Figure:
    """Spectral density of both sensors at a strong and a weak drive, window and side bands marked."""
    seed = results.seeds[0]
    rows = sorted(results.amplitudes_of(seed), key=lambda row: row["gamma_true"])
    setup = results.setup
    rate, drive = setup["accelerometer"]["data_rate"], setup["drive_frequency"]
    figure = Figure(figsize=(WIDTH, 3.1), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True, sharex=True)
    for panel, row in zip(panels, (rows[-1], rows[0]), strict=True):
        record = results.readings(seed, row["amplitude"])
        panel.axvspan(drive - 15.0, drive - 5.0, color="0.93", linewidth=0, label="side bands")
        panel.axvspan(drive + 5.0, drive + 15.0, color="0.93", linewidth=0)
        panel.axvspan(drive - 5.0, drive + 5.0, color="#f3d9a4", linewidth=0, label="window, 10 Hz")
        for number, colour in enumerate(("#9dbfe0", "#14406f")):
            estimate = spectral_amplitude(record[:, number], rate, drive)
            panel.semilogy(
                estimate.frequencies[1:],
                estimate.density[1:],
                color=colour,
                linewidth=0.5,
                label=f"sensor {number + 1}, $a$ = {estimate.amplitude:.3f} g",
            )
        folded = abs(2.0 * drive - rate * round(2.0 * drive / rate))
        panel.annotate(
            "2nd harmonic,\nfolded", (folded, 0.5), xycoords=("data", "axes fraction"), ha="center", fontsize=7
        )
        panel.set_title(rf"A = {row['amplitude']:.2f}, true $\Gamma$ = {row['gamma_true']:.3f}")
        panel.set(xlabel="frequency [Hz]", xlim=(0.0, 0.5 * rate))
        panel.legend(loc="upper left")
    panels[0].set_ylabel(r"spectral density [g$^2$/Hz]")
    low, high = panels[0].get_ylim()
    panels[0].set_ylim(max(low, 1e-9), high * 1e3)
    return figure


def rotation_against_gamma(results: Results) -> Figure:
    """<omega^2>, rho^2 and sigma_a as measured, as in P Fig. 3.2 and 3.3, and in truth."""
    column = {series.name: series.to_numpy() for series in results.amplitudes.sort("gamma_true")}
    figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    measured, true = regression_of(results, measured=True), regression_of(results, measured=False)
    dark, light = "0.1", "#d07a1f"
    for curve, marker, colour, line, name in ((true, "o", dark, ":", "truth"), (measured, "s", light, "-", "measured")):
        positive = curve.values > 0.0
        gamma, square = curve.gamma[positive], curve.values[positive]
        left.loglog(gamma, square, marker, color=colour, ms=4, mfc="none", mew=0.7, label=name)
        if curve.neighbours > 1:
            error = curve.error if curve.neighbours >= ENOUGH else None
            left.errorbar(curve.at, curve.curve, error, ls=line, color=colour, lw=0.8, elinewidth=0.7, capsize=1.5)
    _power_laws(left, measured)
    left.set(xlabel=r"$\Gamma$", ylabel=r"$\langle\omega^2\rangle$ [RPM$^2$]")
    _plain_ticks(left, column["gamma_true"])
    left.legend(loc="lower right", fontsize=7)
    for name, symbol, colour in (("correlation", r"\rho^2", dark), ("adjusted_deviation", r"\sigma_a", "0.55")):
        x, y = column["gamma_measured"], column[f"{name}_camera"]
        right.plot(x, y, "s", color=colour, ms=4, label=rf"$\langle{symbol}\rangle$ measured")
        x, y = column["gamma_true"], column[name]
        right.plot(x, y, "o", color=colour, ms=5.5, mfc="none", mew=0.7, label=rf"$\langle{symbol}\rangle$ truth")
    middle = right.get_yaxis_transform()
    right.axhline(0.43, color="0.1", linewidth=0.6, linestyle=":")
    right.text(0.42, 0.435, r"driftless walk, $\rho^2$", ha="center", va="bottom", fontsize=7, transform=middle)
    right.set(xlabel=r"$\Gamma$", ylabel="steadiness of the paths", ylim=(-0.02, 1.05), xlim=(0.0, None))
    right.legend(loc="center right", bbox_to_anchor=(1.0, 0.68), fontsize=7)
    return figure


def _plain_ticks(axes: Any, gamma: NDArray[np.float64]) -> None:
    """Gamma as 0.2, 0.5, 1, 2, 5 instead of powers of ten."""
    ticks = [t for t in (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0) if 0.7 * gamma.min() <= t <= 1.4 * gamma.max()]
    axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
    axes.minorticks_off()


def _power_laws(axes: Any, curve: Regression) -> None:
    """Our power laws of what was measured, and P's slopes of Fig. 3.2 through the middle of the same points."""
    for range_, slope, style in zip(THESIS_SLOPES, THESIS_SLOPES.values(), ("--", "-."), strict=True):
        inside = within(curve.at, range_) & (curve.curve > 0.0)
        if np.count_nonzero(inside) < 2:
            continue
        x, y = np.log(curve.at[inside]), np.log(curve.curve[inside])
        ends = np.array([x.min() - 0.1, x.max() + 0.1])
        ours = slope_of(curve, range_)
        for exponent, colour, name in (
            (ours.mean, "#c0272d", f"slope {slope_text(ours)} (measured)"),
            (slope, "0.5", f"slope {slope:.2f} (thesis)"),
        ):
            line = np.exp(y.mean() + exponent * (ends - x.mean()))
            axes.loglog(np.exp(ends), line, style, color=colour, lw=0.9, label=name)


PICTURES: dict[str, Callable[[Results], Figure]] = {
    "angular_paths.png": angular_paths,
    "packing.png": packing,
    "accelerometer_spectrum.png": accelerometer_spectrum,
    "rotation_against_gamma.png": rotation_against_gamma,
}
