"""What P 1.3 says of packings whose bottom row is random or fixed, and of bulk viscosity (P 2.2)."""

import math
from collections.abc import Iterable

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Judgement, above, below, every, rises, true, vanish
from studies.ratchet.study import stated
from studies.thesis.packing.bottom_found import Found
from studies.thesis.packing.bottom_runs import equivalent_gamma

MIDDLE = (0.3, 10.0)
"""Equivalent Gamma between which P's packings rotate and keep their places."""
FACTOR = 3.0
"""Root mean square velocities within this factor are of the same size."""
UNLIKE = 0.2
"""A mean velocity beside its root mean square that would not be zero."""


def statements(found: Found) -> list[Statement]:
    """All of them."""
    return [*_random(found), *_symmetry(found), *_small(found), *_three(found), _air(found)]


def _listed(pairs: Iterable[tuple[float, Estimate]]) -> str:
    return ", ".join(f"{x:g}: {e}" for x, e in pairs)


def _micro(values: dict[float, Estimate]) -> str:
    return _listed((1e6 * x, e) for x, e in values.items())


def _random(found: Found) -> list[Statement]:
    faithful = {e: ensemble.over("faithful") for e, ensemble in found.random.items()}
    middle = [e for e in faithful if MIDDLE[0] < equivalent_gamma(e) < MIDDLE[1]]
    largest = max(float(ensemble.each("circle").max()) for ensemble in found.random.values())
    area = next(iter(found.random.values())).over("circle", 1)
    sine = {e: ensemble.over("faithful") for e, ensemble in found.sine.items()}
    same = {e: found.same_sense(e) for e in found.again}
    inside = f"epsilon with an equivalent Gamma from {MIDDLE[0]:g} to {MIDDLE[1]:g}"
    return [
        stated(
            "1.3",
            "sustained rotation does not need a sine: it appears over a layer of bottom disks that vibrate randomly",
            "share of the free disks that turn the same way in each quarter of the record, by epsilon [um]: "
            f"{_micro(faithful)}; by chance 1/8",
            every([above(faithful[e], 0.5) for e in middle], f"above a half by two errors at each {inside}"),
            CAUSES["sustained"],
        ),
        stated(
            "1.3",
            "random motion makes a persistent rotation of each disk",
            f"as above; with the sine of the same rms velocity: {_micro(sine)}",
            every([above(faithful[e], 0.8) for e in middle], f"the share above 0.8 by two errors at each {inside}"),
            CAUSES["each"],
        ),
        _alike(found),
        stated(
            "1.3",
            "the centres of the bottom disks move inside a circle of radius epsilon about their places",
            f"farthest {largest:.3f} epsilon; mean square distance over epsilon^2 {area}, by the noise that all "
            "epsilon share (0.5: anywhere in the circle alike)",
            true(largest <= 1.0 + 1e-6, "never outside; no chance"),
        ),
        stated(
            "1.3",
            "a disk's velocity is that of its contacts, not of the noise",
            "correlation of the velocities of the disks of a packing, shaken by one noise and by another, by epsilon "
            f"[um]: {_micro(same)}",
            every([above(e, 0.5) for e in same.values()], "above 0.5 by two errors at each epsilon"),
            CAUSES["contacts"],
        ),
        _strength(found),
    ]


def _alike(found: Found) -> Statement:
    pairs = {e: (found.random[e].square, sine.square) for e, sine in found.sine.items()}
    ratios = {e: _root_ratio(*pair) for e, pair in pairs.items()}
    parts = [rises([random for random, _ in pairs.values()]), rises([sine for _, sine in pairs.values()])]
    parts += [above(r, 1.0 / FACTOR) & below(r, FACTOR) for r in ratios.values()]
    return stated(
        "1.3",
        "rotation over a random bottom is qualitatively that over a sinusoidal one",
        "<omega^2> of the same disks [RPM^2], random and sine of the same rms velocity, by epsilon [um]: "
        + "; ".join(f"{1e6 * e:g}: {a} and {b}" for e, (a, b) in pairs.items())
        + f"; ratio of the roots: {_micro(ratios)}",
        every(parts, f"both rise with the amplitude; at each the roots are within a factor {FACTOR:g}, by two errors"),
        CAUSES["alike"],
    )


def _root_ratio(a: Estimate, b: Estimate) -> Estimate:
    ratio = math.sqrt(a.mean / b.mean)
    return Estimate(ratio, 0.5 * ratio * math.hypot(a.error / a.mean, b.error / b.mean))


def _strength(found: Found) -> Statement:
    steady = {e: ensemble.over("steady") for e, ensemble in found.random.items()}
    first, *inner, last = steady
    best = max(inner, key=lambda e: steady[e].mean, default=first)

    def lower(end: float) -> Judgement:
        rest = math.hypot(steady[best].error, steady[end].error)
        return above(Estimate(steady[best].mean - steady[end].mean, rest), 0.0)

    return stated(
        "1.3",
        "the vibration must be strong enough for contacts to slide, and not so strong that the packing reorganises",
        f"share of the free disks with rho^2 above 0.95, by epsilon [um]: {_micro(steady)}",
        every([lower(first), lower(last)], "the largest share is above that at either end by two joint errors"),
        CAUSES["strength"],
    )


def _symmetry(found: Found) -> list[Statement]:
    made = []
    for name, ensembles in (("random bottom", found.random), ("sine", found.sine)):
        drifts = {e: ensemble.drift for e, ensemble in ensembles.items()}
        shares = {e: ensemble.over("mean", 1) for e, ensemble in ensembles.items()}
        rests = {e: Estimate(2.0 * s.mean - 1.0, 2.0 * s.error) for e, s in shares.items()}
        pooled = [_mean(list(drifts.values())), _mean(list(rests.values()))]
        made.append(
            stated(
                "1.3",
                f"velocities are symmetrically distributed about zero, numerically verified ({name})",
                f"mean over rms velocity {pooled[0]}, disks that turn counter-clockwise less the others {pooled[1]}, "
                f"all packings; by epsilon [um] {_micro(drifts)} and {_micro(rests)}",
                vanish(pooled, UNLIKE),
                CAUSES["symmetry"],
            )
        )
    return made


def _mean(estimates: list[Estimate]) -> Estimate:
    """Mean over drives of the same packings, whose errors are not independent: as if they were the same."""
    count = len(estimates)
    return Estimate(sum(e.mean for e in estimates) / count, math.sqrt(sum(e.error**2 for e in estimates) / count))


def _small(found: Found) -> list[Statement]:
    turning = {g: found.button(g) for g in found.buttons}
    odd = {g: found.odd(g) for g in found.buttons}
    single = {g: Estimate.over_runs(values) for g, values in found.single.items()}

    def beside(values: dict[float, Estimate]) -> list[Estimate]:
        return [Estimate(*(part / abs(turning[g].mean) for part in (e.mean, e.error))) for g, e in values.items()]

    return [
        stated(
            "1.3, Fig. 1.10",
            "a small packing of buttons turns without tilt, since each of the top ones has a single neighbour there",
            "two on a fixed row of three, right less left over two [RPM], by Gamma: "
            f"{_listed(turning.items())}; half their sum, which symmetry forbids: {_listed(odd.items())}",
            every([_turns(e) for e in turning.values()], "away from zero by three errors at each Gamma"),
            CAUSES["buttons"],
        ),
        stated(
            "1.3, Fig. 1.10",
            "by the mirror symmetry of that packing both turn oppositely",
            f"half the sum of their velocities [RPM], by Gamma: {_listed(odd.items())}",
            _nothing(beside(odd)),
            CAUSES["mirror"],
        ),
        stated(
            "1.3, Fig. 1.10",
            "three disks need a tilt: one on a fixed row of two does not turn without",
            f"velocity [RPM], by Gamma: {_listed(single.items())}",
            _nothing(beside(single)),
            CAUSES["single"],
        ),
        stated(
            "1.3, Fig. 1.10",
            "disks of the bottom row are fixed",
            f"fastest of all small packings {found.held:g} RPM; of packings over a random row "
            f"{max(float(e.each('row', 1).max()) for e in found.random.values()):g} rad in all",
            true(found.held == 0.0, "no disk of a fixed row turns; no chance"),
        ),
    ]


def _nothing(ratios: list[Estimate]) -> Judgement:
    """Zero beside the velocity of the buttons at each Gamma."""
    judged = vanish(ratios, 1.0)
    return Judgement(judged.verdict, f"over half the difference of the buttons at that Gamma: {judged.rule}")


def _turns(e: Estimate) -> Judgement:
    """Away from zero by three errors; not so if an interval of two holds zero only narrowly is not known."""
    if abs(e.mean) >= 3.0 * e.error > 0.0:
        return true(True, "")
    return above(Estimate(abs(e.mean), 1.5 * e.error), 0.0)


def _three(found: Found) -> list[Statement]:
    made = []
    for material in dict.fromkeys(m for m, _ in found.tilted):
        by_tilt = {t: e for (m, t), e in found.tilted.items() if m == material}
        level, leaning = by_tilt[0.0], [e for t, e in by_tilt.items() if t > 0.0]
        size = max(abs(e.mean) for e in leaning)
        made.append(
            stated(
                "1.3, Fig. 1.10",
                f"three disks of {material.name} turn steadily when the set-up is tilted, and not without",
                f"velocity of the upper disk [RPM], by tilt in degrees: {_listed(by_tilt.items())}",
                every(
                    [vanish([level], size), *(_turns(e) for e in leaning)],
                    "each tilt away from zero by three errors; without tilt zero by chance, and its interval of two "
                    "errors below the fastest",
                ),
                CAUSES["three"],
            )
        )
    return made


def _air(found: Found) -> Statement:
    drag = {equivalent_gamma(e): ensemble.drag for e, ensemble in found.sine.items()}
    return stated(
        "2.2",
        "the effect of bulk viscosity is negligible",
        "power that air between the disks and P's panes would take over that which contacts take, by Gamma: "
        + ", ".join(f"{g:.2g}: {e}" for g, e in drag.items())
        + " (a film of 0.5 mm on either side, 1.8e-5 Pa s: all motion dies out in 50 s)",
        every([below(e, 0.01) for e in drag.values()], "below 1 % by two errors at each Gamma"),
        CAUSES["air"],
    )


LONGER = (
    "a disk that wanders in one of four quarters of 3 s is not counted, with the sine neither; records of P's 1000 s "
    "of these packings take 20 min of one processor"
)
CAUSES = {
    "sustained": LONGER,
    "each": LONGER,
    "alike": "four packings of 12 s; more of them decide",
    "contacts": "four packings; more of them, and longer records, decide: what is left of the noise falls with time",
    "strength": "four packings of 12 s; more of them decide",
    "symmetry": "four packings; twelve of them, three minutes of one processor, halve the errors",
    "buttons": "six seeds of a minute; more of them decide",
    "mirror": "six seeds of a minute; more of them decide",
    "single": "six seeds of a minute; more of them decide",
    "three": "four phases of 10 s; longer runs decide",
    "air": "the program has no bulk viscosity; with it the same runs would tell",
}
"""Why ours differs, or what decides, by statement; told where it does not agree."""
