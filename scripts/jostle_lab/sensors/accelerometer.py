"""Base acceleration in, what an adxl345 writes to its file out.

The sensor feels gravity as well: its reading averages -g (P 2.4.3), and clips at 15 g of motion one way. Noise as on
the data sheet (Analog Devices, ADXL345, "Noise performance": z axis 430 ug/sqrt(Hz), that is 1.1 LSB of 3.9 mg at a
data rate of 100 Hz, and sqrt(2) more for each doubling of the rate). Resolution: the thesis says 0.01 g; the part
offers 3.9 mg (full resolution) or 31 mg (10 bit) at +-16 g.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from jostle_lab.errors import LabError, require

STANDARD_GRAVITY = 9.80665
"""What the sensor calls one g [m/s2]."""


@dataclass(frozen=True)
class Accelerometer:
    """An accelerometer of one axis, up positive.

    Without `bandwidth` the sensor samples the acceleration of an instant, and everything above half the data rate
    folds back. With it, a low-pass of Butterworth form comes first; the data sheet gives half the data rate as
    bandwidth but not the form of the filter, so its attenuation at the drive is a guess that `filter_gain` states.
    """

    data_rate: float = 200.0
    """[Hz]."""
    measuring_range: float = 16.0
    """Readings are clipped to +- this [g]."""
    resolution: float = 0.01
    """Step of the readings [g]; 0: none."""
    noise_density: float = 430e-6
    """White noise [g/sqrt(Hz)]; its standard deviation is this times sqrt(data_rate)."""
    bandwidth: float | None = None
    """-3 dB frequency of the low-pass [Hz], or None."""
    filter_order: int = 4
    bias: float = 0.0
    """What is added to each reading before it is rounded [g]."""
    gravity: float = 9.8
    """Gravity of the laboratory [m/s2]."""

    def noise(self) -> float:
        """Standard deviation of one reading [g]."""
        return self.noise_density * math.sqrt(self.data_rate)

    def filter_gain(self, frequency: float) -> float:
        """Attenuation of an amplitude at `frequency` [Hz] by the low-pass, 1 without one."""
        if self.bandwidth is None:
            return 1.0
        return float(1.0 / math.sqrt(1.0 + (frequency / self.bandwidth) ** (2 * self.filter_order)))

    def read(
        self, acceleration: NDArray[np.float64], sample_rate: float, generator: np.random.Generator
    ) -> NDArray[np.float64]:
        """Readings [g], gravity included, shape (samples,).

        Args:
            acceleration: of the base [m/s2], up positive, shape (n,), `sample_rate` [Hz] a multiple of the data rate.
            sample_rate: of `acceleration` [Hz].
            generator: source of the sensor's noise.

        """
        ratio = sample_rate / self.data_rate
        stride = round(ratio)
        if stride < 1 or not math.isclose(ratio, stride, rel_tol=1e-9):
            raise LabError(
                f"accelerometer: {sample_rate:g} Hz is not a multiple of the data rate {self.data_rate:g} Hz. "
                "Choose a communication step that divides both the data period and the drive period, such as 1/4800 s."
            )
        felt = (acceleration - self.gravity) / STANDARD_GRAVITY
        if self.bandwidth is not None:
            require("accelerometer bandwidth [Hz]", self.bandwidth, 1e-3, 0.499 * sample_rate, "Half the data rate.")
            sections = signal.butter(self.filter_order, self.bandwidth, fs=sample_rate, output="sos")
            rest = signal.sosfilt_zi(sections) * felt[0]
            felt, _ = signal.sosfilt(sections, felt, zi=rest)
        samples = np.asarray(felt[stride - 1 :: stride], dtype=np.float64)
        noisy = samples + self.bias + self.noise() * generator.standard_normal(samples.shape)
        if self.resolution > 0.0:
            noisy = np.round(noisy / self.resolution) * self.resolution
        return np.clip(noisy, -self.measuring_range, self.measuring_range)
