//! Acceleration of the base in, readings of an accelerometer out.
//!
//! A low-pass, then at each sampling instant bias, noise, resolution and range, in this order. The sensor feels gravity as well: its
//! readings average -g (P 2.4.3). An instant takes the input of the step that it lies in, or that begins at it; the reading is out at the end
//! of that step.

use fmi_component::{CoSimulation, Component, Error, Result, Step};

use crate::instants;
use crate::low_pass::LowPass;
use crate::noise::Noise;

/// What the sensor calls one g \[m/s2\].
pub const STANDARD_GRAVITY: f64 = 9.80665;
const NAME: &str = "accelerometer";

/// Accelerometer of one axis, up positive: resolution, noise, bandwidth, bias, range and data rate of an ADXL345 (Analog Devices, data sheet).
#[derive(Component)]
#[component(name = "accelerometer", stop_time = 1.0, step_size = 3.125e-4)]
pub struct Accelerometer {
    /// Readings in a second.
    #[parameter(start = 200, min = 1e-3, max = 1e6, unit = "Hz")]
    data_rate: f64,
    /// Readings are clipped to plus and minus this, in standard gravities of 9.80665 m/s2.
    #[parameter(start = 16, min = 1e-3, max = 1e6)]
    measuring_range: f64,
    /// Step of the readings in standard gravities; 0: none. P says 0.01; the part offers 0.0039, or 0.031 with 10 bits.
    #[parameter(start = 0.01, min = 0, max = 1e3)]
    resolution: f64,
    /// White noise in standard gravities per root of Hz; a reading has this times the root of the data rate as standard deviation.
    #[parameter(name = "noise.density", start = 430e-6, min = 0, max = 1e3)]
    noise_density: f64,
    /// Seed of the noise.
    #[parameter(start = 1, min = 0)]
    seed: i64,
    /// What is added to each reading before it is rounded, in standard gravities.
    #[parameter(start = 0, min = -1e3, max = 1e3)]
    bias: f64,
    /// Frequency of -3 dB of the low-pass before the sampling; 0: no low-pass, the acceleration of an instant is sampled.
    #[parameter(name = "filter.bandwidth", start = 0, min = 0, max = 1e6, unit = "Hz")]
    bandwidth: f64,
    /// Order of the low-pass, of Butterworth form.
    #[parameter(name = "filter.order", start = 4, min = 1, max = 8)]
    filter_order: i64,
    /// Rate at which the low-pass samples: a multiple of the data rate, best that of the communication steps.
    #[parameter(name = "filter.rate", start = 4800, min = 1e-3, max = 1e7, unit = "Hz")]
    filter_rate: f64,
    /// Gravity of the laboratory.
    #[parameter(start = 9.8, min = 0, max = 1e3, unit = "m/s2")]
    gravity: f64,
    /// Acceleration of the base, up.
    #[input(unit = "m/s2", nominal = 10.0)]
    acceleration: f64,
    /// Last reading in standard gravities, gravity included.
    #[output(nominal = 1.0)]
    reading: f64,
    /// Last reading, gravity included.
    #[output(name = "reading.acceleration", unit = "m/s2", nominal = 10.0)]
    reading_acceleration: f64,
    /// Number of readings so far.
    #[output]
    readings: i64,
    samples: u64,
    filtered: u64,
    value: f64,
    filter: LowPass,
    noise: Noise,
}

impl Accelerometer {
    /// What the sensor feels, in standard gravities.
    fn felt(&self) -> f64 {
        (self.acceleration - self.gravity) / STANDARD_GRAVITY
    }

    /// The low-pass up to the instant number `until` of its own.
    fn filter_until(&mut self, until: u64) {
        let felt = self.felt();
        if self.filtered == 0 && until > 0 {
            self.filter.rest_at(felt);
        }
        while self.filtered < until {
            self.value = self.filter.filter(felt);
            self.filtered += 1;
        }
    }

    fn show(&mut self, value: f64) {
        let rounded = match self.resolution > 0.0 {
            true => (value / self.resolution).round_ties_even() * self.resolution,
            false => value,
        };
        self.reading = rounded.clamp(-self.measuring_range, self.measuring_range);
        self.reading_acceleration = self.reading * STANDARD_GRAVITY;
    }
}

impl CoSimulation for Accelerometer {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        if self.bandwidth > 0.0 {
            let ratio = self.filter_rate / self.data_rate;
            if ratio < 0.5 || (ratio - ratio.round()).abs() > 1e-9 * ratio {
                let allowed = format!("a multiple of data_rate, {} Hz", self.data_rate);
                return Err(Error::parameter(
                    "filter.rate",
                    self.filter_rate,
                    allowed,
                    "Choose one, best the rate of the steps.",
                ));
            }
            if self.bandwidth >= 0.499 * self.filter_rate {
                let allowed = format!("less than {} Hz, about half of filter.rate", 0.499 * self.filter_rate);
                return Err(Error::parameter(
                    "filter.bandwidth",
                    self.bandwidth,
                    allowed,
                    "The data sheet gives half the data rate.",
                ));
            }
            self.filter = LowPass::new(
                u32::try_from(self.filter_order).unwrap_or(1),
                self.bandwidth,
                self.filter_rate,
            );
        }
        self.noise = Noise::new(self.seed.unsigned_abs());
        self.show(self.felt() + self.bias);
        Ok(())
    }

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        let samples = instants::before_end(step, self.data_rate, NAME)?;
        let filters = self.bandwidth > 0.0;
        let filtered = match filters {
            true => instants::before_end(step, self.filter_rate, NAME)?,
            false => 0,
        };
        let each = (self.filter_rate / self.data_rate).round() as u64;
        let deviation = self.noise_density * self.data_rate.sqrt();
        while self.samples < samples {
            if filters {
                self.filter_until(self.samples * each + 1);
            }
            let clean = if filters { self.value } else { self.felt() };
            let noise = deviation * self.noise.next();
            self.show(clean + self.bias + noise);
            self.samples += 1;
        }
        self.readings = i64::try_from(self.samples).unwrap_or(i64::MAX);
        self.filter_until(filtered);
        Ok(())
    }
}
