"""P Fig. 3.3: squared correlation and adjusted deviation of the angular paths against Gamma, as measured."""

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.statistics.regression import HIGH, Regression, within
from jostle_lab.statistics.rotation import squared_correlation
from jostle_lab.verdicts import above, every, falls, near, rises
from studies.thesis.laboratory.data import EYES, Data
from studies.thesis.laboratory.paths import at_length, mean_gammas, notes, over_packings
from studies.thesis.laboratory.regression import NAMES, STYLES

PRINTED = {"correlation": 0.95, "deviation": 0.4}
"""Where P's curves stabilise."""
MARGIN = 0.05
"""What counts as the same level."""
SYMBOLS = {"correlation": r"$\langle\rho^2_{\theta,t}\rangle$", "deviation": r"$\langle\sigma_a\rangle$"}
WORDS = {"correlation": "<rho^2>", "deviation": "<sigma_a>"}
THRESHOLD = 1.6
WALKS, WALK_FRAMES = 4000, 900
"""Random walks of P's length of a record."""

Curves = dict[tuple[str, str], Regression]
"""By quantity and eye."""


def product(schedule: Data, longer: Data) -> Product:
    """The figure."""
    found = {(q, eye): schedule.regression(q, eye) for q in PRINTED for eye in EYES}
    return Product(
        "Figure 3.3: steadiness of the angular paths against Gamma, measured",
        _rows(found),
        draw(found, longer),
        statements(schedule, longer, found),
        notes(schedule, longer),
    )


def _rows(found: Curves) -> list[dict[str, Any]]:
    return [
        {"quantity": WORDS[q], "eye": eye, "gamma": float(g), "mean": float(y), "error": float(e)}
        for (q, eye), curve in found.items()
        for g, y, e in zip(curve.at, curve.curve, curve.error, strict=True)
    ]


def draw(found: Curves, longer: Data) -> Figure:
    """rho^2 and sigma_a, the levels and the threshold of P beside them."""
    figure = Figure(figsize=(WIDTH, 3.7), layout="constrained")
    panels = figure.subplots(1, 2, sharex=True)
    for panel, quantity in zip(panels, PRINTED, strict=True):
        for eye in EYES:
            curve, (marker, colour, line) = found[quantity, eye], STYLES[eye]
            style = {"color": colour, "ls": line, "lw": 1.0, "marker": marker, "ms": 3, "mfc": "none"}
            panel.errorbar(curve.at, curve.curve, curve.error, elinewidth=0.7, capsize=1.5, label=NAMES[eye], **style)
        length = f"as measured, records of {longer.recording():g} s"
        panel.plot(longer["gamma_measured"], longer[f"{quantity}_camera"], "kx", ms=5, mew=1.0, label=length)
        panel.axhline(PRINTED[quantity], color="#1f5fa8", lw=0.8, ls="-.", label=f"P: {PRINTED[quantity]:g}")
        panel.axvline(THRESHOLD, color="#1f5fa8", lw=0.8, ls=":", label=rf"P: threshold, $\Gamma$ = {THRESHOLD:g}")
        panel.set(xlabel=r"$\Gamma$", ylabel=SYMBOLS[quantity], ylim=(0.0, 1.05))
    panels[0].legend(loc="lower right")
    return figure


def statements(data: Data, longer: Data, found: Curves) -> list[Statement]:
    """What P 3.1 says of the figure."""
    return [
        initially(data),
        *(_level(found, quantity, data, longer) for quantity in PRINTED),
        constant(found),
        *(_break(found, quantity) for quantity in PRINTED),
        fluctuations(data),
        walk(),
    ]


def initially(data: Data) -> Statement:
    """Up to Gamma = 1.6, the end of it apart."""
    gammas = mean_gammas(data)
    rho, sigma = (over_packings(data, lambda rows, q=q: data[f"{q}_camera"][rows]) for q in PRINTED)  # type: ignore[misc]
    below_one, to_threshold = gammas <= 1.05, gammas <= THRESHOLD + 0.05
    parts = [
        check([e for e, keep in zip(points, chosen, strict=True) if keep])
        for chosen in (below_one, to_threshold)
        for points, check in ((rho, rises), (sigma, falls))
    ]
    last = int(np.count_nonzero(below_one)) - 1
    return Statement.judged(
        "3.1, Fig. 3.3",
        "<rho^2> grows and <sigma_a> falls with Gamma up to the threshold 1.6",
        f"from Gamma = {gammas[0]:.2f} to {gammas[last]:.2f} <rho^2> goes from {rho[0]} to {rho[last]}, <sigma_a> from "
        f"{sigma[0]} to {sigma[last]}; at Gamma = 1.5 they are {_at(gammas, rho, 1.5)} and {_at(gammas, sigma, 1.5)}",
        every(parts, "each up to Gamma = 1, and up to 1.6: " + parts[0].rule),
        "both turn at Gamma = 1 in ours, as in P's simulations (Fig. 3.7)",
    )


def _at(gammas: Any, points: list[Estimate], gamma: float) -> Estimate:
    return points[int(np.argmin(np.abs(gammas - gamma)))]


def _level(found: Curves, quantity: str, data: Data, longer: Data) -> Statement:
    """On the longer records, which are nearer to P's 900 s: a disk's mean over the drives, and the scatter of disks."""
    by_eye = {eye: found[quantity, eye].mean(HIGH) for eye in EYES}
    drives = within(longer["gamma_measured"], HIGH)
    ours = Estimate.over_runs(longer.by_disk(f"disk_{quantity}")[drives].mean(axis=0))
    return Statement.judged(
        "3.1, Fig. 3.3",
        f"{WORDS[quantity]} stabilises at about {PRINTED[quantity]:g} from Gamma = 1.6 on",
        f"mean from Gamma = 1.6 to 4.5 as measured: {ours} in records of {longer.recording():g} s (one packing, "
        "scatter of "
        f"the disks); in records of {data.recording():g} s "
        f"{', '.join(f'{NAMES[eye]} {e}' for eye, e in by_eye.items())}",
        near(ours, PRINTED[quantity], MARGIN),
        "rho^2 grows with the length of the record, sigma_a little (table of Fig. 3.2); nine more "
        "packings of 90 s, half an hour of one processor, narrow it to a third",
    )


def constant(found: Curves) -> Statement:
    """The upper half of the range against the lower one."""
    parts, words = [], []
    for quantity in PRINTED:
        change = found[quantity, "camera"].estimate(
            lambda x, y: float(y[(x > 3.0) & (x <= 4.5)].mean() - y[(x >= 1.6) & (x <= 3.0)].mean())
        )
        parts.append(near(change, 0.0, MARGIN))
        words.append(f"{WORDS[quantity]} changes by {change}")
    return Statement.judged(
        "3.1, Fig. 3.3",
        "above the threshold both stay nearly constant",
        f"from Gamma = 1.6-3.0 to 3.0-4.5 {' and '.join(words)}, as measured",
        every(parts, f"changes at most {MARGIN:g}, with the whole interval"),
        "sigma_a grows steadily from Gamma = 1 on, in truth as well, and faster by camera where disks pass 15 "
        "RPM: it passes "
        "0.4 near Gamma = 3, so its mean is P's; P's own simulations have the same rise (Fig. 3.7)",
    )


def _break(found: Curves, quantity: str) -> Statement:
    ours = found[quantity, "camera"].level_break((0.0, HIGH[1]))
    return Statement.judged(
        "3.1, Fig. 3.3",
        f"{WORDS[quantity]} saturates at the same Gamma = 1.6 at which the exponent changes",
        f"two straight lines against ln Gamma meet at Gamma = {ours}, as measured",
        near(ours, THRESHOLD, 0.2),
        "the rise ends below Gamma = 1 in ours, with the disks in contact, as in P's simulations (Fig. 3.7); "
        "pictures of "
        "coarse marks shift it up, since their noise hides slow rotation: by pictures it is at "
        f"{found[quantity, 'pictures'].level_break((0.0, HIGH[1]))}",
    )


def fluctuations(data: Data) -> Statement:
    """Scatter of packings near the threshold and far above it."""
    ratios, words = [], []
    for quantity in PRINTED:
        near_ = _scatter(data, quantity, 1.2, 2.1)
        far = _scatter(data, quantity, 2.6, 4.6)
        ratio = near_.mean / far.mean
        ratios.append(Estimate(ratio, ratio * math.hypot(near_.error / near_.mean, far.error / far.mean)))
        words.append(f"{WORDS[quantity]} {near_} against {far}")
    return Statement.judged(
        "3.1, Fig. 3.3",
        "near the threshold both fluctuate more than far from it, perhaps since Gamma is uncertain",
        f"standard deviation over packings at Gamma 1.2-2.1 against 2.6-4.6: {'; '.join(words)}",
        every([above(r, 1.0) for r in ratios], "ratio of the scatter above 1 by two errors, both"),
        f"{at_length(data)}. Gamma is known to half a per cent here, so no regimes are mixed; P suspects that "
        "mixture itself, and its own "
        "simulations have none of it",
    )


def _scatter(data: Data, quantity: str, low: float, high: float) -> Estimate:
    """Standard deviation over packings, mean over the amplitudes between two Gamma."""
    found = []
    for amplitude in data.amplitudes():
        rows = data.rows_at(amplitude)
        if low <= data["gamma_measured"][rows].mean() <= high:
            found.append(data[f"{quantity}_camera"][rows].std(ddof=1))
    error = np.std(found, ddof=1) / math.sqrt(len(found)) if len(found) > 1 else math.nan
    return Estimate(float(np.mean(found)) if found else math.nan, float(error))


def walk() -> Statement:
    """rho^2 of random walks without drift."""
    steps = np.random.default_rng(1).standard_normal((WALK_FRAMES, WALKS))
    rho = Estimate.over_runs(squared_correlation(np.cumsum(steps, axis=0)))
    return Statement.judged(
        "3.1",
        "rho^2 is 0 for a random walk without drift",
        f"<rho^2> = {rho} of {WALKS} walks of {WALK_FRAMES} steps",
        near(rho, 0.0, 0.05),
        "the correlation of a walk with time does not fall with its length: a single walk wanders off to one side",
    )
