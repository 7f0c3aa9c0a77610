"""P Fig. 3.2: nearest-neighbours regression of <omega^2> on Gamma, both as measured, and our own power laws."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.statistics.regression import HIGH, LOW, THESIS_SLOPES, Numbers, Range, Regression, slope
from jostle_lab.statistics.rotation import nearest_neighbours_regression
from jostle_lab.tables import markdown_table
from jostle_lab.verdicts import above, exact, near
from studies.thesis.laboratory.data import EYES, Data
from studies.thesis.laboratory.paths import at_length, gamma_ticks, notes

SAME_SLOPE, SAME_BREAK = 0.2, 0.2
"""What counts as the same exponent (P gives no error and rounds 3.94 and 3.85 to 4), and as the same Gamma."""
NAMES = {"true": "in truth", "camera": "as measured", "pictures": "by pictures"}
STYLES = {"true": ("o", "0.0", "-"), "camera": ("s", "0.45", "--"), "pictures": ("^", "#d07a1f", ":")}
MIDDLE = 0.5
"""Gamma that cuts the lower range in two: a power law has the same exponent in both."""
PRINTED_AMPLITUDES, PRINTED_POINTS = 37, 55500


def product(schedule: Data, longer: Data) -> Product:
    """The figure."""
    found = {eye: schedule.regression("square", eye) for eye in EYES}
    return Product(
        "Figure 3.2: mean squared angular velocity against Gamma, measured",
        _rows(found),
        draw(found),
        statements(schedule, found),
        [
            *notes(schedule, longer),
            f"regression: mean of the K = {schedule.packings()} nearest packings in Gamma; errors by drawing packings; "
            "lines by least squares through the regression at every K-th Gamma",
            "as measured: Gamma by accelerometers, angles modulo 180 degrees once a second; by pictures: the same "
            "Gamma, "
            "angles of marks in pictures; in truth: Gamma and angles themselves",
        ],
        [length_table(longer)],
    )


def _rows(found: dict[str, Regression]) -> list[dict[str, Any]]:
    return [
        {"eye": eye, "gamma": float(g), "mean_square_rpm": float(y), "error": float(e)}
        for eye, curve in found.items()
        for g, y, e in zip(curve.at, curve.curve, curve.error, strict=True)
    ]


def draw(found: dict[str, Regression]) -> Figure:
    """Linear and logarithmic as in the thesis; its slopes beside ours."""
    figure = Figure(figsize=(WIDTH, 3.9), layout="constrained")
    linear, log = figure.subplots(1, 2)
    for panel in (linear, log):
        for eye in ("true", "camera"):
            curve, (marker, colour, line) = found[eye], STYLES[eye]
            panel.plot(curve.gamma, curve.values, marker, ms=2, mfc="none", mew=0.4, color=colour, alpha=0.5, zorder=1)
            panel.fill_between(
                curve.at, curve.curve - 2 * curve.error, curve.curve + 2 * curve.error, color=colour, alpha=0.25, lw=0
            )
            panel.plot(curve.at, curve.curve, line, color=colour, lw=1.2, label=f"{NAMES[eye]}: regression, 95 %")
        panel.set_xlabel(r"$\Gamma$")
    linear.set_ylabel(r"$\langle\bar\omega^2\rangle$ [RPM$^2$]")
    linear.plot([], [], "o", ms=3, mfc="none", color="0.5", label="single packings")
    log.set(xscale="log", yscale="log")
    gamma_ticks(log, found["true"].gamma)
    measured = found["camera"]
    for range_, printed in THESIS_SLOPES.items():
        ours = measured.slope(range_)
        where = r"$\Gamma < 1$" if range_ == LOW else r"$1.6 < \Gamma < 4.5$"
        _line(log, measured, range_, ours.mean, {"ls": "-", "color": "#c0272d"}, f"ours, {where}: slope {ours}")
        _line(log, measured, range_, printed, {"ls": "-.", "color": "#1f5fa8"}, f"P, {where}: slope {printed:.2f}")
    linear.legend(loc="upper left")
    log.legend(loc="lower right", fontsize=7)
    return figure


def _line(axes: Axes, curve: Regression, range_: Range, slope_: float, style: Any, label: str) -> None:
    """A power law through the middle of the regression within a range."""
    inside = (curve.at >= range_[0]) & (curve.at <= range_[1])
    x, y = np.log(curve.at[inside]), np.log(curve.curve[inside])
    ends = np.array([x.min(), x.max()])
    axes.plot(np.exp(ends), np.exp(y.mean() + slope_ * (ends - x.mean())), lw=1.0, label=label, **style)


def statements(data: Data, found: dict[str, Regression]) -> list[Statement]:
    """What P 3.1 says of the figure."""
    return [
        points(data),
        equivalence(data),
        spread(data),
        *(_slope(data, found, eye, range_) for range_ in THESIS_SLOPES for eye in ("camera", "true")),
        aliasing_of_slope(found),
        *(_transition(data, found[eye], NAMES[eye]) for eye in ("camera", "true")),
    ]


def points(data: Data) -> Statement:
    """Numbers of disks, packings and amplitudes."""
    disks, rows = data.by_disk("disk_velocity").shape[1], len(data["seed"])
    return Statement.judged(
        "3.1",
        f"25 packings of 60 disks at {PRINTED_AMPLITUDES} amplitudes: {PRINTED_POINTS} points",
        f"{data.packings()} packings of {disks} disks at {rows // data.packings()} listed amplitudes: "
        f"{rows * disks} points",
        exact(float(rows * disks - PRINTED_POINTS), 0.0, "difference of the counts"),
        f"60 x 25 x 37 is {PRINTED_POINTS}, but the schedule that P 2.4.2 lists (1 by 0.05 to 0.2, by 0.01 to "
        "0.05) has 32 "
        "amplitudes: 48000 points",
    )


def equivalence(data: Data) -> Statement:
    """Both regressions, on the same numbers."""
    squares, gamma = data.by_disk("disk_velocity") ** 2, data["gamma_measured"]
    at, packings, disks = np.geomspace(gamma.min(), gamma.max(), 200), data.packings(), squares.shape[1]
    by_packing = nearest_neighbours_regression(gamma, squares.mean(axis=1), packings, at)
    by_disk = nearest_neighbours_regression(np.repeat(gamma, disks), squares.ravel(), packings * disks, at)
    difference = float(np.max(np.abs(by_disk / by_packing - 1.0)))
    return Statement.judged(
        "3.1",
        "K = 25 packings is equivalent to K = 1500 disks",
        f"largest relative difference of K = {packings} packings and K = {packings * disks} disks: "
        f"{difference:.1e}; all "
        "disks of a packing have the same Gamma, so the nearest disks are those of the nearest packings",
        exact(difference, 1e-9, "relative difference"),
        "a packing at the edge of the neighbours is cut if another one has the same Gamma to the last digit",
    )


def spread(data: Data) -> Statement:
    """Gamma at the same signal: of the base, and as measured."""
    true, measured = [], []
    for amplitude in data.amplitudes():
        rows = data.rows_at(amplitude)
        mean = data["gamma_true"][rows].mean()
        true.append(data["gamma_true"][rows].std(ddof=1) / mean)
        measured.append((data["gamma_measured"] - data["gamma_true"])[rows].std(ddof=1) / mean)
    packing, sensor = (
        Estimate(float(np.mean(v)), float(np.std(v, ddof=1)) / math.sqrt(len(v))) for v in (true, measured)
    )
    difference = Estimate(packing.mean - sensor.mean, math.hypot(packing.error, sensor.error))
    return Statement.judged(
        "3.1",
        "recorded Gamma differs from packing to packing at the same signal: feedback of the packing, and sensor noise",
        f"standard deviation over packings, mean over amplitudes: of the base's Gamma {100 * packing.mean:.2f} %, "
        "of what "
        f"the accelerometers add {100 * sensor.mean:.2f} %",
        above(packing, 0.0) & above(sensor, 0.0),
        f"difference {difference}",
    )


def _slope(data: Data, found: dict[str, Regression], eye: str, range_: Range) -> Statement:
    printed, ours = THESIS_SLOPES[range_], found[eye].slope(range_)
    curve = found[eye]
    ends = max(range_[0], curve.gamma.min()), min(range_[1], curve.gamma.max())
    even = [
        slope(grid, curve.curve_at(grid), (0.0, np.inf)) for grid in (np.linspace(*ends, 60), np.geomspace(*ends, 60))
    ]
    where = "Gamma < 1" if range_ == LOW else f"{range_[0]:g} < Gamma < {range_[1]:g}"
    limit = (
        "what the camera cannot show, disks above 15 RPM, makes the exponent larger; P has what the camera shows"
        if eye == "true"
        else "one picture a second shows disks above 15 RPM as slower ones, which lowers the exponent"
    )
    scatter = (
        "below Gamma = 0.5 a few disks carry <omega^2>, and packings differ by factors of more than ten, so the "
        "exponent "
        "is that of few; records of 9 and of 90 s give the same (table), so it is not their length"
    )
    cause = scatter if range_ == LOW else limit
    parts = ""
    if range_ == LOW:
        below_, above_ = curve.slope((LOW[0], MIDDLE)), curve.slope((MIDDLE, LOW[1]))
        parts = f"; {below_} below Gamma = {MIDDLE:g}, {above_} above"
    return Statement.judged(
        "3.1, Fig. 3.2",
        f"{where}: <omega^2> grows as Gamma^{printed:.2f}",
        f"exponent {NAMES[eye]} {ours}{parts}; with points evenly in Gamma {even[0]:.2f}, in ln Gamma {even[1]:.2f}",
        near(ours, printed, SAME_SLOPE),
        f"{cause}; {at_length(data)}",
    )


def aliasing_of_slope(found: dict[str, Regression]) -> Statement:
    """Both exponents above 1.6 from the same packings."""

    def paired(low: str, high: str) -> Estimate:
        one, other = found[low], found[high]
        drawn = [
            slope(other.at, b, HIGH) - slope(one.at, a, HIGH)
            for a, b in zip(one.resampled, other.resampled, strict=True)
        ]
        mean = slope(other.at, other.curve, HIGH) - slope(one.at, one.curve, HIGH)
        return Estimate(mean, float(np.std(drawn, ddof=1)))

    ideal, pictures = paired("camera", "true"), paired("pictures", "camera")
    return Statement.judged(
        "(not printed)",
        "does one picture a second lower the exponent above Gamma = 1.6?",
        f"in truth less as measured: {ideal}, the same packings drawn; as measured less by pictures: {pictures} "
        f"(exponents {', '.join(f'{NAMES[eye]} {found[eye].slope(HIGH)}' for eye in EYES)})",
        above(ideal, 0.0),
        "a disk that turns more than a quarter turn in a second is read as a slower one",
    )


def _transition(data: Data, curve: Regression, name: str) -> Statement:
    ours, upper = curve.power_break((0.0, HIGH[1])), curve.power_break((MIDDLE, HIGH[1]))
    low, high = ours.mean - 2.0 * ours.error, ours.mean + 2.0 * ours.error
    return Statement.judged(
        "3.1, Fig. 3.2",
        "the exponent changes at Gamma = 1.6",
        f"{name}: two power laws of the regression meet at Gamma = {ours}, 95 %: {low:.2f} to {high:.2f}; of "
        "Gamma above "
        f"{MIDDLE:g} only, at {upper}",
        near(ours, 1.6, SAME_BREAK),
        "ours changes where the disks leave the bottom, Gamma = 1, as P's simulations do (Fig. 3.6); P suspects "
        "stiffness "
        f"and viscosity of the material (3.1), which are those of P 3.2 here; {at_length(data)}",
    )


def length_table(longer: Data) -> str:
    """What the length of a record does, one packing."""
    lengths = [int(s) for s in longer["piece_seconds"]]
    shape = (-1, len(lengths))
    squares, rho, sigma = (longer[f"piece_{name}"].reshape(shape) for name in ("square", "correlation", "deviation"))
    gammas = longer["gamma_measured"][: len(squares)]
    rows = [
        [f"{gammas[i]:.2f}", *(f"{a[i, j]:.3g}" for a in (squares, rho, sigma) for j in range(len(lengths)))]
        for i in np.argsort(gammas)
    ]
    heads = [f"{name}, {s} s" for name in ("<omega^2> [RPM^2]", "<rho^2>", "<sigma_a>") for s in lengths]
    laws = ", ".join(f"{s} s: {_exponents(gammas, squares[:, j])}" for j, s in enumerate(lengths))
    text = f"Records of the longer packing cut into pieces. Exponents below Gamma = 1 and from 1.6 to 4.5: {laws}."
    return f"{text}\n\n{markdown_table(['Gamma', *heads], rows)}"


def _exponents(gamma: Numbers, square: Numbers) -> str:
    parts = []
    for low, high in (LOW, HIGH):
        inside = (gamma >= low) & (gamma <= high + 0.1)
        parts.append(f"{slope(gamma[inside], square[inside], (low, np.inf)):.2f}" if inside.sum() > 1 else "none")
    return " and ".join(parts)
