//! The packing of hard disks on a sine, over a moving bottom or one of random phase, as a parameter chooses.

use serde::{Deserialize, Serialize};

use crate::drive::{AtRandomPhase, Motion, Sine};
use crate::engine::event_driven::{Counts, EventDrivenState, EventDrivenStop, Moving, Walls};
use crate::engine::{DiskMotion, WorkBudget};
use crate::geometry::Disk;
use crate::scene::{Result, Row, Values};

use super::hard::{HardDisks, HardEngine};

/// Value of `base.model` for the fixed bottom with a random phase (P 2.3.3); the other is the moving bottom.
const RANDOM_PHASE: i64 = 1;

fn base_model<M>() -> Row<M> {
    const OPTIONS: &[(&str, &str)] = &[
        (
            "random_phase",
            "Fixed bottom that lends each impact the velocity of a base of random phase",
        ),
        ("moving", "Bottom that moves"),
    ];
    Row::enumeration_parameter(
        "base.model",
        "base_model",
        OPTIONS,
        2,
        "What the bottom of the box does",
    )
}

/// Sine base in either model, as the parameter `base.model` says.
#[derive(Debug)]
pub enum EitherBase {
    /// Fixed bottom, random phase (P 2.3.3).
    RandomPhase(Box<HardDisks<AtRandomPhase>>),
    /// The bottom moves.
    Moving(Box<HardDisks<Moving<Sine>>>),
}

/// State of [`EitherBase`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum EitherState {
    /// Of the random phase.
    RandomPhase(EventDrivenState<Walls<AtRandomPhase>>),
    /// Of the moving bottom.
    Moving(EventDrivenState<Walls<Moving<Sine>>>),
}

macro_rules! either {
    ($of:expr, $run:ident => $what:expr) => {
        match $of {
            EitherBase::RandomPhase($run) => $what,
            EitherBase::Moving($run) => $what,
        }
    };
}

impl HardEngine for EitherBase {
    type State = EitherState;
    type Drive = Sine;

    fn parameters<M>() -> Vec<Row<M>> {
        let mut rows = <HardDisks<AtRandomPhase> as HardEngine>::parameters();
        rows.push(base_model());
        rows
    }

    fn new(disks: &[Disk], masses: &[f64], start_time: f64, values: &Values) -> Result<Self> {
        Ok(if values.integer("base.model") == RANDOM_PHASE {
            Self::RandomPhase(Box::new(HardEngine::new(disks, masses, start_time, values)?))
        } else {
            Self::Moving(Box::new(HardEngine::new(disks, masses, start_time, values)?))
        })
    }

    fn set_target(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn advance_to(&mut self, end_time: f64, budget: &mut WorkBudget) -> std::result::Result<(), EventDrivenStop> {
        either!(self, run => HardEngine::advance_to(&mut **run, end_time, budget))
    }

    fn disk_at(&self, time: f64, disk: usize) -> DiskMotion {
        either!(self, run => run.disk_at(time, disk))
    }

    fn counts(&self) -> Counts {
        either!(self, run => HardEngine::counts(&**run))
    }

    fn base_at(&self, time: f64) -> Motion {
        either!(self, run => run.base_at(time))
    }

    fn state(&self) -> Self::State {
        match self {
            Self::RandomPhase(run) => EitherState::RandomPhase(HardEngine::state(&**run)),
            Self::Moving(run) => EitherState::Moving(HardEngine::state(&**run)),
        }
    }

    fn fits(&self, state: &Self::State) -> bool {
        match (self, state) {
            (Self::RandomPhase(run), EitherState::RandomPhase(state)) => run.fits(state),
            (Self::Moving(run), EitherState::Moving(state)) => run.fits(state),
            _ => false,
        }
    }

    fn restore(&mut self, state: &Self::State) {
        match (self, state) {
            (Self::RandomPhase(run), EitherState::RandomPhase(state)) => run.restore(state),
            (Self::Moving(run), EitherState::Moving(state)) => run.restore(state),
            _ => {}
        }
    }
}
