//! Velocities of the base in the random-phase approximation against the corrected P 2.40 and its moments 2.43 to 2.46.

#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};

use jostle::drive::{AtRandomPhase, BaseMotion, Motion, RandomPhase, leaves_wall};
use rand::SeedableRng;
use rand_pcg::Pcg64;

const SAMPLES: usize = 200_000;
const RATIOS: [f64; 12] = [1e-4, 0.01, 0.1, 0.2, 0.2172, 0.25, 0.5, 0.8, 0.99, 1.0, 1.5, 20.0];

/// P 2.40 in the phase: between tau_B and tau_A the base is met with density `(cos tau + x) / (2 pi x)`.
///
/// tau_A = acos(-x) is where the line is tangent, tau_B where that line met the period before (x < 1).
fn visible(ratio: f64) -> (f64, f64) {
    if ratio >= 1.0 {
        return (-PI, PI);
    }
    let last = (-ratio).acos();
    let line = |tau: f64| tau.sin() + ratio * tau;
    let (mut low, mut high) = (-last, last);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if line(middle) < line(last) - TAU * ratio {
            low = middle
        } else {
            high = middle
        }
    }
    (high, last)
}

/// P(v_b <= v) for A omega = 1: the density `k (v + x) / (2 pi x sqrt(1 - v^2))` integrated, k = 2 where two phases have
/// the velocity v and both are visible, 1 where one is.
fn distribution(ratio: f64, (first, last): (f64, f64), v: f64) -> f64 {
    let integral = |v: f64| (ratio * v.clamp(-1.0, 1.0).asin() - (1.0 - v * v).max(0.0).sqrt()) / (TAU * ratio);
    // Phases from max(tau_B, 0) to tau_A have velocities from cos tau_A up; phases from tau_B to 0 from cos tau_B up.
    let part = |from: f64, to: f64| {
        if v > from {
            integral(v.min(to)) - integral(from)
        } else {
            0.0
        }
    };
    part(last.cos(), first.max(0.0).cos()) + if first < 0.0 { part(first.cos(), 1.0) } else { 0.0 }
}

fn samples(ratio: f64, seed: u64) -> Vec<f64> {
    let base = RandomPhase { peak_velocity: 1.0 };
    let mut generator = Pcg64::seed_from_u64(seed);
    (0..SAMPLES).map(|_| base.sample(&mut generator, -ratio, 1.0)).collect()
}

#[test]
fn the_corrected_density_is_normalised() {
    for ratio in RATIOS {
        assert!(
            (distribution(ratio, visible(ratio), 1.0) - 1.0).abs() < 1e-11 / ratio,
            "x = {ratio}"
        );
    }
}

/// Kolmogorov and Smirnov at the level 1e-4 of each of twelve seeded runs, so that one in a thousand suites would fail.
#[test]
fn histogram_matches_the_corrected_density() {
    for (seed, ratio) in (1_u64..).zip(RATIOS) {
        let mut velocities = samples(ratio, seed);
        velocities.sort_by(f64::total_cmp);
        let phases = visible(ratio);
        let count = SAMPLES as f64;
        let distance = velocities
            .iter()
            .enumerate()
            .map(|(i, v)| {
                let expected = distribution(ratio, phases, *v);
                (expected - i as f64 / count)
                    .abs()
                    .max((expected - (i + 1) as f64 / count).abs())
            })
            .fold(0.0, f64::max);
        assert!(
            distance < 2.23 / count.sqrt(),
            "x = {ratio}: {}",
            distance * count.sqrt()
        );
    }
}

/// Mean and mean square over the phase by Simpson's rule; beyond x = 1 they are 1/(2x) and 1/2 (P 2.45, 2.46).
#[test]
fn moments_of_the_random_phase_are_those_of_the_integral() {
    for (seed, ratio) in (100_u64..).zip(RATIOS) {
        let (first, last) = visible(ratio);
        let moment = |power: i32| {
            let intervals = 2_000;
            let step = (last - first) / f64::from(intervals);
            (0..=intervals)
                .map(|i| {
                    let weight = if i == 0 || i == intervals {
                        1.0
                    } else {
                        f64::from(2 + 2 * (i % 2))
                    };
                    let cosine = (first + f64::from(i) * step).cos();
                    weight * step / 3.0 * cosine.powi(power) * (cosine + ratio) / (TAU * ratio)
                })
                .sum::<f64>()
        };
        let (f, g) = (moment(1), moment(2));
        if ratio >= 1.0 {
            assert!((f - 0.5 / ratio).abs() < 1e-12 && (g - 0.5).abs() < 1e-12);
        }
        let velocities = samples(ratio, seed);
        let mean = |power: i32| velocities.iter().map(|v| v.powi(power)).sum::<f64>() / SAMPLES as f64;
        let error = |power: i32| ((mean(2 * power) - mean(power).powi(2)) / SAMPLES as f64).sqrt();
        assert!((mean(1) - f).abs() < 3.5 * error(1), "x = {ratio}: {} {f}", mean(1));
        assert!((mean(2) - g).abs() < 3.5 * error(2), "x = {ratio}: {} {g}", mean(2));
    }
}

/// At v_n -> 0 the base is met at its top: the mean falls like the square root of x.
#[test]
fn slow_disks_meet_the_base_at_its_top() {
    for ratio in [1e-4, 1e-6, 1e-8, 1e-12] {
        let mean = samples(ratio, 5).iter().sum::<f64>() / SAMPLES as f64;
        // sqrt(4 pi x U) averages two thirds of sqrt(4 pi x).
        assert!((mean / (2.0 / 3.0 * (4.0 * PI * ratio).sqrt()) - 1.0).abs() < 0.01 + 2.0 * ratio.sqrt());
    }
    assert!(samples(0.0, 5).iter().all(|v| *v == 0.0));
}

/// On a slope n_y scales the wall's amplitude; under a ceiling the base comes down.
#[test]
fn the_random_phase_holds_for_tilted_walls_and_ceilings() {
    let base = RandomPhase { peak_velocity: 0.3 };
    let draw = |base: RandomPhase, v_n: f64, up: f64| base.sample(&mut Pcg64::seed_from_u64(9), v_n, up);
    let flat = RandomPhase { peak_velocity: 0.15 };
    assert!((draw(base, -0.1, 0.5) - 2.0 * draw(flat, -0.1, 1.0)).abs() < 1e-15);
    assert_eq!(draw(base, -0.1, -1.0), -draw(base, -0.1, 1.0));
    assert_eq!(draw(RandomPhase { peak_velocity: 0.0 }, -0.1, 1.0), 0.0);
    assert_eq!(draw(base, -0.1, 0.0), 0.0);
}

/// Every draw lets the disk leave, equal seeds give equal draws, and a disk that never leaves is reported.
#[test]
fn draws_again_until_the_disk_leaves() {
    let base = RandomPhase { peak_velocity: 1.0 };
    let (mut generator, mut again) = (Pcg64::seed_from_u64(2), Pcg64::seed_from_u64(2));
    for i in 0..10_000 {
        let (e, v_n) = (0.01 * f64::from(i % 101), -1e-3 * 1e4_f64.powf(f64::from(i) / 1e4));
        let draw = |generator: &mut Pcg64| {
            base.sample_leaving(generator, v_n, 1.0, |v_b| leaves_wall(e, v_n, v_b, 1.0))
                .unwrap()
        };
        let v_b = draw(&mut generator);
        assert!(v_b - e * (v_n - v_b) > 0.0);
        assert_eq!(v_b, draw(&mut again));
    }
    assert_eq!(base.sample_leaving(&mut generator, 0.0, 1.0, |v_b| v_b > 0.0), None);
}

/// A draw is rejected if `v_b <= e_n v_n / (1 + e_n)`, whose probability is that of the corrected P 2.40. There are
/// none if `e_n x >= 1 + e_n`, as for most impacts of a disk that bounces well: `x` is some `1 / (1 - e_n)`.
#[test]
fn rejected_draws_are_as_frequent_as_the_density_says() {
    let impacts = 100_000_u32;
    for (seed, ratio) in (1..).zip([0.01, 0.2, 0.5, 1.0, 1.5, 3.0]) {
        for restitution in [0.0, 0.1, 0.5, 0.9] {
            let phase = RandomPhase { peak_velocity: 1.0 };
            let mut base = AtRandomPhase::new(phase, Pcg64::seed_from_u64(seed));
            for _ in 0..impacts {
                let leaves = |v_b: f64| leaves_wall(restitution, -ratio, v_b, 1.0);
                base.velocity_at_impact(Motion::default(), -ratio, 1.0, leaves).unwrap();
            }
            let slowest = -restitution * ratio / (1.0 + restitution);
            let rejected = distribution(ratio, visible(ratio), slowest);
            let draws = base.counts.draws as f64;
            let scatter = (rejected * (1.0 - rejected) / draws).sqrt();
            let found = base.counts.rejected as f64 / draws;
            assert!(
                (found - rejected).abs() <= 4.0 * scatter + 1e-12,
                "x {ratio}, e_n {restitution}: {found} for {rejected}"
            );
            assert_eq!(base.counts.draws - base.counts.rejected, u64::from(impacts));
        }
    }
}
