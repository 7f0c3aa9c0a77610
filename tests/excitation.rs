//! What turns the disk on two supports: pieces against formulas, random supports against their covariances.

use jostle::drive::Degree;
use jostle::drive::excitation::{Excitation, HarmonicTorque, InputTorque, NoiseSign, Piece, RandomSupports, Vibration};

/// The piece of an excitation is what its formula says.
#[test]
fn excitations_follow_their_formulas() {
    let torque = HarmonicTorque {
        amplitude: 0.3,
        angular_frequency: 7.0,
    };
    for (start, offset) in [(0.0, 0.01), (1234.5, 0.04)] {
        let expected = 0.3 * (7.0_f64 * (start + offset)).sin();
        assert!((torque.piece(start).torque(offset) - expected).abs() < 1e-12);
    }
    let linear = InputTorque::starting(3.0, 1.0, -2.0, Degree::Automatic);
    assert!((linear.piece(3.5).torque(0.25) - (1.0 - 2.0 * 0.75)).abs() < 1e-15);
}

fn vibration(sign: NoiseSign) -> Vibration {
    Vibration {
        amplitude: 3e-5,
        angle: 6e-5,
        angular_frequency: 62.8,
        damping_ratio: 0.5,
        seed: 11,
        sign,
    }
}

/// Covariances of the supports in their steady state are those of P 5.11 to 5.13 (with the square root corrected), whatever
/// the duration of a cell: sample means over independent coordinates within five standard errors.
#[test]
fn random_supports_have_the_covariances_of_the_thesis() {
    let Vibration {
        amplitude,
        angle,
        angular_frequency: omega,
        damping_ratio: c,
        ..
    } = vibration(NoiseSign::AsDrawn);
    let lag = 0.02;
    let damped = (1.0 - c * c).sqrt();
    let correlation =
        (-c * omega * lag).exp() * ((damped * omega * lag).cos() + c / damped * (damped * omega * lag).sin());
    for cells_a_lag in [1_u32, 8, 50] {
        let mut supports = RandomSupports::new(&vibration(NoiseSign::AsDrawn), lag / f64::from(cells_a_lag));
        let scales = [amplitude, amplitude, angle];
        let mut read = |cells: u32| -> [[f64; 2]; 6] {
            (0..cells).for_each(|_| supports.next_cell());
            let now = supports.piece(0.0).supports(0.0);
            std::array::from_fn(|row| {
                let (support, axis) = (row / 3, row % 3);
                [now[support].place[axis], now[support].rates[axis] / omega].map(|value| value / scales[axis])
            })
        };
        // x^2, v^2, x v, x(t) x(t + lag), x of one coordinate times x of the next one: with their expected values.
        let expected = [1.0, 1.0, 0.0, correlation, 0.0];
        let (mut sums, mut squares, mut count) = ([0.0; 5], [0.0; 5], 0.0);
        for _ in 0..3000 {
            // Ten correlation times apart: independent to 5e-5.
            let first = read(16 * cells_a_lag);
            let second = read(cells_a_lag);
            for row in 0..6 {
                let ([x, v], [later, _]) = (first[row], second[row]);
                let values = [x * x, v * v, x * v, x * later, x * first[(row + 1) % 6][0]];
                for (index, value) in values.into_iter().enumerate() {
                    sums[index] += value;
                    squares[index] += value * value;
                }
                count += 1.0;
            }
        }
        for index in 0..5 {
            let mean = sums[index] / count;
            let error = ((squares[index] / count - mean * mean) / count).sqrt();
            let off = (mean - expected[index]) / error;
            println!(
                "{cells_a_lag} cells a lag, moment {index}: {mean:.4} +- {error:.4}, expected {:.4}",
                expected[index]
            );
            assert!(off.abs() < 5.0, "moment {index}: {off} standard errors");
        }
    }
}

/// The path inside a cell joins its ends smoothly, and paired runs are reflections to the bit.
#[test]
fn random_paths_are_smooth_and_paired() {
    let cell = 1e-3;
    let [mut drawn, mut reversed, mut mirrored] = [NoiseSign::AsDrawn, NoiseSign::Reversed, NoiseSign::Mirrored]
        .map(|sign| RandomSupports::new(&vibration(sign), cell));
    for _ in 0..100 {
        let before = drawn.piece(0.0).supports(cell);
        drawn.next_cell();
        let after = drawn.piece(0.0).supports(0.0);
        for (before, after) in before.iter().zip(&after) {
            for axis in 0..3 {
                assert!((before.place[axis] - after.place[axis]).abs() < 1e-18);
                assert!((before.rates[axis] - after.rates[axis]).abs() < 1e-15);
            }
        }
        reversed.next_cell();
        mirrored.next_cell();
        let at = |supports: &RandomSupports| supports.piece(0.0).supports(0.3 * cell).map(|support| support.place);
        let [[lx, ly, la], [rx, ry, ra]] = at(&drawn);
        assert_eq!(at(&reversed), [[-lx, -ly, -la], [-rx, -ry, -ra]]);
        assert_eq!(at(&mirrored), [[-rx, ry, -ra], [-lx, ly, -la]]);
    }
}
