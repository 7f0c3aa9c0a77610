//! Transport on the sawtooth against the floor under the normal velocity.
//!
//! F's rule lets no disk leave with less than a minimum normal velocity. It saves impacts and adds energy; the bias of
//! the transport velocity shows how much.

use std::rc::Rc;
use std::sync::OnceLock;

use jostle::scene::ratchet::RatchetOnSine;
use jostle::scene::{Simulation, Value};

use super::case::{Case, Done, Point, Stopwatch, Trouble, count, known, ladder, mean_and_error};

const SEEDS: i64 = 32;
const SECONDS: f64 = 10.0;
const SETTLED: f64 = 1.0;
const LOWEST: f64 = 1e-5;
const QUANTITIES: &[(&str, &str)] = &[(
    "transport_velocity",
    "difference of the transport velocity from that of the lowest floor [m/s], with its statistical error",
)];

/// The ratchet at its start values.
pub fn cases() -> Vec<Case> {
    let reference: Rc<OnceLock<(f64, f64, f64)>> = Rc::default();
    let points = ladder(1e-1, 0.1, 5).chain([0.0]).map(|floor| {
        let reference = Rc::clone(&reference);
        Point::new("velocity floor", floor, move |watch: &mut Stopwatch| {
            let lowest = || transport(LOWEST, 1001, &mut Stopwatch::default());
            let &(exact, exact_error, _) = known(&reference, lowest)?;
            let (mean, error, collisions) = transport(floor, 1, watch)?;
            Ok(Done {
                errors: vec![((mean - exact).abs(), error.hypot(exact_error))],
                evaluations: collisions,
            })
        })
    });
    vec![Case {
        name: "ratchet_rule",
        problem: format!("The ratchet as it starts: mean transport velocity over {SECONDS} s, {SEEDS} seeds."),
        setting: "collision.minimum_normal_velocity [m/s]; 0: no rule",
        reference: "a floor of 1e-5 m/s, other seeds",
        quantities: QUANTITIES,
        points: points.collect(),
    }]
}

/// Mean transport velocity \[m/s\], its standard error, impacts.
fn transport(floor: f64, first_seed: i64, watch: &mut Stopwatch) -> Result<(f64, f64, f64), Trouble> {
    let (mut means, mut collisions) = (Vec::new(), 0.0);
    for seed in first_seed..first_seed + SEEDS {
        let parameters: [(&str, Value); 3] = [
            ("collision.minimum_normal_velocity", floor.into()),
            ("measure.start", SETTLED.into()),
            ("seed", seed.into()),
        ];
        let mut ratchet = Simulation::<RatchetOnSine>::new(&[], &parameters)?;
        watch.measure(u32::from(seed == first_seed), || ratchet.advance_to(SETTLED + SECONDS))?;
        means.push(ratchet.real("transport_velocity")?);
        collisions += count(&ratchet, "collisions");
    }
    let (mean, error) = mean_and_error(&means);
    Ok((mean, error, collisions))
}
