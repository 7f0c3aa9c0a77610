//! Restitution of the dashpot law against an integration that shares nothing with it.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::collision::{Dashpot, TabulatedDashpot};
use support::impact_propagator::{Material, Propagator};
use support::reference_impact::Impact;

const STIFFNESS_RATIOS: [f64; 9] = [0.01, 0.05, 0.1, 1.0 / 3.0, 0.773, 1.0, 3.0, 10.0, 100.0];
const FRICTIONS: [f64; 5] = [0.01, 0.05, 0.1, 0.4, 1.0];
const DAMPING_RATIOS: [f64; 9] = [
    0.0,
    1e-6,
    0.0335,
    0.2,
    0.5,
    std::f64::consts::FRAC_1_SQRT_2,
    0.95,
    1.0,
    1.2,
];

/// Unit mass and stiffness, so that velocities and times are those of the reference.
fn law(damping_ratio: f64, stiffness_ratio: f64, friction: f64) -> Dashpot {
    Dashpot::of_damping_ratio(1.0, damping_ratio, 1.0, stiffness_ratio, friction).unwrap()
}

/// 0.001 to 100 evenly in the logarithm, not on round numbers, and the round ones in between.
fn ratios() -> Vec<f64> {
    let mut ratios: Vec<f64> = (0..=30).map(|i| 1e-3 * 1e5_f64.powf(f64::from(i) / 30.0)).collect();
    ratios.extend([0.01, 0.1, 0.3, 0.6, 1.0, 3.0, 10.0]);
    ratios
}

#[test]
fn normal_restitution_to_twelve_digits() {
    let near_critical = [1e-3, 1e-4, 1.01e-4, 0.99e-4, 1e-5, 1e-6, 1e-8, 1e-12];
    let mut all: Vec<f64> = (0..=120).map(|i| f64::from(i) * 0.01).collect();
    all.extend(near_critical.iter().flat_map(|d| [1.0 - d, 1.0 + d]));
    for c in all {
        let difference = law(c, 1.0, 0.1).normal_restitution(1.0) - Propagator::normal_restitution(c);
        assert!(difference.abs() < 1e-12, "c = {c}: {difference:e}");
    }
}

/// Every material of the grid at every ratio, and the bounds that no impact may break.
#[test]
fn tangential_restitution_to_ten_digits() {
    let (mut worst, mut count) = (0.0_f64, 0);
    for kappa in STIFFNESS_RATIOS {
        for mu in FRICTIONS {
            for c in DAMPING_RATIOS {
                let law = law(c, kappa, mu);
                let reference = Propagator::new(Material {
                    damping_ratio: c,
                    stiffness_ratio: kappa,
                    friction: mu,
                    mobility: 3.0,
                });
                for ratio in ratios() {
                    let restitution = law.tangential_restitution(1.0, 1.0 / 3.0, ratio);
                    let expected = reference.velocities_after(ratio).1 / ratio;
                    let error = (restitution - expected).abs();
                    assert!(
                        error < 1e-10,
                        "kappa {kappa}, mu {mu}, c {c}, ratio {ratio}: {restitution} {expected}"
                    );
                    assert!(restitution.abs() <= 1.0);
                    worst = worst.max(error);
                    count += 1;
                }
            }
        }
    }
    println!("{count} impacts, largest error {worst:.1e}");
    assert_eq!(count, 9 * 5 * 9 * 38);
}

/// Materials and ratios off the grid, wider than it: switches that graze, tangential springs that switch ninety times.
fn scan_random_impacts(materials: u32, seed: u64) {
    let mut state = seed;
    let mut between = |low: f64, high: f64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low * (high / low).powf((state >> 11) as f64 / (1_u64 << 53) as f64)
    };
    let mut worst = 0.0_f64;
    for number in 0..materials {
        let material = Material {
            damping_ratio: if number % 5 == 0 { 0.0 } else { between(1e-4, 3.0) },
            stiffness_ratio: between(3e-3, 3e2),
            friction: between(3e-3, 3.0),
            mobility: between(1.5, 5.0),
        };
        let law = law(material.damping_ratio, material.stiffness_ratio, material.friction);
        let reference = Propagator::new(material);
        for _ in 0..10 {
            let ratio = material.friction * between(1e-3, 1e3);
            let restitution = law.tangential_restitution(1.0, 1.0 / material.mobility, ratio);
            let error = restitution - reference.velocities_after(ratio).1 / ratio;
            assert!(
                error.abs() * ratio.min(1.0) < 1e-11,
                "{material:?} ratio {ratio}: {restitution}, {error:e}"
            );
            worst = worst.max(error.abs() * ratio.min(1.0));
        }
    }
    println!("{materials} materials, largest error {worst:.1e}");
}

#[test]
fn random_materials_have_the_restitution_of_the_reference() {
    scan_random_impacts(1_000, 11);
}

#[test]
#[ignore = "minutes: the same, many more"]
fn many_random_materials_have_the_restitution_of_the_reference() {
    scan_random_impacts(100_000, 12);
}

/// Balls: another inertia factor is another mobility, nothing else.
#[test]
fn any_inertia_factor_has_the_restitution_of_the_reference() {
    for kappa in [0.1, 1.0, 30.0] {
        let reference = Propagator::new(Material {
            damping_ratio: 0.1,
            stiffness_ratio: kappa,
            friction: 0.3,
            mobility: 3.5,
        });
        for ratio in ratios() {
            let expected = reference.velocities_after(ratio).1 / ratio;
            let restitution = law(0.1, kappa, 0.3).tangential_restitution(1.0, 1.0 / 3.5, ratio);
            assert!((restitution - expected).abs() < 1e-10);
        }
    }
}

/// The Runge-Kutta reference of the molecular dynamics, a third way.
#[test]
fn agrees_with_the_runge_kutta_impact() {
    for (kappa, mu, damping, ratio) in [(0.773, 0.1, 0.07, 0.4), (10.0, 0.3, 0.02, 0.7), (0.1, 0.2, 0.0, 5.0)] {
        let impact = Impact {
            mass: 1.0,
            normal_stiffness: 1.0,
            normal_damping: damping,
            tangential_stiffness: kappa,
            friction: mu,
            normal_velocity: -1.0,
            tangential_velocity: ratio,
        };
        let (normal, tangential) = impact.velocities_after(20_000);
        let law = Dashpot::new(1.0, damping, kappa, mu).unwrap();
        assert!((law.normal_restitution(1.0) - normal.abs()).abs() < 1e-10);
        assert!((law.tangential_restitution(1.0, 1.0 / 3.0, ratio) - tangential / ratio).abs() < 1e-9);
    }
}

/// The stated bound of the table, over all ratios and beyond the grid's ends.
#[test]
fn table_keeps_its_bound() {
    let mut worst = 0.0_f64;
    for kappa in STIFFNESS_RATIOS {
        for mu in [0.01, 0.1, 1.0] {
            for c in [0.0, 1e-6, 0.0335, 0.5, 1.0, 1.2] {
                let law = law(c, kappa, mu);
                let table = TabulatedDashpot::new(law, &[1.0], 0.5);
                assert!(
                    table.pieces() < 400,
                    "kappa {kappa}, mu {mu}, c {c}: {} pieces",
                    table.pieces()
                );
                for i in 0..=2_000 {
                    let ratio = 1e-5 * 1e10_f64.powf((f64::from(i) + 0.37) / 2_000.0);
                    let looked_up = table.tangential_restitution(1.0, ratio).unwrap();
                    let error = (looked_up - law.tangential_restitution(1.0, 1.0 / 3.0, ratio)).abs();
                    assert!(error < 1e-6, "kappa {kappa}, mu {mu}, c {c}, ratio {ratio}: {error:e}");
                    worst = worst.max(error);
                }
            }
        }
    }
    println!("largest error of the table {worst:.1e}");
}
