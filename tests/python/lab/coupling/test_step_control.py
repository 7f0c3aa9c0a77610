"""Steps as long as the accuracy allows: an oscillator whose master is of known order, a lump on the loudspeaker."""

import copy
import math

import numpy as np
import pytest
from fake_grains import SpringLump

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling
from jostle_lab.coupling.step_control import StepControl, advance_controlled
from jostle_lab.errors import LabError
from jostle_lab.loudspeaker.model import Loudspeaker


class Kicked:
    """x' = the rate now, by the midpoint rule: a second-order master. A kick at t = 0.5 makes its motion fast."""

    def __init__(self):
        self.time, self.x, self.held = 0.0, 0.0, 0

    @staticmethod
    def exact(time):
        return math.tanh(200.0 * (time - 0.5)) + time

    def advance_by(self, step):
        middle = self.time + 0.5 * step
        self.x += step * (200.0 / math.cosh(200.0 * (middle - 0.5)) ** 2 + 1.0)
        self.time += step

    def observed(self):
        return np.array([self.x])

    def save(self):
        self.held += 1
        return self.time, self.x

    def restore(self, saved):
        self.time, self.x = saved

    def discard(self, saved):
        self.held -= 1


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_error_stays_within_the_tolerance_and_steps_follow_the_motion(tolerance):
    system, control, seen = Kicked(), StepControl(tolerance, greatest=0.05, first=0.05), []
    advance_controlled(system, 0.0, 1.0, control, seen.append)
    assert abs(system.x - (Kicked.exact(1.0) - Kicked.exact(0.0))) < 3.0 * tolerance
    assert seen[-1] == 1.0 and system.time == pytest.approx(1.0, abs=1e-12) and system.held == 0
    assert (len(seen), len(control.steps)) == (control.accepted, control.accepted)
    assert max(control.steps) > 20.0 * min(control.steps)
    assert control.rejected > 0


def test_steps_are_of_the_grid_within_the_limits():
    control = StepControl(1.0, least=1e-5, greatest=1e-3, grid=2)
    octaves = np.log2(np.array([control.rounded(step) for step in np.geomspace(2e-5, 5e-3, 50)]) / 1e-3) * 2.0
    np.testing.assert_allclose(octaves, np.round(octaves), atol=1e-9)
    assert (control.rounded(1.0), control.rounded(1e-9)) == (1e-3, 1e-5)
    assert StepControl(1.0, grid=0).rounded(3e-4) == 3e-4


def test_a_step_that_would_have_to_be_too_short_is_an_error():
    system = Kicked()
    with pytest.raises(LabError, match=r"At t = 0\.\d+ s a step of 0\.01 s has .* times the error allowed.*Raise the"):
        advance_controlled(system, 0.0, 1.0, StepControl(1e-6, least=1e-2, greatest=0.05, first=0.05))
    assert system.held == 0


def test_what_a_model_said_when_it_refused_is_told():
    class Refusing(Kicked):
        def advance_by(self, step):
            raise LabError("the base moves too far")

    with pytest.raises(LabError, match="the base moves too far"):
        advance_controlled(Refusing(), 0.0, 1.0, StepControl(1.0))


def test_a_refusal_of_before_is_not_told_with_another_error():
    class RefusingAtFirst(Kicked):
        refused = False

        def advance_by(self, step):
            if not self.refused:
                self.refused = True
                raise LabError("the base moves too far")
            super().advance_by(step)

    system, control = RefusingAtFirst(), StepControl(1e-6, least=1e-2, greatest=0.05, first=0.05)
    with pytest.raises(LabError, match="times the error allowed") as told:
        advance_controlled(system, 0.0, 1.0, control)
    assert system.refused and control.rejected > 1
    assert "moves too far" not in str(told.value)


def test_a_model_without_functions_for_its_state_is_an_error():
    class Stateless(Kicked):
        def save(self):
            raise LabError("cannot save its state")

    with pytest.raises(LabError, match="cannot save its state"):
        advance_controlled(Stateless(), 0.0, 1.0, StepControl(1.0))


@pytest.mark.parametrize(
    ("option", "value", "said"),
    [
        ("tolerance", 0.0, r"tolerance per second = 0 is outside"),
        ("least", 1.0, r"least step \[s\] = 1 is outside \[1e-09, 0\.005\]"),
        ("greatest", math.inf, r"greatest step \[s\] = inf is outside"),
        ("greatest", math.nan, r"greatest step \[s\] = nan is outside"),
        ("greatest", -1.0, r"greatest step \[s\] = -1 is outside"),
        ("first", 1.0, r"first step \[s\] = 1 is outside \[1e-06, 0\.005\]"),
        ("order", 0, r"order of the exchange = 0 is outside \[1, 10\]"),
    ],
)
def test_controls_that_cannot_work_are_refused(option, value, said):
    with pytest.raises(LabError, match=said):
        StepControl(**{"tolerance": 1e-3, option: value})


@pytest.mark.parametrize("end", [0.5, -math.inf, math.inf, math.nan])
def test_an_end_before_the_start_or_at_no_time_is_refused(end):
    system = Kicked()
    with pytest.raises(LabError, match=r"end \[s\] = \S+ is outside \[1, "):
        advance_controlled(system, 1.0, end, StepControl(1.0))
    advance_controlled(system, 1.0, 1.0, StepControl(1.0))
    assert system.time == 0.0


@pytest.mark.parametrize("exchange", [Exchange.GRAINS_FIRST, Exchange.PLANNED, Exchange.ITERATED])
def test_a_loudspeaker_with_a_lump_is_as_exact_as_asked_for(exchange):
    def loop(step):
        grains = SpringLump(stiffness=3e4, damping=20.0)
        speaker = Loudspeaker(step, grains_weight=grains.weight)
        speaker.voltage_amplitude = 10.0
        return Coupling(speaker, grains, exchange)

    fine = loop(1.0 / 51_200)
    fine.run(1024)
    errors = []
    for tolerance in (1e-3, 1e-4):
        coupling, control = loop(1e-4), StepControl(tolerance)
        advance_controlled(coupling, 0.0, 0.02, control)
        assert coupling.loudspeaker.time == pytest.approx(0.02, abs=1e-12)
        assert coupling.grains.time == pytest.approx(0.02, abs=1e-12)
        errors.append(np.max(np.abs(coupling.observed() - fine.observed())))
        assert errors[-1] < 3.0 * tolerance * 0.02
    assert errors[1] < 0.5 * errors[0]


def test_a_loop_that_is_restored_repeats_its_steps():
    grains = SpringLump()
    coupling = Coupling(Loudspeaker(1e-4, grains_weight=grains.weight), grains, Exchange.PLANNED)
    coupling.loudspeaker.voltage_amplitude = 5.0
    coupling.run(20)
    saved = coupling.save()
    ends = []
    for _ in range(2):
        for step in (1e-4, 2e-4, 5e-5):
            coupling.advance_by(step)
        ends.append(copy.deepcopy((coupling.motion(), coupling.work_by_plate, coupling.loudspeaker.time, grains.time)))
        coupling.restore(saved)
    coupling.discard(saved)
    assert ends[0] == ends[1]
