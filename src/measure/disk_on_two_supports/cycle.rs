//! Mean angular velocity under a slow harmonic torque of any amplitude, by marching from slide to slide.
//!
//! A slide ends at rest. If the torque is then within its limits the disk rests until it passes one, and what happened
//! before is forgotten; if it is beyond the limit of the other sense the next slide begins at once. When the disk never
//! rests, the slides of both senses share the period so that friction has no mean,
//!
//! `D_2 A_S2 = D_1 A_S1`, `D_1 + D_2 = 2 pi`, and the counter-clockwise one has its middle at
//! `sin(mid) = A_S2 D_2 / (2 A_e sin(D_2 / 2))`, which makes its speed vanish at both ends.

use crate::elementary::{asin, sin};
use std::f64::consts::{PI, TAU};

use super::slide::{HarmonicTorque, slide};
use super::{Limits, Setting};

/// The periodic motion of the disk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Mean angular velocity \[rad/s\].
    pub angular_velocity: f64,
    /// Share of the time for which the disk rests.
    pub resting: f64,
}

/// Slides after which a disk that has not rested never will; each makes the memory of the first shorter.
const MOST_SLIDES: u32 = 10_000;

/// The periodic motion under `torque` between these `limits`, which must be positive.
///
/// The limits may be those of rigid contacts, [`super::limits`], or of soft ones, [`super::Relaxed`].
pub fn cycle(setting: &Setting, limits: &Limits, torque: HarmonicTorque) -> Cycle {
    let (turn, phase, resting) = if torque.amplitude <= limits.lower() {
        (0.0, TAU, TAU)
    } else if let Some(turn) = without_rest(limits, torque.amplitude) {
        (turn, TAU, 0.0)
    } else {
        with_rests(limits, torque.amplitude)
    };
    Cycle {
        // Angle over time: turn / (I omega_e^2) in phase / omega_e.
        angular_velocity: turn / (setting.inertia() * torque.angular_frequency * phase),
        resting: resting / phase,
    }
}

/// `I omega_e^2` times the angle turned in a period, if the disk never rests.
fn without_rest(limits: &Limits, amplitude: f64) -> Option<f64> {
    let (clockwise, counter_clockwise) = (limits.clockwise, limits.counter_clockwise);
    let forth = TAU * clockwise / (clockwise + counter_clockwise);
    let middle_sine = counter_clockwise * forth / (2.0 * amplitude * sin(0.5 * forth));
    if middle_sine.abs() > 1.0 {
        return None;
    }
    let middle = PI - asin(middle_sine);
    let (begin, end) = (middle - 0.5 * forth, middle + 0.5 * forth);
    // It must set off at once, in both senses.
    if amplitude * sin(begin) < counter_clockwise || -amplitude * sin(end) < clockwise {
        return None;
    }
    let forward = slide(amplitude, counter_clockwise, begin);
    let back = slide(amplitude, clockwise, end - PI);
    Some(forward.turn - back.turn)
}

/// The same, with the phase that it takes and the phase spent at rest, if the disk rests now and then.
fn with_rests(limits: &Limits, amplitude: f64) -> (f64, f64, f64) {
    let mut march = March::from_rest(limits, amplitude);
    // Every start from rest is at one of two phases, one for each sense. From one to its next recurrence is a cycle.
    let mut starts: [Option<March<'_>>; 2] = [None, None];
    starts[usize::from(march.counter_clockwise)] = Some(march.clone());
    let mut begin = march.clone();
    for count in 0..MOST_SLIDES {
        if count == MOST_SLIDES - 2 {
            begin = march.clone();
        }
        march.slide();
        if march.rest() {
            let start = &mut starts[usize::from(march.counter_clockwise)];
            if let Some(earlier) = start {
                begin = earlier.clone();
                break;
            }
            *start = Some(march.clone());
        }
    }
    let of_cycle = |read: fn(&March<'_>) -> f64| read(&march) - read(&begin);
    (of_cycle(|m| m.turn), of_cycle(|m| m.phase), of_cycle(|m| m.resting))
}

/// A disk at rest at this phase and about to slide.
#[derive(Clone)]
struct March<'a> {
    limits: &'a Limits,
    amplitude: f64,
    phase: f64,
    counter_clockwise: bool,
    turn: f64,
    resting: f64,
}

impl<'a> March<'a> {
    /// Starts where the torque passes the lower limit.
    fn from_rest(limits: &'a Limits, amplitude: f64) -> Self {
        let counter_clockwise = limits.counter_clockwise <= limits.clockwise;
        let begin = asin(limits.lower() / amplitude);
        Self {
            limits,
            amplitude,
            phase: if counter_clockwise { begin } else { PI + begin },
            counter_clockwise,
            turn: 0.0,
            resting: 0.0,
        }
    }

    /// Until the disk is at rest.
    fn slide(&mut self) {
        let (resistance, sign, shift) = if self.counter_clockwise {
            (self.limits.counter_clockwise, 1.0, 0.0)
        } else {
            (self.limits.clockwise, -1.0, PI)
        };
        let start = (self.phase - shift).rem_euclid(TAU);
        let slide = slide(self.amplitude, resistance, start);
        self.phase += slide.duration;
        self.turn += sign * slide.turn;
    }

    /// Until the torque passes a limit; whether that took any time. Sets the sense of the next slide.
    fn rest(&mut self) -> bool {
        let torque = self.amplitude * sin(self.phase);
        if torque > self.limits.counter_clockwise || torque < -self.limits.clockwise {
            self.counter_clockwise = torque > 0.0;
            return false;
        }
        let wait = |limit: f64, shift: f64| {
            if self.amplitude <= limit {
                return f64::INFINITY;
            }
            let begin = asin(limit / self.amplitude) + shift;
            (begin - self.phase).rem_euclid(TAU)
        };
        let forth = wait(self.limits.counter_clockwise, 0.0);
        let back = wait(self.limits.clockwise, PI);
        self.counter_clockwise = forth <= back;
        self.phase += forth.min(back);
        self.resting += forth.min(back);
        true
    }
}
