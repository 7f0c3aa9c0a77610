//! A scene for tests: hands that turn at a constant rate and stop at a limit.

use jostle::scene::{Card, Choice, OutputWriter, Scene, Unit, Values, Variable};
use jostle::{Error, Result};

pub struct Clock {
    rate: f64,
    limit: f64,
    hands: u32,
    time: f64,
}

impl Scene for Clock {
    type State = f64;

    fn card() -> Card {
        Card {
            scene: "clock",
            identifier: "jostle_clock",
            engine: "none",
            drive: "sine",
            description: "Hands that turn",
            equations: "",
            disks: 1..=12,
            default_disks: 3,
            stop_time: 1.0,
            step_size: 0.1,
        }
    }

    fn variables(choice: Choice) -> Vec<Variable> {
        let mut rows = vec![
            Variable::parameter("rate", Unit::RadianPerSecond, 0.0..=10.0, 1.0, "Rate of every hand"),
            Variable::parameter("limit", Unit::Second, 0.0..=1e9, 1e9, "When the clock stops"),
            Variable::long_parameter("seed", 0..=i64::MAX, 1, "Not used"),
            Variable::enumeration_parameter(
                "sense",
                "sense",
                &[("ahead", "Clockwise"), ("back", "Counter-clockwise")],
                1,
                "Which way the hands turn",
            ),
        ];
        rows.extend((1..=choice.disks).map(|hand| {
            Variable::output(
                format!("angle[{hand}]"),
                Unit::Radian,
                1.0,
                format!("Angle of disk {hand}"),
            )
        }));
        rows.push(Variable::count_output("ticks", "Whole radians"));
        rows
    }

    fn new(choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
        let (rate, limit) = (values.real("rate"), values.real("limit"));
        Ok(Self {
            rate,
            limit,
            hands: choice.disks,
            time: start_time,
        })
    }

    fn advance_to(&mut self, end_time: f64, _values: &Values) -> Result<()> {
        if end_time > self.limit {
            let (what, remedy) = ("the clock has stopped".into(), "Raise limit.".into());
            return Err(Error::Step {
                scene: "clock",
                time: self.limit,
                what,
                remedy,
            });
        }
        self.time = end_time;
        Ok(())
    }

    fn write_outputs(&self, mut outputs: OutputWriter<'_>) {
        let angle = self.rate * self.time;
        outputs.reals("angle", (0..self.hands).map(|_| angle));
        outputs.integer("ticks", angle as i64);
        outputs.finish();
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
