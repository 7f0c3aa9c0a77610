"""P 1.3: packings over a random or a fixed bottom row; statistics on made-up data, and that held disks stay held."""

import math
from dataclasses import replace

import numpy as np
import pytest

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import Table
from jostle_lab.verdicts import Verdict
from studies.thesis.packing.bottom_found import Ensemble, Found, gather
from studies.thesis.packing.bottom_runs import (
    SECOND_NOISE,
    STEEL,
    Shaken,
    Small,
    Tilted,
    bottom_row,
    equivalent_gamma,
    summary,
    velocities,
)
from studies.thesis.packing.bottom_statements import statements
from studies.thesis.packing.runs import amplitude

EPSILONS = (1e-5, 1e-4, 3e-4, 1e-3)


def kept(generator: np.random.Generator, strength: float, faithful: float, velocity: np.ndarray) -> Table:
    """The summary of a made-up packing."""
    return {
        "velocity": velocity + generator.normal(0.0, 0.1, len(velocity)),
        "mean": np.array([0.01 * generator.normal(), 0.5]),
        "square": np.array([strength * generator.uniform(0.95, 1.05)]),
        "faithful": np.array([faithful + 0.01 * generator.normal()]),
        "steady": np.array([faithful + 0.01 * generator.normal(), faithful]),
        "row": np.array([11.0, 0.0]),
        "circle": np.array([0.99, 0.5]),
        "power": np.array([2e-4, 0.03 * generator.uniform(0.9, 1.1)]),
    }


def made_up(faithful: float = 0.9, rate: float = 1.0, level: float = 0.0) -> Found:
    """Packings that rotate; buttons that turn at `rate` RPM; three disks that turn at `level` RPM without tilt."""
    generator = np.random.default_rng(3)
    own = {seed: generator.normal(0.0, 1.0, 49) for seed in range(1, 5)}
    packings = {
        Shaken(equivalent_gamma(e), s, e, n): kept(generator, 1e8 * e * e, faithful - 0.3 * (e in (1e-5, 1e-3)), own[s])
        for e in EPSILONS
        for n in ((0, SECOND_NOISE) if e == 1e-4 else (0,))
        for s in own
    }
    packings |= {
        Shaken(equivalent_gamma(e), s): kept(generator, 2e8 * e * e, faithful, own[s])
        for e in (1e-4, 3e-4)
        for s in own
    }
    small = {
        Small(g, n, s): np.array([0.0, 0.0, 0.0, -rate, rate][:n] if n == 5 else [0.0, 0.0, 0.0])
        + generator.normal(0.0, 0.05, n) * (np.arange(n) >= (n + 1) // 2)
        for g in (2.0, 3.0)
        for n in (3, 5)
        for s in range(1, 7)
    }
    tilted = {
        Tilted(STEEL, t, p): (t + level + 0.05 * float(generator.normal()))
        for t in (0.0, 8.0)
        for p in (0.0, 1.0, 2.0, 3.0)
    }
    return gather(packings, small, tilted)


def verdicts(found: Found) -> list[Verdict]:
    return [s.verdict for s in statements(found)]


def test_what_rotates_agrees_and_has_rules() -> None:
    found = made_up()
    assert set(verdicts(found)) == {Verdict.AGREES}
    assert all(s.rule and s.place and s.found for s in statements(found))


def test_what_does_not_is_seen() -> None:
    usual = verdicts(made_up())
    walks = verdicts(made_up(faithful=0.4))
    assert walks[0] is Verdict.DISAGREES
    assert walks[1] is Verdict.DISAGREES
    still = verdicts(made_up(rate=0.0))
    assert sum(v is not Verdict.AGREES for v in still) >= 1
    assert verdicts(made_up(level=1.0)) != usual


def test_noise_that_decides_the_sense_is_told_from_contacts_that_do() -> None:
    found = made_up()
    assert found.same_sense(1e-4).mean > 0.9
    again = found.again[1e-4]
    shuffled = Ensemble(again.cases, tuple({**t, "velocity": t["velocity"][::-1]} for t in again.tables))
    assert replace(found, again={1e-4: shuffled}).same_sense(1e-4).mean < 0.5


def test_the_equivalent_sine_has_the_rms_displacement_of_the_circle() -> None:
    assert amplitude(equivalent_gamma(1e-4)) / math.sqrt(2.0) == pytest.approx(0.5e-4)


def test_the_bottom_row_stands_on_the_floor() -> None:
    assert bottom_row(np.array([0.015, 0.0201, 0.025, 0.0466])).tolist() == [True, False, True, False]


def test_buttons_turn_oppositely_by_symmetry() -> None:
    found = made_up(rate=2.0)
    assert found.button(2.0).mean == pytest.approx(2.0, abs=0.1)
    assert abs(found.odd(2.0).mean) < 0.1
    assert found.held == 0.0


def test_the_held_row_of_a_small_packing_does_not_turn(laboratory: Laboratory) -> None:
    case = Small(2.0, 5, 1, seconds=2.0)
    turned = velocities(laboratory, [case], "test")[case]
    assert turned[:3].tolist() == [0.0, 0.0, 0.0]
    assert np.all(turned[3:] != 0.0)


def test_a_random_row_stays_in_its_circle_and_drives_the_others(laboratory: Laboratory) -> None:
    case = Shaken(equivalent_gamma(1e-4), 1, 1e-4)
    run = replace(case.run(), seconds=0.6, sample=0.1)
    found = summary(case, laboratory.run([run], "test")[run])
    assert found["row"].tolist() == [11.0, 0.0]
    assert len(found["velocity"]) == 49
    assert found["circle"][0] <= 1.0
    assert Estimate.over_runs(found["velocity"]).error > 0.0
