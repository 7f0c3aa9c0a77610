//! A communication step as the author of a component sees it.

use crate::error::{Error, Result};
use crate::unit::Unit;

/// Communication points carry the importer's rounding: a grid point that is late by this part of a grid step counts as reached.
const GRID_TOLERANCE: f64 = 1e-6;
/// Grid points of one step, unless it is limited otherwise: a tenth of a second of work for a small model.
pub(crate) const MOST_POINTS: u64 = 10_000_000;

/// A communication step: from when to when, on which grid, and whether it is to end at an event.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    begin: f64,
    end: f64,
    start: f64,
    model: &'static str,
    most_points: u64,
    /// The model has events, and the importer wants to have the step ended at them.
    events: Events,
    event: Option<f64>,
}

/// What becomes of events inside of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Events {
    /// The model says that it has none.
    None,
    /// They are handled on the way.
    OnTheWay,
    /// The step ends at the first.
    Stop,
}

impl Step {
    pub(crate) fn new([start, begin, end]: [f64; 3], model: &'static str, most_points: u64, events: Events) -> Self {
        Self {
            begin,
            end,
            start,
            model,
            most_points,
            events,
            event: None,
        }
    }

    /// Where the step begins \[s\]: where the last one ended.
    pub fn begin(&self) -> f64 {
        self.begin
    }

    /// Where the step is to end \[s\].
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Its length \[s\].
    pub fn size(&self) -> f64 {
        self.end - self.begin
    }

    /// Start of the simulation \[s\].
    pub fn start_of_simulation(&self) -> f64 {
        self.start
    }

    /// The times start + n `spacing` \[s\] after the beginning of the step and not after its end, for a method with a fixed time step:
    /// its points are the same however the importer divides time into steps. What lies behind the last point is for the
    /// next step.
    ///
    /// # Errors
    /// More points than one call may do; a spacing that is not positive.
    pub fn grid(&self, spacing: f64) -> Result<Grid> {
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(Error::parameter(
                "time step of the model",
                Unit::SECOND.format(spacing),
                "finite and greater than 0",
                "Give the grid such a spacing.",
            ));
        }
        let points = |time: f64| ((time - self.start) / spacing + GRID_TOLERANCE).floor();
        let (done, all) = (points(self.begin), points(self.end));
        if all - done > self.most_points as f64 || all > (1_u64 << 53) as f64 {
            let asked = format!("{:e} time steps of {}", all - done, Unit::SECOND.format(spacing));
            return Err(Error::too_much_work(self.model, self.begin, asked));
        }
        Ok(Grid {
            start: self.start,
            spacing,
            done: done as u64,
            all: all as u64,
            begin: self.begin,
            end: self.end,
        })
    }

    /// Tells of an event at `time` \[s\] that has just been handled. If it is true, the importer wants to have the step ended
    /// there: return at once. The rest of the step is done by a step of its own.
    ///
    /// # Panics
    /// The component does not say that it has events (`const EVENTS: bool = true;`), or the time is not in the step.
    #[must_use = "the step must end at the event if this is true: `if step.stop_at_event(time) { return Ok(()); }`"]
    pub fn stop_at_event(&mut self, time: f64) -> bool {
        assert!(
            self.events != Events::None,
            "an event of a component that has none: write `const EVENTS: bool = true;` in its `impl CoSimulation`"
        );
        assert!(
            time >= self.begin && time <= self.end,
            "an event at {time} s is not in the step from {} s to {} s",
            self.begin,
            self.end
        );
        // A grid finer than the resolution of time has points that are no later than the beginning: no step ends there.
        let stops = self.events == Events::Stop && time > self.begin;
        if stops {
            self.event = Some(time);
        }
        stops
    }

    /// Where the step was ended at an event \[s\].
    pub(crate) fn event(&self) -> Option<f64> {
        self.event
    }
}

/// Times on a fixed grid: see [`Step::grid`].
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    start: f64,
    spacing: f64,
    done: u64,
    all: u64,
    begin: f64,
    end: f64,
}

impl Iterator for Grid {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        if self.done >= self.all {
            return None;
        }
        self.done += 1;
        // Never a running sum: rounding does not grow. A point within the tolerance of a communication point is that point.
        let time = self.start + self.done as f64 * self.spacing;
        Some(time.clamp(self.begin, self.end))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(begin: f64, end: f64) -> Step {
        Step::new([0.5, begin, end], "test", 1000, Events::Stop)
    }

    #[test]
    fn points_are_the_same_however_time_is_divided() {
        let whole: Vec<f64> = step(0.5, 1.5).grid(1e-2).unwrap().collect();
        assert_eq!(whole.len(), 100);
        for parts in [3, 7, 100, 333] {
            let (mut time, mut points) = (0.5, Vec::new());
            for part in 1..=parts {
                let end = 0.5 + f64::from(part) / f64::from(parts);
                points.extend(step(time, end).grid(1e-2).unwrap());
                time = end;
            }
            assert_eq!(points.len(), 100, "{parts} parts");
            let worst = whole.iter().zip(&points).map(|(one, other)| (one - other).abs());
            assert!(worst.fold(0.0, f64::max) < 1e-8);
        }
    }

    #[test]
    fn too_many_points_are_refused_with_their_number() {
        let message = step(0.5, 100.5).grid(1e-2).unwrap_err().to_string();
        assert!(message.contains("1e4 time steps of 0.01 s"), "{message}");
        assert!(step(0.5, 1.0).grid(0.0).is_err() && step(0.5, 1.0).grid(f64::NAN).is_err());
    }

    #[test]
    #[should_panic(expected = "const EVENTS: bool = true;")]
    fn an_event_that_was_not_announced_is_a_defect() {
        let mut step = Step::new([0.0, 0.0, 1.0], "test", 10, Events::None);
        let _ = step.stop_at_event(0.5);
    }
}
