//! One explicit Runge-Kutta step of order 8 in 12 stages.
//!
//! Source: Dormand and Prince, as DOP853 in E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential
//! Equations I (Springer 1993), section II.10; the step is fixed here, so that the embedded error estimates are left out.

/// Quantities that one step advances.
pub const WIDTH: usize = 8;

/// Values or rates of the quantities.
pub type Vector = [f64; WIDTH];

/// `y + h sum a_i k_i`.
#[inline(always)]
fn along<const N: usize>(start: &Vector, step: f64, terms: [(f64, &Vector); N]) -> Vector {
    let mut slope = Vector::default();
    for (weight, rates) in terms {
        for row in 0..WIDTH {
            slope[row] += weight * rates[row];
        }
    }
    let mut end = *start;
    for row in 0..WIDTH {
        end[row] += step * slope[row];
    }
    end
}

/// The quantities after `step` \[s\] from `start` under `rates(offset, quantities)`, offset counted from the start of the
/// step; `first` are the rates at the start.
#[inline]
pub fn advance(start: &Vector, first: &Vector, step: f64, rates: impl Fn(f64, &Vector) -> Vector) -> Vector {
    let k1 = first;
    // A row of the tableau: node; weight => rates of an earlier stage, ...
    macro_rules! stage {
        ($node:expr; $($weight:expr => $k:ident),+) => {
            &rates($node * step, &along(start, step, [$(($weight, $k)),+]))
        };
    }
    let k2 = stage!(0.052_600_151_958_767_73; 0.052_600_151_958_767_73 => k1);
    let k3 = stage!(0.078_900_227_938_151_6; 0.019_725_056_984_537_9 => k1, 0.059_175_170_953_613_7 => k2);
    let k4 = stage!(0.118_350_341_907_227_4; 0.029_587_585_476_806_85 => k1, 0.088_762_756_430_420_54 => k3);
    let k5 = stage!(0.281_649_658_092_772_6; 0.241_365_134_159_266_7 => k1, -0.884_549_479_328_286_1 => k3,
        0.924_834_003_261_792 => k4);
    let k6 = stage!(1.0 / 3.0; 1.0 / 27.0 => k1, 0.170_828_608_729_473_86 => k4, 0.125_467_687_566_822_42 => k5);
    let k7 = stage!(0.25; 0.037_109_375 => k1, 0.170_252_211_019_544_05 => k4, 0.060_216_538_980_455_96 => k5,
        -0.017_578_125 => k6);
    let k8 = stage!(4.0 / 13.0; 0.037_092_000_118_504_79 => k1, 0.170_383_925_712_239_98 => k4,
        0.107_262_030_446_373_28 => k5, -0.015_319_437_748_624_402 => k6, 0.008_273_789_163_814_023 => k7);
    let k9 = stage!(0.651_282_051_282_051_3; 0.624_110_958_716_075_7 => k1, -3.360_892_629_446_941_4 => k4,
        -0.868_219_346_841_726 => k5, 27.592_099_699_446_71 => k6, 20.154_067_550_477_894 => k7,
        -43.489_884_181_069_96 => k8);
    let k10 = stage!(0.6; 0.477_662_536_438_264_34 => k1, -2.488_114_619_971_667_7 => k4,
        -0.590_290_826_836_843 => k5, 21.230_051_448_181_193 => k6, 15.279_233_632_882_423 => k7,
        -33.288_210_968_984_86 => k8, -0.020_331_201_708_508_627 => k9);
    let k11 = stage!(6.0 / 7.0; -0.937_142_430_085_987_3 => k1, 5.186_372_428_844_064 => k4,
        1.091_437_348_996_729_5 => k5, -8.149_787_010_746_927 => k6, -18.520_065_659_996_96 => k7,
        22.739_487_099_350_505 => k8, 2.493_605_552_679_652_3 => k9, -3.046_764_471_898_219_6 => k10);
    let k12 = stage!(1.0; 2.273_310_147_516_538 => k1, -10.534_495_466_737_25 => k4, -2.000_872_058_224_862_5 => k5,
        -17.958_931_863_118_8 => k6, 27.948_884_529_419_96 => k7, -2.858_998_277_135_023_5 => k8,
        -8.872_856_933_530_63 => k9, 12.360_567_175_794_303 => k10, 0.643_392_746_015_763_6 => k11);
    along(
        start,
        step,
        [
            (0.054_293_734_116_568_765, k1),
            (4.450_312_892_752_409, k6),
            (1.891_517_899_314_500_3, k7),
            (-5.801_203_960_010_585, k8),
            (0.311_164_366_957_819_9, k9),
            (-0.152_160_949_662_516_1, k10),
            (0.201_365_400_804_030_34, k11),
            (0.044_710_615_727_772_59, k12),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error of x'' = -x with a forced second oscillator after one radian in `steps` steps.
    fn error(steps: u32) -> f64 {
        let step = 1.0 / f64::from(steps);
        let mut now: Vector = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        for index in 0..steps {
            let time = f64::from(index) * step;
            let rates = |offset: f64, at: &Vector| {
                let mut rates = [at[1], -at[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
                rates[2] = at[2] * (time + offset).cos();
                rates
            };
            let first = rates(0.0, &now);
            now = advance(&now, &first, step, rates);
        }
        ((now[0] - 1.0_f64.sin()).powi(2) + (now[1] - 1.0_f64.cos()).powi(2)).sqrt()
    }

    #[test]
    fn the_runge_kutta_step_is_of_order_eight() {
        let (coarse, fine) = (error(1), error(2));
        let order = (coarse / fine).log2();
        assert!((7.5..9.5).contains(&order), "{coarse:e}, {fine:e}: order {order}");
        assert!(error(8) < 1e-14);
    }
}
