//! Two contacts over a step in which neither changes its phase, in lanes: the ends of their motion in, impulses out.
//!
//! The formulas are those of P 4.2 along Hermite's cubics between the ends. Contacts in one pair of lanes are all sticking or
//! all slipping, so that nothing branches. What changes its phase is found here and left to `contact_events`.

use crate::engine::dem::two_lanes::{F64x2, lane, per_lane};

use super::cubic::{Cubic, integrals};
use super::disk_records::DiskRecord;
use super::impulse::OwnImpulse;
use super::lane_geometry::{LaneGeometry, LaneImpulse, LaneMotion, NodeForces, Receivers, impulse};
use super::laws::Laws;
use super::state::{Contact, LocatedPhase};
use super::step_context::StepContext;

/// Beyond this the remembered direction follows the normal \[rad\].
pub const FOLLOWING_ANGLE: f64 = 1e-3;

/// Two contacts at the start of a step. Slopes are rates times the step.
#[derive(Debug, Clone, Copy)]
pub struct ContactLanes<G> {
    /// Their places in the list.
    pub places: [u32; 2],
    /// All bits of a lane that holds a contact: the last pair of lanes may hold one.
    filled: F64x2,
    overlap: [F64x2; 2],
    stretch: [F64x2; 2],
    /// lambda*.
    reference: F64x2,
    /// Sign of the stretch while slipping.
    sense: F64x2,
    /// Impulse and moment of normal and tangential force as in the last pass.
    own: [[F64x2; 2]; 2],
    geometry: G,
}

/// Sums over contacts in the last pass.
#[derive(Debug, Clone, Copy, Default)]
pub struct LaneSums {
    /// Energy lost \[J\].
    pub lost: F64x2,
    /// Work of the walls \[J\].
    pub work: F64x2,
    /// Deepest overlap \[m\].
    pub deepest: F64x2,
    /// Overlapping contacts.
    pub contacts: u32,
}

/// The contact laws over a step, for slopes that are rates times the step.
#[derive(Clone, Copy)]
struct StepLaws {
    stiffness: f64,
    /// Damping over the step.
    damping: f64,
    slip_compliance: f64,
}

impl StepLaws {
    #[inline(always)]
    fn new(context: &StepContext<'_>) -> Self {
        let Laws {
            normal,
            slip_compliance,
            ..
        } = *context.laws;
        Self {
            stiffness: normal.stiffness,
            damping: normal.damping / context.step,
            slip_compliance,
        }
    }

    /// Normal force, or its slope if the arguments are slopes.
    #[inline(always)]
    fn force(&self, overlap: F64x2, slope: F64x2) -> F64x2 {
        overlap * self.stiffness + slope * self.damping
    }
}

impl<G: LaneGeometry> ContactLanes<G> {
    /// The contacts in these two places of the list, of which the second is empty if `single`.
    #[inline(always)]
    pub fn new(contacts: &[Contact], places: [u32; 2], single: bool, context: &StepContext<'_>) -> Self {
        let two = places.map(|place| &contacts[place as usize]);
        let reference = per_lane(|k| two[k].reference);
        let step = context.step;
        let all = F64x2::splat(0.0).simd_eq(F64x2::splat(0.0));
        Self {
            places,
            filled: if single {
                F64x2::new([0.0, 1.0]).simd_eq(F64x2::splat(0.0))
            } else {
                all
            },
            overlap: [
                per_lane(|k| two[k].kinematics.overlap),
                per_lane(|k| two[k].kinematics.closing) * step,
            ],
            stretch: [
                per_lane(|k| two[k].kinematics.tangential_displacement) - reference,
                per_lane(|k| two[k].kinematics.sliding) * step,
            ],
            reference,
            sense: per_lane(|k| two[k].phase.slip_sense().unwrap_or(0.0)),
            own: [[F64x2::splat(0.0); 2]; 2],
            geometry: G::of(two, context),
        }
    }

    /// Impulse of the forces that continue from the start of the step along their tangents in time. They turn with the normal:
    /// by half the angle of the step in the impulse, to first order, and by a third of it in the moment.
    #[inline(always)]
    pub fn predict<const SLIPS: bool>(
        &mut self,
        contacts: &[Contact],
        context: &StepContext<'_>,
        to: &mut Receivers<'_>,
    ) {
        let (laws, step) = (StepLaws::new(context), context.step);
        let two = self.places.map(|place| &contacts[place as usize]);
        let bend = per_lane(|k| two[k].closing_rate) * (step * step);
        let normal = [
            laws.force(self.overlap[0], self.overlap[1]),
            laws.force(self.overlap[1], bend),
        ];
        let tangential = if SLIPS {
            let share = self.sense * -context.laws.slip_share();
            normal.map(|part| share * part)
        } else {
            self.stretch.map(|part| part * -context.laws.tangential.stiffness)
        };
        self.own = [normal, tangential].map(|[value, slope]| {
            [
                (value + slope * 0.5) * step,
                (value + slope * (1.0 / 3.0)) * (0.5 * step * step),
            ]
        });
        let start = |part: fn(&Contact) -> f64| per_lane(|k| part(two[k]));
        let (nx, ny) = (start(|of| of.kinematics.normal[0]), start(|of| of.kinematics.normal[1]));
        let lever = start(|of| of.kinematics.lever);
        let turn = start(|of| of.kinematics.turning) * step;
        let vector = |part: usize, angle: F64x2| {
            let (along, sideways) = (self.own[0][part], self.own[1][part] * lever);
            let (x, y) = (along * nx + sideways * ny, along * ny - sideways * nx);
            [x - angle * y, y + angle * x]
        };
        let ([x, y], [mx, my]) = (vector(0, turn * 0.5), vector(1, turn * (1.0 / 3.0)));
        let kept = |of: [F64x2; 2]| of.map(|part| part & self.filled);
        let given = LaneImpulse {
            x: kept([x, mx]),
            y: kept([y, my]),
            tangential: kept(self.own[1]),
        };
        self.geometry.add(&given, to);
    }

    /// Integrates both along the motion to where the disks are at `disks`, those that keep their phase. Returns a bit for each that
    /// does not.
    #[inline(always)]
    pub fn pass<const SLIPS: bool>(
        &mut self,
        context: &StepContext<'_>,
        disks: &[DiskRecord],
        to: &mut Receivers<'_>,
    ) -> u32 {
        let lanes = self.integrate::<SLIPS>(context, disks);
        self.geometry.add(&lanes.given, to);
        // One that changes its phase is integrated with what it gave in the last pass.
        let before = self.own;
        self.own = [integrals(lanes.at.normal, context.step), lanes.given_own];
        let changes = lanes.changes(self.filled);
        if changes != 0 {
            for (own, before) in self.own.iter_mut().zip(before) {
                *own = [0, 1].map(|i: usize| lanes.holds.bitselect(own[i], before[i]));
            }
        }
        changes
    }

    /// The same, with energies; the contacts are then those at the end.
    #[inline(always)]
    pub fn last_pass<const SLIPS: bool>(
        &self,
        context: &StepContext<'_>,
        disks: &[DiskRecord],
        to: &mut Receivers<'_>,
        contacts: &mut [Contact],
        sums: &mut LaneSums,
    ) -> u32 {
        let lanes = self.integrate::<SLIPS>(context, disks);
        self.geometry.add(&lanes.given, to);
        let end = &lanes.end;
        sums.lost += self.lost::<SLIPS>(context, &lanes) & lanes.holds;
        sums.work += self.geometry.work(context, lanes.vertical) & lanes.holds;
        let overlap = end.overlap[0] & lanes.holds;
        sums.deepest = overlap.fast_max(sums.deepest);
        sums.contacts += overlap.simd_gt(F64x2::splat(0.0)).to_bitmask().count_ones();

        let reference = if SLIPS {
            end.displacement[0] - self.sense * context.laws.slip_compliance * lanes.end_force
        } else {
            self.reference
        };
        let closing_rate = lanes.bends[1] * (1.0 / (context.step * context.step));
        let holds = lanes.holds.to_bitmask();
        for k in 0..2 {
            if holds & (1 << k) != 0 {
                let contact = &mut contacts[self.places[k] as usize];
                contact.reference = lane(reference, k);
                contact.closing_rate = lane(closing_rate, k);
                contact.kinematics = end.kinematics(k, context.step);
            }
        }
        let follows = end.turn.abs().simd_gt(F64x2::splat(FOLLOWING_ANGLE)).to_bitmask() & holds;
        if follows != 0 {
            for k in (0..2).filter(|k| follows & (1 << k) != 0) {
                let contact = &mut contacts[self.places[k] as usize];
                let [first, second] = contact.bodies().map(|disk| context.start.radii[disk]);
                contact.follow(lane(end.turn, k), first + second);
            }
        }
        lanes.changes(self.filled)
    }

    /// What one lane gave in the last pass.
    pub fn own(&self, k: usize) -> OwnImpulse {
        let [normal, tangential] = self.own.map(|own| own.map(|part| lane(part, k)));
        OwnImpulse { normal, tangential }
    }

    /// Notes what one lane gave.
    pub fn set_own(&mut self, k: usize, own: OwnImpulse) {
        for (lanes, new) in self.own.iter_mut().zip([own.normal, own.tangential]) {
            for (part, new) in lanes.iter_mut().zip(new) {
                part.as_mut_array()[k] = new;
            }
        }
    }

    #[inline(always)]
    fn integrate<const SLIPS: bool>(&self, context: &StepContext<'_>, disks: &[DiskRecord]) -> Integrated {
        let laws = StepLaws::new(context);
        let end = self.geometry.end(context, disks);
        let stretch_end = [end.displacement[0] - self.reference, end.displacement[1]];
        let overlap = Cubic::new(self.overlap, end.overlap);
        let stretch = Cubic::new(self.stretch, stretch_end);
        let bends = overlap.bends_at_ends();
        let end_force = laws.force(end.overlap[0], end.overlap[1]);
        let pressed = end_force.simd_gt(F64x2::splat(0.0)) & self.filled;
        let holds = if !SLIPS {
            pressed & self.keeps_sticking(laws, &end, stretch_end, bends)
        } else if context.laws.has_friction() {
            pressed & self.keeps_slipping(laws, &end, &stretch, bends)
        } else {
            pressed
        };
        let (values, slopes) = (overlap.at_nodes(), overlap.slopes_at_nodes());
        let normal = [0, 1].map(|i: usize| laws.force(values[i], slopes[i]));
        let tangential = if SLIPS {
            let share = self.sense * -context.laws.slip_share();
            normal.map(|force| share * force)
        } else {
            stretch
                .at_nodes()
                .map(|stretch| stretch * -context.laws.tangential.stiffness)
        };
        let at = NodeForces {
            normal,
            tangential,
            overlap: values,
        };
        let forces = self.geometry.forces(&end, &at);
        let given_own = integrals(tangential, context.step);
        Integrated {
            holds,
            given: impulse(forces, given_own, context.step, holds),
            given_own,
            vertical: forces[1],
            end,
            at,
            slopes,
            bends,
            end_force,
            overlap,
            stretch,
        }
    }

    /// Neither limit of friction is passed in the step: the control points of the cubic of the stretch stay within those of the
    /// cubic of the limit, of which both are convex combinations.
    #[inline(always)]
    fn keeps_sticking(&self, laws: StepLaws, end: &LaneMotion, stretch_end: [F64x2; 2], bends: [F64x2; 2]) -> F64x2 {
        const THIRD: f64 = 1.0 / 3.0;
        let control = |[value, slope]: [F64x2; 2], [end_value, end_slope]: [F64x2; 2]| {
            [value, value + slope * THIRD, end_value - end_slope * THIRD, end_value]
        };
        let limits = |[overlap, slope]: [F64x2; 2], bend: F64x2| {
            [laws.force(overlap, slope), laws.force(slope, bend)].map(|force| force * laws.slip_compliance)
        };
        let stretches = control(self.stretch, stretch_end);
        let limits = control(limits(self.overlap, bends[0]), limits(end.overlap, bends[1]));
        let within = [0, 1, 2, 3].map(|i: usize| stretches[i].abs().simd_le(limits[i]));
        within[0] & within[1] & within[2] & within[3]
    }

    /// The rate of slip, a parabola in time, stays positive: so do its control points.
    #[inline(always)]
    fn keeps_slipping(&self, laws: StepLaws, end: &LaneMotion, stretch: &Cubic<F64x2>, bends: [F64x2; 2]) -> F64x2 {
        let slip = |sliding: F64x2, slope: F64x2, bend: F64x2| {
            self.sense * sliding - laws.force(slope, bend) * laws.slip_compliance
        };
        let first = slip(self.stretch[1], self.overlap[1], bends[0]);
        let slope = slip(stretch.bends_at_ends()[0], bends[0], bends[1] - bends[0]);
        let last = slip(end.displacement[1], end.overlap[1], bends[1]);
        let zero = F64x2::splat(0.0);
        last.simd_gt(zero) & (first + slope * 0.5).simd_gt(zero)
    }

    /// Energy lost in the dashpots and by slip \[J\].
    #[inline(always)]
    fn lost<const SLIPS: bool>(&self, context: &StepContext<'_>, lanes: &Integrated) -> F64x2 {
        let [first, second] = lanes.slopes;
        let laws = StepLaws::new(context);
        let in_dashpot = (first * first + second * second) * (0.5 * laws.damping);
        if !SLIPS {
            return in_dashpot;
        }
        let (bends, sliding) = (lanes.overlap.bends_at_nodes(), lanes.stretch.slopes_at_nodes());
        let by_slip = [0, 1].map(|i: usize| {
            let slip = self.sense * sliding[i] - laws.force(lanes.slopes[i], bends[i]) * laws.slip_compliance;
            lanes.at.normal[i] * slip
        });
        in_dashpot + (by_slip[0] + by_slip[1]) * (0.5 * context.laws.slip_share())
    }
}

/// Two contacts integrated over a step.
struct Integrated {
    /// All bits of a lane that keeps its phase.
    holds: F64x2,
    given: LaneImpulse,
    given_own: [F64x2; 2],
    /// Vertical forces at the nodes.
    vertical: [F64x2; 2],
    end: LaneMotion,
    at: NodeForces,
    /// Of the overlap at the nodes.
    slopes: [F64x2; 2],
    /// Second derivatives of the overlap at the ends.
    bends: [F64x2; 2],
    end_force: F64x2,
    overlap: Cubic<F64x2>,
    stretch: Cubic<F64x2>,
}

impl Integrated {
    #[inline(always)]
    fn changes(&self, filled: F64x2) -> u32 {
        filled.to_bitmask() & !self.holds.to_bitmask()
    }
}

/// Whether the contact is integrated in lanes while its phase lasts, and whether it slips.
#[inline(always)]
pub fn in_lanes(phase: LocatedPhase) -> Option<bool> {
    phase.is_pressed().then(|| phase.slip_sense().is_some())
}
