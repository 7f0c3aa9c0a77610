//! What the fourth order costs: `cargo bench --bench located`.
//!
//! CPU time of the engine with located contact events at several steps over that of velocity Verlet at its default step,
//! for the 60-disk packing at Gamma 0.5, 4 and 15. Both run in turn, in parts of 0.1 simulated seconds after half a second
//! of settling; printed are the median of the ratios of the parts and their quartiles.
//!
//! `cargo bench --bench located -- ENGINE STEP SECONDS` runs one engine alone at Gamma 4, for `valgrind --tool=callgrind`:
//! ENGINE verlet or located, STEP in seconds (0: the default).

use cpu_time::ProcessTime;

use jostle::drive::Sine;
use jostle::scene::packing::{LocatedPackingOnSine, PackingOnSine};
use jostle::scene::{Model, Simulation};

const SETTLE: f64 = 0.5;
const PART: f64 = 0.1;
const PARTS: u32 = 15;

fn packing<M: Model>(gamma: f64, time_step: f64) -> Simulation<M> {
    let amplitude = Sine::amplitude_of(gamma, 80.0, 9.8);
    let given = [("drive.amplitude", amplitude.into()), ("time_step", time_step.into())];
    let mut packing = Simulation::new(&[("disks", 60)], &given).expect("a legal packing");
    packing.advance_to(SETTLE).expect("settles");
    packing
}

/// CPU seconds of the part that ends at `end`.
fn seconds<M: Model>(packing: &mut Simulation<M>, end: f64) -> f64 {
    let start = ProcessTime::now();
    packing.advance_to(end).expect("runs");
    start.elapsed().as_secs_f64()
}

fn compared(gamma: f64, time_step: f64) {
    let mut verlet = packing::<PackingOnSine>(gamma, 0.0);
    let mut located = packing::<LocatedPackingOnSine>(gamma, time_step);
    let (mut ratios, mut costs) = (Vec::new(), [0.0; 2]);
    for part in 1..=PARTS {
        let end = SETTLE + f64::from(part) * PART;
        let spent = [seconds(&mut verlet, end), seconds(&mut located, end)];
        ratios.push(spent[1] / spent[0]);
        costs = [costs[0] + spent[0], costs[1] + spent[1]];
    }
    ratios.sort_by(f64::total_cmp);
    let quartile = |quarter: usize| ratios[quarter * (ratios.len() - 1) / 4];
    let per_second = costs.map(|cost| cost / (f64::from(PARTS) * PART) * 1e3);
    println!(
        "{gamma:5}  {:.3e}  {:.3e}  {:9.1}  {:10.1}  {:5.2}  {:.2} to {:.2}",
        verlet.model().expect("started").engine().setup().time_step,
        located.model().expect("started").engine().setup().time_step,
        per_second[0],
        per_second[1],
        quartile(2),
        quartile(1),
        quartile(3)
    );
}

fn alone(engine: &str, time_step: f64, seconds: f64) {
    match engine {
        "verlet" => packing::<PackingOnSine>(4.0, time_step).advance_to(SETTLE + seconds),
        "located" => packing::<LocatedPackingOnSine>(4.0, time_step).advance_to(SETTLE + seconds),
        _ => panic!("no engine is called {engine}. Name verlet or located."),
    }
    .expect("runs");
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    if let [engine, time_step, seconds] = &arguments[..] {
        let number = |word: &str| word.parse().expect("a number of seconds");
        return alone(engine, number(time_step), number(seconds));
    }
    println!("ms: CPU milliseconds per simulated second");
    println!("Gamma  step Verlet  step located  ms Verlet  ms located  ratio  quartiles");
    for gamma in [0.5, 4.0, 15.0] {
        for time_step in [1e-4, 5e-5, 2.5e-5] {
            compared(gamma, time_step);
        }
    }
}
