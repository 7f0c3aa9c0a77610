//! The theory against what does not share its formulas: a direct solution of the forces, numeric integration, limits.

mod slides;
mod soft;
mod statics;

use std::f64::consts::{FRAC_PI_4, FRAC_PI_6};

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
                let pivot = rows[column];
                for (entry, above) in rows[row].iter_mut().zip(pivot) {
                    *entry -= factor * above;
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
