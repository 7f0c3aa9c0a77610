//! State events: a ball bounces, and an importer with event mode learns of each impact.

use fmi_component::{CoSimulation, Component, Result, Step};

/// Fixed step of the explicit Euler method \[s\].
const TIME_STEP: f64 = 1e-3;

/// Ball that is dropped: dh/dt = v, dv/dt = g; v becomes -e v where h = 0, until it rests.
#[derive(Component)]
#[component(stop_time = 3.0, step_size = 0.01)]
pub struct BouncingBall {
    /// Gravity acting on the ball.
    #[parameter(start = -9.81, unit = "m/s2")]
    g: f64,
    /// Coefficient of restitution.
    #[parameter(start = 0.7, min = 0.5, max = 1, tunable)]
    e: f64,
    /// Velocity after an impact below which the ball rests.
    #[parameter(start = 0.1, min = 0, unit = "m/s")]
    v_min: f64,
    /// Position of the ball.
    #[output(start = 1, unit = "m", derivative = "v")]
    h: f64,
    /// Velocity of the ball.
    #[output(unit = "m/s")]
    v: f64,
    rests: bool,
}

impl CoSimulation for BouncingBall {
    const EVENTS: bool = true;

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        for time in step.grid(TIME_STEP)? {
            if self.rests {
                break;
            }
            self.h += TIME_STEP * self.v;
            self.v += TIME_STEP * self.g;
            if self.h > 0.0 || self.v >= 0.0 {
                continue;
            }
            (self.h, self.v) = (0.0, -self.e * self.v);
            if self.v < self.v_min {
                (self.v, self.rests) = (0.0, true);
            }
            if step.stop_at_event(time) {
                break;
            }
        }
        Ok(())
    }
}
