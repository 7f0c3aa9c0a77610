"""The loudspeaker against an adaptive integrator, the analytic steady state and its energy balance."""

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from jostle_lab.errors import LabError
from jostle_lab.loudspeaker.driver import CARRIED_MASS, GBS_250F38CP01_04
from jostle_lab.loudspeaker.model import Loudspeaker

STEP = 1.0 / 2400.0


def right_hand_side(speaker, force):
    """The three equations written out, independent of the matrices of the module."""
    d = GBS_250F38CP01_04

    def slope(t, state):
        i, x, v = state[:3]
        u = speaker.voltage_amplitude * math.sin(math.tau * speaker.drive_frequency * t)
        electrical = (u - d.coil_resistance * i - d.force_factor * v) / d.coil_inductance
        push = d.force_factor * i - d.suspension_damping * v - d.suspension_stiffness * x
        mechanical = (push + force + speaker.grains_weight) / (d.moving_mass + CARRIED_MASS)
        # supplied energy, heat in coil and suspension, work done by the force on the plate
        return [electrical, v, mechanical, u * i, d.coil_resistance * i**2 + d.suspension_damping * v**2, force * v]

    return slope


def test_driver_sheet_is_transcribed_consistently():
    d = GBS_250F38CP01_04
    resonance = math.sqrt(d.suspension_stiffness / d.moving_mass) / math.tau
    assert resonance == pytest.approx(37.69, rel=1e-3)  # f_s on the sheet
    electrical_quality = math.tau * resonance * d.moving_mass * d.coil_resistance / d.force_factor**2
    assert electrical_quality == pytest.approx(0.49, abs=0.005)  # Q_es on the sheet


def test_agrees_with_an_adaptive_integrator_under_steps_of_force():
    speaker = Loudspeaker(STEP, grains_weight=2.7)
    speaker.voltage_amplitude = 20.0
    forces = np.random.default_rng(1).normal(-3.0, 5.0, 40)
    state, plate_work = np.zeros(6), 0.0
    for n, force in enumerate(forces):
        plate_work += speaker.advance(force)
        state = solve_ivp(
            right_hand_side(speaker, force),
            (n * STEP, (n + 1) * STEP),
            state,
            method="DOP853",
            rtol=1e-12,
            atol=1e-14,
        ).y[:, -1]
        np.testing.assert_allclose(
            [speaker.current, speaker.displacement, speaker.velocity], state[:3], rtol=1e-9, atol=1e-12
        )
    assert plate_work == pytest.approx(-state[5], rel=1e-9)
    grains_weight_work = speaker.grains_weight * speaker.displacement
    assert speaker.energy() == pytest.approx(state[3] - state[4] + state[5] + grains_weight_work, rel=1e-9)


def test_step_size_does_not_matter():
    ends = []
    for substeps in (1, 7, 64):
        speaker = Loudspeaker(0.01 / substeps)
        speaker.voltage_amplitude = 10.0
        for _ in range(substeps * 5):
            speaker.advance(1.5)
        ends.append([speaker.current, speaker.displacement, speaker.velocity])
    np.testing.assert_allclose(ends[1:], [ends[0]] * 2, rtol=1e-10)


def test_settles_into_the_analytic_steady_state():
    speaker = Loudspeaker(STEP)
    speaker.voltage_amplitude = 22.0
    for _ in range(round(4.0 / STEP)):
        speaker.advance(0.0)
    response = speaker.steady_state(22.0)
    for _ in range(60):
        turn = np.exp(1j * math.tau * speaker.drive_frequency * speaker.time)
        assert speaker.displacement == pytest.approx((response.displacement * turn).imag, abs=1e-11)
        assert speaker.current == pytest.approx((response.current * turn).imag, abs=1e-7)
        assert speaker.acceleration(0.0) == pytest.approx((response.acceleration * turn).imag, abs=1e-6)
        speaker.advance(0.0)


def test_steady_state_dissipates_what_the_amplifier_supplies():
    speaker = Loudspeaker(STEP)
    response, d = speaker.steady_state(22.0), speaker.driver
    omega = math.tau * speaker.drive_frequency
    supplied, _ = quad(
        lambda t: 22.0 * math.sin(omega * t) * (response.current * np.exp(1j * omega * t)).imag, 0.0, math.tau / omega
    )
    lost = 0.5 * (d.coil_resistance * abs(response.current) ** 2 + d.suspension_damping * abs(response.velocity) ** 2)
    assert supplied * omega / math.tau == pytest.approx(lost, rel=1e-9)


def test_grains_at_rest_leave_the_base_at_rest():
    speaker = Loudspeaker(STEP, grains_weight=2.75)
    for _ in range(100):
        assert speaker.advance(-2.75) == 0.0
    assert speaker.displacement == 0.0


def test_voltage_gives_the_acceleration_and_the_rating_is_watched():
    speaker = Loudspeaker(STEP)
    for gamma in (0.2, 5.0):
        voltage = speaker.voltage_for_acceleration(gamma * 9.8)
        assert abs(speaker.steady_state(voltage).acceleration) == pytest.approx(gamma * 9.8, rel=1e-12)
    with pytest.raises(LabError, match=r"coil power.*outside.*Lower"):
        speaker.voltage_for_acceleration(10.0 * 9.8)


def test_restore_repeats_bit_for_bit():
    speaker = Loudspeaker(STEP)
    speaker.voltage_amplitude = 5.0
    speaker.advance(1.0)
    saved = speaker.save()
    first = [speaker.advance(0.3), speaker.displacement, speaker.time]
    speaker.restore(saved)
    assert [speaker.advance(0.3), speaker.displacement, speaker.time] == first


def test_steps_of_any_lengths_lead_to_the_same_motion():
    straight, varied = Loudspeaker(STEP), Loudspeaker(STEP)
    for speaker in (straight, varied):
        speaker.voltage_amplitude = 5.0
    for _ in range(12):
        straight.advance(0.7)
    for step, count in ((STEP, 2), (3.0 * STEP, 2), (0.25 * STEP, 12), (STEP, 1)):
        varied.change_step(step)
        saved = varied.save()
        varied.change_step(0.1 * STEP)
        varied.restore(saved)
        for _ in range(count):
            varied.advance(0.7)
    assert varied.step_size == STEP
    assert varied.time == pytest.approx(straight.time, rel=1e-14)
    assert varied.drive_turns == pytest.approx(straight.drive_turns, rel=1e-12)
    np.testing.assert_allclose(varied.save()[0], straight.save()[0], rtol=1e-11)
    with pytest.raises(LabError, match=r"communication step \[s\]"):
        varied.change_step(0.0)
