//! Dahlquist's equation x' = -k x, solved exactly: `cargo build --release -p fmi-component --example decay`.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

use fmi_component::{Model, ModelInfo, Result, Row, StructuralParameters, Unit, Values};

fmi_component::export_fmu!(crate::Decay);

/// Time \[s\], k \[1/s\], x: the model is its state.
pub struct Decay([f64; 3]);

impl Model for Decay {
    type State = [f64; 3];

    fn info() -> ModelInfo {
        ModelInfo::new("decay", env!("CARGO_PKG_VERSION"), "Exponential decay")
    }
    fn variables(_: &StructuralParameters) -> Vec<Row<Self>> {
        let rate = Row::parameter("k", Unit::HERTZ, 0.0..=1e3, 1.0, "Rate of the decay.");
        vec![
            rate,
            Row::output("x", Unit::ONE, 1.0, "What decays.", |model| model.0[2]),
        ]
    }
    fn new(_: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        Ok(Self([start_time, values.real("k"), 1.0]))
    }
    fn advance_to(&mut self, end_time: f64, _: &Values) -> Result<()> {
        let [time, k, x] = self.0;
        self.0 = [end_time, k, x * (-k * (end_time - time)).exp()];
        Ok(())
    }
    fn state(&self) -> [f64; 3] {
        self.0
    }
    fn time_of(state: &[f64; 3]) -> f64 {
        state[0]
    }
    fn restore(&mut self, state: &[f64; 3]) -> Result<()> {
        self.0 = *state;
        Ok(())
    }
}
