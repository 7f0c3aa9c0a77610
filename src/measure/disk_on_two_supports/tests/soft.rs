//! What overlap and inertia of soft contacts do.

use std::f64::consts::FRAC_PI_2;

use super::*;

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

/// The kick by an independent computation: equilibria at two torques by elimination, their difference as the velocity, the
/// stop of the centre with its spin by four more equations.
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
            let [n_1, n_2, tau_1, tau_2] = solve([newton[0], newton[1], slides, torque], [0.0, 0.0, 0.0, -sense]);
            // Centre and spin: overlaps and the tangential spring of the contact that sticks follow the forces.
            let (r, k) = (setting.radius, stiffness);
            let (sticks, tau) = if setting.tilt > 0.0 {
                ([c_1, -s_1, r], tau_1)
            } else {
                ([c_2, s_2, r], tau_2)
            };
            let wound = -tau / setting.tangential_stiffness;
            let [x, y, spin] = solve([[s_1, c_1, 0.0], [-s_2, c_2, 0.0], sticks], [-n_1 / k, -n_2 / k, wound]);
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
