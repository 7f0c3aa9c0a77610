//! The parameter that bounds how long a user waits: how many events a communication step may take, and a simulated second on
//! average.
//!
//! It counts and takes no time, so that the same steps are refused on every machine. The unit is that of
//! [`WorkBudget`](crate::engine::WorkBudget).

use crate::engine::WorkBudget;

use super::{Error, Row, Unit, Values};

const NAME: &str = "work.limit";

/// Disks for whose events the limit of a simulated second is meant; more of them may have more in proportion.
const DISKS: f64 = 1000.0;

/// The parameter. Its start value is about a minute of one core.
pub fn row<M>() -> Row<M> {
    Row::parameter(
        NAME,
        Unit::ONE,
        1.0..=1e15,
        2e8,
        "Events of hard disks, or time steps of ten soft disks, that a communication step may take, and a simulated second on \
         average since the start (of up to 1000 disks); a step that takes more is refused",
    )
}

/// How much work a run may do.
#[derive(Debug, Clone, Copy)]
pub struct WorkLimit {
    /// In one communication step.
    of_step: u64,
    /// In a simulated second, on average since the start.
    of_second: f64,
    /// \[s\]
    start_time: f64,
}

impl WorkLimit {
    /// What the parameter says, for a run of so many disks from `start_time` \[s\] on.
    pub fn new(start_time: f64, disks: usize, values: &Values) -> Self {
        let limit = values.real(NAME);
        Self {
            of_step: limit as u64,
            of_second: limit * (disks as f64 / DISKS).max(1.0),
            start_time,
        }
    }

    /// Replaces the limits by one for each communication step.
    pub fn replace(&mut self, most: u64) {
        (self.of_step, self.of_second) = (most, f64::INFINITY);
    }

    /// The budget of a step to `end_time` \[s\] of a run that has done this much.
    pub fn budget(&self, done: u64, end_time: f64) -> WorkBudget {
        let seconds = (end_time - self.start_time).ceil().max(1.0);
        let left = self.of_second * seconds - done as f64;
        WorkBudget::at_most(self.of_step.min(left.max(0.0) as u64))
    }
}

/// The refusal of a step at `time` \[s\] that asks for so much, with what makes it much.
pub fn refusal(scene: &'static str, time: f64, asked: &str, reason: &str) -> Error {
    Error::Step {
        model: scene,
        time,
        what: format!("the step asks for {asked}, more than one call may do"),
        remedy: format!(
            "Take shorter communication steps. If that does not help, the run takes more than {NAME} for a simulated second, at its \
             start value about a minute of one core: {reason} Or raise {NAME}."
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_is_what_a_step_may_take_and_what_is_left_of_the_seconds_begun() {
        let limit = WorkLimit {
            of_step: 100,
            of_second: 100.0,
            start_time: -2.0,
        };
        let budget = |done, end_time| limit.budget(done, end_time).most();
        assert_eq!([budget(0, -1.5), budget(30, -1.5), budget(100, -1.0)], [100, 70, 0]);
        assert_eq!([budget(100, -0.5), budget(250, 0.5), budget(900, 0.5)], [100, 50, 0]);
        let mut replaced = limit;
        replaced.replace(7);
        assert_eq!(replaced.budget(1_000_000, -1.9).most(), 7);
    }
}
