//! Time events: a counter that goes up at each whole second, at which an importer with event mode stops.

use fmi_component::{CoSimulation, Component, Result, Step};

/// Counts the seconds since the start.
#[derive(Component)]
#[component(stop_time = 10.0, step_size = 0.2)]
pub struct Stair {
    /// Counts the seconds.
    #[output(start = 1, min = 1)]
    counter: i32,
}

impl CoSimulation for Stair {
    const EVENTS: bool = true;

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        for second in step.grid(1.0)? {
            self.counter = self.counter.saturating_add(1);
            if step.stop_at_event(second) {
                break;
            }
        }
        Ok(())
    }
}
