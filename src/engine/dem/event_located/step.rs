//! One step: predict, integrate every contact along the motion found so far, correct by the impulses, and again.

use crate::engine::dem::two_lanes::F64x2;

use super::contact_groups::{ContactGroups, Pass, StepSums};
use super::disk_records::{DiskRecord, ImpulseSums, free_flight, inverse_masses_of_record};
use super::lane_geometry::{PairLanes, Receivers, WallLanes};
use super::state::{Contact, Kinematics, LocatedPhase};
use super::step_context::StepContext;

/// Impulses and moments of one step, and the motion at its end. Scratch memory: nothing outlives the step.
#[derive(Debug, Clone, Default)]
pub struct StepScratch {
    /// Positions at the end.
    pub positions: Vec<[f64; 3]>,
    /// Velocities at the end.
    pub velocities: Vec<[f64; 3]>,
    /// What rounding took from both.
    pub remainders: Vec<[[f64; 3]; 2]>,
    /// Impulses of the walls in this step.
    pub wall_impulses: Vec<[f64; 2]>,
    /// Sums over the contacts.
    pub sums: StepSums,
    /// Disks at the end without any contact.
    free: Vec<DiskRecord>,
    /// Disks at the end, as known so far.
    disks: Vec<DiskRecord>,
    impulses: Vec<ImpulseSums>,
    inverse_masses: Vec<ImpulseSums>,
    pairs: ContactGroups<PairLanes>,
    wall_contacts: ContactGroups<WallLanes>,
}

impl StepScratch {
    /// For disks of these inverse masses, as in [`StepContext`].
    pub fn new(inverse_masses: &[[f64; 3]]) -> Self {
        let count = inverse_masses.len();
        Self {
            pairs: ContactGroups::new(count),
            wall_contacts: ContactGroups::new(count),
            inverse_masses: inverse_masses.iter().copied().map(inverse_masses_of_record).collect(),
            ..Self::default()
        }
    }

    /// Takes the step: the motion at its end is here, and the contacts are those at its end.
    pub fn take(&mut self, context: &StepContext<'_>, pairs: &mut [Contact], wall_contacts: &mut [Contact]) {
        self.begin(context);
        let to = &mut Receivers {
            disks: &mut self.impulses,
            walls: &mut self.wall_impulses,
        };
        self.pairs.predict(pairs, context, to);
        self.wall_contacts.predict(wall_contacts, context, to);
        self.correct_records();

        self.clear(context);
        let pass = Pass {
            context,
            disks: &self.disks,
        };
        let to = &mut Receivers {
            disks: &mut self.impulses,
            walls: &mut self.wall_impulses,
        };
        self.pairs.pass(pairs, pass, to);
        self.wall_contacts.pass(wall_contacts, pass, to);
        self.correct_records();

        self.clear(context);
        let pass = Pass {
            context,
            disks: &self.disks,
        };
        let to = &mut Receivers {
            disks: &mut self.impulses,
            walls: &mut self.wall_impulses,
        };
        self.pairs.last_pass(pairs, pass, to, &mut self.sums);
        self.wall_contacts.last_pass(wall_contacts, pass, to, &mut self.sums);
        self.correct(context);
    }

    #[inline(never)]
    fn begin(&mut self, context: &StepContext<'_>) {
        self.sums = StepSums::default();
        self.clear(context);
        self.free.clear();
        let start = context.start;
        let disks = start.positions.iter().zip(start.velocities);
        let disks = disks.zip(context.remainders.iter().zip(start.radii));
        self.free
            .extend(disks.map(|((position, velocity), (remainders, radius))| {
                free_flight([position, velocity], remainders, *radius, context.gravity, context.step)
            }));
    }

    fn clear(&mut self, context: &StepContext<'_>) {
        self.impulses.clear();
        self.impulses
            .resize(context.start.positions.len(), [F64x2::splat(0.0); 3]);
        self.wall_impulses.clear();
        self.wall_impulses.resize(context.walls.len(), [0.0; 2]);
    }

    /// Disks at the end of the step under the impulses found so far.
    #[inline(never)]
    fn correct_records(&mut self) {
        self.disks.clear();
        let impulses = self.impulses.iter().zip(&self.inverse_masses);
        self.disks
            .extend(self.free.iter().zip(impulses).map(|(free, (sums, inverse))| {
                let [moment, impulse, turning] = [0, 1, 2].map(|part: usize| sums[part] * inverse[part]);
                [free[0] + moment, free[1] + impulse, free[2] + turning]
            }));
    }

    /// Positions and velocities at the end from impulses and moments. The sums are compensated: equal steps in a row would
    /// else all be rounded the same way, and short steps drift by half a unit in the last place each.
    #[inline(never)]
    fn correct(&mut self, context: &StepContext<'_>) {
        self.positions.clear();
        self.velocities.clear();
        self.remainders.clear();
        let StepContext { step, start, .. } = *context;
        let (drop, fall) = (
            [0.0, 0.5 * step * step * context.gravity, 0.0],
            [0.0, step * context.gravity, 0.0],
        );
        let disks = start.positions.iter().zip(start.velocities).zip(context.remainders);
        let impulses = self.impulses.iter().zip(context.inverse_masses.iter().zip(start.radii));
        for (((position, velocity), [short_position, short_velocity]), (sums, (inverse, radius))) in disks.zip(impulses)
        {
            let [[moment_x, moment_y], [x, y], [moment, turning]] = sums.map(F64x2::to_array);
            let moment = [moment_x, moment_y, radius * moment];
            let impulse = [x, y, radius * turning];
            let moved: [(f64, f64); 3] = std::array::from_fn(|i| {
                let exact = step * velocity[i] + step * short_velocity[i];
                compensated(
                    position[i],
                    short_position[i] + (moment[i] * inverse[i] - drop[i]) + exact,
                )
            });
            let sped: [(f64, f64); 3] = std::array::from_fn(|i| {
                compensated(velocity[i], short_velocity[i] + (impulse[i] * inverse[i] - fall[i]))
            });
            self.positions.push(moved.map(|(sum, _)| sum));
            self.velocities.push(sped.map(|(sum, _)| sum));
            self.remainders
                .push([moved.map(|(_, short)| short), sped.map(|(_, short)| short)]);
        }
    }
}

/// Sum of two numbers, the first the larger or near it, and what rounding took from it (Kahan 1965).
#[inline(always)]
fn compensated(sum: f64, term: f64) -> (f64, f64) {
    let next = sum + term;
    (next, term - (next - sum))
}

/// Bodies that overlap at the start of a run have just touched: their springs are not stretched.
pub fn close_overlapping(context: &StepContext<'_>, pairs: &mut [Contact], wall_contacts: &mut [Contact]) {
    let close = |contact: &mut Contact, kinematics: Kinematics| {
        if kinematics.overlap <= 0.0 {
            return;
        }
        let pressed = context.laws.normal_force(kinematics.overlap, kinematics.closing) > 0.0;
        contact.phase = match pressed {
            true if context.laws.has_friction() => LocatedPhase::Stick,
            true => LocatedPhase::SlipForward,
            false => LocatedPhase::Unpressed,
        };
        contact.direction = kinematics.normal;
        contact.reference = kinematics.tangential_displacement;
        contact.kinematics = kinematics;
    };
    for contact in pairs {
        close(contact, context.start.of_pair(contact.bodies()));
    }
    for contact in wall_contacts {
        let [disk, wall] = contact.bodies();
        close(
            contact,
            context.start.of_wall(disk, &context.walls[wall], &context.base[0]),
        );
    }
}
