//! Measured acceleration in, voltage out: holds Gamma of the base by feedback, period by period.
//!
//! ```text
//! a_1 = (2/T) integral of a exp(-i phase) over whole periods      lock-in at the phase of the drive
//! U <- U (Gamma_set g / |a_1|)^gain                               an integrator of the logarithm
//! ```
//! It knows no model of the shaker. Stable for gains below 2 if the shaker settles within a period; one that takes longer needs a smaller
//! gain. Each communication step is one sample: take a whole number of steps a period.

use std::f64::consts::TAU;

use fmi_component::{CoSimulation, Component, Error, Result, Step};

const NAME: &str = "gamma_controller";
/// Rounding of the phase must not move the end of a period by a step \[turns\].
const ROUNDING: f64 = 1e-9;
/// Bounds of what one period may ask for: a base that hardly moves yet must not ask for everything at once.
const SMALLEST_RATIO: f64 = 0.25;
const LARGEST_RATIO: f64 = 4.0;

/// Controller that holds Gamma, the peak acceleration of the base over gravity, by the amplitude of the drive's voltage.
#[derive(Component)]
#[component(name = "gamma_controller", stop_time = 1.0, step_size = 3.125e-4)]
pub struct GammaController {
    /// Gamma to hold.
    #[parameter(start = 2, min = 1e-3, max = 1e3, tunable)]
    target: f64,
    /// Share of the logarithmic error that a period corrects.
    #[parameter(start = 0.3, min = 1e-6, max = 1.9, tunable)]
    gain: f64,
    /// Amplitude of the voltage at the start.
    #[parameter(name = "voltage.start", start = 1, min = 1e-6, max = 1e4, unit = "V")]
    voltage_start: f64,
    /// Largest amplitude that the amplifier gives; a step that asks for more is refused.
    #[parameter(name = "voltage.limit", start = 60, min = 1e-6, max = 1e4, unit = "V")]
    voltage_limit: f64,
    /// Gravity of the laboratory.
    #[parameter(start = 9.8, min = 1e-3, max = 1e3, unit = "m/s2")]
    gravity: f64,
    /// Acceleration of the base; a constant in it, such as gravity, does not count.
    #[input(unit = "m/s2", nominal = 10.0)]
    acceleration: f64,
    /// Phase of the drive in turns, from 0 to 1: a period ends where it falls.
    #[input(name = "drive.turns")]
    turns: f64,
    /// Amplitude of the voltage.
    #[output(name = "voltage", unit = "V", nominal = 10.0)]
    voltage: f64,
    /// Gamma of the last whole period.
    #[output(name = "gamma")]
    measured: f64,
    /// Number of whole periods so far.
    #[output]
    periods: i64,
    sum: [f64; 2],
    samples: u32,
    last_turns: f64,
}

impl GammaController {
    fn correct(&mut self, time: f64) -> Result<()> {
        self.measured = 2.0 * libm::hypot(self.sum[0], self.sum[1]) / f64::from(self.samples) / self.gravity;
        (self.sum, self.samples) = ([0.0; 2], 0);
        self.periods += 1;
        let ratio = (self.target / self.measured.max(1e-9)).clamp(SMALLEST_RATIO, LARGEST_RATIO);
        let wanted = self.voltage * libm::pow(ratio, self.gain);
        if wanted <= self.voltage_limit {
            self.voltage = wanted;
            return Ok(());
        }
        Err(Error::Step {
            model: NAME,
            time,
            what: format!(
                "it asks for {wanted:.3} V at Gamma {:.3} of {}; voltage.limit is {} V",
                self.measured, self.target, self.voltage_limit
            ),
            remedy: "Lower the target or the mass of the load, or raise the limit of the amplifier.".into(),
        })
    }
}

impl CoSimulation for GammaController {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        if self.voltage_start > self.voltage_limit {
            let allowed = format!("up to voltage.limit = {} V", self.voltage_limit);
            return Err(Error::parameter(
                "voltage.start",
                self.voltage_start,
                allowed,
                "Lower it.",
            ));
        }
        self.voltage = self.voltage_start;
        Ok(())
    }

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        let turns = (self.turns + ROUNDING) % 1.0;
        if turns < self.last_turns && self.samples > 0 {
            self.correct(step.begin())?;
        }
        let (sine, cosine) = libm::sincos(TAU * turns);
        self.sum = [
            self.sum[0] + self.acceleration * cosine,
            self.sum[1] - self.acceleration * sine,
        ];
        self.samples = self.samples.saturating_add(1);
        self.last_turns = turns;
        Ok(())
    }
}
