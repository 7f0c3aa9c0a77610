//! Corners, limits, regimes and mean torques of rigid contacts.

use std::f64::consts::PI;

use super::*;

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
    // P 5.2.2 and 5.2.3: 0.115 slides in both senses at all tilts, 0.113 does at 0.1 pi, where 0.100 does not slide.
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

#[test]
fn what_is_no_setting_is_refused() {
    let message = |setting: Setting| setting.checked().unwrap_err().to_string();
    let good = Setting::THESIS;
    assert!(good.checked().is_ok());
    assert!(message(Setting { gravity: -1.0, ..good }).starts_with("gravity = -1"));
    assert!(message(Setting { mass: f64::NAN, ..good }).starts_with("disk.mass = NaN"));
    assert!(message(Setting { friction: -0.1, ..good }).contains("from 0"));
    assert!(
        message(Setting {
            half_angle: 2.0,
            ..good
        })
        .contains("pi/6")
    );
    assert!(message(good.tilted(0.6)).contains("rolls off"));
    assert!(relaxed(&good, 1.0, 1.0).is_err() && relaxed(&good, f64::NAN, 1.0).is_err());
    assert!(relaxed(&good, 1e3, 0.0).is_err());
}
