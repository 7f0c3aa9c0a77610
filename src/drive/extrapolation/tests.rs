use std::f64::consts::TAU;

use super::*;

fn sine(time: f64) -> [f64; 3] {
    let (sine, cosine) = (TAU * time).sin_cos();
    [sine, TAU * cosine, -TAU * TAU * sine]
}

/// The first `values` values of `motion`; the others are not given.
fn sample(time: f64, motion: [f64; 3], values: usize) -> InputSample {
    let given = |index: usize| if index < values { motion[index] } else { 0.0 };
    InputSample {
        time,
        values: std::array::from_fn(given),
    }
}

/// Polynomials of a candidate's degree are continued exactly, whatever the distances of the samples.
#[test]
fn candidates_continue_polynomials_of_their_degree() {
    let times = [-1.3, -0.8, -0.5, -0.45, -0.1, 0.0];
    for candidate in CANDIDATES {
        let degree = candidate.coefficients() as i32 - 1;
        let motion = |t: f64| {
            let powers = |factor: fn(i32) -> i32, less: i32| -> f64 {
                (less..=degree)
                    .map(|power| f64::from(factor(power)) * t.powi(power - less))
                    .sum()
            };
            [powers(|_| 1, 0), powers(|n| n, 1), powers(|n| n * (n - 1), 2)]
        };
        let samples = times.map(|time| sample(time, motion(time), 3));
        let newton = Newton::through(&samples, candidate.values, candidate.coefficients());
        for (found, exact) in newton.expanded().at(0.3).into_iter().zip(motion(0.3)) {
            assert!(
                (found - exact).abs() < 1e-9 * (1.0 + exact.abs()),
                "{candidate:?}: {found} {exact}"
            );
        }
    }
}

#[test]
fn every_candidate_has_an_index_of_its_own() {
    for (index, Candidate { points, values }) in CANDIDATES.into_iter().enumerate() {
        assert_eq!(index_of(points, values), index);
        assert!(index == 0 || CANDIDATES[index - 1].coefficients() <= points * values);
    }
}

/// Largest error of value and acceleration on a unit sine, over the amplitudes, after two periods.
fn error_on_a_sine(samples_a_period: u32, values: usize, degree: Degree) -> [f64; 2] {
    let step = 1.0 / f64::from(samples_a_period);
    let mut history = InputHistory::default();
    let mut worst = [0.0_f64; 2];
    for number in 0..4 * samples_a_period {
        let time = f64::from(number) * step;
        history.record(sample(time, sine(time), values));
        if number > 2 * samples_a_period {
            let found = history
                .extrapolate(time + step, degree)
                .expect("there are samples")
                .at(time + step);
            let exact = sine(time + step);
            worst[0] = worst[0].max((found[0] - exact[0]).abs());
            worst[1] = worst[1].max((found[2] - exact[2]).abs() / TAU.powi(2));
        }
    }
    worst
}

/// Errors worked out by hand for the polynomials of degree five: displacement over amplitude.
#[test]
fn a_sine_is_followed_with_degree_five() {
    for (samples, two_values, three_values) in [(8, 1.9e-2, 4.9e-3), (16, 3.1e-4, 8.0e-5), (25, 2.2e-5, 5.5e-6)] {
        for (values, expected) in [(2, two_values), (3, three_values)] {
            for degree in [Degree::Automatic, Degree::AtMost(5)] {
                let [error, _] = error_on_a_sine(samples, values, degree);
                assert!(
                    error < 1.05 * expected,
                    "{samples} samples, {values} values, {degree:?}: {error:e}"
                );
            }
        }
    }
}

#[test]
fn an_error_of_degree_k_falls_as_the_power_k_plus_one() {
    for (values, degree, order) in [
        (1, 0, 1.0),
        (2, 1, 2.0),
        (3, 2, 3.0),
        (2, 3, 4.0),
        (1, 4, 5.0),
        (3, 5, 6.0),
    ] {
        let [coarse, _] = error_on_a_sine(40, values, Degree::AtMost(degree));
        let [fine, _] = error_on_a_sine(80, values, Degree::AtMost(degree));
        let found = (coarse / fine).log2();
        assert!((found - order).abs() < 0.2, "degree {degree}: {found}");
    }
}

#[test]
fn a_step_does_not_overshoot() {
    let step = |number: u32| [if number < 10 { 0.0 } else { 1.0 }, 0.0, 0.0];
    let mut history = InputHistory::default();
    for number in 0..30 {
        let time = f64::from(number);
        history.record(sample(time, step(number), 3));
        let found = history
            .extrapolate(time + 1.0, Degree::Automatic)
            .expect("there are samples");
        assert!(found.at(time + 1.0)[0] <= 1.0 + 1e-12, "sample {number}: {found:?}");
    }
}

/// A ramp that stops, with and without its rate.
#[test]
fn a_stop_overshoots_no_more_than_a_linear_prediction() {
    for values in 1..=2 {
        let ramp = |number: u32| {
            if number < 20 {
                [f64::from(number), 1.0, 0.0]
            } else {
                [20.0, 0.0, 0.0]
            }
        };
        let [found, linear] = errors_beside_linear(values, 60, ramp, ramp);
        assert!(found <= linear + 1e-9, "{values} values: {found} {linear}");
    }
}

/// Linear prediction of the same samples: `x + h v`, or through two samples where no rate is given.
fn linear(samples: &[InputSample], values: usize, time: f64) -> f64 {
    let last = samples[samples.len() - 1];
    let slope = match (values, samples.len()) {
        (2.., _) => last.values[1],
        (_, 1) => 0.0,
        (_, count) => (last.values[0] - samples[count - 2].values[0]) / (last.time - samples[count - 2].time),
    };
    last.values[0] + (time - last.time) * slope
}

/// Largest errors of the automatic and of the linear prediction of `truth`, where `input` is what is sampled.
fn errors_beside_linear(
    values: usize,
    steps: u32,
    truth: impl Fn(u32) -> [f64; 3],
    input: impl Fn(u32) -> [f64; 3],
) -> [f64; 2] {
    let (mut history, mut samples, mut worst) = (InputHistory::default(), Vec::new(), [0.0_f64; 2]);
    for number in 0..steps {
        let time = f64::from(number);
        let taken = sample(time, input(number), values);
        history.record(taken);
        samples.push(taken);
        let found = history
            .extrapolate(time + 1.0, Degree::Automatic)
            .expect("there are samples")
            .at(time + 1.0)[0];
        let exact = truth(number + 1)[0];
        worst[0] = worst[0].max((found - exact).abs());
        worst[1] = worst[1].max((linear(&samples, values, time + 1.0) - exact).abs());
    }
    worst
}

/// A sine of 25 samples a period.
fn slow_sine(number: u32) -> [f64; 3] {
    let [value, slope, curvature] = sine(f64::from(number) / 25.0);
    [value, slope / 25.0, curvature / 625.0]
}

#[test]
fn a_missing_sample_does_less_harm_than_to_a_linear_prediction() {
    for values in 1..=3 {
        for missing in 40..65 {
            let input = |number: u32| slow_sine(if number == missing { number - 1 } else { number });
            let [found, linear] = errors_beside_linear(values, 90, slow_sine, input);
            assert!(
                found <= linear,
                "{values} values, sample {missing} missing: {found} {linear}"
            );
        }
    }
}

/// Two equal samples beside a crest are no stop.
#[test]
fn a_crest_between_two_samples_is_followed() {
    for samples in [26, 30, 34, 50] {
        let motion = |number: u32| {
            // A half step off, so that crests are between samples; rounded, so that these are equal bit by bit.
            let [value, ..] =
                sine((f64::from(number) + 0.5) / f64::from(samples) + if samples % 4 == 2 { 0.0 } else { 0.25 });
            [(value * 1e12).round() / 1e12, 0.0, 0.0]
        };
        let mut history = InputHistory::default();
        for number in 0..4 * samples {
            let time = f64::from(number);
            history.record(sample(time, motion(number), 1));
            let found = history
                .extrapolate(time + 1.0, Degree::Automatic)
                .expect("there are samples")
                .at(time + 1.0)[0];
            let error = (found - motion(number + 1)[0]).abs();
            assert!(
                number < 2 * samples || error < 2e-3,
                "{samples} samples, number {number}: {error:e}"
            );
        }
    }
}

#[test]
fn white_noise_does_less_harm_than_to_a_linear_prediction() {
    for values in 1..=3 {
        let noise = |number: u32| {
            let mut bits = u64::from(number + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            std::array::from_fn(|_| {
                bits = (bits ^ (bits >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
                (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
            })
        };
        let [found, linear] = errors_beside_linear(values, 3000, noise, noise);
        assert!(found <= linear, "{values} values: {found} {linear}");
    }
}

/// Many tiny steps and then a long one: rounding must not be extrapolated with a high degree.
#[test]
fn steps_of_very_different_lengths_agree() {
    for values in 1..=3 {
        let mut history = InputHistory::default();
        let mut time = 0.0;
        for number in 0..400 {
            history.record(sample(time, sine(time), values));
            time += if number % 20 == 19 { 0.02 } else { 1e-9 };
        }
        let found = history
            .extrapolate(time, Degree::Automatic)
            .expect("there are samples")
            .at(time)[0];
        assert!(
            (found - sine(time)[0]).abs() < 0.2,
            "{values} values: {found} {}",
            sine(time)[0]
        );
    }
}

#[test]
fn a_sample_at_the_same_time_replaces_the_last() {
    let mut history = InputHistory::default();
    for value in [5.0, 7.0] {
        history.record(sample(1.0, [value, 0.0, 0.0], 1));
    }
    let found = history.extrapolate(2.0, Degree::Automatic).expect("there are samples");
    assert_eq!((history.samples().len(), found.at(2.0)[0]), (1, 7.0));
}

#[test]
fn rates_that_contradict_are_found_and_right_ones_are_not() {
    let contradicting = |samples_a_period: f64, factors: [f64; 3]| {
        let mut history = InputHistory::default();
        for number in 0..100 {
            let time = f64::from(number) / samples_a_period;
            let values = sine(time);
            history.record(sample(
                time,
                std::array::from_fn(|index| factors[index] * values[index]),
                3,
            ));
        }
        history.contradiction().map(|found| found.rate)
    };
    for samples in [3.3, 8.0, 25.0, 1000.0] {
        assert_eq!(
            contradicting(samples, [1.0, 1.0, 1.0]),
            None,
            "{samples} samples a period"
        );
        assert_eq!(contradicting(samples, [1.0, 0.0, 0.0]), None);
    }
    for samples in [8.0, 25.0, 1000.0] {
        assert_eq!(contradicting(samples, [1.0, -1.0, -1.0]), Some(1));
        assert_eq!(contradicting(samples, [1e3, 1.0, 1.0]), Some(1));
        assert_eq!(contradicting(samples, [0.0, 1.0, 1.0]), Some(1));
        assert_eq!(contradicting(samples, [1.0, 1.0, -1.0]), Some(2));
    }
}
