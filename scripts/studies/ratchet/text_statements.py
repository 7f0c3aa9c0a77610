"""What F II to V says in its text, and two statements that no run of disks can decide."""

import numpy as np

from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Judgement, Verdict, above, below, every, exact, true
from studies.ratchet.study import listed, stated
from studies.ratchet.text_found import Found

MORE = "more runs decide"
SHARP = 0.5**0.5
"""v(1.05 f_c) over v(1.1 f_c) of a square root: steeper onsets have more, linear ones a half."""


def statements(found: Found) -> list[Statement]:
    """In the order of the text."""
    return [*_layer(found), _shape(), _masses(found), *_crystals(found), *_bed(found), _onsets(found), _jumps(found)]


def _layer(found: Found) -> list[Statement]:
    ratio = Estimate.over_runs(found.spread / found.whole)
    scatter = Estimate(
        float(found.whole.std(ddof=1) / found.whole.mean()),
        float(found.whole.std(ddof=1) / found.whole.mean() / np.sqrt(2.0 * (len(found.whole) - 1))),
    )
    mean = Estimate.over_runs(found.whole)
    return [
        stated(
            "II B",
            "the flow is of the entire layer (bulk motion)",
            f"four layers on h = 3 mm, a = 0.1, 25 Hz, {mean} cm/s: the disks' own mean velocities in 15 s scatter by "
            f"{ratio} of it",
            below(ratio, 0.5),
            MORE,
        ),
        stated(
            "II B",
            "this motion is reproducible over repeated experiments",
            f"other radii and places at the start: the velocity scatters by {scatter} of its mean",
            below(scatter, 0.1),
            "the scatter of a run of 15 s; more seeds tell it better, longer runs lower it",
        ),
    ]


def _shape() -> Statement:
    return Statement.judged(
        "II B",
        "another shape of the particles lowers the velocity and moves the maximum, the curve keeps its form",
        "not computed",
        Judgement(Verdict.OPEN, "the maximum of Fig. 2 with particles that are not round"),
        "F shows no result, and the engines have disks only. Two disks that are glued together need an engine of rigid "
        "bodies with two points of impact, some weeks of work, and then the quarter of an hour of F2 for each shape",
    )


def _masses(found: Found) -> Statement:
    difference = float(np.max(np.abs(found.masses[:, 1])))
    return stated(
        "IV",
        "the masses were equal, hence it did not matter what they were",
        "transport velocity with 1024 times the mass less that of 1e-5 kg, after 10 s, "
        f"{len(found.masses)} seeds: {difference:g} m/s of {np.mean(found.masses[:, 0]):.3f}",
        exact(difference, 0.0, "difference"),
        "a scale by a power of two changes no digit",
    )


def _crystals(found: Found) -> list[Statement]:
    shares = [{t: Estimate.over_runs(v[:, 1]) for t, v in values.items()} for values in (found.mono, found.poly)]
    order = [{t: Estimate.over_runs(v[:, 0]) for t, v in values.items()} for values in (found.mono, found.poly)]
    longest = max(found.mono)
    mono, poly = (by_time[longest] for by_time in shares)
    gain = Estimate(mono.mean - poly.mean, float(np.hypot(mono.error, poly.error)))
    text = "share of all disks that sit in a hexagon, |psi_6| above 0.9, by the time of shaking [s]: equal radii "
    text += f"{listed(shares[0].items())}; 1.05 to 1.155 mm {listed(shares[1].items())}; mean |psi_6| in the bulk "
    text += f"{listed(order[0].items())} and {listed(order[1].items())}; share on a flat base after 4 s "
    text += " and ".join(str(Estimate.over_runs(values)) for values in found.flat)
    return [
        stated(
            "IV",
            "a hexagonal structure often appears in two dimensions when the system freezes (equal radii)",
            text,
            _above_at(mono, longest),
            "the teeth break the rows: on a flat base four tenths of the disks sit in hexagons, where a lattice of "
            "four layers has a half. F shows nothing of it",
        ),
        stated(
            "IV",
            "radii from 1.05 to 1.155 mm avoid it",
            f"as above; the share falls by {gain}",
            every(
                [above(gain, 0.0), below(poly, 0.5 * mono.mean)],
                f"after {longest:g} s lower by two errors, and by half at least",
            ),
            "radii that differ by a tenth at most order as equal ones do, on the teeth and on a flat base; a wider "
            "spread of radii would tell how much it takes",
        ),
    ]


def _above_at(share: Estimate, seconds: float) -> Judgement:
    """A tenth of the disks, for F's word `often`."""
    judged = above(share, 0.1)
    return Judgement(judged.verdict, f"after {seconds:g} s: {judged.rule}")


def _bed(found: Found) -> list[Statement]:
    flying = found.flying()
    solid = {g: e for g, e in flying.items() if g < 1.0}
    loudest = max(flying)
    ranges = {g: float(found.beds[g].max()) for g in solid}
    between = [g for g, e in flying.items() if e.mean - 2.0 * e.error > 0.05 and e.mean + 2.0 * e.error < 0.95]
    text = f"share of the disks that move by a tenth of A against the base, by Gamma: {listed(flying.items())}"
    return [
        stated(
            "IV D",
            "Gamma < 1: the whole layer has zero velocity relative to the base (solid phase)",
            "; ".join(f"Gamma = {g:g}: farthest disk {r:.2g} A in the last 2 s" for g, r in ranges.items())
            + f", with a velocity floor of 1 mm/s instead of 5 {found.landed.max():.2g} A",
            true(max(ranges.values()) < 0.01, "no disk moves by a hundredth of A against the base; no chance"),
            "a bed of this law is never quite at rest: the velocity floor of 5 mm/s makes disks hop, the higher the "
            "less the base presses, a tenth of g at the top; with a lower floor the hops are lower",
        ),
        stated(
            "IV D",
            "with rising frequency some of the particles, and later all of them, fly (fluidized phase)",
            text,
            every(
                [true(bool(between), ""), above(Estimate(flying[loudest].mean + 1e-9, flying[loudest].error), 0.95)],
                f"at some Gamma a share between 0.05 and 0.95 by two errors, at {loudest:g} above 0.95",
            ),
            MORE,
        ),
    ]


def _onsets(found: Found) -> Statement:
    ratios = {name: _ratio(*pair) for name, pair in found.onsets.items()}
    (sudden, first), (gradual, second) = ratios.items()
    return stated(
        "abstract, IV D",
        "the onset of transport can occur either gradually or suddenly",
        "v(1.05 f_c) / v(1.1 f_c): " + "; ".join(f"{name}: {e}" for name, e in ratios.items()),
        every(
            [above(first, SHARP), below(second, SHARP)],
            f"above that of a square root, 0.71, for {sudden}, below for {gradual}, by two errors",
        ),
        MORE,
    )


def _ratio(near: Estimate, far: Estimate) -> Estimate:
    ratio = near.mean / far.mean
    return Estimate(ratio, abs(ratio) * float(np.hypot(near.error / near.mean, far.error / far.mean)))


def _jumps(found: Found) -> Statement:
    right, left = (Estimate.over_runs(found.jumps[:, side]) for side in (0, 1))
    both, net = Estimate.over_runs(found.jumps.sum(axis=1)), Estimate.over_runs(found.jumps[:, 0] - found.jumps[:, 1])
    return stated(
        "V",
        "with many particles the motion is that of a ratchet: occasional jumps over to the next valley, more of them "
        "forwards",
        f"jumps of a disk in a period: {right} to the right, {left} to the left, net {net}",
        every(
            [below(both, 0.5), above(net, 0.0)], "fewer than one in two periods, and more to the right; by two errors"
        ),
        MORE,
    )
