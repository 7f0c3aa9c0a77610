//! Readings of an accelerometer in, amplitude of the drive out (P 2.4.3).
//!
//! The spectral density is summed over a window centred on the drive's frequency, times the frequency step: the variance in the window.
//! The amplitude is the root of twice the variance (P 2.47). On a noise-free sine with whole periods in the record it is exact. The noise
//! floor in the window adds to it: side bands estimate and remove it. Leakage beyond the window is lost, and harmonics that fold onto
//! the window are taken for the drive.

use fmi_component::{CoSimulation, Component, Error, Result, Step};

use crate::instants;
use crate::spectrum::Spectrum;

const NAME: &str = "spectral_amplitude";
/// Room for rounding where a frequency lies at the end of a band \[Hz\].
const ROUNDING: f64 = 1e-9;

/// Amplitude at the drive's frequency in records of a sensor, from a window of their spectral density, with and without the noise floor.
#[derive(Component)]
#[component(name = "spectral_amplitude", stop_time = 10.0, step_size = 5e-3)]
pub struct SpectralAmplitude {
    /// Readings in a second that are recorded: those of the sensor.
    #[parameter(start = 200, min = 1e-3, max = 1e6, unit = "Hz")]
    data_rate: f64,
    /// Readings in a record; one record follows the other.
    #[parameter(name = "record.readings", start = 400, min = 4, max = 100_000)]
    record_readings: i64,
    /// Readings in a segment of Welch's method, Hann-windowed, overlapping by half; 0: one periodogram of the whole record.
    #[parameter(name = "record.segment", start = 0, min = 0, max = 100_000)]
    segment: i64,
    /// Frequency of the drive.
    #[parameter(name = "drive.frequency", start = 80, min = 1e-3, max = 1e6, unit = "Hz")]
    drive_frequency: f64,
    /// Full width of the window, centred on the drive.
    #[parameter(start = 10, min = 1e-6, max = 1e6, unit = "Hz")]
    window: f64,
    /// Width of each of the two bands beside the window that give the noise floor.
    #[parameter(start = 10, min = 0, max = 1e6, unit = "Hz")]
    side_band: f64,
    /// Reading of the sensor, any offset.
    #[input]
    reading: f64,
    /// Amplitude in the last record, in the unit of the readings.
    #[output]
    amplitude: f64,
    /// The same without the noise floor; 0 where the floor exceeds the window.
    #[output(name = "amplitude.corrected")]
    corrected: f64,
    /// Mean spectral density in the side bands of the last record, in the unit of the readings squared, per Hz.
    #[output(name = "noise.density")]
    noise_density: f64,
    /// Number of whole records so far.
    #[output]
    records: i64,
    record: Vec<f64>,
    taken: u64,
}

impl SpectralAmplitude {
    fn evaluate(&mut self) {
        let (half, drive) = (0.5 * self.window, self.drive_frequency);
        let outer = half + self.side_band + ROUNDING;
        let segment = if self.segment == 0 {
            self.record_readings
        } else {
            self.segment
        };
        let spectrum = Spectrum {
            rate: self.data_rate,
            segment: usize::try_from(segment).unwrap_or(1),
            hann: self.segment != 0,
        };
        let (mut variance, mut inside, mut floor, mut beside) = (0.0, 0_u32, 0.0, 0_u32);
        for (frequency, density) in spectrum.densities(&self.record, drive - outer, drive + outer) {
            let distance = (frequency - drive).abs();
            if distance <= half + ROUNDING {
                (variance, inside) = (variance + density, inside + 1);
            } else if distance <= outer {
                (floor, beside) = (floor + density, beside + 1);
            }
        }
        let step = self.data_rate / segment as f64;
        self.noise_density = if beside == 0 { 0.0 } else { floor / f64::from(beside) };
        let corrected = variance - self.noise_density * f64::from(inside);
        self.amplitude = (2.0 * variance * step).sqrt();
        self.corrected = (2.0 * corrected.max(0.0) * step).sqrt();
        self.records += 1;
    }
}

impl CoSimulation for SpectralAmplitude {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        let half = 0.5 * self.window;
        if self.drive_frequency + half > 0.5 * self.data_rate || self.drive_frequency <= half {
            let (low, high) = (half, 0.5 * self.data_rate - half);
            let allowed = format!(
                "from {low} to {high} Hz, so that a window of {} Hz fits below half of data_rate",
                self.window
            );
            let remedy = "Narrow the window or raise the data rate.";
            return Err(Error::parameter(
                "drive.frequency",
                self.drive_frequency,
                allowed,
                remedy,
            ));
        }
        let least = self.data_rate / self.window * 4.0;
        if (self.record_readings as f64) < least {
            let allowed = format!(
                "{} or more, so that a window of {} Hz is resolved",
                least.ceil(),
                self.window
            );
            return Err(Error::parameter(
                "record.readings",
                self.record_readings,
                allowed,
                "Record longer.",
            ));
        }
        if self.segment != 0 && !(2..=self.record_readings).contains(&self.segment) {
            let allowed = format!("0, or from 2 to record.readings = {}", self.record_readings);
            return Err(Error::parameter("record.segment", self.segment, allowed, "Shorten it."));
        }
        Ok(())
    }

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        let all = instants::before_end(step, self.data_rate, NAME)?;
        while self.taken < all {
            self.record.push(self.reading);
            self.taken += 1;
            if self.record.len() as i64 >= self.record_readings {
                self.evaluate();
                self.record.clear();
            }
        }
        Ok(())
    }
}
