"""P 2.4: the schedule, what the accelerometers give, and what pictures of the packing give, beside the truth."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.protocol.intervals import thesis
from jostle_lab.sensors.webcam import BackLight, Webcam
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import Table, markdown_table
from jostle_lab.verdicts import above, below, every, exact, true
from studies.thesis.laboratory.camera_trial import NOISES
from studies.thesis.laboratory.data import EYES, Data
from studies.thesis.laboratory.paths import gamma_ticks, mean_gammas, notes, over_packings
from studies.thesis.laboratory.regression import NAMES, PRINTED_AMPLITUDES, STYLES

READING = 0.01
"""By how much a sensor's mean reading may differ from -g (P 2.4.3) [g]."""
AMPLITUDE_ERROR = 0.02
"""Relative error up to which an estimate of Gamma counts as one."""
QUICK_ENOUGH = 0.1
"""Processor time of a picture with its marks found [s]."""


def product(schedule: Data, longer: Data, cameras: Table) -> Product:
    """The page and its picture."""
    webcam = Webcam()
    return Product(
        "P 2.4: schedule, accelerometers and camera",
        _rows(cameras),
        draw(schedule, cameras),
        [*drive_statements(schedule), *camera_statements(schedule, cameras)],
        [
            *notes(schedule, longer),
            f"pictures: {webcam.resolution:g} pixels/m, marks of {1e3 * webcam.mark_length:g} by "
            f"{1e3 * webcam.mark_width:g} mm (P gives no size), noise of {webcam.noise:g} steps of 255, corners "
            f"{100 * webcam.vignetting:g} % darker; threshold by IsoData, of which ImageJ's default is a variant; "
            "ellipse of "
            "equal second moments; nearest neighbour from picture to picture; no blur by motion",
        ],
        [camera_table(cameras)],
    )


def _rows(cameras: Table) -> list[dict[str, Any]]:
    names = [name for name in cameras if not name.startswith(("shown", "mark"))]
    return [{name: float(cameras[name][i]) for name in names} for i in range(len(cameras["resolution"]))]


def draw(data: Data, cameras: Table) -> Figure:
    """A snapshot with the axes found; errors of the angle; what pictures do to sigma_a."""
    figure = Figure(figsize=(WIDTH, 5.6), layout="constrained")
    mosaic = figure.subplot_mosaic([["snapshot", "error"], ["snapshot", "noise"]], width_ratios=[1.15, 1.0])
    _draw_snapshot(mosaic["snapshot"], cameras)
    _draw_errors(mosaic["error"], cameras)
    panel, gammas = mosaic["noise"], mean_gammas(data)
    for eye in EYES:
        marker, colour, line = STYLES[eye]
        points = over_packings(data, lambda rows, eye=eye: data[f"deviation_{eye}"][rows])  # type: ignore[misc]
        panel.errorbar(
            gammas, [p.mean for p in points], [p.error for p in points], color=colour, ls=line, marker=marker, ms=3,
            mfc="none", lw=0.9, elinewidth=0.7, capsize=1.5, label=NAMES[eye] if eye != "camera" else "ideal camera",
        )  # fmt: skip
    panel.set(xscale="log", xlabel=r"measured $\Gamma$", ylabel=r"$\langle\sigma_a\rangle$", ylim=(0.0, None))
    gamma_ticks(panel, gammas)
    panel.legend()
    return figure


def _draw_snapshot(panel: Axes, cameras: Table) -> None:
    webcam = Webcam()
    scene = BackLight(webcam, float(cameras["shown_width"][0]), cameras["shown_radius"])
    positions = np.column_stack((cameras["shown_x"], cameras["shown_y"]))
    picture = scene.take(positions, cameras["shown_angle"], np.random.default_rng(1))
    panel.imshow(picture, cmap="gray", vmin=0, vmax=255)
    half = 0.5 * webcam.mark_length * webcam.resolution
    for column, row, angle in zip(cameras["mark_column"], cameras["mark_row"], cameras["mark_angle"], strict=True):
        across, down = half * math.cos(angle), -half * math.sin(angle)
        panel.plot([column - across, column + across], [row - down, row + down], color="#d07a1f", lw=1.2)
    panel.plot([], [], color="#d07a1f", lw=1.2, label="major axis found")
    top = float(scene.to_pixels(np.array([[0.0, np.max(positions[:, 1]) + 0.06]]))[0, 1])
    centimetres = [-20, -10, 0, 10, 20]
    places = scene.to_pixels(np.array([[0.01 * c, 0.0] for c in centimetres]))[:, 0]
    panel.set_xticks(places, [f"{c}" for c in centimetres])
    heights = [0, 10, 20, 30]
    panel.set_yticks(scene.to_pixels(np.array([[0.0, 0.01 * c] for c in heights]))[:, 1], [f"{c}" for c in heights])
    panel.set(ylim=(scene.rows - 0.5, max(top, -0.5)), xlabel="x [cm]", ylabel="y [cm]", title="a snapshot")
    panel.legend(loc="lower center", bbox_to_anchor=(0.5, -0.3))


def _draw_errors(panel: Axes, cameras: Table) -> None:
    plain = (cameras["otsu"] == 0) & (np.abs(cameras["vignetting"] - Webcam().vignetting) < 1e-6)
    for noise, marker, grey in zip(NOISES, "os^D", ("0.0", "0.3", "0.5", "0.7"), strict=True):
        rows = plain & (cameras["noise"] == noise)
        resolutions = np.unique(cameras["resolution"][rows])
        rms = [_rms(cameras["angle_error"][rows & (cameras["resolution"] == r)]) for r in resolutions]
        panel.plot(resolutions / 1000, rms, marker=marker, color=grey, ms=3.5, mfc="none", lw=0.9, label=f"{noise:g}")
    panel.set(xscale="log", yscale="log", xlabel="pixels per mm", ylabel="rms error of the angle [degrees]")
    panel.set_xticks(resolutions / 1000, [f"{r / 1000:g}" for r in resolutions])
    panel.minorticks_off()
    panel.legend(title="noise [steps of 255]", ncols=2)


def _rms(values: Any) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def drive_statements(data: Data) -> list[Statement]:
    """Schedule and accelerometers."""
    listed = len(thesis().intervals)
    readings = np.concatenate([data["mean_reading_1"], data["mean_reading_2"]]) + 1.0
    gammas = mean_gammas(data)
    bias = over_packings(data, lambda rows: data["gamma_measured"][rows] / data["gamma_true"][rows] - 1.0)
    worst = max(range(len(bias)), key=lambda i: abs(bias[i].mean))
    peaks = over_packings(data, lambda rows: data["gamma_peak"][rows] / data["gamma_true"][rows])
    sensors = np.abs(data["gamma_sensor_1"] - data["gamma_sensor_2"]) / data["gamma_true"]
    return [
        Statement.judged(
            "2.4.2, 3.1",
            f"each packing goes through {PRINTED_AMPLITUDES} amplitudes: 1 by 0.05 to 0.2, by 0.01 to 0.05",
            f"the listed steps are {listed}",
            exact(float(listed - PRINTED_AMPLITUDES), 0.0),
            "17 amplitudes from 1 to 0.2 and 15 from 0.19 to 0.05; P 2.4.2 and 3.1 contradict each other",
        ),
        Statement.judged(
            "2.4.3",
            "each accelerometer's mean reading is -g +- 0.01 g",
            f"mean reading + g over all {len(readings)} records: {1e3 * readings.mean():+.1f} mg on average, at most "
            f"{1e3 * np.max(np.abs(readings)):.1f} mg (the laboratory's gravity is 9.8 m/s2)",
            true(bool(np.max(np.abs(readings)) <= READING), f"all records within {READING:g} g"),
            f"records of {data.recording():g} s: the base need not end where it began",
        ),
        Statement.judged(
            "2.4.3, 2.47",
            "sqrt(2) SD in a 10 Hz window estimates the amplitude of the base",
            f"measured over true Gamma, less 1: {_percent(bias[0])} at Gamma = {gammas[0]:.2f}, "
            f"{_percent(bias[-1])} at "
            f"{gammas[-1]:.2f}, at worst {_percent(bias[worst])} at {gammas[worst]:.2f}; both sensors differ by "
            f"{100 * sensors.mean():.2f} %",
            every(
                [below(Estimate(abs(e.mean), e.error), AMPLITUDE_ERROR) for e in bias],
                f"at each amplitude within {100 * AMPLITUDE_ERROR:g} %, with the whole interval of two errors",
            ),
            "with the sum times the frequency step (as printed the sum has no step)",
        ),
        Statement.judged(
            "2.4.3",
            "the maximum of the acceleration fails as its amplitude: impacts of the disks",
            f"largest acceleration of the base over its amplitude at 80 Hz: {peaks[0]} at Gamma = {gammas[0]:.2f}, "
            f"{peaks[-1]} at {gammas[-1]:.2f}",
            every([above(e, 1.0 + AMPLITUDE_ERROR) for e in peaks], "above 1.02 by two errors at every amplitude"),
            "at weak drives the disks never leave the bottom, and there are no impacts",
        ),
    ]


def _percent(e: Estimate) -> str:
    return f"{Estimate(100.0 * e.mean, 100.0 * e.error)} %"


def camera_statements(data: Data, cameras: Table) -> list[Statement]:
    """Pictures and what is made of them."""
    return [*marks_statements(data, cameras), *unwrapping(data), *effect(data)]


def marks_statements(data: Data, cameras: Table) -> list[Statement]:
    """Threshold, ellipses and tracking."""
    frames = round(len(data["seed"]) * (data.recording() + 1.0))
    disks = data.by_disk("disk_velocity").shape[1]
    count = len(data["seed"]) * disks
    share = float(np.mean(data["swapped"]))
    swapped = Estimate(share, math.sqrt(max(share * (1.0 - share), 1.0 / count) / count))
    angle = Estimate.over_runs(
        np.array([_rms(data["angle_error"][data["seed"] == seed]) for seed in np.unique(data["seed"])])
    )
    default = (cameras["resolution"] == Webcam().resolution) & (cameras["otsu"] == 0)
    seconds = Estimate.over_runs(cameras["seconds"][default])
    otsu = _rms(cameras["angle_error"][cameras["otsu"] == 1])
    return [
        Statement.judged(
            "2.4.3",
            "an automatic threshold leaves only the marks",
            f"in {frames} pictures of {disks} disks {data['lost'].sum():.0f} marks were lost and "
            f"{data['extra'].sum():.0f} "
            "other things taken for one (bolts and bottom are black, too: the range of sizes leaves them out)",
            exact(float(data["lost"].sum() + data["extra"].sum()), 0.0, "lost and extra marks"),
        ),
        Statement.judged(
            "2.4.3",
            "the nearest mark in the next picture is the same disk, also in a reorganisation",
            f"share of disks taken for another one at some time of a record: {swapped}",
            below(swapped, 0.01),
            "after a jump of a disk of more than half the distance of two marks",
        ),
        Statement.judged(
            "(not printed)",
            "how well does a fitted ellipse give the angle?",
            f"rms error {angle} degrees at {Webcam().resolution:g} pixels/m; with Otsu's threshold {otsu:.2f}; other "
            "cameras in the table",
            below(angle, 1.0),
        ),
        Statement.judged(
            "(not printed)",
            "does a picture of 60 disks, drawn and evaluated, take less than 0.1 s?",
            f"{Estimate(1e3 * seconds.mean, 1e3 * seconds.error)} ms of one processor",
            below(seconds, QUICK_ENOUGH),
        ),
    ]


def unwrapping(data: Data) -> list[Statement]:
    """The rule that makes angles continuous, and its limit."""
    disks = len(data["seed"]) * data.by_disk("disk_velocity").shape[1]
    printed, ours = data["wrong_as_printed"].sum(), data["aliased"].sum()
    fast, slow = (Estimate(*_binomial(data[f"{g}_wrong"].sum(), data[g].sum())) for g in ("fast", "slow"))
    return [
        Statement.judged(
            "2.4.3",
            "a jump above +90 degrees shifts the past by -180 degrees: then the series is continuous",
            f"excursions wrong by a half turn or more: {printed:.0f} of {disks} as printed, {ours:.0f} with +180 "
            "degrees",
            exact(float(printed - ours), 0.0, "more wrong excursions than with +180 degrees"),
            "as printed each crossing makes the jump larger, 180 degrees become 360; with the other sign only "
            "disks above "
            "15 RPM are wrong (ERRATA)",
        ),
        Statement.judged(
            "(not printed)",
            "one picture a second shows mean velocities up to 15 RPM only",
            f"share of wrong excursions among disks above 15 RPM {fast} (of {data['fast'].sum():.0f}), below 10 "
            f"RPM {slow} (of "
            f"{data['slow'].sum():.0f})",
            every(
                [above(fast, 0.9), below(slow, 0.05)],
                "above 15 RPM more than 90 % wrong, below 10 RPM less than 5 %, with two errors",
            ),
            "some disks below 15 RPM turn faster for single seconds",
        ),
    ]


def _binomial(count: float, total: float) -> tuple[float, float]:
    if total == 0:
        return math.nan, math.nan
    share = count / total
    return share, math.sqrt(max(share * (1.0 - share), 1.0 / (total + 2.0)) / total)


def effect(data: Data) -> list[Statement]:
    """What errors of the angles do to the numbers of P 3.1."""
    gammas = mean_gammas(data)
    weak = gammas < 1.0
    added = {
        name: over_packings(data, lambda rows, n=name: data[f"{n}_pictures"][rows] - data[f"{n}_camera"][rows])  # type: ignore[misc]
        for name in ("deviation", "correlation")
    }
    square = over_packings(data, lambda rows: data["square_pictures"][rows] / data["square_camera"][rows] - 1.0)
    sigma, rho = added["deviation"][0], added["correlation"][0]
    middle = int(np.argmin(np.abs(gammas - 0.5)))
    return [
        Statement.judged(
            "3.2, Fig. 3.5",
            "below Gamma = 1 paths of simulations are less noisy than those of the laboratory",
            f"what pictures add to <sigma_a>: {sigma} at Gamma = {gammas[0]:.2f}, {added['deviation'][middle]} at "
            f"{gammas[middle]:.2f}; to <rho^2>: {rho} and {added['correlation'][middle]}; the same paths, "
            f"{np.count_nonzero(weak)} amplitudes",
            every(
                [above(sigma, 0.0), below(rho, 0.0)], "at the weakest drive sigma_a rises and rho^2 falls by pictures"
            ),
            "angles of marks are wrong by a fifth of a degree, which is more than weakly driven disks turn in a second",
        ),
        Statement.judged(
            "(not printed)",
            "do errors of the angles change <omega^2>?",
            f"relative to an ideal camera: {square[0]} at Gamma = {gammas[0]:.2f}, {square[middle]} at "
            f"{gammas[middle]:.2f}, "
            f"{square[-1]} at {gammas[-1]:.2f}",
            below(Estimate(abs(square[middle].mean), square[middle].error), 0.1),
        ),
    ]


def camera_table(cameras: Table) -> str:
    """One row for each camera."""
    keys = list(zip(*(cameras[n] for n in ("resolution", "noise", "vignetting", "otsu")), strict=True))
    rows = []
    for key in dict.fromkeys(keys):
        at = np.array([k == key for k in keys])
        weak = at & (cameras["amplitude"] == cameras["amplitude"].min())
        pixels, noise, vignetting, otsu = key
        rows.append(
            [
                f"{pixels:g}",
                f"{noise:g}",
                f"{100 * vignetting:.0f} %",
                "Otsu" if otsu else "IsoData",
                f"{_rms(cameras['angle_error'][at]):.2f}",
                f"{100 * cameras['swapped'][at].mean():.1f} %",
                f"{cameras['lost'][at].sum():.0f}",
                f"{cameras['extra'][at].sum():.0f}",
                f"{cameras['deviation'][weak].mean() - cameras['deviation_true'][weak].mean():+.2f}",
                f"{1e3 * cameras['seconds'][at].mean():.0f}",
            ]
        )
    header = ["pixels/m", "noise", "corners darker", "threshold", "rms error of the angle [degrees]", "swapped", "lost"]
    header += ["extra", "added to sigma_a at the weakest drive", "ms a picture"]
    total = f"{cameras['frames'][0] * 2:g} pictures of {cameras['disks'][0]:g} disks for each row"
    return f"Cameras: {total}; noise in steps of 255.\n\n{markdown_table(header, rows)}"
