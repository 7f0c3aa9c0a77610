//! A model for tests: hands that turn at a constant rate and stop at a limit.

use jostle::scene::{
    DataSheet, Model, ModelInfo, ModelType, Row, SceneInfo, Simulation, StructuralParameters, Unit, Values,
};
use jostle::{Error, Result};

pub struct Clock {
    rate: f64,
    limit: f64,
    time: f64,
}

/// The clock with so many hands, not started.
pub fn prepare(hands: u32) -> Simulation<Clock> {
    let structure = StructuralParameters::choose(&Clock::info(), &[("disks", hands)]).unwrap();
    Simulation::prepare(structure)
}

/// The clock as a model that is chosen at run time.
pub const MODEL: ModelType = ModelType::of::<Clock>();

impl Model for Clock {
    type State = f64;

    fn info() -> ModelInfo {
        SceneInfo {
            scene: "clock",
            identifier: "jostle_clock",
            unnamed_drive: "sine",
            engine: "none",
            drive: "sine",
            description: "Hands that turn",
            equations: "",
            disks: 1..=12,
            default_disks: 3,
            stop_time: 1.0,
            step_size: 0.1,
            sheet: DataSheet::EMPTY,
        }
        .into()
    }

    fn variables(structure: &StructuralParameters) -> Vec<Row<Self>> {
        let mut rows = vec![
            Row::parameter("rate", Unit::RADIAN_PER_SECOND, 0.0..=10.0, 1.0, "Rate of every hand"),
            Row::parameter("limit", Unit::SECOND, 0.0..=1e9, 1e9, "When the clock stops"),
            Row::long_parameter("seed", 0..=i64::MAX, 1, "Not used"),
            Row::enumeration_parameter(
                "sense",
                "sense",
                &[("ahead", "Clockwise"), ("back", "Counter-clockwise")],
                1,
                "Which way the hands turn",
            ),
        ];
        let hands = structure.get("disks");
        rows.extend(Row::outputs(
            "angle",
            hands,
            Unit::RADIAN,
            1.0,
            "Angle of disk {}",
            |clock: &Self, _| clock.angle(),
        ));
        rows.push(Row::count_output("ticks", "Whole radians", |clock| {
            clock.angle() as i64
        }));
        rows
    }

    fn new(_structure: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        let (rate, limit) = (values.real("rate"), values.real("limit"));
        Ok(Self {
            rate,
            limit,
            time: start_time,
        })
    }

    fn advance_to(&mut self, end_time: f64, _values: &Values) -> Result<()> {
        if end_time > self.limit {
            let (what, remedy) = ("the clock has stopped".into(), "Raise limit.".into());
            return Err(Error::Step {
                model: "clock",
                time: self.limit,
                what,
                remedy,
            });
        }
        self.time = end_time;
        Ok(())
    }

    fn state(&self) -> f64 {
        self.time
    }

    fn time_of(state: &f64) -> f64 {
        *state
    }

    fn restore(&mut self, state: &f64) -> Result<()> {
        self.time = *state;
        Ok(())
    }
}

impl Clock {
    fn angle(&self) -> f64 {
        self.rate * self.time
    }
}
