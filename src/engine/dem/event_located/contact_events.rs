//! A contact in a step in which its phase changes: the contact's own equation is solved segment by segment.
//!
//! What the other contacts, gravity and the rotation of the frame do to the relative motion is smooth: the motion at the
//! end of the step without the contact's own force gives the external acceleration as a line in time. Under it each segment
//! is a power series (`segment`), and its impulse is that along Hermite's cubic between its ends.

use crate::engine::dem::two_lanes::{F64x2, lane};

use super::contact_step::{ContactStep, Outcome};
use super::cubic::{Cubic, NODE};
use super::frame::{ContactFrame, HermiteCubic};
use super::impulse::{ContactForces, ContactImpulse, QuadratureNode};
use super::laws::Laws;
use super::segment::{Event, ExternalAcceleration, Found, KnownRoots, RelativeMotion, Segment, SegmentPhase, Span};
use super::state::LocatedPhase;

/// Segments of one step; what is beyond stays in the last phase. Grazing events could else alternate without end.
const MOST_SEGMENTS: usize = 12;

impl<F: ContactFrame> ContactStep<'_, F> {
    /// Integrals over a step in which the phase changes, with the phase at its end.
    pub fn integrate_with_events(&self, laws: &Laws) -> Outcome {
        let external = self.external_acceleration();
        let mut motion = RelativeMotion {
            value: F64x2::new([self.start.overlap, self.start.tangential_displacement]),
            rate: F64x2::new([self.start.closing, self.start.sliding]),
        };
        let mut start = SegmentPhase {
            phase: self.contact.phase,
            reference: self.contact.reference,
            roots: KnownRoots::default(),
        };
        let mut given = ContactImpulse::default();
        let mut elapsed = 0.0;
        let mut stored = spring_energy(laws, start, &motion);
        for index in 1.. {
            let span = Span {
                elapsed,
                length: self.step - elapsed,
            };
            let segment = Segment::new(laws, &external, &motion, start, span);
            let found = if index < MOST_SEGMENTS {
                segment.first_event(laws)
            } else {
                None
            };
            let x = found.map_or(1.0, |found| found.x);
            let end = segment.motion(x);
            self.integrate(laws, &segment, [&motion, &end], x, &mut given);
            motion = end;
            // What the spring has less after a slip is lost. The energies at its ends say so where a rate of slip, which goes with
            // the inverse of a tiny stiffness, would make a large loss of the rounding of a force that vanishes.
            let released = found.is_some_and(|found| found.event == Event::Release);
            let left = f64::from(!released) * spring_energy(laws, start, &motion);
            if released || start.phase.slip_sense().is_some() {
                given.lost += stored - left;
            }
            stored = left;
            let Some(Found { x, event }) = found else {
                break;
            };
            elapsed += x * span.length;
            start = next_phase(laws, event, start, &mut motion);
            // An event at the very end leaves no time for a further segment, whose rates would be divided by zero.
            if elapsed >= self.step {
                break;
            }
        }
        self.finish(laws, &external, start, &motion, given)
    }

    fn finish(
        &self,
        laws: &Laws,
        external: &ExternalAcceleration,
        last: SegmentPhase,
        motion: &RelativeMotion,
        given: ContactImpulse,
    ) -> Outcome {
        let phase = match last.phase {
            LocatedPhase::Unpressed if self.end.overlap <= 0.0 => LocatedPhase::Open,
            other => other,
        };
        let force = laws.normal_force(motion.overlap(), motion.closing());
        let reference = match phase.slip_sense() {
            Some(sense) => motion.tangential_displacement() - sense * laws.slip_compliance * force,
            None => last.reference,
        };
        let own = if phase.is_pressed() {
            self.inverse_mass * force
        } else {
            0.0
        };
        Outcome {
            phase,
            reference,
            closing_rate: lane(external.value + external.rate * self.step, 0) - own,
            given,
        }
    }

    /// Second derivatives of the cubic from the start to the end less what the contact's own force did.
    #[inline(always)]
    fn external_acceleration(&self) -> ExternalAcceleration {
        let (start, end, step) = (self.start, self.end, self.step);
        // Acceleration of lambda by a unit of tangential force: that of the centres and of both spins.
        let tangential_inverse_mass = (end.lever * end.lever + 2.0) * self.inverse_mass;
        let (normal, tangential) = (self.own.normal, self.own.tangential);
        let (along, across) = (self.inverse_mass, -tangential_inverse_mass);
        let reference = self.contact.reference;
        let before = [
            F64x2::new([start.overlap, start.tangential_displacement - reference]),
            F64x2::new([start.closing, start.sliding]) * step,
        ];
        let after = [
            F64x2::new([
                end.overlap + along * normal[1],
                end.tangential_displacement - reference + across * tangential[1],
            ]),
            F64x2::new([end.closing + along * normal[0], end.sliding + across * tangential[0]]) * step,
        ];
        let [first, last] = Cubic::new(before, after).bends_at_ends();
        let per_square = 1.0 / (step * step);
        ExternalAcceleration {
            value: first * per_square,
            rate: (last - first) * (per_square / step),
            inverse_masses: F64x2::new([self.inverse_mass, tangential_inverse_mass]),
        }
    }

    /// Adds the impulse of a segment up to the scaled time x, where its motion goes from the first to the second, and what is lost in
    /// the dashpot and given to the spring by slip.
    #[inline(always)]
    fn integrate(
        &self,
        laws: &Laws,
        segment: &Segment,
        [from, to]: [&RelativeMotion; 2],
        x: f64,
        given: &mut ContactImpulse,
    ) {
        let SegmentPhase { phase, reference, .. } = segment.start;
        if phase == LocatedPhase::Open {
            return;
        }
        if phase == LocatedPhase::Unpressed {
            let energy = |motion: &RelativeMotion| laws.normal.energy(motion.overlap().max(0.0));
            given.lost += energy(from) - energy(to);
            return;
        }
        let length = x * segment.span.length;
        if length <= 0.0 {
            return;
        }
        let cubic = Cubic::new([from.value, from.rate * length], [to.value, to.rate * length]);
        let (values, slopes) = (cubic.at_nodes(), cubic.slopes_at_nodes());
        for (i, node) in [0.5 - NODE, 0.5 + NODE].into_iter().enumerate() {
            let ([overlap, displacement], rates) = (values[i].to_array(), slopes[i] * (1.0 / length));
            let [closing, sliding] = rates.to_array();
            let span = 0.5 * length;
            let normal = laws.normal_force(overlap, closing);
            let tangential = match phase.slip_sense() {
                None => laws.tangential.force(displacement - reference),
                Some(sense) => {
                    let limit = laws.slip_share() * normal;
                    given.lost += span * limit * sense * sliding;
                    -sense * limit
                }
            };
            let forces = ContactForces {
                normal,
                tangential,
                overlap,
            };
            let time = segment.span.elapsed + node * length;
            let whole = time / self.step;
            let node = QuadratureNode {
                span,
                ahead: self.step - time,
                value: HermiteCubic::value(whole),
                slope: HermiteCubic::slope(whole),
            };
            given.add(self.frame, &forces, &node);
            given.lost += span * laws.normal.damping * closing * closing;
        }
    }
}

fn spring_energy(laws: &Laws, at: SegmentPhase, motion: &RelativeMotion) -> f64 {
    let force = laws.normal_force(motion.overlap(), motion.closing());
    laws.spring_energy(at.phase, motion.tangential_displacement() - at.reference, force)
}

fn slipping(sense: f64) -> LocatedPhase {
    if sense > 0.0 {
        LocatedPhase::SlipForward
    } else {
        LocatedPhase::SlipBackward
    }
}

/// The phase of a contact whose force begins.
///
/// A force that begins at zero holds the spring only if the limit of friction rises faster than the stretch.
fn closed_phase(laws: &Laws, motion: &RelativeMotion, from_zero: bool) -> SegmentPhase {
    let force = usize::from(from_zero);
    let outrun = motion.sliding().abs() > laws.slip_compliance * laws.normal.stiffness * motion.closing();
    let slips = !laws.has_friction() || (from_zero && outrun);
    SegmentPhase {
        phase: if slips {
            slipping(motion.sliding())
        } else {
            LocatedPhase::Stick
        },
        reference: motion.tangential_displacement(),
        roots: KnownRoots {
            force,
            yields: if slips { [0; 2] } else { [force; 2] },
            slip: 0,
        },
    }
}

/// The phase after an event.
fn next_phase(laws: &Laws, event: Event, before: SegmentPhase, motion: &mut RelativeMotion) -> SegmentPhase {
    match event {
        Event::Touch => {
            motion.value = F64x2::new([0.0, motion.tangential_displacement()]);
            closed_phase(laws, motion, laws.normal.damping == 0.0)
        }
        Event::Press => closed_phase(laws, motion, true),
        Event::Release => SegmentPhase {
            phase: if motion.overlap() > 0.0 {
                LocatedPhase::Unpressed
            } else {
                LocatedPhase::Open
            },
            reference: motion.tangential_displacement(),
            roots: KnownRoots {
                force: 1,
                ..KnownRoots::default()
            },
        },
        Event::Yield(sense) => SegmentPhase {
            phase: slipping(sense),
            reference: before.reference,
            roots: KnownRoots::default(),
        },
        Event::Hold => {
            let sense = before.phase.slip_sense().unwrap_or(1.0);
            let force = laws.normal_force(motion.overlap(), motion.closing());
            SegmentPhase {
                phase: LocatedPhase::Stick,
                reference: motion.tangential_displacement() - sense * laws.slip_compliance * force,
                roots: KnownRoots {
                    yields: if sense > 0.0 { [2, 0] } else { [0, 2] },
                    ..KnownRoots::default()
                },
            }
        }
    }
}
