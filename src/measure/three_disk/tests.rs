//! The theory against what does not share its formulas: a direct solution of the forces, numeric integration, limits.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, FRAC_PI_6, PI, TAU};

use super::*;

/// Settings that differ in everything, all below detachment.
fn settings() -> Vec<Setting> {
    let mut found = Vec::new();
    for (half_angle, friction) in [
        (FRAC_PI_6, 0.1),
        (FRAC_PI_6, 0.3),
        (FRAC_PI_4, 0.6),
        (1.2, 1.5),
        (0.2, 0.02),
    ] {
        let setting = Setting {
            gravity: 9.81,
            mass: 0.3,
            radius: 0.7,
            half_angle,
            friction,
            tangential_stiffness: 4e5,
            tilt: 0.0,
        };
        let most = detachment_tilt(&setting);
        found.extend([-0.9, -0.3, 0.0, 0.5, 0.95].map(|share| setting.tilted(share * most)));
    }
    found
}

const ACCELERATIONS: [Acceleration; 3] = [
    Acceleration { x: 0.0, y: 0.0 },
    Acceleration { x: 0.2, y: -0.4 },
    Acceleration { x: -0.1, y: 1.1 },
];

/// Solves a linear system by elimination with pivots.
fn solve<const N: usize>(mut rows: [[f64; N]; N], mut right: [f64; N]) -> [f64; N] {
    for column in 0..N {
        let pivot = (column..N).max_by(|&i, &j| rows[i][column].abs().total_cmp(&rows[j][column].abs()));
        rows.swap(column, pivot.unwrap());
        right.swap(column, pivot.unwrap());
        for row in 0..N {
            if row != column {
                let factor = rows[row][column] / rows[column][column];
                for k in 0..N {
                    rows[row][k] -= factor * rows[column][k];
                }
                right[row] -= factor * right[column];
            }
        }
    }
    std::array::from_fn(|i| right[i] / rows[i][i])
}

/// n1, n2, tau1, tau2 from Newton's equations 4.23, 4.24 and two more rows, no algebra done by hand.
fn forces(setting: &Setting, acceleration: Acceleration, closures: [[f64; 4]; 2]) -> [f64; 4] {
    let (s_1, c_1) = setting.left_angle().sin_cos();
    let (s_2, c_2) = setting.right_angle().sin_cos();
    let newton = [[s_1, -s_2, c_1, c_2], [c_1, c_2, -s_1, s_2]];
    let right = [
        setting.mass * acceleration.x,
        setting.mass * (setting.gravity + acceleration.y),
        0.0,
        0.0,
    ];
    solve([newton[0], newton[1], closures[0], closures[1]], right)
}

/// Rows that say what a corner is.
fn closures(corner: Corner, mu: f64) -> [[f64; 4]; 2] {
    let saturated = |sign_1: f64, sign_2: f64| [[-sign_1 * mu, 0.0, 1.0, 0.0], [0.0, -sign_2 * mu, 0.0, 1.0]];
    match corner {
        Corner::S1 => saturated(1.0, 1.0),
        Corner::S2 => saturated(-1.0, -1.0),
        Corner::T1 => saturated(-1.0, 1.0),
        Corner::T2 => saturated(1.0, -1.0),
        Corner::D1 => [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
        Corner::D2 => [[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]],
    }
}

#[test]
fn corners_are_where_the_forces_say() {
    for setting in settings() {
        for acceleration in ACCELERATIONS {
            for corner in Corner::ALL {
                let [n_1, n_2, tau_1, tau_2] = forces(&setting, acceleration, closures(corner, setting.friction));
                let found = point(&setting, acceleration, corner);
                let unit = 2.0 * setting.tangential_stiffness * setting.radius;
                let wanted = (-(tau_1 + tau_2) / unit, (tau_2 - tau_1) / unit);
                let size = 1e-12 * (tau_1.abs() + tau_2.abs() + setting.weight()) / unit;
                assert!((found.departure - wanted.0).abs() < size, "{corner:?} {setting:?}");
                assert!((found.stretch - wanted.1).abs() < size, "{corner:?} {setting:?}");
                let tangential = found.forces(&setting);
                let (left, right) = normal_forces(&setting, acceleration, tangential);
                assert!((left - n_1).abs() + (right - n_2).abs() < 1e-11 * setting.weight().max(tau_1.abs()));
                assert_eq!(
                    Point::from_forces(&setting, tangential).departure as f32,
                    found.departure as f32
                );
            }
        }
    }
}

/// The second lines of 4.41, 4.43, 4.47 and 4.49, which print writes without W.
#[test]
fn corners_agree_with_the_other_printed_form() {
    for setting in settings() {
        let (mu, g) = (setting.friction, setting.gravity);
        let (s_0, c_0) = setting.half_angle.sin_cos();
        let (s_t, c_t) = setting.tilt.sin_cos();
        let unit = mu * setting.weight() / (2.0 * setting.tangential_stiffness * setting.radius);
        for Acceleration { x, y } in ACCELERATIONS {
            let (x, y) = (x / g, y / g);
            let both = 1.0 + mu * mu;
            let (plus, minus) = (1.0 + mu * x + y, 1.0 - mu * x + y);
            let (less, more) = (mu - x + mu * y, mu + x + mu * y);
            let sideways = x * c_t + (1.0 + y) * s_t;
            let down = (1.0 + y) * c_t - x * s_t;
            let printed = [
                (
                    Corner::S1,
                    -(plus * c_t + less * s_t) / (both * c_0),
                    -(plus * s_t - less * c_t) / (both * s_0),
                ),
                (
                    Corner::S2,
                    (minus * c_t - more * s_t) / (both * c_0),
                    (minus * s_t + more * c_t) / (both * s_0),
                ),
                (Corner::T1, sideways / (s_0 - mu * c_0), down / (c_0 + mu * s_0)),
                (Corner::T2, -sideways / (s_0 + mu * c_0), -down / (c_0 - mu * s_0)),
            ];
            let acceleration = Acceleration { x: x * g, y: y * g };
            for (corner, departure, stretch) in printed {
                let found = point(&setting, acceleration, corner);
                let size = 1e-12 * unit * (1.0 + departure.abs() + stretch.abs());
                assert!(
                    (found.departure - unit * departure).abs() < size,
                    "{corner:?} {setting:?}"
                );
                assert!((found.stretch - unit * stretch).abs() < size, "{corner:?} {setting:?}");
            }
        }
    }
}

#[test]
fn margins_vanish_at_corners_and_are_positive_between() {
    let vanishing = [
        (Corner::S1, [1, 2]),
        (Corner::S2, [0, 3]),
        (Corner::T1, [0, 2]),
        (Corner::T2, [1, 3]),
    ];
    for setting in settings() {
        for acceleration in ACCELERATIONS {
            let jams = setting.friction * setting.half_angle.tan() >= 1.0;
            if jams || setting.friction >= detachment_friction(&setting, acceleration) {
                continue;
            }
            let corners = vanishing.map(|(corner, which)| (point(&setting, acceleration, corner), which));
            let size = 1e-12 * setting.weight();
            for (corner, which) in corners {
                let margins = amonton_margins(&setting, acceleration, corner);
                for (i, margin) in margins.into_iter().enumerate() {
                    assert!(if which.contains(&i) {
                        margin.abs() < size
                    } else {
                        margin > size
                    });
                }
            }
            let mean = |of: fn(&Point) -> f64| corners.iter().map(|(p, _)| of(p)).sum::<f64>() / 4.0;
            let inside = Point {
                departure: mean(|p| p.departure),
                stretch: mean(|p| p.stretch),
            };
            assert!(
                amonton_margins(&setting, acceleration, inside)
                    .iter()
                    .all(|&m| m > size)
            );
        }
    }
}

#[test]
fn limits_are_the_printed_ones() {
    for setting in settings() {
        let (sine, cosine) = setting.tilt.sin_cos();
        let unit = Limits::untilted(&setting);
        let found = limits(&setting);
        assert!((found.clockwise / (unit * (cosine + setting.friction * sine)) - 1.0).abs() < 1e-12);
        assert!((found.counter_clockwise / (unit * (cosine - setting.friction * sine)) - 1.0).abs() < 1e-12);
    }
    // P 5.2.2 and 5.2.3: 0.115 slides both ways at all tilts, 0.113 does at 0.1 pi, where 0.100 does not slide.
    let setting = Setting::THESIS;
    let highest = limits(&setting.tilted(0.1_f64.atan())).clockwise;
    assert!(highest < 0.115 && Limits::untilted(&setting) > 0.113);
    assert!(limits(&setting.tilted(0.1 * PI)).clockwise < 0.113);
    assert!(limits(&setting.tilted(0.1 * PI)).counter_clockwise > 0.1);
    // But 0.100 is not below A_S2 at all tilts, as P 5.2.2 has it: it slides in the last half degree before detachment.
    assert!(critical_tilt(&setting, 0.1).unwrap() < detachment_tilt(&setting) - 8e-3);
    let detaching = limits(&setting.tilted(detachment_tilt(&setting) - 1e-12));
    assert!(detaching.counter_clockwise < 0.0996);
}

/// At the detachment tilt the slide that pulls a contact most takes its last normal force.
#[test]
fn a_contact_opens_at_the_detachment_tilt() {
    for setting in settings() {
        let most = detachment_tilt(&setting);
        for (tilt, corner, which) in [(most, Corner::S2, 1), (-most, Corner::S1, 0)] {
            let at = |tilt| {
                forces(
                    &setting.tilted(tilt),
                    Acceleration::default(),
                    closures(corner, setting.friction),
                )
            };
            assert!(at(tilt)[which].abs() < 1e-12 * setting.weight());
            assert!(at(0.99 * tilt)[which] > 0.0 && at(1.01 * tilt)[which] < 0.0);
        }
    }
}

/// The friction at which the smaller normal force of S1 and S2 vanishes, by bisection on the forces.
#[test]
fn friction_of_detachment_with_accelerations() {
    for setting in settings() {
        for acceleration in ACCELERATIONS {
            let least = |friction: f64| {
                let [of_1, of_2] = [Corner::S1, Corner::S2].map(|corner| {
                    forces(
                        &Setting { friction, ..setting },
                        acceleration,
                        closures(corner, friction),
                    )
                });
                of_1[0].min(of_1[1]).min(of_2[0]).min(of_2[1])
            };
            let found = detachment_friction(&setting, acceleration);
            let (mut low, mut high) = (0.0, 100.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if least(middle) > 0.0 {
                    low = middle
                } else {
                    high = middle
                }
            }
            assert!(
                (found - low).abs() < 1e-10 * (1.0 + low),
                "{found} {low} {setting:?} {acceleration:?}"
            );
        }
    }
}

#[test]
fn regimes_follow_the_diagram_of_the_thesis() {
    let setting = Setting::THESIS;
    let unit = Limits::untilted(&setting);
    let most = detachment_tilt(&setting);
    let along = |share: f64| -> Vec<Regime> {
        let mut found: Vec<Regime> = (0..1000)
            .map(|i| regime(&setting.tilted(f64::from(i) / 1000.0 * most), share * unit))
            .collect();
        found.dedup();
        found
    };
    use Regime::{Bidirectional, None, Unidirectional};
    // P 5.2.1: lines of constant amplitude from below A_S2(theta_D) to above the largest A_S1, at tan(theta_T) = mu.
    let highest = 0.1_f64.hypot(1.0);
    assert_eq!(along(0.85), [None]);
    assert_eq!(along(0.93), [None, Unidirectional]);
    assert_eq!(along(0.98), [None, Unidirectional, Bidirectional]);
    assert_eq!(
        along(0.5 * (1.0 + highest)),
        [Bidirectional, Unidirectional, Bidirectional]
    );
    assert_eq!(along(highest * (1.0 + 1e-6)), [Bidirectional]);
    assert_eq!(regime(&setting.tilted(most), 0.1), Regime::Detaching);
    for share in [0.9, 0.95, 0.99] {
        let tilt = critical_tilt(&setting, share * unit).unwrap();
        assert!((limits(&setting.tilted(tilt)).counter_clockwise / (share * unit) - 1.0).abs() < 1e-12);
    }
    assert_eq!(critical_tilt(&setting, 1.2 * unit), Some(0.0));
    assert_eq!(critical_tilt(&setting, 0.5 * unit), Option::None);
}

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
fn without_tilt_or_with_the_other_tilt_the_mirror_image_comes_out() {
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

#[test]
fn mean_torques_are_the_printed_ones_with_t1_and_t2_swapped_back() {
    for setting in settings() {
        let (mu, weight) = (setting.friction, setting.weight() * setting.radius);
        let (s_0, c_0) = setting.half_angle.sin_cos();
        let (s_t, c_t) = setting.tilt.sin_cos();
        let found = mean_torques(&setting);
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * weight * (1.0 + b.abs() / weight), "{a} {b}");
        close(found.s1, weight * mu * (c_t + mu * s_t) / ((1.0 + mu * mu) * c_0));
        close(found.s2, -weight * mu * (c_t - mu * s_t) / ((1.0 + mu * mu) * c_0));
        close(found.t2, weight * mu * s_t / (s_0 + mu * c_0));
        close(found.t1, -weight * mu * s_t / (s_0 - mu * c_0));
        // P 5.21 as printed.
        let tangent = s_0 / c_0;
        let numerator = mu * mu * (mu * mu + (1.0 + mu * mu) * (2.0 * setting.half_angle).cos()) * s_t / c_0.powi(3);
        close(
            found.all(),
            weight * numerator / (2.0 * (1.0 + mu * mu) * (mu * mu - tangent * tangent)),
        );
        assert!(found.sliding_together() * setting.tilt >= 0.0);
        // Torque of the forces themselves.
        let [_, _, tau_1, tau_2] = forces(&setting, Acceleration::default(), closures(Corner::T1, mu));
        close(found.t1, setting.radius * (tau_1 + tau_2));
    }
    assert!(mean_torques(&Setting::THESIS.tilted(0.1)).all() < 0.0);
}

/// Soft contacts tend to rigid ones as 1 / k_n, with the slope of the first-order estimate in the docs without friction.
#[test]
fn soft_limits_tend_to_rigid_ones() {
    for setting in settings() {
        let rigid = limits(&setting);
        let arms = 2.0 * setting.radius;
        let off = |units: f64| {
            let soft = relaxed(&setting, units * setting.weight() / arms, setting.radius).unwrap();
            let found = soft.limits();
            (
                found.clockwise / rigid.clockwise - 1.0,
                found.counter_clockwise / rigid.counter_clockwise - 1.0,
            )
        };
        let (near, far) = (off(1e4), off(1e6));
        assert!(
            (near.0 / far.0 / 100.0 - 1.0).abs() < 0.05,
            "{near:?} {far:?} {setting:?}"
        );
        assert!(
            (near.1 / far.1 / 100.0 - 1.0).abs() < 0.05,
            "{near:?} {far:?} {setting:?}"
        );
        assert!(near.0.abs() < 1e-2);
    }
    // Slippery and upright: n = m g / (2 cos theta_0), d(ln n) = tan^2(theta_0) n / (k_n arms).
    let setting = Setting {
        friction: 1e-4,
        ..Setting::THESIS
    };
    let normal = 0.5 / FRAC_PI_6.cos();
    let soft = relaxed(&setting, 1e5, 1.0).unwrap().limits();
    let shift = soft.clockwise / limits(&setting).clockwise - 1.0;
    assert!((shift / (normal / 2e5 / 3.0) - 1.0).abs() < 1e-2, "{shift}");
}

/// The kick by a path of its own: equilibria at two torques by elimination, their difference as the velocity, the stop of
/// the centre with its spin by four more equations.
#[test]
fn kicks_stop_the_centre() {
    let stiffness = 1e3;
    for setting in settings().into_iter().filter(|s| s.tilt != 0.0) {
        for (corner, sense) in [(Corner::S2, 1.0), (Corner::S1, -1.0)] {
            let slope = -sense * setting.friction;
            // One contact slides, the weaker one; the torque grows by one unit a second.
            let slides = if setting.tilt > 0.0 {
                [0.0, -slope, 0.0, 1.0]
            } else {
                [-slope, 0.0, 1.0, 0.0]
            };
            let (s_1, c_1) = setting.left_angle().sin_cos();
            let (s_2, c_2) = setting.right_angle().sin_cos();
            let newton = [[s_1, -s_2, c_1, c_2], [c_1, c_2, -s_1, s_2]];
            let torque = [0.0, 0.0, setting.radius, setting.radius];
            let [n_1, n_2, ..] = solve([newton[0], newton[1], slides, torque], [0.0, 0.0, 0.0, -sense]);
            // Centre and spin: overlaps follow the forces, the other contact sticks.
            let (r, k) = (setting.radius, stiffness);
            let sticks = if setting.tilt > 0.0 {
                [c_1, -s_1, r]
            } else {
                [c_2, s_2, r]
            };
            let [x, y, spin] = solve([[s_1, c_1, 0.0], [-s_2, c_2, 0.0], sticks], [-n_1 / k, -n_2 / k, 0.0]);
            // Impulses N_1, N_2 with friction stop x and y; the spin that is left is the third unknown.
            let m = setting.mass;
            let rows = [
                [s_1 + slope * c_1, -s_2 + slope * c_2, 0.0],
                [c_1 - slope * s_1, c_2 + slope * s_2, 0.0],
                [r * slope, r * slope, -setting.inertia()],
            ];
            let [_, _, left] = solve(rows, [-m * x, -m * y, -setting.inertia() * spin]);
            let found = inertia::kick(&setting, stiffness, corner);
            assert!(
                (found - sense * left).abs() < 1e-12 * left.abs().max(1e-3 / k),
                "{found} {left} {setting:?}"
            );
        }
    }
}

/// The forces at a soft corner, put into the equations by hand at the angles that the overlaps give.
#[test]
fn soft_corners_balance() {
    let setting = Setting::THESIS.tilted(0.25);
    let soft = relaxed(&setting, 300.0, 0.6).unwrap();
    for corner in [Corner::S1, Corner::S2, Corner::T1, Corner::T2] {
        let Tangential { left, right } = soft.point(corner).forces(&setting);
        let mu = setting.friction;
        let (n_1, n_2) = (left.abs() / mu, right.abs() / mu);
        // Triangle of centres: the supports stay where rigid disks would touch them.
        let (r_1, r_2) = (1.6 - n_1 / 300.0, 1.6 - n_2 / 300.0);
        let base = 3.2 * setting.half_angle.sin();
        let along = (r_1 * r_1 - r_2 * r_2 + base * base) / (2.0 * base);
        let height = (r_1 * r_1 - along * along).sqrt();
        let alpha_1 = FRAC_PI_2 - height.atan2(along) - setting.tilt;
        let alpha_2 = FRAC_PI_2 - height.atan2(base - along) + setting.tilt;
        let (tau_1, tau_2) = (left * 1.6 / r_1, right * 1.6 / r_2);
        let x = n_1 * alpha_1.sin() - n_2 * alpha_2.sin() + tau_1 * alpha_1.cos() + tau_2 * alpha_2.cos();
        let y = n_1 * alpha_1.cos() + n_2 * alpha_2.cos() - tau_1 * alpha_1.sin() + tau_2 * alpha_2.sin();
        assert!(
            x.abs() < 1e-9 && (y - setting.weight()).abs() < 1e-9,
            "{corner:?} {x} {y}"
        );
    }
}

#[test]
fn what_is_no_setting_is_refused() {
    let told = |setting: Setting| setting.checked().unwrap_err().to_string();
    let good = Setting::THESIS;
    assert!(good.checked().is_ok());
    assert!(told(Setting { gravity: -1.0, ..good }).starts_with("gravity = -1"));
    assert!(told(Setting { mass: f64::NAN, ..good }).starts_with("disk.mass = NaN"));
    assert!(told(Setting { friction: -0.1, ..good }).contains("from 0"));
    assert!(
        told(Setting {
            half_angle: 2.0,
            ..good
        })
        .contains("pi/6")
    );
    assert!(told(good.tilted(0.6)).contains("rolls off"));
    assert!(relaxed(&good, 1.0, 1.0).is_err() && relaxed(&good, f64::NAN, 1.0).is_err());
    assert!(relaxed(&good, 1e3, 0.0).is_err());
}
