//! Steps of an instance: as a whole, to the first event, or from event to event with a report to the importer at each. For an
//! importer that offers inputs inside of a step, the places where it is asked for them stand for the events.
//!
//! Guarantees: a refused step leaves time, values and state as before, even if events inside of it were reported already.

use super::{Instance, Snapshot};
use crate::dynamic::DynSimulation;
use crate::error::{Error, Result};
use crate::life_cycle::{Call, Phase};
use crate::model::Reached;
use crate::times::{check_time, is_simulated};
use crate::unit::Unit;

/// Importers add up communication points in their own way; as much of a step may differ from ours.
const POINT_TOLERANCE_OF_STEP: f64 = 1e-6;
/// As many units in the last place of the time may differ besides.
const POINT_TOLERANCE_OF_TIME: f64 = 64.0 * f64::EPSILON;

/// How far a step got that goes from event to event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Part {
    /// To an event, or to where inputs may be renewed, at this time \[s\], before the end of the step. [`Instance::resume_step`] does the rest.
    Event(f64),
    /// To its end, or to where the importer wanted to have it ended.
    Done(Reached),
}

/// A step that is not done yet.
pub(super) struct UnderWay {
    /// All as it was before the step, in case that the rest is refused.
    before: Snapshot,
    /// Where it began \[s\].
    begin: f64,
    /// Where the importer asked it to end \[s\].
    asked: f64,
    /// Where it is to end \[s\]: there, or before by an early return.
    end: f64,
    /// Parts done, if inputs are offered inside.
    parts: u32,
}

impl Instance {
    /// Advances from `current` \[s\] by `step` \[s\], or to the first event in between if the importer handles events in
    /// event mode and lets a step end early. Otherwise events are handled on the way.
    ///
    /// # Errors
    /// [`Error::Step`] if the model cannot do it; anything else if the arguments are wrong. Time, values and state are
    /// then as before, and the importer may try again.
    pub fn do_step(&mut self, current: f64, step: f64) -> Result<Reached> {
        Call::DoStep.check(self.phase)?;
        let end = self.end_of_step(current, step)?;
        if self.importer.stops_at_events() {
            return self.simulation.advance_to_event(end);
        }
        self.simulation.advance_to(end)?;
        Ok(Reached {
            time: end,
            event: false,
        })
    }

    /// Begins a step from `current` \[s\] by `step` \[s\] that stops at every event inside of it, to be resumed from there.
    ///
    /// # Errors
    /// As [`Instance::do_step`].
    pub fn begin_step(&mut self, current: f64, step: f64) -> Result<Part> {
        Call::DoStep.check(self.phase)?;
        let end = self.end_of_step(current, step)?;
        let step = UnderWay {
            before: self.save()?,
            begin: self.time(),
            asked: end,
            end,
            parts: 0,
        };
        self.advance_part(step, |simulation, end| simulation.advance_to_event(end))
    }

    /// Does the next part of a step, or goes to an event before its end, by `advance`.
    fn advance_part(
        &mut self,
        mut step: UnderWay,
        advance: impl FnOnce(&mut dyn DynSimulation, f64) -> Result<Reached>,
    ) -> Result<Part> {
        let end = self.end_of_part(&step);
        let reached = advance(&mut *self.simulation, end);
        step.parts += u32::from(reached.as_ref().is_ok_and(|reached| reached.time == end));
        self.end_part(step, reached)
    }

    /// Where the next part of a step ends \[s\].
    fn end_of_part(&self, step: &UnderWay) -> f64 {
        let done = step.parts + 1;
        if done >= self.input_parts {
            return step.end;
        }
        let share = f64::from(done) / f64::from(self.input_parts);
        step.end
            .min(step.begin + share * (step.asked - step.begin))
            .max(self.time().next_up())
    }

    /// Resumes a step after a [`Part::Event`]. The step ends at `early_return` \[s\] if that is given, or at once if it is past or not
    /// finite. Of several such times the first counts; one beyond the end changes nothing.
    ///
    /// # Errors
    /// No step is under way, or the model refuses the rest: all is then as before the step.
    pub fn resume_step(&mut self, early_return: Option<f64>) -> Result<Part> {
        let under_way = self.under_way.take();
        Call::Resume.check(self.phase)?;
        let Some(mut step) = under_way else {
            return Err(Error::call("no step is under way", "Reset the instance."));
        };
        let now = self.time();
        if let Some(time) = early_return {
            let wanted = if time.is_finite() { time.max(now) } else { now };
            step.end = step.end.min(wanted);
        }
        if step.end > now {
            return self.advance_part(step, |simulation, end| simulation.resume_to_event(end));
        }
        let reached = Reached {
            time: now,
            event: false,
        };
        self.end_part(step, Ok(reached))
    }

    /// Whether a step is under way of which an event is reported: anything but reading, and setting inputs that are
    /// offered, would change the state that the step resumes from.
    pub fn is_stepping(&self) -> bool {
        self.under_way.is_some()
    }

    /// Refuses all that is more than reading while a step is under way.
    ///
    /// # Errors
    /// A step is under way.
    pub fn check_change(&self) -> Result<()> {
        match self.under_way {
            Some(_) => Call::Change.check(Phase::IntermediateUpdate),
            None => Ok(()),
        }
    }

    /// From now on the importer is asked for inputs inside of steps that [`Instance::begin_step`] begins.
    pub fn offer_inputs(&mut self, parts: u32) {
        self.input_parts = parts;
    }

    /// Whether inputs may be set now, as far as steps are concerned.
    ///
    /// # Errors
    /// A step is under way inside of which no inputs are asked for.
    pub fn check_setting(&self) -> Result<()> {
        match self.input_parts {
            0 => self.check_change(),
            _ => Ok(()),
        }
    }

    /// What is left of a step of which a part was done. An event at the end of the step does not make it another step.
    fn end_part(&mut self, step: UnderWay, reached: Result<Reached>) -> Result<Part> {
        match reached {
            Ok(Reached { time, .. }) if time < step.end => {
                self.phase = Phase::IntermediateUpdate;
                self.under_way = Some(step);
                Ok(Part::Event(time))
            }
            Ok(Reached { time, .. }) => {
                self.phase = Phase::Step;
                Ok(Part::Done(Reached { time, event: false }))
            }
            Err(refused) => {
                self.go_to(&step.before).inspect_err(|_| self.fail())?;
                Err(refused)
            }
        }
    }

    /// The importer's own sum, so that its next communication point is ours bit for bit.
    #[inline]
    fn end_of_step(&self, current: f64, step: f64) -> Result<f64> {
        let now = self.time();
        let tolerance = tolerance(step, now);
        let end = current + step;
        let late = |stop: f64| end > stop + tolerance + POINT_TOLERANCE_OF_TIME * stop.abs();
        let fits = step.is_finite() && step > 0.0 && (current - now).abs() <= tolerance && is_simulated(end);
        match fits && end > now && !self.stop.is_some_and(late) {
            true => Ok(end),
            false => Err(self.no_step(current, step)),
        }
    }

    /// Why there is no step from `current` \[s\] by `step` \[s\].
    #[cold]
    fn no_step(&self, current: f64, step: f64) -> Error {
        let (now, end) = (self.time(), current + step);
        let tolerance = tolerance(step, now);
        let [now_text, step_text] = [now, step].map(|time| Unit::SECOND.format(time));
        if !(step.is_finite() && step > 0.0) {
            return Error::parameter(
                "communication step size",
                step_text,
                "finite and greater than 0",
                "Both standards ask for steps forward in time; read outputs without a step.",
            );
        }
        let fits = (current - now).abs() <= tolerance;
        if !fits {
            return Error::parameter(
                "current communication point",
                Unit::SECOND.format(current),
                format!("{now_text} within {tolerance:e} s, where the last step ended"),
                "Steps join without gaps; restore a saved state to go back.",
            );
        }
        if let Err(error) = check_time("end of the step", end) {
            return error;
        }
        if end <= now {
            return Error::parameter(
                "communication step size",
                step_text,
                format!("large enough to move the time {now_text} in double precision"),
                "Take larger steps or start nearer to time zero.",
            );
        }
        let stop = Unit::SECOND.format(self.stop.unwrap_or(f64::INFINITY));
        Error::parameter(
            "end of the step",
            Unit::SECOND.format(end),
            format!("not after the stop time {stop} given at set-up"),
            "Shorten the step or leave the stop time undefined.",
        )
    }
}

/// How far a communication point may be from ours \[s\].
fn tolerance(step: f64, now: f64) -> f64 {
    POINT_TOLERANCE_OF_STEP * step + POINT_TOLERANCE_OF_TIME * now.abs()
}
