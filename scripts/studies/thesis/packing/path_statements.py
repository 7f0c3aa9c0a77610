"""What P 3.2 and 3.3 say of the angular paths of one packing."""

import math

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Judgement, above, below, every, rises, true
from studies.thesis.packing.paths_found import Paths, share_of

REARRANGED = 10
"""P 3.1: rearrangements typically involve fewer than 10 disks."""


def molecular_statements(found: dict[float, Paths]) -> list[Statement]:
    """Figure 3.5."""
    faithful = {g: p.faithful() for g, p in found.items()}
    weak = [g for g in found if g < 1.0]
    return [
        Statement.judged(
            "3.2, Fig. 3.5",
            "sustained rotation is present",
            f"share of disks that turn the same way in each quarter of the record: {_listed(faithful)}; by chance 1/8",
            every([above(e, 0.5) for g, e in faithful.items() if g < 10.0], "above a half for certain, Gamma below 10"),
            CAUSES["sustained"],
        ),
        Statement.judged(
            "3.2, Fig. 3.5",
            "paths for Gamma < 1 are more linear than those of the experiment",
            f"<rho^2> {', '.join(f'{g:g}: {found[g].correlation:.2f}' for g in weak)}; in P's "
            "experiment 0.5 to 0.9 (Fig. 3.3)",
            above(_mean_correlation(found, weak), 0.7),
            CAUSES["linear"],
        ),
        Statement.judged(
            "3.2, Fig. 3.5",
            "angular excursions are of the same order of magnitude as in the experiment",
            "root of <omega^2> [RPM]: " + ", ".join(f"{g:g}: {math.sqrt(p.square):.2g}" for g, p in found.items()),
            true(1.0 < math.sqrt(found[5.0].square) < 30.0, "P's Fig. 3.2 has 3 to 10 RPM at Gamma 1 to 4.5; 1 to 30"),
            CAUSES["order"],
        ),
        _rearrangements("3.1, 3.2", found),
    ]


def _mean_correlation(found: dict[float, Paths], gammas: list[float]) -> Estimate:
    mean = sum(found[g].correlation for g in gammas) / len(gammas)
    return Estimate(mean, 0.3 / math.sqrt(60.0 * len(gammas)))


def event_driven_statements(found: dict[float, Paths]) -> list[Statement]:
    """Figure 3.10."""
    steady = {g: share_of(p.steady, p.disks) for g, p in found.items()}
    faithful = {g: p.faithful() for g, p in found.items()}
    square = {g: Estimate(p.square, p.square * math.sqrt(2.0 / p.disks)) for g, p in found.items()}
    return [
        Statement.judged(
            "3.3, Fig. 3.10",
            "for all Gamma all paths look linear: all disks turn with nearly constant velocity",
            f"share of disks with rho^2 above 0.95: {_listed(steady)}",
            every([above(e, 0.8) for e in steady.values()], "above 0.8 for certain at every Gamma"),
            CAUSES["all linear"],
        ),
        Statement.judged(
            "3.3, Fig. 3.10",
            "velocity fluctuations are not appreciable on this scale",
            "<sigma_a> on 1 s: " + ", ".join(f"{g:g}: {p.adjusted_deviation:.2f}" for g, p in found.items()),
            every(
                [_wobble(p) for p in found.values()], "the walk of an angle over the record below a tenth of its way"
            ),
            CAUSES["fluctuations"],
        ),
        _rearrangements("3.3", {g: found[g] for g in (2.0, 8.0)}),
        Statement.judged(
            "3.2, 3.3",
            "disks turn the same way for good",
            f"share that turns the same way in each quarter: {_listed(faithful)}; by chance 1/8",
            every([above(e, 0.8) for e in faithful.values()], "above 0.8 for certain at every Gamma"),
            CAUSES["for good"],
        ),
        Statement.judged(
            "3.2, 3.3",
            "they turn faster as Gamma grows, up to about 10",
            f"<omega^2> [RPM^2]: {_listed(square)}",
            rises([e for g, e in square.items() if g <= 10.0]),
            CAUSES["faster"],
        ),
    ]


def _wobble(paths: Paths) -> Judgement:
    """Walk of the angles over their way: on 1 s sigma_a = s / (w + s), after a time T they are s sqrt(T) and w T."""
    ratio = paths.adjusted_deviation / max(1.0 - paths.adjusted_deviation, 1e-9)
    part = ratio / math.sqrt(paths.time[-1])
    return below(Estimate(part, part / math.sqrt(2.0 * paths.disks)), 0.1)


def _rearrangements(place: str, found: dict[float, Paths]) -> Statement:
    changed = {g: p.changed() for g, p in found.items()}
    few = all(e.mean < REARRANGED for g, e in changed.items() if g < 10.0)
    some = any(e.mean >= 1.0 for e in changed.values())
    return Statement.judged(
        place,
        "rearrangements change the velocity of some disks, fewer than 10, for good"
        + (" (at Gamma = 2 and 8 in P)" if place == "3.3" else ""),
        "disks whose velocity changes beyond what their random walk does by chance: "
        + ", ".join(f"{g:g}: {e.mean:.0f}" for g, e in changed.items()),
        every(
            [true(some, ""), true(few, "")],
            "at some Gamma one or more, below Gamma = 10 everywhere fewer than 10; four standard deviations each",
        ),
        CAUSES["rearrangements"],
    )


def _listed(estimates: dict[float, Estimate]) -> str:
    return ", ".join(f"{g:g}: {e}" for g, e in estimates.items())


CAUSES = dict.fromkeys(
    ("sustained", "linear", "order", "all linear", "fluctuations", "for good", "faster", "rearrangements"), ""
)
"""Why ours differs, by statement."""
