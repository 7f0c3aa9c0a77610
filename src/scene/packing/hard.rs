//! Engines of the packing with hard disks: laws, base and walls from the same parameters as the soft ones (P 2.3, 3.3).

use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use crate::drive::{AtRandomPhase, Motion, RandomPhase, Sine};
use crate::engine::event_driven::{
    Counts, EventDriven, EventDrivenStop, Model, Open, Region, Settings, Unobserved, Walls,
};
use crate::engine::{DiskMotion, Engine};
use crate::geometry::{Disk, Vector2};
use crate::scene::base_drive::BaseDrive;
use crate::scene::hard_disks::HardBase;
use crate::scene::{Result, Row, Unit, Values, Warning, random_phase_base};

use super::hard_law::{HardLaw, hard_law};
use super::{initial_packing, settled};

/// Engine of the packing over a base W.
pub type HardDisks<W> = EventDriven<HardLaw, Walls<W>, Open>;

/// Height of the cells over the width of the box; disks above belong to the topmost.
const REGION_HEIGHT: f64 = 3.0;

/// How a scene runs hard disks: one engine, or one of two that a parameter chooses. Chosen outside the inner loop.
pub trait HardEngine: Engine<Stop = EventDrivenStop> {
    /// Drive, which brings variables.
    type Drive: BaseDrive;

    /// Further parameters.
    fn parameters<M>() -> Vec<Row<M>>;
    /// Further outputs.
    fn own_outputs<M: AsRef<Self>>() -> Vec<Row<M>> {
        Vec::new()
    }
    /// Disks at rest at `start_time` \[s\].
    ///
    /// # Errors
    /// Parameters that no law is made of.
    fn from_values(disks: &[Disk], masses: &[f64], start_time: f64, values: &Values) -> Result<Self>;
    /// Whether the seed decides more than the start.
    fn draws(_values: &Values) -> bool {
        false
    }
    /// Work since the start, in units of [`WorkBudget`](crate::engine::WorkBudget).
    fn work_done(&self) -> u64;
    /// Collides by another law from now on.
    fn set_law(&mut self, law: HardLaw);
    /// Changes gravity \[m/s2\] at `time` \[s\].
    fn set_gravity(&mut self, time: f64, gravity: f64);
    /// Takes the inputs at `time` \[s\] for a step of `duration` \[s\].
    fn set_target(&mut self, time: f64, duration: f64, values: &Values);
    /// What is doubtful of the inputs so far.
    fn warning(&self, _told: &[&'static str]) -> Option<Warning> {
        None
    }
    /// Motion of a disk at `time` \[s\].
    fn disk_at(&self, time: f64, disk: usize) -> DiskMotion;
    /// Sums since the start.
    fn counts(&self) -> Counts;
    /// Motion of the base at `time` \[s\].
    fn base_at(&self, time: f64) -> Motion;
}

impl HardBase for AtRandomPhase {
    type Drive = Sine;

    fn from_values(start_time: f64, values: &Values) -> Result<Self> {
        let sine = <Sine as BaseDrive>::new(start_time, values)?;
        let peak_velocity = sine.amplitude * std::f64::consts::TAU * sine.frequency;
        // Another stream than that of the radii, which has the seed itself.
        let generator = Pcg64::seed_from_u64((values.integer("seed") as u64) ^ 0x9e37_79b9_7f4a_7c15);
        Ok(Self::new(RandomPhase { peak_velocity }, generator).with_profile(random_phase_base::profile(values)))
    }

    fn set_target(&mut self, _time: f64, _duration: f64, _values: &Values) -> bool {
        false
    }
}

impl<W: HardBase> HardEngine for HardDisks<W> {
    type Drive = W::Drive;

    fn parameters<M>() -> Vec<Row<M>> {
        vec![
            Row::parameter(
                "collision.contact_time",
                Unit::SECOND,
                0.0..=1.0,
                1e-6,
                "Impacts of a disk that follow its last one within this time lose nothing along the normal",
            )
            // A flight between impacts at some mm/s over some tens of um, and a soft contact, last about 1 ms.
            .recommended(
                0.0..=1e-4,
                "impacts of free flights, some milliseconds apart, would lose nothing either.",
            ),
        ]
    }

    fn from_values(disks: &[Disk], masses: &[f64], start_time: f64, values: &Values) -> Result<Self> {
        let law = hard_law(masses, values)?;
        let base = W::from_values(start_time, values)?;
        let lift = base.motion(start_time).displacement;
        let disks: Vec<Disk> = disks.iter().map(|disk| disk.raised(lift)).collect();
        let boundary = Walls {
            walls: initial_packing::walls(values),
            base,
            origin: start_time,
        };
        let width = values.real("box.width");
        let space = Open(Region {
            corner: Vector2::new(-0.5 * width, 0.0),
            size: Vector2::new(width, REGION_HEIGHT * width),
        });
        let settings = Settings {
            start_time,
            ..Settings::default()
        };
        let model = Model {
            law,
            boundary,
            gravity: values.real("gravity"),
            space,
        };
        let up = match settled::is_wanted(values) {
            true => model.boundary.base.motion(start_time).velocity,
            false => 0.0,
        };
        Ok(Self::new(
            model,
            &disks,
            masses,
            &vec![[0.0, up, 0.0]; disks.len()],
            settings,
        ))
    }

    fn set_law(&mut self, law: HardLaw) {
        Self::set_law(self, law);
    }

    fn set_gravity(&mut self, time: f64, gravity: f64) {
        Self::set_gravity(self, time, gravity, &mut Unobserved);
    }

    fn set_target(&mut self, time: f64, duration: f64, values: &Values) {
        let mut base = self.state().boundary.base.clone();
        if base.set_target(time, duration, values) {
            self.change_boundary(time, &mut Unobserved, |boundary| boundary.base = base);
        }
    }

    fn warning(&self, told: &[&'static str]) -> Option<Warning> {
        self.state().boundary.base.warning(told)
    }

    fn work_done(&self) -> u64 {
        Self::work_done(self)
    }

    fn disk_at(&self, time: f64, disk: usize) -> DiskMotion {
        self.sample_at(time, disk)
    }

    fn counts(&self) -> Counts {
        self.state().counts
    }

    fn base_at(&self, time: f64) -> Motion {
        self.state().boundary.base.motion(time)
    }
}
