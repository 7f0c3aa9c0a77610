//! The motion of one contact in one phase, from an event to the next: a power series in time, whose roots are events.
//!
//! Under an external acceleration that is a line in time the contact's own law is a linear equation in each phase:
//! `delta'' = a_n - N / m`, `lambda'' = a_t + tau / m_t`, with N of delta and its rate, and tau of the stretch while sticking,
//! of N while slipping.

use crate::engine::dem::two_lanes::{F64x2, lane};

use super::laws::Laws;
use super::polynomial::{LENGTH, Polynomial};
use super::state::LocatedPhase;

/// Overlap and lambda \[m\] in lanes, and their rates.
#[derive(Clone, Copy)]
pub struct RelativeMotion {
    /// delta, lambda \[m\].
    pub value: F64x2,
    /// \[m/s\]
    pub rate: F64x2,
}

impl RelativeMotion {
    /// delta \[m\].
    pub fn overlap(&self) -> f64 {
        lane(self.value, 0)
    }

    /// Its rate \[m/s\].
    pub fn closing(&self) -> f64 {
        lane(self.rate, 0)
    }

    /// lambda \[m\].
    pub fn tangential_displacement(&self) -> f64 {
        lane(self.value, 1)
    }

    /// Its rate \[m/s\].
    pub fn sliding(&self) -> f64 {
        lane(self.rate, 1)
    }
}

/// Accelerations of overlap and lambda without the contact's own force \[m/s2\], a line in time from the start of the step.
#[derive(Clone, Copy)]
pub struct ExternalAcceleration {
    /// At the start of the step.
    pub value: F64x2,
    /// Its rate \[m/s3\].
    pub rate: F64x2,
    /// Accelerations by a unit of normal and of tangential force \[1/kg\].
    pub inverse_masses: F64x2,
}

/// Multiplicity of roots at the start of a segment that are known, since the segment begins there.
#[derive(Clone, Copy, Default)]
pub struct KnownRoots {
    /// Of the normal force.
    pub force: usize,
    /// Of the distance to the limit of friction, for positive and for negative stretch.
    pub yields: [usize; 2],
    /// Of the rate of slip.
    pub slip: usize,
}

/// Phase of a segment, lambda* in it, and what vanishes at its start.
#[derive(Clone, Copy)]
pub struct SegmentPhase {
    /// The phase.
    pub phase: LocatedPhase,
    /// lambda* \[m\].
    pub reference: f64,
    /// What vanishes at the start.
    pub roots: KnownRoots,
}

/// What ends a segment.
#[derive(Clone, Copy, PartialEq)]
pub enum Event {
    /// The bodies meet.
    Touch,
    /// The force ends.
    Release,
    /// A force that was cut off begins.
    Press,
    /// The spring begins to slip, with a stretch of this sign.
    Yield(f64),
    /// The slip ends.
    Hold,
}

/// An event and the scaled time in its segment.
#[derive(Clone, Copy)]
pub struct Found {
    /// 0 at the start of the segment, 1 at the end of the step.
    pub x: f64,
    /// What happens.
    pub event: Event,
}

/// Time from the start of the step \[s\] at which a segment begins, and from there to the end of the step \[s\].
#[derive(Clone, Copy)]
pub struct Span {
    /// \[s\]
    pub elapsed: f64,
    /// \[s\]
    pub length: f64,
}

/// Motion from an event to the end of the step, unless another event comes first.
pub struct Segment {
    /// How it starts.
    pub start: SegmentPhase,
    /// When.
    pub span: Span,
    /// Power series of overlap and stretch on the scaled time 0 to 1.
    series: [F64x2; LENGTH],
}

/// 1 / ((i + 1) (i + 2)) and 1 / (i + 2).
const PER_VALUE: [f64; 6] = [1.0 / 2.0, 1.0 / 6.0, 1.0 / 12.0, 1.0 / 20.0, 1.0 / 30.0, 1.0 / 42.0];
const PER_SLOPE: [f64; 6] = [1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0];

impl Segment {
    /// The segment that begins so.
    #[inline(always)]
    pub fn new(
        laws: &Laws,
        external: &ExternalAcceleration,
        motion: &RelativeMotion,
        start: SegmentPhase,
        span: Span,
    ) -> Self {
        let Span { elapsed, length } = span;
        let square = length * length;
        let mut series = [F64x2::splat(0.0); LENGTH];
        series[0] = motion.value - F64x2::new([0.0, start.reference]);
        series[1] = motion.rate * length;
        series[2] = (external.value + external.rate * elapsed) * (0.5 * square);
        series[3] = external.rate * (square * length * (1.0 / 6.0));
        let inverse = external.inverse_masses * square;
        let (stiffness, damping) = (laws.normal.stiffness, laws.normal.damping / length);
        match start.phase {
            LocatedPhase::Open | LocatedPhase::Unpressed => {}
            LocatedPhase::Stick => {
                let per_value = inverse * F64x2::new([stiffness, laws.tangential.stiffness]);
                let per_slope = inverse * F64x2::new([damping, 0.0]);
                for i in 0..LENGTH - 2 {
                    series[i + 2] =
                        series[i + 2] - per_value * PER_VALUE[i] * series[i] - per_slope * PER_SLOPE[i] * series[i + 1];
                }
            }
            LocatedPhase::SlipForward | LocatedPhase::SlipBackward => {
                let sense = start.phase.slip_sense().unwrap_or(0.0);
                let inverse = inverse * F64x2::new([1.0, sense * laws.slip_share()]);
                let (per_value, per_slope) = (inverse * stiffness, inverse * damping);
                let overlap = |of: F64x2| F64x2::splat(lane(of, 0));
                for i in 0..LENGTH - 2 {
                    series[i + 2] = series[i + 2]
                        - per_value * PER_VALUE[i] * overlap(series[i])
                        - per_slope * PER_SLOPE[i] * overlap(series[i + 1]);
                }
            }
        }
        Self { start, span, series }
    }

    /// Motion at the scaled time x.
    #[inline(always)]
    pub fn motion(&self, x: f64) -> RelativeMotion {
        let (mut value, mut slope) = (self.series[LENGTH - 1], F64x2::splat(0.0));
        for coefficient in self.series[..LENGTH - 1].iter().rev() {
            slope = slope * x + value;
            value = value * x + *coefficient;
        }
        RelativeMotion {
            value: value + F64x2::new([0.0, self.start.reference]),
            rate: slope * (1.0 / self.span.length),
        }
    }

    /// Normal force.
    #[inline(always)]
    fn force(&self, laws: &Laws) -> Polynomial {
        let (stiffness, damping) = (laws.normal.stiffness, laws.normal.damping / self.span.length);
        // The last coefficient would need a further one of the overlap.
        Polynomial(std::array::from_fn(|i| {
            let slope = if i + 1 < LENGTH {
                (i + 1) as f64 * lane(self.series[i + 1], 0)
            } else {
                return 0.0;
            };
            stiffness * lane(self.series[i], 0) + damping * slope
        }))
    }

    /// The first change of phase.
    #[inline(always)]
    pub fn first_event(&self, laws: &Laws) -> Option<Found> {
        let SegmentPhase { phase, roots, .. } = self.start;
        let when = |x: Option<f64>, event: Event| x.map(|x| Found { x, event });
        match phase {
            LocatedPhase::Open => {
                let gap = Polynomial(std::array::from_fn(|i| -lane(self.series[i], 0)));
                when(gap.first_fall(0), Event::Touch)
            }
            LocatedPhase::Unpressed => {
                let force = self.force(laws);
                let missing = Polynomial(force.0.map(|coefficient| -coefficient));
                when(missing.first_fall(roots.force), Event::Press)
            }
            LocatedPhase::Stick => {
                let force = self.force(laws);
                let yields = |sense: f64, roots: usize| {
                    let room = Polynomial(std::array::from_fn(|i| {
                        laws.slip_compliance * force.0[i] - sense * lane(self.series[i], 1)
                    }));
                    when(room.first_fall(roots), Event::Yield(sense))
                };
                let either = earlier(yields(1.0, roots.yields[0]), yields(-1.0, roots.yields[1]));
                earlier(when(force.first_fall(roots.force), Event::Release), either)
            }
            LocatedPhase::SlipForward | LocatedPhase::SlipBackward => {
                let force = self.force(laws);
                let release = when(force.first_fall(roots.force), Event::Release);
                if !laws.has_friction() {
                    return release;
                }
                let sense = phase.slip_sense()?;
                let slip = Polynomial(std::array::from_fn(|i| {
                    if i + 1 < LENGTH {
                        let slope = sense * lane(self.series[i + 1], 1) - laws.slip_compliance * force.0[i + 1];
                        (i + 1) as f64 * slope
                    } else {
                        0.0
                    }
                }));
                earlier(release, when(slip.first_fall(roots.slip), Event::Hold))
            }
        }
    }
}

#[inline(always)]
fn earlier(a: Option<Found>, b: Option<Found>) -> Option<Found> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.x < a.x { b } else { a }),
        (a, b) => a.or(b),
    }
}
