"""The components of the laboratory as FMUs against the laboratory in Python, which shares no code with them."""

import math
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from jostle_lab.demos.ratchet.controller import GammaController
from jostle_lab.errors import LabError
from jostle_lab.fmu.instance import FmuInstance
from jostle_lab.loudspeaker import model
from jostle_lab.loudspeaker.model import Loudspeaker
from jostle_lab.sensors.accelerometer import STANDARD_GRAVITY, Accelerometer
from jostle_lab.sensors.camera import photograph, unwrap
from jostle_lab.sensors.spectral_amplitude import spectral_amplitude

RATE = 3200
STEP = 1.0 / RATE
TOLERANCE = 1e-12
"""Of the largest value of each signal."""
COMPONENTS = ("accelerometer", "camera", "gamma_controller", "loudspeaker", "spectral_amplitude")


@pytest.fixture(scope="module", params=[2, 3], ids=["fmi2", "fmi3"])
def folder(request: pytest.FixtureRequest, jostle: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all components for one version of FMI."""
    folder = tmp_path_factory.mktemp("laboratory")
    for name in COMPONENTS:
        out = folder / f"{name}.fmu"
        subprocess.run([jostle, "fmu", name, "--fmi", str(request.param), "--out", out], check=True)
    return folder


def run(
    fmu: Path,
    inputs: Mapping[str, Sequence[float] | NDArray[np.float64]],
    outputs: Sequence[str],
    parameters: Mapping[str, float] | None = None,
    step: float = STEP,
) -> NDArray[np.float64]:
    """Outputs at the end of each step, shape (steps, outputs), under the inputs at its beginning."""
    rows = np.column_stack(list(inputs.values()))
    found = np.empty((len(rows), len(outputs)))
    with FmuInstance(fmu, parameters) as instance:
        setting, reading = instance.group(list(inputs)), instance.group(list(outputs))
        for n, row in enumerate(rows):
            setting.values[:] = row
            instance.write_group(setting, "setting inputs")
            instance.time = n * step
            instance.do_step(step)
            found[n] = instance.read_group(reading)
    return found


def assert_alike(found: NDArray[np.float64], expected: NDArray[np.float64], tolerance: float = TOLERANCE) -> None:
    assert found.shape == expected.shape
    scale = np.max(np.abs(expected), axis=0)
    assert np.all(scale > 0.0)
    worst = np.max(np.abs(found - expected), axis=0) / scale
    assert np.all(worst < tolerance), worst


@pytest.mark.parametrize("steps_per_second", [RATE, 4096, 640])
def test_the_loudspeaker_moves_as_that_of_the_laboratory(
    folder: Path, monkeypatch: pytest.MonkeyPatch, steps_per_second: int
) -> None:
    # The laboratory rounds its matrix so that processors agree; here it is to be as exact as it can.
    monkeypatch.setattr(model, "DIGITS", 17)
    count, step = 4000, 1.0 / steps_per_second
    generator = np.random.default_rng(1)
    force = -2.7 + generator.standard_normal(count)
    voltage = np.where(np.arange(count) < 2500, 20.0, 35.0)
    frequency = np.where(np.arange(count) < 1500, 80.0, 63.7)
    speaker = Loudspeaker(step, 80.0, grains_weight=2.7)
    expected = np.empty((count, 5))
    for n in range(count):
        speaker.voltage_amplitude = voltage[n]
        if speaker.drive_frequency != frequency[n]:
            speaker.retune(frequency[n])
        speaker.advance(force[n])
        acceleration = speaker.acceleration(force[n])
        expected[n] = speaker.displacement, speaker.velocity, acceleration, speaker.current, speaker.drive_turns
    inputs = {"reaction_force": force, "drive.voltage": voltage, "drive.frequency": frequency}
    outputs = ["displacement", "velocity", "acceleration", "current", "drive.turns"]
    found = run(folder / "loudspeaker.fmu", inputs, outputs, {"load.weight": 2.7}, step)
    phase = expected[:, 4]
    # Phases next to a whole turn are alike on both sides of it.
    found[:, 4] = phase + (found[:, 4] - phase + 0.5) % 1.0 - 0.5
    assert_alike(found, expected)


def test_a_voltage_beside_the_sine_is_held_over_a_step(folder: Path) -> None:
    """A battery drives the current u / R in the end, which holds the spring at Bl u / (R k)."""
    steady = run(folder / "loudspeaker.fmu", {"voltage": np.full(400, 1.0)}, ["current", "displacement"], step=0.01)[-1]
    assert steady == pytest.approx([1.0 / 3.45, 13.11 / 3.45 * 172.5e-6], rel=1e-12)


def test_the_loudspeaker_warns_of_its_excursion_and_refuses_endless_steps(folder: Path) -> None:
    with FmuInstance(folder / "loudspeaker.fmu") as instance:
        instance.write("voltage", 50.0)
        instance.do_step(0.5)
        assert any("maximum_excursion" in message for message in instance._log)
        instance.time = 0.5
        with pytest.raises(LabError, match="shorter communication steps"):
            instance.do_step(100.0)


def acceleration(count: int) -> NDArray[np.float64]:
    """Of a base [m/s2]: a sine with noise on it, so that nothing repeats."""
    generator = np.random.default_rng(2)
    return 25.0 * np.sin(math.tau * 80.0 * STEP * np.arange(count)) + generator.standard_normal(count)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 7, 8])
@pytest.mark.parametrize("bandwidth", [None, 30.0, 100.0])
@pytest.mark.parametrize("resolution", [0.0, 0.0039])
def test_readings_without_noise_are_those_of_the_laboratory(
    folder: Path, order: int, bandwidth: float | None, resolution: float
) -> None:
    sensor = Accelerometer(
        resolution=resolution,
        noise_density=0.0,
        bandwidth=bandwidth,
        filter_order=order,
        bias=0.013,
        measuring_range=2.5,
    )
    count, stride = 3200, 16
    record = acceleration(count)
    # The laboratory's records begin a step after the start: those of the FMU have a reading at the start too.
    earlier = np.full(stride - 1, record[0])
    expected = sensor.read(np.concatenate([earlier, record]), RATE, np.random.default_rng(0))
    parameters = {
        "noise.density": 0.0,
        "resolution": resolution,
        "bias": 0.013,
        "measuring_range": 2.5,
        "filter.bandwidth": bandwidth or 0.0,
        "filter.order": order,
        "filter.rate": RATE,
    }
    outputs = ["reading", "reading.acceleration"]
    found = run(folder / "accelerometer.fmu", {"acceleration": record}, outputs, parameters)
    if bandwidth is None:
        assert np.max(np.abs(expected)) == 2.5  # some are clipped
    if resolution == 0.0:
        assert_alike(found[::stride, :1], expected[: count // stride, None])
    else:  # a reading that lies between two steps of the resolution may be rounded either way
        steps = np.abs(found[::stride, 0] - expected[: count // stride]) / resolution
        assert np.count_nonzero(steps > 1e-9) == 0, steps.max()
    assert_alike(found[:, 1:], STANDARD_GRAVITY * found[:, :1])


def test_noise_is_that_of_the_data_sheet_and_of_the_seed(folder: Path) -> None:
    count = 20_000
    still = {"acceleration": np.zeros(count)}
    common = {"data_rate": RATE, "resolution": 0.0}
    noise = [
        run(folder / "accelerometer.fmu", still, ["reading"], {**common, "seed": seed})[:, 0] for seed in (1, 1, 2)
    ]
    assert np.array_equal(noise[0], noise[1]) and not np.array_equal(noise[0], noise[2])
    deviation = Accelerometer(data_rate=RATE).noise()
    for each in (noise[0], noise[2]):
        clean = each + 9.8 / STANDARD_GRAVITY
        # Four standard errors of the mean, of the variance, and of the correlation with the next.
        assert abs(np.mean(clean)) < 4.0 * deviation / math.sqrt(count)
        assert abs(np.var(clean) / deviation**2 - 1.0) < 4.0 * math.sqrt(2.0 / count)
        assert abs(np.mean(clean[1:] * clean[:-1])) < 4.0 * deviation**2 / math.sqrt(count)


def test_noise_is_part_of_the_state(folder: Path) -> None:
    with FmuInstance(folder / "accelerometer.fmu", {"data_rate": RATE, "resolution": 0.0}) as instance:
        instance.do_step(10 * STEP)
        saved = instance.save()
        again = []
        for _ in range(2):
            instance.restore(saved)
            instance.time = 10 * STEP
            instance.do_step(10 * STEP)
            again.append(instance.read("reading"))
        instance.discard(saved)
    assert again[0] == again[1]


@pytest.mark.parametrize("segment", [0, 100, 101])
@pytest.mark.parametrize("readings", [400, 399])
def test_spectral_amplitudes_are_those_of_the_laboratory(folder: Path, segment: int, readings: int) -> None:
    generator = np.random.default_rng(3)
    records = generator.standard_normal((3, readings)) + 2.0 * np.sin(
        math.tau * 79.6 * np.arange(3 * readings) / 200.0
    ).reshape(3, -1)
    parameters = {"record.readings": readings, "record.segment": segment}
    outputs = ["amplitude", "amplitude.corrected", "noise.density"]
    found = run(folder / "spectral_amplitude.fmu", {"reading": records.ravel()}, outputs, parameters, step=1.0 / 200.0)
    for number, record in enumerate(records, 1):
        wanted = spectral_amplitude(record, 200.0, 80.0, segment=segment or None)
        expected = np.array([[wanted.amplitude, wanted.amplitude_corrected, wanted.noise_density]])
        assert_alike(found[number * readings - 1][None], expected)
    assert np.all(found[: readings - 1] == 0.0)


def test_the_amplitude_of_whole_periods_is_exact(folder: Path) -> None:
    record = 1.7 * np.sin(math.tau * 80.0 * np.arange(400) / 200.0 + 0.3) - 0.999
    found = run(folder / "spectral_amplitude.fmu", {"reading": record}, ["amplitude"], step=1.0 / 200.0)
    assert found[-1, 0] == pytest.approx(1.7, rel=1e-12)


@pytest.mark.parametrize(
    ("parameters", "said"),
    [({"drive.frequency": 99.0}, "below half of data_rate"), ({"record.readings": 50}, "80 or more")],
)
def test_bands_and_records_that_do_not_fit_are_refused(folder: Path, parameters: dict[str, float], said: str) -> None:
    with pytest.raises(LabError, match=said):
        FmuInstance(folder / "spectral_amplitude.fmu", parameters)


def test_paths_of_the_camera_are_those_of_the_laboratory_but_for_half_turns(folder: Path) -> None:
    generator = np.random.default_rng(4)
    frames, disks = 300, 60
    angles = np.cumsum(generator.normal(0.0, 1.5, (frames, disks)), axis=0)
    angles[:3, 0] = -1e-17, 0.0, math.pi  # at the ends of the range of a mark
    inputs = {f"angle[{disk}]": angles[:, disk - 1] for disk in range(1, disks + 1)}
    found = run(folder / "camera.fmu", inputs, [f"path[{disk}]" for disk in range(1, disks + 1)], step=1.0)
    expected = unwrap(photograph(angles))
    assert np.all((found[0] >= 0.0) & (found[0] < math.pi))
    assert_alike(found - found[0], expected - expected[0])


def test_the_controller_acts_as_that_of_the_laboratory(folder: Path) -> None:
    count = 4000
    turns = (80.0 * STEP * np.arange(count)) % 1.0
    swelling = acceleration(count) * np.linspace(0.2, 1.1, count) - 9.8
    controller = GammaController(2.0, 1.0, 1e4, 9.8, gain=0.05)
    expected = np.empty((count, 2))
    for n in range(count):
        # Rounding must not move the end of a period by a step.
        controller.update(swelling[n], math.fmod(turns[n] + 1e-9, 1.0))
        expected[n] = controller.voltage, controller.measured
    inputs = {"acceleration": swelling, "drive.turns": turns}
    found = run(folder / "gamma_controller.fmu", inputs, ["voltage", "gamma"], {"voltage.limit": 1e4, "gain": 0.05})
    assert len(np.unique(expected[:, 0])) > 90
    assert_alike(found, expected)


def test_the_controller_refuses_more_than_the_amplifier_gives(folder: Path) -> None:
    count = 200
    inputs = {"acceleration": np.zeros(count), "drive.turns": (80.0 * STEP * np.arange(count)) % 1.0}
    with pytest.raises(LabError, match=r"voltage\.limit is 1\.2 V"):
        run(folder / "gamma_controller.fmu", inputs, ["voltage"], {"voltage.limit": 1.2})
