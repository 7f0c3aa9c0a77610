"""The shaker that holds Gamma: retuning, the controller on a plant without grains, the whole loop with an FMU."""

import math
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import PROGRAM
from scipy.integrate import solve_ivp

from jostle_lab.demos.ratchet.command import ratchet_demo
from jostle_lab.demos.ratchet.controller import GammaController
from jostle_lab.demos.ratchet.sweep import Plan, make, sweep
from jostle_lab.errors import LabError
from jostle_lab.fmu.ratchet import FmuRatchet
from jostle_lab.loudspeaker.model import Loudspeaker
from jostle_lab.statements import Verdict

STEP = 1.0 / 4096.0


@pytest.fixture(scope="module", params=[2, 3], ids=["fmi2", "fmi3"])
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("fmu") / "ratchet.fmu"
    words = [PROGRAM, "fmu", "ratchet", "--drive", "input"]
    subprocess.run([*words, "--fmi", str(request.param), "--out", path], check=True)
    return path


def test_retuned_loudspeaker_agrees_with_an_adaptive_integrator() -> None:
    """A voltage whose phase goes on and whose frequency and amplitude change, against the raw equations."""
    speaker = Loudspeaker(STEP, 20.0)
    driver = speaker.driver
    state, turns, time = np.zeros(3), 0.0, 0.0
    for frequency, amplitude in ((20.0, 5.0), (33.0, 7.0), (12.5, 2.0)):
        speaker.retune(frequency)
        speaker.voltage_amplitude = amplitude

        def slope(
            t: float, s: np.ndarray, f: float = frequency, a: float = amplitude, b: float = time, p: float = turns
        ):
            u = a * math.sin(math.tau * (p + f * (t - b)))
            push = driver.force_factor * s[0] - driver.suspension_damping * s[2] - driver.suspension_stiffness * s[1]
            coil = u - driver.coil_resistance * s[0] - driver.force_factor * s[2]
            return [coil / driver.coil_inductance, s[2], push / speaker.mass]

        for _ in range(300):
            speaker.advance(0.0)
        end = time + 300 * STEP
        state = solve_ivp(slope, (time, end), state, method="DOP853", rtol=1e-12, atol=1e-15).y[:, -1]
        turns, time = turns + frequency * 300 * STEP, end
        np.testing.assert_allclose(
            [speaker.current, speaker.displacement, speaker.velocity], state, rtol=1e-8, atol=1e-11
        )
        assert speaker.drive_turns == pytest.approx(math.fmod(turns, 1.0), abs=1e-12)


def test_controller_holds_gamma_of_an_empty_shaker_through_a_change_of_frequency() -> None:
    speaker, controller = Loudspeaker(STEP, 18.0), GammaController(2.5, 1.0, 60.0, 9.81)
    for frequency in (18.0, 31.0):
        speaker.retune(frequency)
        for _ in range(round(3.0 / STEP)):
            if controller.update(speaker.acceleration(0.0), speaker.drive_turns):
                speaker.voltage_amplitude = controller.voltage
            speaker.advance(0.0)
        assert controller.measured == pytest.approx(2.5, rel=2e-3)
        expected = speaker.voltage_for_acceleration(2.5 * 9.81)  # the closed form of the steady state
        assert controller.voltage == pytest.approx(expected, rel=5e-3)


def test_controller_refuses_what_the_amplifier_cannot_give() -> None:
    with pytest.raises(LabError, match="Gamma to hold"):
        GammaController(math.nan, 1.0, 60.0, 9.81)
    with pytest.raises(LabError, match="gain of the controller"):
        GammaController(3.0, 1.0, 60.0, 9.81, gain=2.0)
    controller = GammaController(3.0, 1.0, 1.5, 9.81)
    with pytest.raises(LabError, match=r"the amplifier gives 1\.5 V"):
        for n in range(1000):
            controller.update(1e-3 * math.sin(math.tau * n / 100), math.fmod(n / 100, 1.0))


def test_gamma_is_held_the_grains_are_felt_and_the_flow_reverses(fmu: Path) -> None:
    """Reduced effort: two frequencies, at which native runs of 40 s tell -1.4 +- 0.2 and 0.30 +- 0.04 cm/s."""
    plan = Plan(frequencies=(20.0, 44.0), seconds=12.0)
    product = make(fmu, plan, show_progress=False)
    held, felt, _ = product.statements
    assert held.verdict is Verdict.AGREES, held.found
    assert felt.verdict is Verdict.AGREES, felt.found
    low, high = (row["velocity_cm_per_s"] for row in product.rows)
    assert low < -0.15 < 0.05 < high


def test_a_mark_starts_the_average_anew(fmu: Path) -> None:
    """transport_velocity after a mark is the displacement since, over the time."""
    grains = FmuRatchet(fmu, {"tooth.height": 3e-3, "tooth.asymmetry": 0.1})
    try:
        motion = [2e-3 * math.sin(math.tau * 25.0 * n * STEP) for n in range(8192)]
        speed = [2e-3 * math.tau * 25.0 * math.cos(math.tau * 25.0 * n * STEP) for n in range(8192)]
        for n in range(4096):
            grains.step(motion[n], speed[n], 0.0, STEP)
        grains.restart_averages()
        before = grains.mean_displacement()
        for n in range(4096, 8192):
            grains.step(motion[n], speed[n], 0.0, STEP)
        assert grains.transport().mean == pytest.approx(100.0 * (grains.mean_displacement() - before), rel=1e-9)
        assert grains.weight == pytest.approx(20 * 1e-5 * 9.81)
        assert grains.box_width == pytest.approx(0.06)
    finally:
        grains.close()


def test_wrong_plans_and_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(LabError, match="No FMU at"):
        sweep(tmp_path / "none.fmu", Plan(), False)
    with pytest.raises(LabError, match="frequency"):
        sweep(tmp_path / "none.fmu", Plan(frequencies=(1.0,)), False)
    with pytest.raises(LabError, match="seconds at each frequency"):
        sweep(tmp_path / "none.fmu", Plan(seconds=math.nan), False)
    with pytest.raises(LabError, match=r"--low = 20 and --high = 20 are one frequency"):
        ratchet_demo(tmp_path / "none.fmu", low=20.0, high=20.0)
