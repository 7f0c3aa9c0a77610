use fmi_component::{CoSimulation, Component, Result, Step};

/// Dahlquist's test equation, dx/dt = -k x.
#[derive(Component)]
pub struct Dahlquist {
    /// Rate of the decay.
    #[parameter(start = 1.0, min = 0.0, max = 1e3, unit = "1/s")]
    k: f64,
    /// What decays.
    #[output(start = 1.0)]
    x: f64,
}

impl CoSimulation for Dahlquist {
    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        self.x *= (-self.k * step.size()).exp();
        Ok(())
    }
}

fmi_component::export_fmu!(Dahlquist);
