//! Engines of the packing with hard disks: laws, base and walls from the same parameters as the soft ones (P 2.3, 3.3).

use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::collision::{ContactTime, Dashpot, TabulatedDashpot, effective_mass};
use crate::drive::{Motion, RandomPhase, Sine};
use crate::engine::WorkBudget;
use crate::engine::event_driven::{
    AtRandomPhase, Counts, EventDriven, Gravity, Moving, Open, Settings, State, Stop, Unobserved, Walls,
};
use crate::error::{Error, Result};
use crate::geometry::{Disk, Wall};
use crate::scene::base_drive::BaseDrive;
use crate::scene::hard_disks::HardBase;
use crate::scene::{Unit, Values, Variable};

/// Law of the packing: stick and slip of the soft contact from a table, without loss in impacts that follow at once.
pub type Law = ContactTime<TabulatedDashpot>;

/// Engine of the packing over a base W.
pub type HardDisks<W> = EventDriven<Law, Walls<W>, Gravity, Open>;

/// Gap of neighbours at the start over the sum of their radii: hard disks that touch have no next impact.
pub const START_GAP: f64 = 1e-3;

/// Height of the cells over the width of the box; disks above belong to the topmost.
const REGION_HEIGHT: f64 = 3.0;

/// How a scene runs hard disks: one engine, or one of two that a parameter chooses. Chosen outside the inner loop.
pub trait HardRun: Sized + Send + 'static {
    /// State of the engine.
    type State: Clone + PartialEq + Serialize + DeserializeOwned + Send;
    /// Drive, which brings variables.
    type Base: BaseDrive;

    /// Further parameters.
    fn variables() -> Vec<Variable>;
    /// Disks at rest at `start_time` \[s\].
    ///
    /// # Errors
    /// Parameters that no law is made of.
    fn new(disks: &[Disk], masses: &[f64], start_time: f64, values: &Values) -> Result<Self>;
    /// Takes the inputs at `time` \[s\] for a step of `duration` \[s\].
    fn aim(&mut self, time: f64, duration: f64, values: &Values);
    /// Handles all events up to `end_time` \[s\].
    ///
    /// # Errors
    /// No headway, or too many events.
    fn advance_to(&mut self, end_time: f64, work: &mut WorkBudget) -> std::result::Result<(), Stop>;
    /// Place, velocity, angle and angular velocity of a disk at `time` \[s\].
    fn seen(&self, disk: usize, time: f64) -> ([f64; 2], [f64; 2], f64, f64);
    /// Sums since the start.
    fn counts(&self) -> Counts;
    /// Motion of the base at `time` \[s\].
    fn base(&self, time: f64) -> Motion;
    /// A copy of the state.
    fn state(&self) -> Self::State;
    /// Whether `state` can be one of this run.
    fn fits(&self, state: &Self::State) -> bool;
    /// Goes to a state.
    fn restore(&mut self, state: &Self::State);
}

impl HardBase for AtRandomPhase {
    type Drive = Sine;

    fn from_values(start_time: f64, values: &Values) -> Result<Self> {
        let sine = <Sine as BaseDrive>::new(start_time, values)?;
        let peak_velocity = sine.amplitude * std::f64::consts::TAU * sine.frequency;
        // Another stream than that of the radii, which has the seed itself.
        let generator = Pcg64::seed_from_u64((values.integer("seed") as u64) ^ 0x9e37_79b9_7f4a_7c15);
        Ok(Self {
            phase: RandomPhase { peak_velocity },
            generator,
        })
    }

    fn aim(&mut self, _time: f64, _duration: f64, _values: &Values) -> bool {
        false
    }
}

impl<W: HardBase> HardRun for HardDisks<W> {
    type State = State<Walls<W>>;
    type Base = W::Drive;

    fn variables() -> Vec<Variable> {
        vec![Variable::parameter(
            "collision.contact_time",
            Unit::Second,
            0.0..=1.0,
            1e-6,
            "Impacts of a disk that follow its last one within this time lose nothing along the normal",
        )]
    }

    fn new(disks: &[Disk], masses: &[f64], start_time: f64, values: &Values) -> Result<Self> {
        let kappa = values.real("contact.stiffness_ratio");
        if kappa > STIFFEST_SKIN {
            return Err(Error::parameter(
                "contact.stiffness_ratio",
                kappa,
                format!(
                    "at most {STIFFEST_SKIN:e} with the engine event-driven, which follows each of its oscillations"
                ),
                "Take a softer skin, or the engine molecular-dynamics.",
            ));
        }
        let law = Dashpot::new(
            values.real("contact.normal_stiffness"),
            values.real("contact.normal_damping"),
            kappa,
            values.real("contact.friction"),
        )?;
        let mut inverse: Vec<f64> = masses.iter().map(|mass| 1.0 / mass).collect();
        inverse.sort_by(f64::total_cmp);
        inverse.dedup();
        let lightest = inverse.last().map_or(1.0, |most| effective_mass(*most, *most));
        let ratio = law.damping_ratio(lightest);
        if ratio > STRONGEST_DAMPING {
            let damping = values.real("contact.normal_damping");
            let most = damping * STRONGEST_DAMPING / ratio;
            return Err(Error::parameter(
                "contact.normal_damping",
                format!("{damping:e} kg/s"),
                format!("at most {most:e} kg/s for these masses with the engine event-driven, a damping ratio of 10"),
                "Damp less, or take heavier disks or the engine molecular-dynamics.",
            ));
        }
        // Beyond a few classes the tables would cost more than they save, and impacts are stitched one by one.
        let classes: Vec<f64> = if inverse.len() <= MOST_CLASSES {
            let with_others = inverse
                .iter()
                .flat_map(|one| inverse.iter().map(|two| effective_mass(*one, *two)));
            with_others
                .chain(inverse.iter().map(|one| effective_mass(*one, 0.0)))
                .collect()
        } else {
            Vec::new()
        };
        let table = TabulatedDashpot::new(law, &classes, 0.5);
        let law = ContactTime::new(table, values.real("collision.contact_time"))?;
        let base = W::from_values(start_time, values)?;
        let lift = base.motion(start_time).displacement;
        let disks: Vec<Disk> = disks.iter().map(|disk| disk.raised(lift)).collect();
        let width = values.real("box.width");
        let walls = vec![
            Wall::vibrating_floor(),
            Wall::left(-0.5 * width),
            Wall::right(0.5 * width),
        ];
        let boundary = Walls {
            walls,
            base,
            origin: start_time,
        };
        let space = Open {
            corner: [-0.5 * width, 0.0],
            size: [width, REGION_HEIGHT * width],
        };
        let settings = Settings {
            start_time,
            ..Settings::default()
        };
        let gravity = Gravity(values.real("gravity"));
        Ok(Self::new(
            (law, boundary, gravity, space),
            &disks,
            masses,
            &vec![[0.0; 3]; disks.len()],
            settings,
        ))
    }

    fn aim(&mut self, time: f64, duration: f64, values: &Values) {
        let mut base = self.state().boundary.base.clone();
        if base.aim(time, duration, values) {
            self.change_boundary(time, |boundary| boundary.base = base);
        }
    }

    fn advance_to(&mut self, end_time: f64, work: &mut WorkBudget) -> std::result::Result<(), Stop> {
        self.advance_within(end_time, &mut Unobserved, work)
    }

    fn seen(&self, disk: usize, time: f64) -> ([f64; 2], [f64; 2], f64, f64) {
        Self::seen(self, disk, time)
    }

    fn counts(&self) -> Counts {
        self.state().counts
    }

    fn base(&self, time: f64) -> Motion {
        self.state().boundary.base.motion(time)
    }

    fn state(&self) -> Self::State {
        Self::state(self).clone()
    }

    fn fits(&self, state: &Self::State) -> bool {
        Self::fits(self, state)
    }

    fn restore(&mut self, state: &Self::State) {
        Self::restore(self, state);
    }
}

/// Largest ratio of stiffnesses: an impact has some sqrt(3 kappa) phases of stick and slip.
const STIFFEST_SKIN: f64 = 1e4;

/// Largest damping ratio c: beyond, disks leave an impact at less than 0.003 of their velocity.
const STRONGEST_DAMPING: f64 = 10.0;

/// Different masses up to which impacts are tabulated.
const MOST_CLASSES: usize = 8;

/// Sine base in either model, as the parameter `base.model` says.
#[derive(Debug)]
pub enum EitherModel {
    /// Fixed bottom, random phase (P 2.3.3).
    RandomPhase(Box<HardDisks<AtRandomPhase>>),
    /// The bottom moves.
    Moving(Box<HardDisks<Moving<Sine>>>),
}

/// State of [`EitherModel`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum EitherState {
    /// Of the random phase.
    RandomPhase(State<Walls<AtRandomPhase>>),
    /// Of the moving bottom.
    Moving(State<Walls<Moving<Sine>>>),
}

macro_rules! either {
    ($of:expr, $run:ident => $what:expr) => {
        match $of {
            EitherModel::RandomPhase($run) => $what,
            EitherModel::Moving($run) => $what,
        }
    };
}

impl HardRun for EitherModel {
    type State = EitherState;
    type Base = Sine;

    fn variables() -> Vec<Variable> {
        let mut rows = <HardDisks<AtRandomPhase> as HardRun>::variables();
        rows.push(super::rows::base_model());
        rows
    }

    fn new(disks: &[Disk], masses: &[f64], start_time: f64, values: &Values) -> Result<Self> {
        Ok(if values.integer("base.model") == super::rows::RANDOM_PHASE {
            Self::RandomPhase(Box::new(HardRun::new(disks, masses, start_time, values)?))
        } else {
            Self::Moving(Box::new(HardRun::new(disks, masses, start_time, values)?))
        })
    }

    fn aim(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn advance_to(&mut self, end_time: f64, work: &mut WorkBudget) -> std::result::Result<(), Stop> {
        either!(self, run => HardRun::advance_to(&mut **run, end_time, work))
    }

    fn seen(&self, disk: usize, time: f64) -> ([f64; 2], [f64; 2], f64, f64) {
        either!(self, run => run.seen(disk, time))
    }

    fn counts(&self) -> Counts {
        either!(self, run => HardRun::counts(&**run))
    }

    fn base(&self, time: f64) -> Motion {
        either!(self, run => run.base(time))
    }

    fn state(&self) -> Self::State {
        match self {
            Self::RandomPhase(run) => EitherState::RandomPhase(HardRun::state(&**run)),
            Self::Moving(run) => EitherState::Moving(HardRun::state(&**run)),
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
