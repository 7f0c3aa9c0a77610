"""P Fig. 3.11: <omega^2> against Gamma, molecular dynamics beside event-driven dynamics, three stiffnesses."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.runs.run import Run
from jostle_lab.statements import Product, Statement, Verdict, verdict
from jostle_lab.statistics.estimates import Estimate, Numbers, bootstrap, bootstrap_mean, bootstrap_ratio
from studies.thesis.packing.runs import (
    MOLECULAR,
    MOVING,
    RANDOM_PHASE,
    Method,
    Record,
    angles,
    mean_square,
    mean_velocities,
    packing_run,
    persistent_square,
)

STIFFNESSES = {1e4: ("o", "#1f5fa8"), 1e5: ("^", "#d07a1f"), 1e6: ("s", "#2e7d4f")}
"""Symbols of the thesis' caption."""
METHODS: dict[Method, dict[str, Any]] = {
    MOLECULAR: {"linestyle": "-"},
    RANDOM_PHASE: {"linestyle": "--", "mfc": "white"},
    MOVING: {"linestyle": ":", "mfc": "white", "alpha": 0.75},
}


@dataclass(frozen=True)
class Scope:
    """How much is run."""

    gammas: tuple[float, ...]
    packings: int
    record: Record


QUICK = Scope((2.0, 5.0, 12.0), 2, Record(4.0, 8.0, 2.0))
FULL = Scope((2.0, 3.0, 5.0, 9.0, 15.0, 25.0), 5, Record(10.0, 30.0, 5.0))

Key = tuple[Method, float, float]
"""Method, k_n [N/m], Gamma."""


def make(laboratory: Laboratory, quick: bool, seeds: int | None = None) -> Product:
    """Run every packing by every method and compare."""
    scope = QUICK if quick else FULL
    numbers = range(1, (seeds or scope.packings) + 1)
    keys: list[Key] = list(product(METHODS, STIFFNESSES, scope.gammas))
    runs: dict[tuple[Key, int], Run] = {
        (key, seed): packing_run(key[0], key[2], key[1], seed, scope.record) for seed in numbers for key in keys
    }
    tables = laboratory.run(list(runs.values()), "figure 3.11")
    squares: dict[Key, list[float]] = {key: [] for key in keys}
    lasting: dict[Key, list[float]] = {key: [] for key in keys}
    velocities: dict[tuple[Key, int], Numbers] = {}
    for (key, seed), run in runs.items():
        paths = angles(tables[run], scope.record)
        velocities[key, seed] = mean_velocities(paths, scope.record.sample)
        squares[key].append(mean_square(paths, scope.record.sample))
        lasting[key].append(persistent_square(paths, scope.record.sample))
    record = scope.record
    return Product(
        "Figure 3.11: mean squared angular velocity, molecular dynamics and event-driven",
        _rows(squares, lasting),
        draw(squares, scope),
        [*statements(squares, lasting, scope), disk_by_disk(velocities, scope)],
        [
            f"60 disks, 80 Hz, kappa = 0.77, gamma_n = 0.1 kg/s, mu = 0.1; {len(numbers)} packings, seeds 1 to "
            f"{len(numbers)} (the thesis has 100); {record.settling:g} s unobserved, then {record.observed:g} s",
            "errors by bootstrap over packings, ratios packing by packing",
            "lasting part: product of the mean angular velocities of the two halves of the record, free of the random "
            "walk of the angles that every finite record adds to <omega^2>",
            "the thesis' ED is the fixed bottom with a random phase; the moving base needs no such assumption",
        ],
    )


def _rows(squares: dict[Key, list[float]], lasting: dict[Key, list[float]]) -> list[dict[str, Any]]:
    rows = []
    for key, values in squares.items():
        method, stiffness, gamma = key
        mean, last = bootstrap_mean(values), bootstrap_mean(lasting[key])
        ratio = bootstrap_ratio(values, squares[MOLECULAR, stiffness, gamma])
        rows.append(
            {
                "method": method.name,
                "normal_stiffness": stiffness,
                "gamma": gamma,
                "mean_square_rpm": mean.mean,
                "error": mean.error,
                "lasting_rpm": last.mean,
                "lasting_error": last.error,
                "ratio_to_md": ratio.mean,
                "ratio_error": ratio.error,
                "packings": len(values),
            }
        )
    return rows


def draw(squares: dict[Key, list[float]], scope: Scope) -> Figure:
    """Linear and logarithmic, as in the thesis, and the ratio below."""
    figure = Figure(figsize=(WIDTH, 6.4), layout="constrained")
    mosaic = figure.subplot_mosaic([["linear", "log"], ["ratio", "ratio"]], height_ratios=[1.5, 1.0])
    shift = {stiffness: 1.0 + 0.012 * (i - 1) for i, stiffness in enumerate(STIFFNESSES)}
    for method, style in METHODS.items():
        for stiffness, (marker, colour) in STIFFNESSES.items():
            points = [bootstrap_mean(squares[method, stiffness, gamma]) for gamma in scope.gammas]
            x = np.array(scope.gammas) * shift[stiffness]
            line = {"marker": marker, "color": colour, "ms": 4, "lw": 1.0, "elinewidth": 0.7, "capsize": 1.5, **style}
            y, e = [p.mean for p in points], [p.error for p in points]
            label = f"{method.name}, $k_n$ = {_power(stiffness)} N/m"
            for name in ("linear", "log"):
                mosaic[name].errorbar(x, y, yerr=e, label=label, **line)
            if method is MOLECULAR:
                continue
            ratios = [
                bootstrap_ratio(squares[method, stiffness, gamma], squares[MOLECULAR, stiffness, gamma])
                for gamma in scope.gammas
            ]
            mosaic["ratio"].errorbar(x, [r.mean for r in ratios], yerr=[r.error for r in ratios], label=label, **line)
    for name in ("log", "ratio"):
        mosaic[name].set_xscale("log")
        mosaic[name].set_xticks(list(scope.gammas), [f"{g:g}" for g in scope.gammas])
        mosaic[name].minorticks_off()
    mosaic["log"].set_yscale("log")
    mosaic["ratio"].set_yscale("log")
    low, high = mosaic["ratio"].get_ylim()
    ticks = [t for t in (0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0) if low <= t <= high]
    mosaic["ratio"].set_yticks(ticks, [f"{t:g}" for t in ticks])
    mosaic["ratio"].minorticks_off()
    mosaic["ratio"].axhline(1.0, color="0.4", lw=0.8, zorder=0)
    mosaic["ratio"].set_ylabel("event-driven / MD")
    for panel in mosaic.values():
        panel.set_xlabel(r"$\Gamma$")
    for name in ("linear", "log"):
        mosaic[name].set_ylabel(r"$\langle\bar\omega^2\rangle$ [RPM$^2$]")
    mosaic["linear"].set_ylim(0.0, None)
    handles, labels = mosaic["linear"].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    return figure


def _power(stiffness: float) -> str:
    return rf"$10^{{{round(np.log10(stiffness))}}}$"


def overall(values: dict[Key, list[float]], method: Method, stiffness: float, gammas: tuple[float, ...]) -> Estimate:
    """Geometric mean over Gamma of event-driven over MD, error by drawing packings."""

    def geometric_mean(*samples: Numbers, axis: int) -> Numbers:
        return np.asarray(np.exp(_logs(samples, axis).mean(axis=0)))

    return _estimate(_samples(values, method, stiffness, gammas), geometric_mean)


def distance(values: dict[Key, list[float]], method: Method, stiffness: float, gammas: tuple[float, ...]) -> Estimate:
    """Root mean square over Gamma of ln(event-driven / MD), error by drawing packings."""

    def rms(*samples: Numbers, axis: int) -> Numbers:
        return np.asarray(np.sqrt(np.mean(_logs(samples, axis) ** 2, axis=0)))

    return _estimate(_samples(values, method, stiffness, gammas), rms)


def _samples(
    values: dict[Key, list[float]], method: Method, stiffness: float, gammas: tuple[float, ...]
) -> list[Numbers]:
    """The packings of `method` at each Gamma, then those of MD."""
    return [np.array(values[m, stiffness, gamma]) for m in (method, MOLECULAR) for gamma in gammas]


def _estimate(samples: Sequence[Numbers], statistic: Callable[..., Numbers]) -> Estimate:
    """`statistic` of all packings; its error by drawing the same packings from every sample."""
    drawn = bootstrap(samples, statistic, paired=True)
    return Estimate(float(statistic(*samples, axis=0)), float(drawn.std(ddof=1)))


def _logs(samples: Sequence[Numbers], axis: int) -> Numbers:
    """ln(event-driven / MD) of the means over packings, Gamma first."""
    means = np.stack([np.mean(sample, axis=axis) for sample in samples])
    above, below = np.split(means, 2)
    return np.asarray(np.log(above / below))


def statements(squares: dict[Key, list[float]], lasting: dict[Key, list[float]], scope: Scope) -> list[Statement]:
    """The statements of P 3.3 on this figure."""
    found = [s for method in (RANDOM_PHASE, MOVING) for s in _coincidence(squares, method, scope)]
    for k in STIFFNESSES:
        whole = [bootstrap_mean(squares[MOLECULAR, k, g]) for g in scope.gammas]
        last = [bootstrap_mean(lasting[MOLECULAR, k, g]) for g in scope.gammas]
        top = scope.gammas[int(np.argmax([e.mean for e in last]))]
        text = ", ".join(f"{g:g}: {w} ({x})" for g, w, x in zip(scope.gammas, whole, last, strict=True))
        found.append(
            Statement(
                "3.2",
                "<omega^2> grows with Gamma up to about 10, then falls",
                f"MD, k_n = {k:.0e}, <omega^2> (lasting part) [RPM^2]: {text}; the lasting part is largest at {top:g}",
                verdict(5.0 <= top <= 18.0),
            )
        )
    return found


def _coincidence(squares: dict[Key, list[float]], method: Method, scope: Scope) -> list[Statement]:
    ratios = {k: overall(squares, method, k, scope.gammas) for k in STIFFNESSES}
    far = {k: distance(squares, method, k, scope.gammas) for k in STIFFNESSES}
    softest, stiffest = far[1e4], far[1e6]
    gain = Estimate(softest.mean - stiffest.mean, float(np.hypot(softest.error, stiffest.error)))
    clear = abs(gain.mean) > 2.0 * gain.error
    text = "; ".join(f"k_n = {k:.0e}: {ratios[k]}, rms of ln {far[k]}" for k in STIFFNESSES)
    worst = {k: _worst(squares, method, k, scope) for k in STIFFNESSES}
    return [
        Statement(
            "Fig. 3.11",
            "the coincidence of MD and ED gets better for increasing stiffness",
            f"{method.name} / MD, geometric mean over Gamma: {text}; the rms falls by {gain} from 1e4 to 1e6"
            + ("" if clear else ": not beyond the errors"),
            verdict(gain.mean > 0.0) if clear else Verdict.OPEN,
        ),
        Statement(
            "3.3",
            "good degree of coincidence for Gamma > 2",
            f"{method.name}: worst factor "
            + ", ".join(f"{f:.2f} at k_n = {k:.0e}, Gamma = {g:g}" for k, (f, g) in worst.items()),
            verdict(max(f for f, _ in worst.values()) < 1.6),
        ),
    ]


def disk_by_disk(velocities: dict[tuple[Key, int], Numbers], scope: Scope) -> Statement:
    """Correlation of the same disks' velocities by two methods, for Gamma below the onset of diffusion."""
    gammas = [g for g in scope.gammas if g <= 15.0]
    seeds = sorted({seed for _, seed in velocities})

    def alike(one: Method, other: Method, stiffness: float) -> Estimate:
        return bootstrap_mean(
            [
                float(
                    np.mean(
                        [
                            np.corrcoef(velocities[(one, stiffness, g), seed], velocities[(other, stiffness, g), seed])[
                                0, 1
                            ]
                            for g in gammas
                        ]
                    )
                )
                for seed in seeds
            ]
        )

    pairs = ((MOLECULAR, RANDOM_PHASE), (MOLECULAR, MOVING), (RANDOM_PHASE, MOVING))
    text = "; ".join(
        f"{one.name} with {other.name}: " + ", ".join(f"{k:.0e}: {alike(one, other, k)}" for k in STIFFNESSES)
        for one, other in pairs
    )
    softest, stiffest = (alike(MOLECULAR, MOVING, k) for k in (1e4, 1e6))
    clear = stiffest.mean - softest.mean > 2.0 * float(np.hypot(stiffest.error, softest.error))
    return Statement(
        "(not printed)",
        "do the same disks turn the same way in MD and ED, the more the stiffer?",
        f"correlation of the disks' mean velocities, mean over Gamma up to 15, by k_n: {text}",
        Verdict.AGREES if clear else Verdict.OPEN,
    )


def _worst(squares: dict[Key, list[float]], method: Method, stiffness: float, scope: Scope) -> tuple[float, float]:
    """Largest factor between event-driven and MD, and its Gamma."""
    logs = np.abs(_logs(_samples(squares, method, stiffness, scope.gammas), axis=0))
    return float(np.exp(logs.max())), scope.gammas[int(np.argmax(logs))]
