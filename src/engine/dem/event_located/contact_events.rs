//! A contact in a step in which its phase changes: the contact's own equation is solved segment by segment.
//!
//! What the other contacts, gravity and the rotation of the frame do to the relative motion is smooth: the motion at the
//! end of the step without the contact's own force gives the external acceleration as a line in time. Under it the
//! contact's own law is a linear equation in each phase, solved by its power series, whose roots are the events.

use super::contact_step::{ContactStep, Outcome};
use super::frame::{ContactFrame, HermiteCubic};
use super::impulse::{ContactForces, ContactImpulse, QuadratureNode};
use super::laws::Laws;
use super::polynomial::{LENGTH, Polynomial};
use super::state::LocatedPhase;

/// Segments of one step; what is beyond stays in the last phase. Grazing events could else alternate without end.
const MOST_SEGMENTS: usize = 12;

/// Nodes and weights of Gauss's rule with four nodes on 0 to 1.
const NODES: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Overlap and lambda, each with its rate.
#[derive(Clone, Copy)]
struct RelativeMotion {
    overlap: f64,
    closing: f64,
    tangential_displacement: f64,
    sliding: f64,
}

/// Accelerations of overlap and lambda without the contact's own force: value and slope in time.
struct ExternalAcceleration {
    normal: [f64; 2],
    tangential: [f64; 2],
}

/// Multiplicity of roots at the start of a segment that are known, since the segment begins there.
#[derive(Clone, Copy, Default)]
struct KnownRoots {
    /// Of the normal force.
    force: usize,
    /// Of the distance to the limit of friction, for positive and for negative stretch.
    yields: [usize; 2],
    /// Of the rate of slip.
    slip: usize,
}

/// Phase of a segment, lambda* in it, and what vanishes at its start.
#[derive(Clone, Copy)]
struct SegmentPhase {
    phase: LocatedPhase,
    reference: f64,
    roots: KnownRoots,
}

/// Overlap, lambda and normal force from an event to the end of the step, on the scaled time 0 to 1.
struct Segment {
    start: SegmentPhase,
    overlap: Polynomial,
    tangential_displacement: Polynomial,
    force: Polynomial,
    /// From the start of the step \[s\].
    elapsed: f64,
    /// \[s\]
    length: f64,
}

/// What ends a segment.
#[derive(Clone, Copy, PartialEq)]
enum Event {
    Touch,
    Release,
    Press,
    Yield(f64),
    Hold,
}

/// An event and the scaled time in its segment.
#[derive(Clone, Copy)]
struct Found {
    x: f64,
    event: Event,
}

impl<F: ContactFrame> ContactStep<'_, F> {
    /// Integrals over a step in which the phase changes, with the phase at its end.
    pub fn integrate_with_events(&self, laws: &Laws) -> Outcome {
        let external = self.external_acceleration();
        let mut motion = RelativeMotion {
            overlap: self.start.overlap,
            closing: self.start.closing,
            tangential_displacement: self.start.tangential_displacement,
            sliding: self.start.sliding,
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
            let segment = self.segment(laws, &external, &motion, start, elapsed);
            let found = if index < MOST_SEGMENTS {
                segment.first_event(laws)
            } else {
                None
            };
            let end = found.map_or(1.0, |found| found.x);
            self.integrate(laws, &segment, end, &mut given);
            motion = segment.motion(end);
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
            elapsed += x * segment.length;
            start = next_phase(laws, event, start, &mut motion);
            // An event at the very end leaves no time for a further segment, whose rates would be divided by zero.
            if elapsed >= self.step {
                break;
            }
        }
        self.finish(laws, start, motion, given)
    }

    fn finish(&self, laws: &Laws, last: SegmentPhase, motion: RelativeMotion, given: ContactImpulse) -> Outcome {
        let phase = match last.phase {
            LocatedPhase::Unpressed if self.end.overlap <= 0.0 => LocatedPhase::Open,
            other => other,
        };
        let force = laws.normal_force(motion.overlap, motion.closing);
        let reference = match phase.slip_sense() {
            Some(sense) => motion.tangential_displacement - sense * laws.slip_compliance * force,
            None => last.reference,
        };
        let own = if phase.is_pressed() {
            self.inverse_mass * force
        } else {
            0.0
        };
        let external = self.external_acceleration();
        Outcome {
            phase,
            reference,
            closing_rate: external.normal[0] + self.step * external.normal[1] - own,
            given,
        }
    }

    /// Acceleration of lambda by a unit of tangential force \[1/kg\]: that of the centres and of both spins.
    fn tangential_inverse_mass(&self) -> f64 {
        (self.end.lever * self.end.lever + 2.0) * self.inverse_mass
    }

    /// Second derivatives of the cubic from the start to the end less what the contact's own force did.
    fn external_acceleration(&self) -> ExternalAcceleration {
        let (start, end, step) = (self.start, self.end, self.step);
        let [from, to] = [HermiteCubic::bend(0.0), HermiteCubic::bend(1.0)];
        let line = |value: f64, slope: f64, end_value: f64, end_slope: f64| {
            let bend = |x: &HermiteCubic| x.of(value, step * slope, end_value, step * end_slope) / (step * step);
            let (first, last) = (bend(&from), bend(&to));
            [first, (last - first) / step]
        };
        let (normal, tangential) = (self.own.normal, self.own.tangential);
        let inverse_mass = self.tangential_inverse_mass();
        ExternalAcceleration {
            normal: line(
                start.overlap,
                start.closing,
                end.overlap + self.inverse_mass * normal[1],
                end.closing + self.inverse_mass * normal[0],
            ),
            tangential: line(
                start.tangential_displacement - self.contact.reference,
                start.sliding,
                end.tangential_displacement - self.contact.reference - inverse_mass * tangential[1],
                end.sliding - inverse_mass * tangential[0],
            ),
        }
    }

    /// Power series of `delta'' = a_n - N / m`, `lambda'' = a_t + 3 tau / m` in this phase, with external accelerations a.
    fn segment(
        &self,
        laws: &Laws,
        external: &ExternalAcceleration,
        motion: &RelativeMotion,
        start: SegmentPhase,
        elapsed: f64,
    ) -> Segment {
        let length = self.step - elapsed;
        let square = length * length;
        let line = |of: [f64; 2]| [square * (of[0] + of[1] * elapsed), square * of[1] * length];
        let (normal, tangential) = (line(external.normal), line(external.tangential));
        let (mut overlap, mut displacement, mut force) = ([0.0; LENGTH], [0.0; LENGTH], [0.0; LENGTH]);
        (overlap[0], overlap[1]) = (motion.overlap, length * motion.closing);
        (displacement[0], displacement[1]) = (motion.tangential_displacement, length * motion.sliding);
        let (per_normal, per_tangential) = (square * self.inverse_mass, square * self.tangential_inverse_mass());
        let (stiffness, damping) = (laws.normal.stiffness, laws.normal.damping / length);
        let pressed = start.phase.is_pressed();
        let share = -start.phase.slip_sense().unwrap_or(0.0) * laws.slip_share();
        for i in 0..LENGTH {
            if i + 1 < LENGTH {
                force[i] = stiffness * overlap[i] + damping * (i + 1) as f64 * overlap[i + 1];
            }
            if i + 2 < LENGTH {
                let (own_normal, own_tangential) = match start.phase {
                    _ if !pressed => (0.0, 0.0),
                    LocatedPhase::Stick => {
                        let stretch = displacement[i] - if i == 0 { start.reference } else { 0.0 };
                        (force[i], laws.tangential.force(stretch))
                    }
                    _ => (force[i], share * force[i]),
                };
                let (normal, tangential) = if i < 2 { (normal[i], tangential[i]) } else { (0.0, 0.0) };
                let divisor = ((i + 1) * (i + 2)) as f64;
                overlap[i + 2] = (normal - per_normal * own_normal) / divisor;
                displacement[i + 2] = (tangential + per_tangential * own_tangential) / divisor;
            }
        }
        Segment {
            start,
            overlap: Polynomial(overlap),
            tangential_displacement: Polynomial(displacement),
            force: Polynomial(force),
            elapsed,
            length,
        }
    }

    /// Adds the impulse of a segment up to the scaled time `end`, and what is lost in the dashpot and given to the spring by slip.
    fn integrate(&self, laws: &Laws, segment: &Segment, end: f64, given: &mut ContactImpulse) {
        let SegmentPhase { phase, reference, .. } = segment.start;
        if phase == LocatedPhase::Open {
            return;
        }
        if phase == LocatedPhase::Unpressed {
            let energy = |x: f64| laws.normal.energy(segment.overlap.at(x).max(0.0));
            given.lost += energy(0.0) - energy(end);
            return;
        }
        let (closing, sliding) = (
            segment.overlap.derivative(),
            segment.tangential_displacement.derivative(),
        );
        for (node, weight) in NODES {
            let x = node * end;
            let span = weight * end * segment.length;
            let time = segment.elapsed + x * segment.length;
            let (overlap, normal) = (segment.overlap.at(x), segment.force.at(x));
            let closing = closing.at(x) / segment.length;
            let tangential = match phase.slip_sense() {
                None => laws.tangential.force(segment.tangential_displacement.at(x) - reference),
                Some(sense) => {
                    let limit = laws.slip_share() * normal;
                    given.lost += span * limit * sense * sliding.at(x) / segment.length;
                    -sense * limit
                }
            };
            let forces = ContactForces {
                normal,
                tangential,
                overlap,
            };
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

impl Segment {
    fn motion(&self, x: f64) -> RelativeMotion {
        RelativeMotion {
            overlap: self.overlap.at(x),
            closing: self.overlap.derivative().at(x) / self.length,
            tangential_displacement: self.tangential_displacement.at(x),
            sliding: self.tangential_displacement.derivative().at(x) / self.length,
        }
    }

    /// The first change of phase.
    fn first_event(&self, laws: &Laws) -> Option<Found> {
        let SegmentPhase {
            phase,
            reference,
            roots,
        } = self.start;
        let earlier = |a: Option<Found>, b: Option<Found>| match (a, b) {
            (Some(a), Some(b)) => Some(if b.x < a.x { b } else { a }),
            (a, b) => a.or(b),
        };
        let when = |x: Option<f64>, event: Event| x.map(|x| Found { x, event });
        let release = || {
            let falling = self.force.mixed(-1.0, &self.force, 0.0);
            when(falling.first_rise(roots.force), Event::Release)
        };
        match phase {
            LocatedPhase::Open => when(self.overlap.first_rise(0), Event::Touch),
            LocatedPhase::Unpressed => when(self.force.first_rise(roots.force), Event::Press),
            LocatedPhase::Stick => {
                let stretch = self.tangential_displacement.raised(-reference);
                let yields = |sense: f64, roots: usize| {
                    let beyond = stretch.mixed(sense, &self.force, -laws.slip_compliance);
                    when(beyond.first_rise(roots), Event::Yield(sense))
                };
                let either = earlier(yields(1.0, roots.yields[0]), yields(-1.0, roots.yields[1]));
                earlier(release(), either)
            }
            LocatedPhase::SlipForward | LocatedPhase::SlipBackward => {
                let sense = phase.slip_sense()?;
                let hold = if laws.has_friction() {
                    let slip = self
                        .tangential_displacement
                        .mixed(-sense, &self.force, laws.slip_compliance)
                        .derivative();
                    when(slip.first_rise(roots.slip), Event::Hold)
                } else {
                    None
                };
                earlier(release(), hold)
            }
        }
    }
}

fn spring_energy(laws: &Laws, at: SegmentPhase, motion: &RelativeMotion) -> f64 {
    let force = laws.normal_force(motion.overlap, motion.closing);
    laws.spring_energy(at.phase, motion.tangential_displacement - at.reference, force)
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
    let outrun = motion.sliding.abs() > laws.slip_compliance * laws.normal.stiffness * motion.closing;
    let slips = !laws.has_friction() || (from_zero && outrun);
    SegmentPhase {
        phase: if slips {
            slipping(motion.sliding)
        } else {
            LocatedPhase::Stick
        },
        reference: motion.tangential_displacement,
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
            motion.overlap = 0.0;
            closed_phase(laws, motion, laws.normal.damping == 0.0)
        }
        Event::Press => closed_phase(laws, motion, true),
        Event::Release => SegmentPhase {
            phase: if motion.overlap > 0.0 {
                LocatedPhase::Unpressed
            } else {
                LocatedPhase::Open
            },
            reference: motion.tangential_displacement,
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
            let force = laws.normal_force(motion.overlap, motion.closing);
            SegmentPhase {
                phase: LocatedPhase::Stick,
                reference: motion.tangential_displacement - sense * laws.slip_compliance * force,
                roots: KnownRoots {
                    yields: if sense > 0.0 { [2, 0] } else { [0, 2] },
                    ..KnownRoots::default()
                },
            }
        }
    }
}
