//! Speed of the packing scene: `cargo bench --bench packing`.
//!
//! Prints nanoseconds per disk and time step and simulated seconds per second of the 60-disk scene at Gamma 0.5, 4 and
//! 15, larger packings at Gamma 4, and the time of one communication step that does no work. Medians of seven runs after
//! half a simulated second of settling; built for the generic x86-64 that ships.

use cpu_time::ProcessTime;
use std::hint::black_box;

use jostle::drive::Sine;
use jostle::scene::Simulation;
use jostle::scene::packing::PackingOnSine;

const RUNS: usize = 7;

fn packing(disks: u32, gamma: f64) -> Simulation<PackingOnSine> {
    let width = 0.4 * (f64::from(disks) / 60.0).sqrt();
    let amplitude = Sine::amplitude_of(gamma, 80.0, 9.8);
    let given = [("box.width", width.into()), ("drive.amplitude", amplitude.into())];
    Simulation::new(&[("disks", disks)], &given).expect("a legal packing")
}

/// Median seconds of `RUNS` calls of `work`.
fn median(mut work: impl FnMut()) -> f64 {
    let mut seconds: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = ProcessTime::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[RUNS / 2]
}

fn main() {
    println!("disks  Gamma  time step  contacts  ns per disk and step  simulated seconds per second");
    for (disks, gamma, horizon) in [
        (60, 0.5, 0.5),
        (60, 4.0, 0.5),
        (60, 15.0, 0.5),
        (1000, 4.0, 0.05),
        (10_000, 4.0, 5e-3),
    ] {
        let mut packing = packing(disks, gamma);
        packing.advance_to(0.5_f64.min(10.0 * horizon)).expect("settles");
        let mut end = packing.model().expect("started").engine().time();
        let seconds = median(|| {
            end += horizon;
            packing.advance_to(end).expect("runs");
        });
        let engine = packing.model().expect("started").engine();
        let step = engine.setup().time_step;
        println!(
            "{disks:5}  {gamma:5}  {step:.3e}  {:8}  {:20.2}  {:.2}",
            engine.now().contacts,
            seconds / (horizon / step) / f64::from(disks) * 1e9,
            horizon / seconds
        );
    }
    let mut packing = packing(60, 4.0);
    let step = packing.model().expect("started").engine().setup().time_step;
    let calls = 1000_u32;
    let mut time = 0.0;
    let between = median(|| {
        for _ in 0..calls {
            time += step * 1e-4 / f64::from(calls);
            packing.advance_to(time).expect("runs");
        }
    });
    let read = median(|| {
        (0..calls).for_each(|_| {
            black_box(packing.all_values().expect("started"));
        });
    });
    let mut saved = packing.save();
    let save = median(|| (0..calls).for_each(|_| saved = packing.save()));
    let restore = median(|| (0..calls).for_each(|_| packing.restore(&saved).expect("restores")));
    let each = |seconds: f64| seconds / f64::from(calls) * 1e6;
    println!(
        "one communication step between two grid points: {:.2} us",
        each(between)
    );
    println!(
        "all outputs read: {:.2} us; state saved: {:.2} us, restored: {:.2} us",
        each(read),
        each(save),
        each(restore)
    );
}
