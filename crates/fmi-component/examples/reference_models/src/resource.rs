//! Data in a file, which is compiled into the library: no importer can lose it, and no path has to be decoded.

use fmi_component::{CoSimulation, Component, Result, Step};

/// Gives the number of the first character in a file.
#[derive(Component)]
#[component(stop_time = 1.0, step_size = 1.0)]
pub struct Resource {
    /// Number of the first character in y.txt.
    #[output]
    y: i32,
}

impl CoSimulation for Resource {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        self.y = include_bytes!("y.txt")[0].into();
        Ok(())
    }

    fn do_step(&mut self, _step: &mut Step) -> Result<()> {
        Ok(())
    }
}
