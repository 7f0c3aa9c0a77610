"""Accelerometers and the spectral amplitude: exact where it must be, wrong by the expected amount where it must be."""

import math

import numpy as np
import pytest

from jostle_lab.errors import LabError
from jostle_lab.sensors.accelerometer import STANDARD_GRAVITY, Accelerometer
from jostle_lab.sensors.spectral_amplitude import spectral_amplitude, true_amplitude

RATE, DRIVE, FINE = 200.0, 80.0, 2400.0
IDEAL = Accelerometer(resolution=0.0, noise_density=0.0, measuring_range=1e9)


def sine(amplitude, seconds, frequency=DRIVE, rate=RATE, phase=0.3):
    return amplitude * np.sin(math.tau * frequency * np.arange(round(seconds * rate)) / rate + phase)


def estimate(record):
    return spectral_amplitude(record, RATE, DRIVE).amplitude


def read(sensor, acceleration, seed=1):
    return sensor.read(acceleration, FINE, np.random.default_rng(seed))


@pytest.mark.parametrize("seconds", [1.0, 7.5, 60.0])
@pytest.mark.parametrize("amplitude", [0.2, 5.0])
def test_exact_on_a_sine_with_whole_periods(amplitude, seconds):
    assert estimate(sine(amplitude, seconds) - 1.0) == pytest.approx(amplitude, rel=1e-12)


def test_whole_chain_without_imperfections_is_exact():
    acceleration = sine(30.0, 10.0, rate=FINE)
    assert estimate(read(IDEAL, acceleration)) * STANDARD_GRAVITY == pytest.approx(30.0, rel=1e-12)
    assert true_amplitude(acceleration, FINE, DRIVE) == pytest.approx(30.0, rel=1e-12)


def test_true_amplitude_ignores_harmonics_and_a_partial_period():
    acceleration = sine(3.0, 2.004, rate=FINE) + sine(2.0, 2.004, 160.0, FINE) + 5.0
    assert true_amplitude(acceleration, FINE, DRIVE) == pytest.approx(3.0, rel=1e-12)


def test_leakage_loses_amplitude_and_less_in_longer_records():
    """A frequency between two bins: the share of the sinc^2 line shape outside the window is lost."""
    losses = []
    for periods in (80.5, 640.5):
        seconds = round(periods / DRIVE * RATE) / RATE
        losses.append(1.0 - estimate(sine(1.0, seconds, frequency=periods / seconds)))
    assert 2e-3 < losses[0] < 5e-2
    assert 0.0 < losses[1] < 0.25 * losses[0]


def test_quantisation_adds_the_variance_of_its_steps_where_noise_dithers_it():
    amplitude, step = 0.02, 0.04
    sensor = Accelerometer(resolution=step, noise_density=2e-3)
    found = spectral_amplitude(read(sensor, sine(amplitude * STANDARD_GRAVITY, 2000.0, rate=FINE)), RATE, DRIVE)
    variance = sensor.noise() ** 2 + step**2 / 12.0
    assert found.noise_density == pytest.approx(2.0 * variance / RATE, rel=0.01)
    assert found.amplitude == pytest.approx(math.sqrt(amplitude**2 + 2.0 * variance * 0.1), rel=0.02)
    assert found.amplitude_corrected == pytest.approx(amplitude, rel=0.05)


def test_quantisation_without_noise_is_an_error_of_five_repeating_phases():
    """80 Hz sampled at 200 Hz meets five phases only: rounding shifts the amplitude, and hides it below half a step."""
    silent = Accelerometer(noise_density=0.0)
    small = sine(0.004 * STANDARD_GRAVITY, 20.0, rate=FINE)
    assert estimate(read(silent, small)) < 1e-12
    assert estimate(read(Accelerometer(), small)) > 0.003
    coarse = Accelerometer(noise_density=0.0, resolution=0.2)
    phases = np.linspace(0.0, 2.0, 9)
    errors = [estimate(read(coarse, sine(0.5 * STANDARD_GRAVITY, 5.0, rate=FINE, phase=p))) - 0.5 for p in phases]
    assert 0.01 < np.max(np.abs(errors)) < 0.1


def test_noise_floor_biases_weak_drives_and_side_bands_remove_it():
    sensor = Accelerometer(resolution=0.0, noise_density=2e-3)
    amplitude = 0.02
    records = [read(sensor, sine(amplitude * STANDARD_GRAVITY, 60.0, rate=FINE), seed) for seed in range(40)]
    estimates = [spectral_amplitude(record, RATE, DRIVE) for record in records]
    plain = np.mean([e.amplitude for e in estimates])
    corrected = np.mean([e.amplitude_corrected for e in estimates])
    density = 2.0 * sensor.noise() ** 2 / RATE
    assert plain == pytest.approx(math.sqrt(amplitude**2 + 2.0 * density * 10.0), rel=0.01)
    assert corrected == pytest.approx(amplitude, rel=0.01)
    assert np.mean([e.noise_density for e in estimates]) == pytest.approx(density, rel=0.03)


def test_clips_at_sixteen_g_less_gravity():
    sensor = Accelerometer(noise_density=0.0)
    record = read(sensor, sine(20.0 * STANDARD_GRAVITY, 1.0, rate=FINE, frequency=7.0))
    assert (record.min(), record.max()) == (-16.0, 16.0)
    free = read(sensor, sine(14.9 * STANDARD_GRAVITY, 10.0, rate=FINE))
    clipped = read(sensor, sine(18.0 * STANDARD_GRAVITY, 10.0, rate=FINE, phase=0.0))
    assert np.count_nonzero(np.abs(free) >= 16.0) == 0
    assert estimate(free) == pytest.approx(14.9, rel=1e-3)
    assert estimate(clipped) < 17.5


@pytest.mark.parametrize(
    ("harmonic", "folds_onto_drive"),
    [(120.0, True), (160.0, False), (240.0, False), (280.0, True), (320.0, True)],
)
def test_what_folds_onto_the_drive_counts_as_drive(harmonic, folds_onto_drive):
    """At 200 Hz, 120, 280 and 320 Hz (the 4th harmonic) look like 80 Hz; 160 and 240 Hz look like 40 Hz."""
    acceleration = STANDARD_GRAVITY * (sine(1.0, 10.0, rate=FINE, phase=0.0) + sine(0.2, 10.0, harmonic, FINE, 0.5))
    error = estimate(read(IDEAL, acceleration)) - 1.0
    if folds_onto_drive:
        assert 0.05 < abs(error) <= 0.2
    else:
        assert abs(error) < 1e-9


def test_low_pass_keeps_the_fold_out_and_costs_a_known_gain():
    sensor = Accelerometer(resolution=0.0, noise_density=0.0, measuring_range=1e9, bandwidth=100.0)
    drive = sine(STANDARD_GRAVITY, 20.0, rate=FINE)
    with_harmonic = drive + sine(0.2 * STANDARD_GRAVITY, 20.0, 320.0, FINE)
    gain = sensor.filter_gain(DRIVE)
    assert gain == pytest.approx(0.926, abs=1e-3)
    plain, disturbed = (estimate(read(sensor, record)[200:]) for record in (drive, with_harmonic))
    assert plain == pytest.approx(gain, rel=5e-3)  # the filter of the simulation is bilinear
    assert disturbed == pytest.approx(plain, rel=3e-3)


def test_noise_is_that_of_the_data_sheet_and_seeded():
    sensor = Accelerometer(resolution=0.0)
    record = read(sensor, np.zeros(240_000))
    assert np.std(record) == pytest.approx(430e-6 * math.sqrt(200.0), rel=0.02)
    assert np.mean(record) == pytest.approx(-9.8 / STANDARD_GRAVITY, abs=2e-4)
    assert Accelerometer(data_rate=100.0).noise() / 3.9e-3 == pytest.approx(1.1, rel=0.01)  # LSB rms, z axis, 100 Hz
    np.testing.assert_array_equal(record, read(sensor, np.zeros(240_000)))
    assert not np.array_equal(record, read(sensor, np.zeros(240_000), seed=2))


def test_errors_name_value_and_remedy():
    with pytest.raises(LabError, match=r"2500 Hz is not a multiple.*200.*1/4800"):
        Accelerometer().read(np.zeros(100), 2500.0, np.random.default_rng(1))
    with pytest.raises(LabError, match=r"does not fit below half the data rate"):
        spectral_amplitude(np.zeros(1000), RATE, 98.0)
    with pytest.raises(LabError, match=r"record at least 0\.4 s"):
        spectral_amplitude(np.zeros(20), RATE, DRIVE)
