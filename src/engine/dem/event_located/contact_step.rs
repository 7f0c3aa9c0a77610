//! One contact over one step: its relative motion at both ends in, its impulse on the two bodies out.
//!
//! Between the ends the motion is Hermite's cubic. While the contact stays in its phase the force is integrated along it
//! by Gauss's rule with two nodes; the step in which the phase changes is left to `contact_events`.

use super::frame::{ContactFrame, HermiteCubic};
use super::impulse::{ContactForces, ContactImpulse, OwnImpulse, QuadratureNode};
use super::laws::Laws;
use super::state::{Contact, Kinematics, LocatedPhase};

/// The contact after a step, and what it gave to its bodies.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// Phase at the end.
    pub phase: LocatedPhase,
    /// lambda* at the end \[m\].
    pub reference: f64,
    /// Rate of the closing velocity at the end \[m/s2\].
    pub closing_rate: f64,
    /// Impulses and energies.
    pub given: ContactImpulse,
}

/// One contact in one step.
#[derive(Debug, Clone, Copy)]
pub struct ContactStep<'step, F> {
    /// Relative motion at the start.
    pub start: &'step Kinematics,
    /// Relative motion at the end, as known so far.
    pub end: &'step Kinematics,
    /// The contact at the start.
    pub contact: &'step Contact,
    /// Integrals of the contact's own force that are contained in `end`.
    pub own: OwnImpulse,
    /// Inverse of the effective mass \[1/kg\].
    pub inverse_mass: f64,
    /// Frame over the step.
    pub frame: &'step F,
    /// Length \[s\].
    pub step: f64,
}

/// Nodes of Gauss's rule, (1 -+ 1/sqrt 3) / 2; each stands for half of the step.
const GAUSS: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];
const VALUES: [HermiteCubic; 2] = [HermiteCubic::value(GAUSS[0]), HermiteCubic::value(GAUSS[1])];
const SLOPES: [HermiteCubic; 2] = [HermiteCubic::slope(GAUSS[0]), HermiteCubic::slope(GAUSS[1])];
const BENDS: [HermiteCubic; 2] = [HermiteCubic::bend(GAUSS[0]), HermiteCubic::bend(GAUSS[1])];
const FIRST_BEND: HermiteCubic = HermiteCubic::bend(0.0);
const LAST_BEND: HermiteCubic = HermiteCubic::bend(1.0);

/// Whether the cubic with these values and rates at the ends of a step cannot rise above zero: its control points, of
/// which it is a convex combination, are all below.
#[inline(always)]
fn stays_below([value, rate]: [f64; 2], [end_value, end_rate]: [f64; 2], step: f64) -> bool {
    let third = step / 3.0;
    value <= 0.0 && value + third * rate <= 0.0 && end_value - third * end_rate <= 0.0 && end_value <= 0.0
}

impl<F: ContactFrame> ContactStep<'_, F> {
    /// Integrals over the step if the phase does not change in it. Energies are summed in the `LAST` pass only.
    #[inline(always)]
    pub fn within_phase<const LAST: bool>(&self, laws: &Laws) -> Option<Outcome> {
        match self.contact.phase {
            LocatedPhase::Open => self.apart(),
            LocatedPhase::Unpressed => self.unpressed(laws),
            LocatedPhase::Stick => self.sticking::<LAST>(laws),
            LocatedPhase::SlipForward => self.slipping::<LAST>(laws, 1.0),
            LocatedPhase::SlipBackward => self.slipping::<LAST>(laws, -1.0),
        }
    }

    fn resting(&self, phase: LocatedPhase) -> Outcome {
        Outcome {
            phase,
            reference: self.contact.reference,
            closing_rate: 0.0,
            given: ContactImpulse::default(),
        }
    }

    fn apart(&self) -> Option<Outcome> {
        let (start, end) = (self.start, self.end);
        let apart = stays_below([start.overlap, start.closing], [end.overlap, end.closing], self.step);
        apart.then(|| self.resting(LocatedPhase::Open))
    }

    fn unpressed(&self, laws: &Laws) -> Option<Outcome> {
        let (start, end) = (self.start, self.end);
        if laws.normal_force(end.overlap, end.closing) > 0.0 {
            return None;
        }
        let phase = if end.overlap > 0.0 {
            LocatedPhase::Unpressed
        } else {
            LocatedPhase::Open
        };
        let mut outcome = self.resting(phase);
        // The spring gives way to nothing.
        outcome.given.lost = laws.normal.energy(start.overlap) - laws.normal.energy(end.overlap.max(0.0));
        Some(outcome)
    }

    #[inline(always)]
    fn overlap(&self, x: &HermiteCubic) -> f64 {
        let (start, end, step) = (self.start, self.end, self.step);
        x.of(start.overlap, step * start.closing, end.overlap, step * end.closing)
    }

    #[inline(always)]
    fn stretch(&self, x: &HermiteCubic) -> f64 {
        let (start, end, step) = (self.start, self.end, self.step);
        let (from, to) = (
            start.tangential_displacement - self.contact.reference,
            end.tangential_displacement - self.contact.reference,
        );
        x.of(from, step * start.sliding, to, step * end.sliding)
    }

    /// Rates of the closing velocity at the start and at the end \[m/s2\].
    #[inline(always)]
    fn closing_rates(&self) -> [f64; 2] {
        let square = self.step * self.step;
        [self.overlap(&FIRST_BEND) / square, self.overlap(&LAST_BEND) / square]
    }

    #[inline(always)]
    fn gauss_node(&self, index: usize) -> QuadratureNode {
        QuadratureNode {
            span: 0.5 * self.step,
            ahead: (1.0 - GAUSS[index]) * self.step,
            value: VALUES[index],
            slope: SLOPES[index],
        }
    }

    #[inline(always)]
    fn sticking<const LAST: bool>(&self, laws: &Laws) -> Option<Outcome> {
        let rates = self.closing_rates();
        if !self.keeps_sticking(laws, rates) {
            return None;
        }
        let mut given = ContactImpulse::default();
        for index in 0..2 {
            let overlap = self.overlap(&VALUES[index]);
            let closing = self.overlap(&SLOPES[index]) / self.step;
            let forces = ContactForces {
                normal: laws.normal_force(overlap, closing),
                tangential: laws.tangential.force(self.stretch(&VALUES[index])),
                overlap,
            };
            let node = self.gauss_node(index);
            given.add(self.frame, &forces, &node);
            if LAST {
                given.lost += node.span * laws.normal.damping * closing * closing;
            }
        }
        Some(Outcome {
            phase: LocatedPhase::Stick,
            reference: self.contact.reference,
            closing_rate: rates[1],
            given,
        })
    }

    /// Neither limit of friction is passed in the step, nor is the force cut off.
    #[inline(always)]
    fn keeps_sticking(&self, laws: &Laws, closing_rates: [f64; 2]) -> bool {
        let ends = [self.start, self.end];
        let limit = |i: usize| {
            [
                laws.slip_compliance * laws.normal_force(ends[i].overlap, ends[i].closing),
                laws.slip_compliance * laws.normal_force(ends[i].closing, closing_rates[i]),
            ]
        };
        let (limits, stretches) = (
            [limit(0), limit(1)],
            [0, 1].map(|i: usize| {
                [
                    ends[i].tangential_displacement - self.contact.reference,
                    ends[i].sliding,
                ]
            }),
        );
        let holds = |sense: f64| {
            let beyond = [0, 1].map(|i: usize| [0, 1].map(|d: usize| sense * stretches[i][d] - limits[i][d]));
            stays_below(beyond[0], beyond[1], self.step)
        };
        laws.normal_force(self.end.overlap, self.end.closing) > 0.0 && holds(1.0) && holds(-1.0)
    }

    #[inline(always)]
    fn slipping<const LAST: bool>(&self, laws: &Laws, sense: f64) -> Option<Outcome> {
        let end = self.end;
        let end_force = laws.normal_force(end.overlap, end.closing);
        let rates = self.closing_rates();
        if end_force <= 0.0 || (laws.has_friction() && !self.keeps_slipping(laws, sense, rates)) {
            return None;
        }
        let mut given = ContactImpulse::default();
        for index in 0..2 {
            let overlap = self.overlap(&VALUES[index]);
            let closing = self.overlap(&SLOPES[index]) / self.step;
            let normal = laws.normal_force(overlap, closing);
            let limit = laws.slip_share() * normal;
            let forces = ContactForces {
                normal,
                tangential: -sense * limit,
                overlap,
            };
            let node = self.gauss_node(index);
            given.add(self.frame, &forces, &node);
            if LAST {
                let closing_rate = self.overlap(&BENDS[index]) / (self.step * self.step);
                let sliding = self.stretch(&SLOPES[index]) / self.step;
                let slip = sense * sliding - laws.slip_compliance * laws.normal_force(closing, closing_rate);
                given.lost += node.span * (laws.normal.damping * closing * closing + limit * slip);
            }
        }
        Some(Outcome {
            phase: self.contact.phase,
            reference: end.tangential_displacement - sense * laws.slip_compliance * end_force,
            closing_rate: rates[1],
            given,
        })
    }

    /// The rate of slip, a parabola in time, stays positive: so do its control points.
    #[inline(always)]
    fn keeps_slipping(&self, laws: &Laws, sense: f64, closing_rates: [f64; 2]) -> bool {
        let (start, end) = (self.start, self.end);
        let slip = |sliding: f64, closing: f64, closing_rate: f64| {
            sense * sliding - laws.slip_compliance * laws.normal_force(closing, closing_rate)
        };
        let jerk = (closing_rates[1] - closing_rates[0]) / self.step;
        let sliding_rate = self.stretch(&FIRST_BEND) / (self.step * self.step);
        let first = slip(start.sliding, start.closing, closing_rates[0]);
        let rate = slip(sliding_rate, closing_rates[0], jerk);
        slip(end.sliding, end.closing, closing_rates[1]) > 0.0 && first + 0.5 * self.step * rate > 0.0
    }
}
