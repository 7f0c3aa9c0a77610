"""F Figs 13 and 14: kept fields, and the count of impacts by side on made-up runs."""

import numpy as np
import pytest

from jostle_lab.statistics.estimates import Estimate
from jostle_lab.verdicts import Verdict
from studies.ratchet import quoted, sides
from studies.ratchet.cases import Case
from studies.ratchet.fields import BOX, PHASES, Flow, MeanFields
from studies.ratchet.flow import pack, unpack
from studies.ratchet.observe import Observed


def test_fields_are_kept_as_far_up_as_they_are_drawn() -> None:
    generator = np.random.default_rng(1)
    x, y = BOX * (np.arange(6) + 0.5), BOX * (np.arange(30) - 2.5)
    fields = MeanFields(
        x, y, generator.random((PHASES, len(y), len(x))), generator.normal(size=(PHASES, len(y), len(x), 2))
    )
    flow = Flow((Estimate(8.0, 0.2), Estimate(-9.0, 0.1)), Estimate(0.2, 0.03), Estimate(0.1, 0.01))
    again, numbers = unpack(pack(fields, flow))
    rows = len(again.y)
    assert again.y.max() < 16.0 < y.max()
    np.testing.assert_array_equal(again.mass, fields.mass[:, :rows])
    np.testing.assert_array_equal(again.momentum, fields.momentum[:, :rows])
    assert numbers == flow


def observed(case: Case, left: float, right: float) -> Observed:
    """Four runs with so many impacts on either side, give or take a few."""
    tables = {}
    for seed in range(1, 5):
        table = {f"tooth.{side}_impulse": np.array([0.0, 1e-3 * seed]) for side in sides.SIDES}
        for side, count in (("left_side", left), ("right_side", right), ("tip", 10.0)):
            table[f"tooth.{side}_impacts"] = np.array([0.0, count + 0.01 * seed])
        tables[case.run(seed)] = table
    return Observed(tables, {case: 4})


@pytest.mark.parametrize(
    ("case", "left", "verdict"),
    [
        (quoted.POSITIVE, 30.0, Verdict.AGREES),
        (quoted.POSITIVE, 80.0, Verdict.DISAGREES),
        (quoted.NEGATIVE, 80.0, Verdict.AGREES),
        (quoted.NEGATIVE, 30.0, Verdict.DISAGREES),
    ],
)
def test_most_disks_meet_the_other_side_or_do_not(case: Case, left: float, verdict: Verdict) -> None:
    (statement,) = sides.statements(observed(case, left, 100.0), case)
    assert statement.verdict is verdict
    assert statement.rule


def test_impulses_are_velocities_of_a_disk_in_a_period() -> None:
    case = quoted.POSITIVE
    found = sides.impulse(observed(case, 30.0, 100.0), case, "left_side")
    periods = 30.0 * 25.0
    np.testing.assert_allclose(found, [100.0 * 1e-3 * seed / (20 * periods * 1e-5) for seed in range(1, 5)])
