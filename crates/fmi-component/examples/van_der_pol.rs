//! Van der Pol's oscillator as a component: `cargo build --release -p fmi-component --example van_der_pol`.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

use fmi_component::{Error, Model, ModelInfo, Result, Row, StructuralParameters, Unit, Values};
use serde::{Deserialize, Serialize};

fmi_component::export_fmu!(crate::VanDerPol);

/// x'' = mu (1 - x^2) x' - x + u, by semi-implicit Euler. The state is the model itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VanDerPol {
    time: f64,
    mu: f64,
    x: f64,
    v: f64,
}

impl Model for VanDerPol {
    type State = Self;

    fn info() -> ModelInfo {
        ModelInfo {
            stop_time: 20.0,
            ..ModelInfo::new("van_der_pol", env!("CARGO_PKG_VERSION"), "Van der Pol's oscillator")
        }
    }

    fn variables(_: &StructuralParameters) -> Vec<Row<Self>> {
        vec![
            Row::parameter("mu", Unit::ONE, 0.0..=10.0, 1.0, "Strength of the damping."),
            Row::input("u", Unit::ONE, 1.0, "Force."),
            Row::output("x", Unit::ONE, 1.0, "Position.", |model: &Self| model.x).with_derivative("v"),
            Row::output("v", Unit::ONE, 1.0, "Velocity.", |model: &Self| model.v),
        ]
    }

    fn new(_: &StructuralParameters, time: f64, values: &Values) -> Result<Self> {
        let mu = values.real("mu");
        Ok(Self {
            time,
            mu,
            x: 2.0,
            v: 0.0,
        })
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        let steps = ((end_time - self.time) / 1e-3).ceil();
        if steps > 1e7 {
            return Err(Error::too_much_work(
                "van_der_pol",
                self.time,
                format!("{steps} time steps"),
            ));
        }
        let (step, force) = ((end_time - self.time) / steps, values.real("u"));
        for _ in 0..steps as u64 {
            self.v += step * (self.mu * (1.0 - self.x * self.x) * self.v - self.x + force);
            self.x += step * self.v;
        }
        self.time = end_time;
        Ok(())
    }

    fn state(&self) -> Self {
        self.clone()
    }

    fn time_of(state: &Self) -> f64 {
        state.time
    }

    fn restore(&mut self, state: &Self) -> Result<()> {
        self.clone_from(state);
        Ok(())
    }
}
