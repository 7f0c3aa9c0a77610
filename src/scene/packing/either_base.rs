//! The packing of hard disks on a sine, over a moving bottom or one of random phase, as a parameter chooses.

use serde::{Deserialize, Serialize};

use crate::drive::{AtRandomPhase, BaseProfile, DrawCounts, Motion, Sine};
use crate::engine::event_driven::{Counts, EventDrivenState, EventDrivenStop, Moving, Walls};
use crate::engine::{DiskMotion, Engine, WorkBudget};
use crate::geometry::Disk;
use crate::scene::{Error, Result, Row, Unit, Values, random_phase_base};

use super::hard::{HardDisks, HardEngine};
use super::hard_law::HardLaw;
use super::initial_packing;

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

fn stays_in_place(values: &Values) -> bool {
    values.integer("base.model") == RANDOM_PHASE
}

/// Refuses a profile that would change nothing.
fn check_profile_of_moving_base(values: &Values) -> Result<()> {
    match random_phase_base::profile(values) {
        BaseProfile::Sine => Ok(()),
        BaseProfile::Sawtooth => Err(Error::parameter(
            random_phase_base::PROFILE,
            "sawtooth",
            "sine with base.model moving, whose bottom has the velocity of its own motion",
            "Set base.model random_phase, or leave base.profile sine.",
        )),
    }
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

impl EitherBase {
    /// Velocities that the base has drawn; none if it moves.
    fn draw_counts(&self) -> DrawCounts {
        match self {
            Self::RandomPhase(run) => run.state().boundary.base.counts,
            Self::Moving(_) => DrawCounts::default(),
        }
    }
}

macro_rules! either {
    ($of:expr, $run:ident => $what:expr) => {
        match $of {
            EitherBase::RandomPhase($run) => $what,
            EitherBase::Moving($run) => $what,
        }
    };
}

impl Engine for EitherBase {
    type State = EitherState;
    type Stop = EventDrivenStop;

    fn advance_within(&mut self, end_time: f64, budget: &mut WorkBudget) -> std::result::Result<(), EventDrivenStop> {
        either!(self, run => run.advance_within(end_time, budget))
    }

    fn copied_state(&self) -> EitherState {
        match self {
            Self::RandomPhase(run) => EitherState::RandomPhase(run.copied_state()),
            Self::Moving(run) => EitherState::Moving(run.copied_state()),
        }
    }

    fn copy_state_to(&self, state: &mut EitherState) {
        match (self, state) {
            (Self::RandomPhase(run), EitherState::RandomPhase(state)) => run.copy_state_to(state),
            (Self::Moving(run), EitherState::Moving(state)) => run.copy_state_to(state),
            (_, state) => *state = self.copied_state(),
        }
    }

    fn fits(&self, state: &EitherState, time: f64) -> bool {
        match (self, state) {
            (Self::RandomPhase(run), EitherState::RandomPhase(state)) => run.fits(state, time),
            (Self::Moving(run), EitherState::Moving(state)) => run.fits(state, time),
            _ => false,
        }
    }

    /// Never fails.
    fn restore(&mut self, state: &EitherState, time: f64) -> std::result::Result<(), EventDrivenStop> {
        match (self, state) {
            (Self::RandomPhase(run), EitherState::RandomPhase(state)) => run.restore(state, time),
            (Self::Moving(run), EitherState::Moving(state)) => run.restore(state, time),
            _ => Ok(()),
        }
    }
}

impl HardEngine for EitherBase {
    type Drive = Sine;

    fn parameters<M>() -> Vec<Row<M>> {
        let mut rows = <HardDisks<AtRandomPhase> as HardEngine>::parameters();
        rows.extend([base_model(), random_phase_base::profile_parameter()]);
        rows
    }

    fn own_outputs<M: AsRef<Self>>() -> Vec<Row<M>> {
        let [draws, rejected] = random_phase_base::DRAW_COUNTS;
        let count = |(name, description): (&str, &str), read: fn(&M) -> f64| {
            Row::output(name, Unit::ONE, 1e4, description, read)
        };
        vec![
            count(draws, |packing| packing.as_ref().draw_counts().draws as f64),
            count(rejected, |packing| packing.as_ref().draw_counts().rejected as f64),
        ]
    }

    fn from_values(disks: &[Disk], masses: &[f64], start_time: f64, values: &Values) -> Result<Self> {
        Ok(if stays_in_place(values) {
            initial_packing::check_walls_of_random_phase(values)?;
            Self::RandomPhase(Box::new(HardEngine::from_values(disks, masses, start_time, values)?))
        } else {
            check_profile_of_moving_base(values)?;
            Self::Moving(Box::new(HardEngine::from_values(disks, masses, start_time, values)?))
        })
    }

    fn draws(values: &Values) -> bool {
        stays_in_place(values) && random_phase_base::profile(values) == BaseProfile::Sine
    }

    fn work_done(&self) -> u64 {
        either!(self, run => HardEngine::work_done(&**run))
    }

    fn set_law(&mut self, law: HardLaw) {
        either!(self, run => HardEngine::set_law(&mut **run, law));
    }

    fn set_gravity(&mut self, time: f64, gravity: f64) {
        either!(self, run => HardEngine::set_gravity(&mut **run, time, gravity));
    }

    fn set_target(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn disk_at(&self, time: f64, disk: usize) -> DiskMotion {
        either!(self, run => run.disk_at(time, disk))
    }

    fn counts(&self) -> Counts {
        either!(self, run => HardEngine::counts(&**run))
    }

    fn base_at(&self, time: f64) -> Motion {
        either!(self, run => run.base_at(time))
    }
}
