//! Tangential motion during an impact of the linear dashpot with a tangential spring: phases of stick and slip, each in
//! closed form, joined at their exact instants (P 4.5.2 with the corrections below).
//!
//! Units as in `oscillator`, and the stretch z of the spring in those of the overlap. With `rho = m_eff / alpha` (3 for disks):
//! ```text
//! stick:  z' = u,  u' = -Omega^2 z,  Omega^2 = rho kappa      while  kappa |z| < mu N
//! slip:   kappa z = s mu N,  u = u_0 + s rho mu (v - v_0)     while  kappa s u > mu N'
//! ```
//! since `u' = -s rho mu N` and `N = -v'`. In the printed recipe (4.76 to 4.79) an impact that starts to slide is taken
//! to slide throughout, which creates energy; here every switch is found. The first one for certain:
//! - slip: `kappa s u - mu N'` is a constant plus a damped oscillation, whose turning points are known in closed form
//!   (at most one within a contact), so that every piece between them has one root at most;
//! - stick: with `f'' >= -B` until the end of the contact, `f` has no root before that of the parabola
//!   `f + f' h - B h^2 / 2`. Stepping from root to root of such parabolas never passes the first root and converges to
//!   it like Newton's method. A phase of stick that follows slip starts at a double root (`f = f' = 0`, `f'' > 0`);
//!   there `f''' >= -B_3` gives the first step `3 f'' / B_3`.

use super::oscillator::{Normal, Oscillator};
use crate::elementary::{hypot, powi, sin_cos};
use crate::geometry::bracketed_root::falling_root;

/// What decides the tangential motion, all without dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TangentialSpring {
    /// kappa = k_t / k_n.
    pub stiffness_ratio: f64,
    /// mu.
    pub friction: f64,
    /// rho = m_eff / alpha = 1 + m_eff (R_1^2/I_1 + R_2^2/I_2): 3 for disks, 3.5 for balls.
    pub mobility: f64,
}

/// Stick and slip of one kind of impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StickSlip {
    spring: TangentialSpring,
    pub normal: Oscillator,
    /// Omega.
    frequency: f64,
}

/// How an impact ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outcome {
    /// u_t' / |u_n|.
    pub velocity: f64,
    /// Number that differs between different sequences of stick and slip.
    pub sequence: u64,
}

/// Start of a phase: time, stretch and velocity of the spring.
#[derive(Debug, Clone, Copy)]
struct Start {
    time: f64,
    stretch: f64,
    velocity: f64,
}

/// `f = mu N - s kappa z` and its rate.
#[derive(Debug, Clone, Copy)]
struct Margin {
    value: f64,
    rate: f64,
}

/// A stiff spring switches some `Omega` times; the shortest stick is about 1e-7 of a contact. Never reached in tests.
const MOST_PHASES: usize = 10_000;
/// Steps from parabola to parabola within one phase; grazing takes the most, some hundred.
const MOST_STEPS: usize = 2_000;

/// Appends a phase to the number that identifies a sequence.
fn next_in(sequence: u64, phase: u64) -> u64 {
    sequence.wrapping_mul(1_000_003).wrapping_add(phase)
}

impl Margin {
    /// Largest step without a root, given `f'' >= -bound`.
    #[inline]
    fn safe_step(self, bound: f64) -> f64 {
        let root = (self.rate * self.rate + 2.0 * bound * self.value.max(0.0)).sqrt();
        if self.rate < 0.0 {
            2.0 * self.value.max(0.0) / (root - self.rate)
        } else {
            (self.rate + root) / bound
        }
    }
}

impl StickSlip {
    pub fn new(spring: TangentialSpring, normal: Oscillator) -> Self {
        let frequency = (spring.mobility * spring.stiffness_ratio).sqrt();
        Self {
            spring,
            normal,
            frequency,
        }
    }

    /// `rho mu (1 + e_n)`: what sliding from touch to end takes off the ratio |u_t / u_n| (P 4.74).
    pub fn full_slide(&self) -> f64 {
        self.spring.mobility * self.spring.friction * (1.0 + self.normal.restitution)
    }

    /// Velocity of the surfaces after an impact at `ratio` = |u_t / u_n|, finite and not negative.
    pub fn after(&self, ratio: f64) -> Outcome {
        let mut start = Start {
            time: 0.0,
            stretch: 0.0,
            velocity: ratio,
        };
        let mut sequence = 1;
        // Only without damping is there no force at touch, and only then may the surfaces slide from the start (P 4.76).
        let mut sliding = self.normal.damping == 0.0 && self.spring.stiffness_ratio * ratio > self.spring.friction;
        let mut sense = 1.0;
        for _ in 0..MOST_PHASES {
            if !sliding {
                match self.stick(&mut start) {
                    Some(slides) => sense = slides,
                    None => break,
                }
                sequence = next_in(sequence, if sense > 0.0 { 1 } else { 2 });
            }
            if !self.slip(&mut start, sense) {
                break;
            }
            sliding = false;
            sequence = next_in(sequence, 3);
        }
        Outcome {
            velocity: start.velocity,
            sequence,
        }
    }

    /// Sticks until the spring slips and returns the sense of the slip, or until the contact ends.
    fn stick(&self, start: &mut Start) -> Option<f64> {
        let TangentialSpring {
            stiffness_ratio: kappa,
            friction: mu,
            ..
        } = self.spring;
        let omega = self.frequency;
        let amplitude = hypot(start.stretch, start.velocity / omega);
        let (mut time, mut stretch, mut velocity) = (start.time, start.stretch, start.velocity);
        let mut normal = self.normal.at(time);
        for step in 0..MOST_STEPS {
            let force_rate = self.normal.force_rate(normal);
            let margin = |sense: f64| Margin {
                value: mu * normal.force - sense * kappa * stretch,
                rate: mu * force_rate - sense * kappa * velocity,
            };
            // Solutions of the damped oscillation keep y^2 + y'^2 from growing: a bound on N'' and N''' from now on.
            let curvature = -normal.force - 2.0 * self.normal.damping * force_rate;
            let later = hypot(curvature, -force_rate - 2.0 * self.normal.damping * curvature);
            let bound = mu * later + kappa * omega * omega * amplitude;
            let limits = [margin(1.0), margin(-1.0)];
            let steps = limits.map(|limit| limit.safe_step(bound));
            let nearer = if steps[0] <= steps[1] { 1.0 } else { -1.0 };
            let mut length = steps[0].min(steps[1]);
            if step == 0 {
                if start.time > 0.0 {
                    // The side just left is at a double root; the other one is not.
                    let (left, other) = if stretch > 0.0 {
                        (1.0, steps[1])
                    } else {
                        (-1.0, steps[0])
                    };
                    let jerk = mu * later + kappa * powi(omega, 3) * amplitude;
                    let leaving = 3.0 * (mu * curvature + left * kappa * omega * omega * stretch) / jerk;
                    length = length.max(leaving.min(other));
                }
                // Whatever rounding makes of a degenerate start, each phase advances; f moves by less than rounding.
                length = length.max(1e-7 / (1.0 + omega));
            } else if limits[0].value <= 0.0 || limits[1].value <= 0.0 || time + length <= time {
                let sense = if limits[0].value <= limits[1].value { 1.0 } else { -1.0 };
                *start = Start {
                    time,
                    stretch,
                    velocity,
                };
                return Some(if time + length <= time { nearer } else { sense });
            }
            time = (time + length).min(self.normal.duration);
            normal = self.normal.at(time);
            let (sine, cosine) = sin_cos(omega * (time - start.time));
            stretch = start.stretch * cosine + start.velocity / omega * sine;
            velocity = start.velocity * cosine - start.stretch * omega * sine;
            if time >= self.normal.duration {
                *start = Start {
                    time,
                    stretch,
                    velocity,
                };
                return None;
            }
        }
        *start = Start {
            time,
            stretch,
            velocity,
        };
        Some(stretch.signum())
    }

    /// Slips in one sense until the spring sticks and returns true, or until the contact ends.
    fn slip(&self, start: &mut Start, sense: f64) -> bool {
        let TangentialSpring {
            stiffness_ratio: kappa,
            friction: mu,
            mobility: rho,
        } = self.spring;
        let c = self.normal.damping;
        let first = self.normal.at(start.time);
        let excess = rho * kappa - 1.0;
        let wave = |normal: Normal| mu * (excess * normal.velocity + 2.0 * c * normal.force);
        let wave_rate = |normal: Normal| mu * (2.0 * c * normal.velocity - (excess + 4.0 * c * c) * normal.force);
        let constant = kappa * (sense * start.velocity - rho * mu * first.velocity);
        let slides = |time: f64| {
            let normal = self.normal.at(time);
            (constant + wave(normal), wave_rate(normal))
        };
        let end = self.normal.duration;
        let turn = self.normal.turns_after(wave(first), wave_rate(first));
        let turn = turn.map_or(end, |delay| (start.time + delay).min(end));
        let mut low = (start.time, slides(start.time).0);
        for time in [turn, end] {
            let high = (time, slides(time).0);
            if high.1 < 0.0 && high.1 < low.1 {
                let time = if low.1 > 0.0 {
                    falling_root(low.0, high.0, slides)
                } else {
                    low.0
                };
                let normal = self.normal.at(time);
                *start = Start {
                    time,
                    stretch: sense * mu * normal.force / kappa,
                    velocity: start.velocity + sense * rho * mu * (normal.velocity - first.velocity),
                };
                return true;
            }
            low = high;
        }
        *start = Start {
            time: end,
            stretch: 0.0,
            velocity: start.velocity - sense * rho * mu * (self.normal.restitution + first.velocity),
        };
        false
    }
}
