"""Accelerometer record in, amplitude of the drive out (P 2.4.3).

The spectral density is summed over a window centred on the drive frequency, times the frequency step: the variance in
the window, SD^2. The amplitude is a = sqrt(2) SD (P 2.47). On a noise-free sine with whole periods in the record it is
exact. Known errors: the noise floor in the window adds to the amplitude (side bands estimate and remove it); leakage
beyond the window is lost; harmonics that fold onto the window are taken for the drive.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from jostle_lab.errors import LabError


@dataclass(frozen=True)
class SpectralAmplitude:
    """Estimate of the amplitude of the drive, in the unit of the record."""

    amplitude: float
    """sqrt(2) times the standard deviation in the window (P 2.47)."""
    amplitude_corrected: float
    """The same without the noise floor; 0 where the floor exceeds the window."""
    noise_density: float
    """Mean spectral density in the side bands [unit^2/Hz]."""
    frequencies: NDArray[np.float64]
    """[Hz], shape (n,)."""
    density: NDArray[np.float64]
    """[unit^2/Hz], shape (n,)."""


def spectral_amplitude(
    record: NDArray[np.float64],
    data_rate: float,
    drive_frequency: float,
    *,
    window: float = 10.0,
    side_band: float = 10.0,
    segment: int | None = None,
) -> SpectralAmplitude:
    """Amplitude of the drive in `record`, shape (n,).

    Args:
        record: readings, any offset.
        data_rate: [Hz].
        drive_frequency: [Hz], window included below half the data rate.
        window: full width of the window [Hz], centred on the drive.
        side_band: width of each of the two bands beside the window that give the noise floor [Hz].
        segment: None for one periodogram of the whole record, or the length of Welch's Hann-windowed segments.

    """
    if drive_frequency + 0.5 * window > 0.5 * data_rate or drive_frequency <= 0.5 * window:
        raise LabError(
            f"spectral amplitude: a window of {window:g} Hz at {drive_frequency:g} Hz does not fit below half the data "
            f"rate, {0.5 * data_rate:g} Hz. Narrow the window or raise the data rate."
        )
    if record.size < data_rate / window * 4:
        raise LabError(
            f"spectral amplitude: {record.size} readings at {data_rate:g} Hz do not resolve a window of {window:g} Hz: "
            f"record at least {4 / window:g} s."
        )
    if segment is None:
        frequencies, density = signal.periodogram(record, fs=data_rate, window="boxcar", detrend="constant")
    else:
        frequencies, density = signal.welch(record, fs=data_rate, window="hann", nperseg=segment, detrend="constant")
    frequency_step = frequencies[1] - frequencies[0]
    distance = np.abs(frequencies - drive_frequency)
    inside = distance <= 0.5 * window + 1e-9
    beside = ~inside & (distance <= 0.5 * window + side_band + 1e-9)
    variance = float(np.sum(density[inside]) * frequency_step)
    floor = float(np.mean(density[beside])) if beside.any() else 0.0
    corrected = variance - floor * np.count_nonzero(inside) * frequency_step
    return SpectralAmplitude(
        amplitude=math.sqrt(2.0 * variance),
        amplitude_corrected=math.sqrt(2.0 * max(corrected, 0.0)),
        noise_density=floor,
        frequencies=frequencies,
        density=density,
    )


def true_amplitude(signal_values: NDArray[np.float64], sample_rate: float, frequency: float) -> float:
    """Amplitude of the component at `frequency` [Hz] of a record cut to whole periods: the truth to compare with."""
    periods = math.floor(signal_values.size * frequency / sample_rate + 1e-9)
    if periods < 1:
        raise LabError(f"true amplitude: the record holds no whole period of {frequency:g} Hz. Record longer.")
    count = round(periods * sample_rate / frequency)
    phase = math.tau * frequency / sample_rate * np.arange(count)
    values = signal_values[:count] - np.mean(signal_values[:count])
    return float(2.0 / count * abs(np.sum(values * np.exp(-1j * phase))))
