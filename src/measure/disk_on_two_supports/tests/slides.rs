//! Slides and cycles under a harmonic torque.

use std::f64::consts::{PI, TAU};

use super::*;

/// Angular velocity of `I omega' = A sin(omega_e t) - friction`, friction the nearest to what stops the disk: RK4 on steps
/// cut where the sense changes. Mean over the last of `periods`.
fn integrate(setting: &Setting, limits: &Limits, torque: HarmonicTorque, periods: u32, steps: u32) -> f64 {
    let (inertia, step) = (setting.inertia(), TAU / torque.angular_frequency / f64::from(steps));
    let drive = |time: f64| torque.amplitude * (torque.angular_frequency * time).sin();
    let holds = |time: f64| (-limits.clockwise..=limits.counter_clockwise).contains(&drive(time));
    let (mut angle, mut velocity, mut at_last) = (0.0, 0.0_f64, 0.0);
    for index in 0..periods * steps {
        if index == (periods - 1) * steps {
            at_last = angle;
        }
        let (mut time, mut left) = (f64::from(index) * step, step);
        while left > 1e-14 * step {
            if velocity == 0.0 && holds(time) && holds(time + left) {
                break;
            }
            if velocity == 0.0 && holds(time) {
                // Rests until the torque passes a limit: bisect.
                let (mut low, mut high) = (0.0, left);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if holds(time + middle) {
                        low = middle
                    } else {
                        high = middle
                    }
                }
                (time, left) = (time + high, left - high);
                continue;
            }
            let sense = if velocity == 0.0 {
                drive(time).signum()
            } else {
                velocity.signum()
            };
            let friction = if sense > 0.0 {
                limits.counter_clockwise
            } else {
                -limits.clockwise
            };
            let gain = |t: f64| (drive(t) - friction) / inertia;
            // Simpson for the velocity, Runge-Kutta-Nystroem for the angle: the acceleration depends on time alone.
            let advance = |h: f64| {
                let (first, middle, last) = (gain(time), gain(time + 0.5 * h), gain(time + h));
                let turned = h * velocity + h * h / 6.0 * (first + 2.0 * middle);
                (turned, velocity + h / 6.0 * (first + 4.0 * middle + last))
            };
            let mut part = left;
            if advance(part).1 * sense < 0.0 {
                let (mut low, mut high) = (0.0, left);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if advance(middle).1 * sense > 0.0 {
                        low = middle
                    } else {
                        high = middle
                    }
                }
                part = high;
            }
            let (turned, faster) = advance(part);
            angle += turned;
            velocity = if part < left { 0.0 } else { faster };
            (time, left) = (time + part, left - part);
        }
    }
    (angle - at_last) * torque.angular_frequency / TAU
}

/// Amplitudes, as multiples of the upper limit, from the first slide to never resting.
const SHARES: [f64; 7] = [0.97, 1.02, 1.2, 1.7, 1.95, 2.2, 6.0];

#[test]
fn cycles_agree_with_integration() {
    for setting in settings().into_iter().filter(|s| s.tilt != 0.0) {
        let limits = limits(&setting);
        for share in SHARES {
            let torque = HarmonicTorque {
                amplitude: share * limits.upper(),
                angular_frequency: 3.0,
            };
            let found = cycle(&setting, &limits, torque);
            let integrated = integrate(&setting, &limits, torque, 40, 1500);
            let unit = torque.amplitude / (setting.inertia() * torque.angular_frequency);
            let error = (found.angular_velocity - integrated).abs() / unit;
            assert!(error < 1e-9, "{share} {error:e} {found:?} {integrated} {setting:?}");
        }
    }
}

#[test]
fn closed_form_is_the_cycle_in_its_range_and_nowhere_else() {
    for setting in settings() {
        let limits = limits(&setting);
        let most = closed_form_range(&limits);
        for share in [0.3, 0.9, 0.999, 1.001, 1.1, 2.0] {
            let torque = HarmonicTorque {
                amplitude: share * most,
                angular_frequency: 0.4,
            };
            let marched = cycle(&setting, &limits, torque);
            let unit = torque.amplitude / (setting.inertia() * torque.angular_frequency);
            match closed_form(&setting, &limits, torque) {
                Some(closed) => {
                    assert!(share < 1.0);
                    assert!(
                        (closed - marched.angular_velocity).abs() < 1e-13 * unit,
                        "{share} {setting:?}"
                    );
                }
                None => assert!(share > 1.0),
            }
        }
    }
    let untilted = limits(&Setting::THESIS);
    assert!((closed_form_range(&untilted) / untilted.upper() - (2.0 / PI).atan().sin().recip()).abs() < 1e-12);
}

/// Just above the limit the slide is a parabola in the phase: `(3 eps A)^2 / (2 A)`, `eps = A_e / A_S - 1`.
#[test]
fn slides_just_above_the_limit_keep_their_digits() {
    for excess in [1e-3, 1e-6, 1e-9] {
        let amplitude = 1.0 + excess;
        let found = slide(amplitude, 1.0, (1.0 / amplitude).asin());
        let wanted = 0.5 * (3.0 * excess) * (3.0 * excess);
        let tolerance = excess + 1e-15 / excess;
        assert!(
            (found.turn / wanted - 1.0).abs() < 3.0 * tolerance,
            "{excess} {} {wanted}",
            found.turn
        );
    }
}

/// A strong torque turns the disk forth for the share `A_S1 / (A_S1 + A_S2)` of each period.
#[test]
fn strong_torques_never_let_the_disk_rest() {
    let setting = Setting::THESIS.tilted(0.3);
    let limits = limits(&setting);
    for ratio in [10.0, 1e3, 1e6] {
        let torque = HarmonicTorque {
            amplitude: ratio * limits.upper(),
            angular_frequency: 2.0,
        };
        let found = cycle(&setting, &limits, torque);
        let share = limits.clockwise / (limits.clockwise + limits.counter_clockwise);
        let unit = torque.amplitude / (setting.inertia() * torque.angular_frequency);
        let asymptote = unit * (PI * (share - 0.5)).sin();
        assert_eq!(found.resting, 0.0);
        assert!((found.angular_velocity / asymptote - 1.0).abs() < 2.0 / (ratio * ratio) + 1e-9);
    }
}

#[test]
fn opposite_tilts_give_mirrored_cycles() {
    for setting in settings() {
        for share in SHARES {
            let torque = HarmonicTorque {
                amplitude: share * limits(&setting).upper(),
                angular_frequency: 3.0,
            };
            let here = cycle(&setting, &limits(&setting), torque).angular_velocity;
            let mirrored = setting.tilted(-setting.tilt);
            let there = cycle(&mirrored, &limits(&mirrored), torque).angular_velocity;
            let unit = torque.amplitude / (setting.inertia() * torque.angular_frequency);
            assert!((here + there).abs() < 1e-13 * unit);
            assert!(here * setting.tilt >= 0.0, "5.2: positive tilt, positive rotation");
        }
    }
}
