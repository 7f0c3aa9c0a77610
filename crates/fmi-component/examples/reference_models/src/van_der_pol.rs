//! The oscillator of Van der Pol, with the derivatives of its outputs.

use fmi_component::{CoSimulation, Component, Result, Step};

/// Fixed step of the explicit Euler method \[s\].
const TIME_STEP: f64 = 1e-2;

/// Oscillator of Van der Pol: dx0/dt = x1, dx1/dt = mu (1 - x0²) x1 - x0.
#[derive(Component)]
#[component(stop_time = 20.0, step_size = 0.01)]
pub struct VanDerPol {
    /// Strength of the damping.
    #[parameter(start = 1, min = 0, max = 100)]
    mu: f64,
    /// The first state.
    #[output(start = 2, derivative = "x1")]
    x0: f64,
    /// The second state.
    #[output(start = 0, derivative = "der_x1")]
    x1: f64,
    /// Derivative of the second state.
    #[output(unit = "1/s")]
    der_x1: f64,
}

impl VanDerPol {
    fn acceleration(&self) -> f64 {
        self.mu * ((1.0 - self.x0 * self.x0) * self.x1) - self.x0
    }
}

impl CoSimulation for VanDerPol {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        self.der_x1 = self.acceleration();
        Ok(())
    }

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        for _ in step.grid(TIME_STEP)? {
            let (velocity, acceleration) = (self.x1, self.acceleration());
            self.x0 += TIME_STEP * velocity;
            self.x1 += TIME_STEP * acceleration;
        }
        self.der_x1 = self.acceleration();
        Ok(())
    }
}
