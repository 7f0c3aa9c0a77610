//! Method of fourth order in which every change of a contact happens at its exact time.
//!
//! Touch, release, yield and hold of a contact are located inside the step and integrated for this contact alone; the
//! other contacts take the whole step. So the order survives contact events, and the cost of an event is that of one
//! contact.
//!
//! A step predicts positions and velocities at its end. Then, twice, it takes the relative motion of each contact as the
//! cubic between its ends, integrates its force along it, and corrects the ends by the impulses. Contacts that keep their phase go
//! two by two in lanes (`contact_groups`, `lane_contacts`), the others one by one (`single_contact`, `contact_events`). Momentum is
//! conserved to rounding: a contact gives both its bodies the same impulse. Each contact has the bits that it would have alone.

mod contact_events;
mod contact_groups;
mod contact_step;
mod cubic;
mod disk_records;
mod frame;
mod impulse;
mod kinematics;
mod lane_contacts;
mod lane_geometry;
mod laws;
mod neighbour_list;
mod polynomial;
mod segment;
mod single_contact;
mod state;
mod step;
mod step_context;
mod tuning;

use crate::contact::LinearDashpot;
use crate::drive::{Drive, Motion};
use crate::engine::threads::OneThread;
use crate::engine::{ContactNow, Touched};
use crate::error::are_sane;
use crate::geometry::Disk;

use super::candidates::{self, Candidate};
use super::fixed_grid::{GridState, Stepper};
use super::setup::{Breakdown, SoftDiskSetup, SoftDisks};
use super::two_lanes::largest;

pub use state::{Contact, Disks, Kinematics, LocatedPhase};

use kinematics::DiskArrays;
use laws::Laws;
use neighbour_list::{EndOfStep, NeighbourList};
use step::StepScratch;
use step_context::{StepContext, velocity_at_nodes};

/// Steps of fourth order with located contact events.
#[derive(Debug, Clone)]
pub struct EventStepper {
    constants: SoftDisks,
    laws: Laws,
    /// 1/m, 1/m, 1/I of each disk.
    inverse_masses: Vec<[f64; 3]>,
    scratch: StepScratch,
    neighbours: NeighbourList,
}

impl Stepper for EventStepper {
    type Normal = LinearDashpot;
    type Threads = OneThread;
    type Disks = Disks;

    const WORK_OF_STEP: f64 = 1.0;

    fn at_rest(setup: SoftDiskSetup, disks: &[Disk]) -> (Self, Disks) {
        let inverse_masses = disks.iter().zip(&setup.masses).map(|(disk, mass)| {
            let inertia = 0.5 * mass * disk.radius * disk.radius;
            [1.0 / mass, 1.0 / mass, 1.0 / inertia]
        });
        let state = Disks {
            positions: disks.iter().map(|disk| [disk.x, disk.y, 0.0]).collect(),
            velocities: vec![[0.0; 3]; disks.len()],
            remainders: vec![[[0.0; 3]; 2]; disks.len()],
            wall_impulses: vec![[0.0; 2]; setup.walls.len()],
            ..Disks::default()
        };
        let inverse_masses: Vec<_> = inverse_masses.collect();
        let stepper = Self {
            laws: Laws::new(&setup.laws),
            scratch: StepScratch::new(&inverse_masses),
            inverse_masses,
            constants: SoftDisks::new(setup, disks),
            neighbours: NeighbourList::new(disks.len()),
        };
        (stepper, state)
    }

    fn use_threads(&mut self, _threads: OneThread) {}

    fn constants(&self) -> &SoftDisks {
        &self.constants
    }

    fn start<D: Drive>(&mut self, state: &mut GridState<D, Disks>) {
        const { assert!(!D::MOVES_DISKS, "disks that a drive moves are those of velocity Verlet") };
        state.disks.remainders.fill([[0.0; 3]; 2]);
        state.disks.pairs.clear();
        state.disks.wall_contacts.clear();
        self.neighbours.build(state, &self.constants);
        let mut pairs = std::mem::take(&mut state.disks.pairs);
        let mut wall_contacts = std::mem::take(&mut state.disks.wall_contacts);
        let context = self.context(&state.disks, [state.base; 2], 0.0);
        step::close_overlapping(&context, &mut pairs, &mut wall_contacts);
        let contacts = pairs.iter().chain(&wall_contacts);
        state.contacts = contacts.filter(|contact| contact.remembers()).count() as u32;
        (state.disks.pairs, state.disks.wall_contacts) = (pairs, wall_contacts);
    }

    fn make_room(disks: &mut Disks) {
        let count = disks.positions.len();
        candidates::make_room(&mut disks.pairs, count);
        candidates::make_room(&mut disks.wall_contacts, count);
    }

    fn step<D: Drive>(&mut self, state: &mut GridState<D, Disks>, duration: f64, time: f64) -> Result<(), Breakdown> {
        let base = state.drive.motion(time);
        let end = EndOfStep {
            time,
            base: base.displacement,
        };
        self.neighbours.build_if_due(state, &self.constants, duration, end)?;
        let mut scratch = std::mem::take(&mut self.scratch);
        let mut pairs = std::mem::take(&mut state.disks.pairs);
        let mut wall_contacts = std::mem::take(&mut state.disks.wall_contacts);
        let context = self.context(&state.disks, [state.base, base], duration);
        scratch.take(&context, &mut pairs, &mut wall_contacts);
        (state.disks.pairs, state.disks.wall_contacts) = (pairs, wall_contacts);
        self.scratch = scratch;
        self.commit(state, base, time)
    }

    fn tune<D: Drive>(&mut self, state: &mut GridState<D, Disks>, friction: f64, gravity: f64) {
        self.retune(state, friction, gravity);
    }

    fn motion<'s>(&self, disks: &'s Disks) -> (&'s [[f64; 3]], &'s [[f64; 3]]) {
        (&disks.positions, &disks.velocities)
    }

    fn set_velocity(&self, disks: &mut Disks, [x, y]: [f64; 2]) {
        disks.velocities.fill([x, y, 0.0]);
    }

    fn base_force(&self, disks: &Disks, base: Motion) -> f64 {
        let arrays = self.arrays(disks);
        let force = |contact: &Contact| {
            let [disk, wall] = contact.bodies();
            let wall = &self.constants.setup.walls[wall];
            let now = arrays.of_wall(disk, wall, &base);
            let [normal, tangential] = self.laws.forces(contact, now.overlap, now.closing);
            wall.follows_base * (normal * wall.normal.y + tangential * wall.tangent().y)
        };
        disks.wall_contacts.iter().map(force).sum()
    }

    fn impulse_of_wall(&self, disks: &Disks, wall: usize) -> [f64; 2] {
        disks.wall_impulses[wall]
    }

    fn elastic_energy(&self, disks: &Disks, base: Motion) -> f64 {
        let arrays = self.arrays(disks);
        let of_pair = |contact: &Contact| arrays.of_pair(contact.bodies()).overlap;
        let of_wall = |contact: &Contact| {
            let [disk, wall] = contact.bodies();
            arrays.of_wall(disk, &self.constants.setup.walls[wall], &base).overlap
        };
        let energy_of_pair = |contact: &Contact| self.laws.elastic_energy(contact, of_pair(contact));
        let energy_of_wall = |contact: &Contact| self.laws.elastic_energy(contact, of_wall(contact));
        disks.pairs.iter().map(energy_of_pair).sum::<f64>()
            + disks.wall_contacts.iter().map(energy_of_wall).sum::<f64>()
    }

    fn contacts(&self, disks: &Disks, base: Motion) -> Vec<ContactNow> {
        let arrays = self.arrays(disks);
        let pairs = disks.pairs.iter().map(|pair| {
            let now = arrays.of_pair(pair.bodies());
            self.contact_now(disks, pair, Touched::Disk(pair.second), now)
        });
        let walls = disks.wall_contacts.iter().map(|contact| {
            let [disk, wall] = contact.bodies();
            let now = arrays.of_wall(disk, &self.constants.setup.walls[wall], &base);
            self.contact_now(disks, contact, Touched::Wall(contact.second), now)
        });
        pairs.chain(walls).flatten().collect()
    }

    fn is_sane(disks: &Disks) -> bool {
        let motion = disks.positions.iter().chain(&disks.velocities).flatten();
        are_sane(motion.chain(disks.wall_impulses.iter().flatten()).copied())
    }

    fn fits<D>(&self, own: &Disks, state: &GridState<D, Disks>) -> bool {
        let lengths = |disks: &Disks| {
            [
                disks.positions.len(),
                disks.velocities.len(),
                disks.remainders.len(),
                disks.wall_impulses.len(),
                disks.positions_at_list_build.len(),
            ]
        };
        let disks = &state.disks;
        let (count, walls) = (
            self.constants.radii.len() as u32,
            self.constants.setup.walls.len() as u32,
        );
        let pair_fits = |pair: &Contact| pair.first < pair.second && pair.second < count && pair.is_sane();
        let wall_fits = |contact: &Contact| contact.first < count && contact.second < walls && contact.is_sane();
        lengths(disks) == lengths(own)
            && disks.pairs.iter().all(pair_fits)
            && disks.wall_contacts.iter().all(wall_fits)
            && disks.list_margin > 0.0
            && are_sane(disks.positions_at_list_build.iter().flatten().copied())
            && are_sane(disks.remainders.iter().flatten().flatten().copied())
            && are_sane([disks.base_at_list_build, disks.list_margin])
    }
}

impl EventStepper {
    /// Makes the end of the step the state.
    fn commit<D>(&mut self, state: &mut GridState<D, Disks>, base: Motion, time: f64) -> Result<(), Breakdown> {
        let (disks, scratch) = (&mut state.disks, &mut self.scratch);
        let sums = scratch.sums;
        self.constants
            .check_overlap(largest(sums.lanes.deepest).max(sums.deepest), time)?;
        std::mem::swap(&mut disks.positions, &mut scratch.positions);
        std::mem::swap(&mut disks.velocities, &mut scratch.velocities);
        std::mem::swap(&mut disks.remainders, &mut scratch.remainders);
        for (sum, new) in disks.wall_impulses.iter_mut().zip(&scratch.wall_impulses) {
            sum[0] += new[0];
            sum[1] += new[1];
        }
        disks.changes += u64::from(sums.changes);
        state.base = base;
        state.energy_input += sums.lanes.work.reduce_add() + sums.work;
        state.energy_lost += sums.lanes.lost.reduce_add() + sums.lost;
        state.contacts = sums.lanes.contacts + sums.contacts;
        Ok(())
    }

    /// A closed contact with this relative motion; none if it is open.
    fn contact_now(&self, disks: &Disks, contact: &Contact, other: Touched, now: Kinematics) -> Option<ContactNow> {
        if !contact.remembers() {
            return None;
        }
        let disk = contact.first as usize;
        let ([x, y, _], [nx, ny]) = (disks.positions[disk], now.normal);
        let inside = self.constants.radii[disk] - 0.5 * now.overlap;
        let [normal_force, tangential_force] = self.laws.forces(contact, now.overlap, now.closing);
        Some(ContactNow {
            first: contact.first,
            other,
            point: [x - inside * nx, y - inside * ny],
            normal: [nx, ny],
            normal_force,
            tangential_force,
        })
    }

    fn arrays<'s>(&'s self, disks: &'s Disks) -> DiskArrays<'s> {
        DiskArrays {
            positions: &disks.positions,
            velocities: &disks.velocities,
            radii: &self.constants.radii,
        }
    }

    fn context<'s>(&'s self, disks: &'s Disks, base: [Motion; 2], step: f64) -> StepContext<'s> {
        StepContext {
            laws: &self.laws,
            inverse_masses: &self.inverse_masses,
            walls: &self.constants.setup.walls,
            gravity: self.constants.setup.gravity,
            start: self.arrays(disks),
            base,
            base_velocity_at_nodes: velocity_at_nodes(base, step),
            remainders: &disks.remainders,
            step,
        }
    }
}
