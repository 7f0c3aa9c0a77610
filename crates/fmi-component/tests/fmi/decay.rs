//! Exponential decay: a model without events whose time step follows from a tolerance.

use fmi_component::{DataSheet, Model, ModelInfo, ModelType, Result, Row, StructuralParameters, Unit, Values};

pub const DECAY: ModelType = ModelType::of::<Decay>();

/// x' = -x, explicit Euler.
pub struct Decay {
    time_step: f64,
    state: (f64, f64),
}

impl Model for Decay {
    /// Time and x.
    type State = (f64, f64);

    fn info() -> ModelInfo {
        ModelInfo {
            package: "fmi-component",
            version: env!("CARGO_PKG_VERSION"),
            name: "decay",
            variant: vec![],
            identifier: "decay".into(),
            description: "Exponential decay",
            equations: "<p>x' = -x</p>",
            structure: vec![],
            stop_time: 1.0,
            step_size: 0.1,
            sheet: DataSheet::EMPTY,
        }
    }

    fn variables(_: &StructuralParameters) -> Vec<Row<Self>> {
        vec![
            Row::parameter("tolerance", Unit::ONE, 1e-12..=1e-4, 1e-6, "Local error of a step."),
            Row::calculated("chosen_time_step", Unit::SECOND, 1e-3, "Time step.", |decay| {
                decay.time_step
            }),
            Row::output("x", Unit::ONE, 1.0, "What decays.", |decay: &Self| decay.state.1),
        ]
    }

    fn new(_: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        Ok(Self {
            time_step: (2.0 * values.real("tolerance")).sqrt(),
            state: (start_time, 1.0),
        })
    }

    fn advance_to(&mut self, end_time: f64, _: &Values) -> Result<()> {
        while self.state.0 < end_time {
            let step = self.time_step.min(end_time - self.state.0);
            self.state = (self.state.0 + step, self.state.1 * (1.0 - step));
        }
        self.state.0 = end_time;
        Ok(())
    }

    fn state(&self) -> Self::State {
        self.state
    }

    fn time_of(state: &Self::State) -> f64 {
        state.0
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        self.state = *state;
        Ok(())
    }
}
