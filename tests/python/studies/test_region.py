"""Admissible region: reflections through the origin and in the mirror, and its corners by the balance of forces."""

import math

import numpy as np
import pytest

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.verdicts import Verdict
from studies.thesis.two_supports import constant_forces, region_statements
from studies.thesis.two_supports.reduced_model import Excitation, turned
from studies.thesis.two_supports.region_statements import TILT, asymmetry, constant_normal_forces, share_of_first
from studies.thesis.two_supports.saturated import printed, saturated
from studies.thesis.two_supports.spring_region import QUADRILATERAL, Region


def closed(corners: list[tuple[float, float]]) -> np.ndarray:
    return np.array([*corners, corners[0]])


def test_reflection_through_the_origin_is_not_the_mirror() -> None:
    """A slanted parallelogram is symmetric through the origin and not in the mirror, a kite is the other way round."""
    slanted = closed([(-2.0, -1.0), (0.0, -1.0), (2.0, 1.0), (0.0, 1.0)])
    assert asymmetry(slanted) == pytest.approx(0.0, abs=1e-15)
    assert asymmetry(slanted, (-1, 1)) > 0.1
    kite = closed([(-1.0, 0.0), (0.0, -3.0), (1.0, 0.0), (0.0, 1.0)])
    assert asymmetry(kite, (-1, 1)) == pytest.approx(0.0, abs=1e-15)
    assert asymmetry(kite) > 0.1


def test_constant_normal_forces_are_symmetric_at_any_tilt() -> None:
    for tilt in (0.0, 0.2, 0.4):
        corners = constant_normal_forces(tilt)
        assert asymmetry(np.vstack([corners, corners[:1]])) < 1e-12


def region_of(corners: dict[str, tuple[float, float]]) -> Region:
    return Region({name: np.array(corners[name]) for name in QUADRILATERAL})


def test_statements_reflect_through_the_origin_where_the_thesis_does() -> None:
    """A tilted disk at constant normal forces is symmetric through the origin and not in the mirror."""
    square = constant_normal_forces(TILT)
    constant = np.vstack([square, square[:1]])
    assert asymmetry(constant, (-1, 1)) > 0.1, "the mirror of one coordinate tells another thing"
    kite = {"S1": (-1.0, 0.0), "S2": (1.0, 0.0), "T1": (0.0, 1.0), "T2": (0.0, -2.0)}
    skew = {"S1": (-1.0, 0.3), "S2": (1.0, 0.0), "T1": (0.0, 1.0), "T2": (0.2, -2.0)}
    found = region_statements._symmetry(region_of(skew), region_of(kite))
    assert [s.verdict for s in found] == [Verdict.AGREES] * 4
    mirrored = region_statements._symmetry(region_of(kite), region_of(kite))
    assert mirrored[0].verdict is Verdict.DISAGREES, "a region that the mirror maps on itself is not asymmetric"
    slanted = {"S1": (-2.0, -1.0), "T2": (0.0, -1.0), "S2": (2.0, 1.0), "T1": (0.0, 1.0)}
    through = region_statements._symmetry(region_of(slanted), region_of(slanted))
    assert [through[0].verdict, through[3].verdict] == [Verdict.DISAGREES, Verdict.DISAGREES]


def test_saturated_corners_balance_the_weight() -> None:
    for name in ("S1", "S2", "T1", "T2", "D1", "D2"):
        assert printed(name, 0.2, 1.0, -0.5) == pytest.approx(saturated(0.2, 1.0, -0.5)[name], rel=1e-9)


def test_share_counts_only_points_on_an_outline() -> None:
    first = np.array([0.0, 0.0, 0.5, 0.5] * 16)
    second = np.array([0.5, 0.5, 0.0, 0.5] * 16)
    assert share_of_first(first, second).mean == pytest.approx(2.0 / 3.0, rel=0.05)


def test_reduced_model_is_odd_with_constant_normal_forces_and_turns_with_others() -> None:
    tilt = 0.04 * math.pi
    for constant in (True, False):
        both = [turned(tilt, Excitation(supports=s * 4e-5), constant, 0.2, 0.05, 4, 1) for s in (1.0, -1.0)]
        summed = float(np.max(np.abs(both[0] + both[1])) / np.max(np.abs(both[0])))
        assert (summed < 1e-9) is constant


def test_disks_on_random_supports_are_run_as_drawn(laboratory: Laboratory, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the reversed noise beside each constant normal forces would cancel by construction."""
    driven: list[tuple[float, int]] = []

    def drift(_tilt: float, excitation: Excitation, *rest: float) -> Numbers:
        driven.append((excitation.supports, int(rest[-2])))
        return np.full(constant_forces.DISKS, math.copysign(3e-5, excitation.supports))

    monkeypatch.setattr(constant_forces, "turned", drift)
    found = constant_forces.Case(random=True, constant=True, seconds=1.0).velocities(laboratory)
    assert driven == [(constant_forces.SHAKEN.amplitude, constant_forces.DISKS)]
    assert float(found.mean()) == pytest.approx(3e-5)
