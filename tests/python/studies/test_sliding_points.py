"""Random supports: counts, zero without tilt and onset, judged on made-up runs that agree and that do not."""

import math

import numpy as np
import pytest

from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.tables import Table
from jostle_lab.verdicts import Verdict
from studies.thesis.two_supports.random_mechanism import equal_counts, equal_durations
from studies.thesis.two_supports.random_runs import AS_DRAWN, POINTS, Effort, Measured, Place, measured
from studies.thesis.two_supports.random_statements import minimum, monotonic, onset, opening, sign, upright

EFFORT = Effort(20.0, 8)
UPRIGHT, TILTED = Place(0.0, 4e-5), Place(0.25, 4e-5)


def table(velocity: float, counts: Numbers | None = None, times: Numbers | None = None) -> Table:
    """Last row of a run."""
    counts = np.full(4, 1000.0) if counts is None else counts
    times = 1e-3 * counts if times is None else times
    row = {"time_averaged_angular_velocity": velocity, "detachments": 0.0, "slips": 4000.0}
    row |= {f"sliding.{name}.count": float(n) for name, n in zip(POINTS, counts, strict=True)}
    row |= {f"sliding.{name}.time": float(t) for name, t in zip(POINTS, times, strict=True)}
    row |= {f"contact[{i}].slip_time": 15.0 for i in (1, 2)}
    return {name: np.array([0.0, value]) for name, value in row.items()}


def place_with(place: Place, velocities: Numbers, **numbers: Numbers) -> Measured:
    """Runs with these velocities, one a group."""
    return measured(place, [[table(float(v), **numbers)] for v in velocities], EFFORT)


def noisy(mean: float, error: float, count: int = 16, seed: int = 3) -> Numbers:
    drawn = np.random.default_rng(seed).normal(size=count)
    drawn = (drawn - drawn.mean()) / drawn.std(ddof=1)
    return np.asarray(mean + error * math.sqrt(count) * drawn)


def test_without_tilt_no_run_is_mirrored_and_seeds_are_its_own() -> None:
    runs = [run for group in UPRIGHT.groups(EFFORT) for run in group]
    assert len(runs) == 24
    assert all(dict(run.settings)["support.noise"] == AS_DRAWN for run in runs)
    assert all(len(group) == 2 for group in TILTED.groups(EFFORT))
    elsewhere = [run for group in Place(0.0, 6e-5).groups(EFFORT) for run in group]
    assert not {run.seed for run in runs} & {run.seed for run in elsewhere}


def test_a_drift_without_tilt_is_found_though_mirrored_pairs_would_cancel_it() -> None:
    """A program that turns the disk without tilt, the other way in the mirror: the mean of pairs is zero."""
    tilted = place_with(TILTED, noisy(-9e-5, 2e-6))
    drifting = place_with(UPRIGHT, noisy(3e-5, 4e-6))
    assert upright({UPRIGHT: drifting, TILTED: tilted}).verdict is Verdict.DISAGREES
    still = place_with(UPRIGHT, noisy(2e-6, 4e-6))
    assert upright({UPRIGHT: still, TILTED: tilted}).verdict is Verdict.AGREES
    blurred = place_with(UPRIGHT, noisy(2e-6, 8e-5))
    assert upright({UPRIGHT: blurred, TILTED: tilted}).verdict is Verdict.OPEN


def test_equal_times_are_no_equal_counts() -> None:
    """Counts as in a run, 966, 884, 1342, 1402, while the times are equal: N^j = N / 4 does not hold."""
    counts = np.array([966.0, 884.0, 1342.0, 1402.0])
    found = place_with(TILTED, noisy(-9e-5, 2e-6), counts=counts, times=np.ones(4))
    assert found.share_of_counts("s1").mean == pytest.approx(966.0 / 4594.0)
    assert equal_counts([found], found).verdict is Verdict.DISAGREES
    even = place_with(TILTED, noisy(-9e-5, 2e-6), times=np.array([1.0, 2.0, 3.0, 4.0]))
    assert equal_counts([even], even).verdict is Verdict.AGREES


def test_durations_are_judged_beside_the_counts() -> None:
    even = place_with(TILTED, noisy(-9e-5, 2e-6))
    uneven = place_with(TILTED, noisy(-9e-5, 2e-6), times=np.array([1.0, 1.0, 3.0, 3.0]))
    assert [s.verdict for s in equal_durations([even], [even])] == [Verdict.AGREES] * 3
    upright_row, tilted_row, mirrored = equal_durations([uneven], [uneven])
    assert (upright_row.verdict, tilted_row.verdict) == (Verdict.DISAGREES, Verdict.DISAGREES)
    assert mirrored.verdict is Verdict.AGREES


def test_a_duration_is_the_time_of_one_visit() -> None:
    """Twice the visits in twice the time last as long: neither counts nor times alone are durations."""
    counts = np.array([500.0, 1000.0, 1000.0, 2000.0])
    found = place_with(TILTED, noisy(-9e-5, 2e-6), counts=counts, times=2e-3 * counts)
    assert [found.duration(name).mean for name in POINTS] == pytest.approx([2e-3] * 4)
    assert [s.verdict for s in equal_durations([found], [found])] == [Verdict.AGREES] * 3
    assert equal_counts([found], found).verdict is Verdict.DISAGREES


def line(law: dict[float, float], error: float, tilt: float = 0.25) -> dict[Place, Measured]:
    return {Place(tilt, a): place_with(Place(tilt, a), noisy(v, error)) for a, v in law.items()}


def test_onset_is_where_the_line_is_zero() -> None:
    law = {a: -2.0 * (a - 1.2e-5) for a in (2e-5, 4e-5, 6e-5, 8e-5)}
    assert onset(line(law, 1e-7)).verdict is Verdict.AGREES
    late = {a: -2.0 * (a - 5e-5) for a in (6e-5, 8e-5, 1e-4)}
    assert onset(line(late, 1e-7)).verdict is Verdict.DISAGREES
    assert onset(line(dict.fromkeys(law, 0.0), 1e-7)).verdict is Verdict.OPEN
    two = {a: law[a] for a in (2e-5, 4e-5)}
    assert onset(line(two, 1e-7)).verdict is Verdict.OPEN, "a line through two points has no error"


def test_monotonic_curves_and_others() -> None:
    falling = {a: -2.0 * a for a in (2e-5, 4e-5, 6e-5, 8e-5)}
    assert monotonic(line(falling, 1e-6)).verdict is Verdict.AGREES
    back = {2e-5: -4e-5, 4e-5: -9e-5, 6e-5: -2e-5, 8e-5: -1e-4}
    assert monotonic(line(back, 1e-6)).verdict is Verdict.DISAGREES


def test_sign_of_many_points() -> None:
    negative, zero, positive = Estimate(-9.0, 1.0), Estimate(0.5, 1.0), Estimate(9.0, 1.0)
    assert sign([negative, negative, zero])[2].verdict is Verdict.AGREES
    assert sign([negative, zero, zero])[2].verdict is Verdict.OPEN
    assert sign([negative, negative, positive])[2].verdict is Verdict.PARTLY
    assert sign([positive, positive, negative])[2].verdict is Verdict.DISAGREES


def along(velocities: dict[float, float]) -> dict[Place, Measured]:
    return {Place(t, 4e-5): place_with(Place(t, 4e-5), noisy(v, 1e-6)) for t, v in velocities.items()}


def test_minimum_has_both_ends_above_it() -> None:
    assert minimum(along({0.0: 0.0, 0.1: -9e-5, 0.2: -3e-5})).verdict is Verdict.AGREES
    assert minimum(along({0.0: 0.0, 0.1: -3e-5, 0.2: -9e-5})).verdict is Verdict.OPEN


def test_opening_never_moves_up() -> None:
    def opened(place: Place, share: float) -> Measured:
        found = place_with(place, noisy(0.0, 1e-6))
        return Measured(**{**found.__dict__, "opened": share})

    places = [Place(t, a) for t in (0.1, 0.2) for a in (6e-5, 8e-5, 1e-4)]
    earlier = {p: opened(p, float(p.amplitude > (9e-5 if p.tilt == 0.1 else 7e-5))) for p in places}
    assert opening(earlier, "amplitude").verdict is Verdict.AGREES
    later = {p: opened(p, float(p.amplitude > (7e-5 if p.tilt == 0.1 else 9e-5))) for p in places}
    assert opening(later, "amplitude").verdict is Verdict.DISAGREES
