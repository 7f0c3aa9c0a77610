//! The test equation of Dahlquist, whose solution is an exponential.

use fmi_component::{CoSimulation, Component, Result, Step};

/// Fixed step of the explicit Euler method \[s\].
const TIME_STEP: f64 = 0.1;

/// Exponential decay: dx/dt = -k x.
#[derive(Component)]
#[component(stop_time = 10.0, step_size = 0.1)]
pub struct Dahlquist {
    /// Rate of the decay.
    #[parameter(start = 1, min = 0, max = 1e3, unit = "1/s")]
    k: f64,
    /// The only state.
    #[output(start = 1)]
    x: f64,
}

impl CoSimulation for Dahlquist {
    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        for _ in step.grid(TIME_STEP)? {
            self.x -= TIME_STEP * self.k * self.x;
        }
        Ok(())
    }
}
