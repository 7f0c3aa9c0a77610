//! Steps of an instance: as a whole, to the first event, or from event to event with a word to the importer at each.
//!
//! Guarantees: a refused step leaves time, values and state as before, even if events inside of it were told already.

use super::Instance;
use crate::error::{Error, Result};
use crate::fmi::life_cycle::{Call, Phase};
use crate::fmi::snapshot::Snapshot;
use crate::scene::times::check_time;
use crate::scene::{Reached, Scene};

/// Importers add up communication points in their own way; as much of a step may differ from ours.
const POINT_TOLERANCE_OF_STEP: f64 = 1e-6;
/// As many units in the last place of the time may differ besides.
const POINT_TOLERANCE_OF_TIME: f64 = 64.0 * f64::EPSILON;

/// How far a step got that goes from event to event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Part {
    /// To an event at this time \[s\], before the end of the step. [`Instance::go_on`] does the rest.
    Event(f64),
    /// To its end, or to where the importer wanted to have it ended.
    Done(Reached),
}

/// How far a scene is to go at once.
#[derive(Clone, Copy)]
enum Way {
    ToEnd,
    ToEvent,
    /// On from an event inside of the step.
    OnToEvent,
}

/// A step that is not done yet.
pub(super) struct UnderWay<State> {
    /// All as it was before the step, in case that the rest is refused.
    before: Snapshot<State>,
    /// Where it is to end \[s\].
    end: f64,
}

impl<S: Scene> Instance<S> {
    /// Advances from `current` \[s\] by `step` \[s\], or to the first event in between if the importer handles events in
    /// event mode and lets a step end early. Otherwise events are done with on the way.
    ///
    /// # Errors
    /// [`Error::Step`] if the scene cannot do it; anything else if the arguments are wrong. Time, values and state are
    /// then as before, and the importer may try again.
    pub fn do_step(&mut self, current: f64, step: f64) -> Result<Reached> {
        Call::DoStep.check(self.phase)?;
        let end = self.end_of_step(current, step)?;
        let stops = S::EVENTS && self.importer.stops_at_events();
        self.advance(end, if stops { Way::ToEvent } else { Way::ToEnd })
    }

    /// Begins a step from `current` \[s\] by `step` \[s\] that stops at every event inside of it, to go on from there.
    ///
    /// # Errors
    /// As [`Instance::do_step`].
    pub fn begin_step(&mut self, current: f64, step: f64) -> Result<Part> {
        Call::DoStep.check(self.phase)?;
        let end = self.end_of_step(current, step)?;
        let before = self.save()?;
        self.advance_part(UnderWay { before, end }, Way::ToEvent)
    }

    /// Goes on after an event. The step ends at `early_return` \[s\] if that is given, or at once if it is past or not
    /// finite. Of several such times the first counts; one beyond the end changes nothing.
    ///
    /// # Errors
    /// No step is under way, or the scene refuses the rest: all is then as before the step.
    pub fn go_on(&mut self, early_return: Option<f64>) -> Result<Part> {
        let under_way = self.under_way.take();
        Call::GoOn.check(self.phase)?;
        let Some(mut step) = under_way else {
            return Err(Error::call("no step is under way", "Reset the instance."));
        };
        let now = self.clock.now;
        if let Some(time) = early_return {
            let wanted = if time.is_finite() { time.max(now) } else { now };
            step.end = step.end.min(wanted);
        }
        if step.end > now {
            return self.advance_part(step, Way::OnToEvent);
        }
        self.phase = Phase::Step;
        Ok(Part::Done(Reached {
            time: now,
            event: false,
        }))
    }

    /// Whether a step is under way that the importer is told of: anything but reading would pull the ground from under it.
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

    /// To the next event, or to the end of the step, which an event there does not make another one.
    fn advance_part(&mut self, step: UnderWay<S::State>, way: Way) -> Result<Part> {
        match self.advance(step.end, way) {
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
                self.bring_back(&step.before).inspect_err(|_| self.fail())?;
                Err(refused)
            }
        }
    }

    fn advance(&mut self, end: f64, way: Way) -> Result<Reached> {
        let Some(scene) = &mut self.scene else {
            return Err(Error::call("the scene was never initialised", "Reset the instance."));
        };
        let reached = match way {
            Way::ToEvent => scene.advance_to_event(end, &self.values)?,
            Way::OnToEvent => scene.go_on_to_event(end, &self.values)?,
            Way::ToEnd => {
                scene.advance_to(end, &self.values)?;
                Reached {
                    time: end,
                    event: false,
                }
            }
        };
        let legal = reached.time == end || reached.event && reached.time > self.clock.now && reached.time < end;
        assert!(legal, "the scene went to {reached:?} where {end} s was asked");
        scene.write_outputs(self.values.writer());
        self.clock.now = reached.time;
        Ok(reached)
    }

    /// The importer's own sum, so that its next communication point is ours bit for bit.
    fn end_of_step(&self, current: f64, step: f64) -> Result<f64> {
        let now = self.clock.now;
        if !(step.is_finite() && step > 0.0) {
            return Err(Error::parameter(
                "communication step size",
                format!("{step} s"),
                "finite and greater than 0",
                "Both standards ask for steps forward in time; read outputs without a step.",
            ));
        }
        let tolerance = POINT_TOLERANCE_OF_STEP * step + POINT_TOLERANCE_OF_TIME * now.abs();
        let fits = (current - now).abs() <= tolerance;
        if !fits {
            return Err(Error::parameter(
                "current communication point",
                format!("{current} s"),
                format!("{now} s within {tolerance:e} s, where the last step ended"),
                "Steps join without gaps; restore a saved state to go back.",
            ));
        }
        let end = current + step;
        check_time("end of the step", end)?;
        if end <= now {
            return Err(Error::parameter(
                "communication step size",
                format!("{step} s"),
                format!("large enough to move the time {now} s in double precision"),
                "Take larger steps or start nearer to time zero.",
            ));
        }
        match self.clock.stop {
            Some(stop) if end > stop + tolerance + POINT_TOLERANCE_OF_TIME * stop.abs() => Err(Error::parameter(
                "end of the step",
                format!("{end} s"),
                format!("not after the stop time {stop} s given at set-up"),
                "Shorten the step or leave the stop time undefined.",
            )),
            _ => Ok(end),
        }
    }
}
