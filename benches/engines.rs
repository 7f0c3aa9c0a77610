//! What a simulated second of the 60-disk packing costs, by engine and Gamma: `cargo bench --bench engines`.
//!
//! CPU milliseconds per simulated second, medians of five runs after a second of settling. Molecular dynamics pays for
//! time (and for stiffness, by its square root), event-driven dynamics for impacts: the table shows where they cross.

use cpu_time::ProcessTime;

use jostle::drive::Sine;
use jostle::scene::packing::PackingOnSine;
use jostle::scene::packing::event_driven::HardPackingOnSine;
use jostle::scene::{Model, Simulation};

const SETTLE: f64 = 1.0;
const RUNS: usize = 5;

/// Median milliseconds per simulated second, or why there is none.
fn cost<M: Model>(gamma: f64, stiffness: f64, model: Option<i64>, seconds: f64) -> Result<f64, String> {
    let message_of = |error: jostle::Error| error.to_string();
    let mut given = vec![
        ("drive.amplitude", Sine::amplitude_of(gamma, 80.0, 9.8).into()),
        ("contact.normal_stiffness", stiffness.into()),
    ];
    given.extend(model.map(|model| ("base.model", model.into())));
    let mut simulation = Simulation::<M>::new(&[("disks", 60)], &given).map_err(message_of)?;
    simulation.advance_to(SETTLE).map_err(message_of)?;
    let mut costs = Vec::with_capacity(RUNS);
    for run in 1..=RUNS {
        let start = ProcessTime::now();
        simulation
            .advance_to(SETTLE + run as f64 * seconds)
            .map_err(message_of)?;
        costs.push(start.elapsed().as_secs_f64() / seconds * 1e3);
    }
    costs.sort_by(f64::total_cmp);
    Ok(costs[RUNS / 2])
}

fn shown(cost: Result<f64, String>) -> String {
    cost.map_or_else(|_| "stops".into(), |cost| format!("{cost:.1}"))
}

fn main() {
    for stiffness in [1e4, 1e6] {
        println!("k_n = {stiffness:e} N/m, ms per simulated second");
        println!("Gamma  molecular dynamics  hard, moving bottom  hard, random phase");
        for gamma in [0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 15.0, 25.0] {
            let soft = cost::<PackingOnSine>(gamma, stiffness, None, 0.2);
            let moving = cost::<HardPackingOnSine>(gamma, stiffness, Some(2), 1.0);
            let random = cost::<HardPackingOnSine>(gamma, stiffness, Some(1), 1.0);
            println!(
                "{gamma:5}  {:>18}  {:>19}  {:>18}",
                shown(soft),
                shown(moving),
                shown(random)
            );
        }
    }
}
