//! Ten reals in, ten out and an empty step: what `benches/beside_c.rs` compares with the same model in C.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

use fmi_component::{CoSimulation, Component, Result, Step};

fmi_component::export_fmu!(crate::TenReals);

/// Twice the inputs at the start.
#[derive(Component)]
pub struct TenReals {
    /// Inputs.
    #[input]
    u: [f64; 10],
    /// Outputs.
    #[output]
    y: [f64; 10],
}

impl CoSimulation for TenReals {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        self.y = self.u.map(|u| 2.0 * u);
        Ok(())
    }

    fn do_step(&mut self, _step: &mut Step) -> Result<()> {
        Ok(())
    }
}
