"""Impacts from the equations of motion: limits that are known without the formulas of P 4.5."""

import math

import numpy as np
import pytest

from jostle_lab.verdicts import Verdict
from studies.thesis.impact import printed, statements
from studies.thesis.impact.equations import Contact, integrate


def test_elastic_impact_without_friction_only_reverses_the_normal_velocity() -> None:
    found = integrate(Contact(damping=0.0, friction=0.0, ratio=1.0), 1.0, 0.3)
    assert found.restitutions == pytest.approx((1.0, 1.0), abs=1e-9)
    assert found.duration == pytest.approx(math.pi / found.contact.frequency, rel=1e-9)


def test_no_energy_is_created() -> None:
    for kappa in (0.1, 0.773, 5.0):
        for slip in (0.05, 0.3, 2.0):
            found = integrate(Contact(ratio=kappa), 1.0, slip)
            assert abs(found.restitutions[1]) <= 1.0 + 1e-9


def test_friction_limits_the_tangential_force_at_all_times() -> None:
    found = integrate(Contact(ratio=3.0), 1.0, 0.4)
    normal, tangential = found.forces(np.linspace(0.0, found.duration, 500)[1:-1])
    assert np.max(np.abs(tangential) - 0.1 * normal) < 1e-9 * normal.max()


def test_a_wrong_formula_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    right = {s.place: s.verdict for s in statements._normal()}
    assert right["4.57"] is Verdict.AGREES
    force = printed.normal_force
    monkeypatch.setattr(printed, "normal_force", lambda contact, u_n, t: 1.001 * force(contact, u_n, t))
    wrong = {s.place: s.verdict for s in statements._normal()}
    assert wrong["4.57"] is Verdict.DISAGREES
