//! Times of many steps of one case, run twice: what a run measures, and what the numbers of a table say of it.

use std::f64::consts::TAU;
use std::path::Path;
use std::time::Instant;

use anyhow::{Result, bail};
use cpu_time::ThreadTime;

use super::library::Instance;

/// Frequency \[Hz\] of the base, and its peak acceleration over that of gravity.
const FREQUENCY: f64 = 80.0;
const GAMMA: f64 = 2.0;
/// Simulated seconds before steps are timed.
const WARM_UP: f64 = 0.25;
/// Outputs that are read after each step.
pub const OUTPUTS: [&str; 4] = [
    "base.reaction_force",
    "base.acceleration",
    "disk.angle[1]",
    "energy.input",
];
pub const INPUTS: [&str; 2] = ["base.displacement", "base.velocity"];

/// What is timed.
pub struct Case<'a> {
    pub library: &'a Path,
    pub token: &'a str,
    pub inputs: &'a [u32],
    pub outputs: &'a [u32],
    /// Communication step \[s\].
    pub step: f64,
}

/// Times \[s\] of the timed steps of one run, in order.
#[derive(Debug, Default, PartialEq)]
pub struct Run {
    /// CPU time of this thread inside of `fmi3DoStep`.
    pub cpu: Vec<f64>,
    /// Wall time of the same.
    pub wall: Vec<f64>,
    /// Mean wall time of setting inputs and reading outputs.
    pub exchange: f64,
    /// Page faults of this thread meanwhile.
    pub page_faults: u64,
}

/// Runs a case for `steps` timed steps, or fewer if they take more than `budget` seconds of CPU time.
///
/// # Errors
/// The library refuses anything, or the steps before the first timed one take more than the budget.
pub fn run(case: &Case<'_>, steps: usize, budget: f64) -> Result<Run> {
    let instance = Instance::new(case.library, case.token)?;
    let warm_up = (WARM_UP / case.step).round() as usize;
    // Filled with what is not zero, so that the pages are there before the first step is timed.
    let mut run = Run {
        cpu: vec![f64::NAN; steps],
        wall: vec![f64::NAN; steps],
        ..Run::default()
    };
    let (mut done, mut spent, mut exchange, mut faults) = (0, 0.0, 0.0, page_faults());
    for number in 0..warm_up + steps {
        if number == warm_up {
            faults = page_faults();
        }
        let current = number as f64 * case.step;
        let (cpu, wall, others) = one(&instance, case, current)?;
        spent += cpu;
        if number >= warm_up {
            (run.cpu[done], run.wall[done]) = (cpu, wall);
            exchange += others;
            done += 1;
        }
        if spent > budget {
            break;
        }
    }
    if done == 0 {
        bail!("{WARM_UP} simulated seconds before the first timed step take more than {budget} s");
    }
    run.page_faults = page_faults() - faults;
    run.exchange = exchange / done as f64;
    run.cpu.truncate(done);
    run.wall.truncate(done);
    Ok(run)
}

/// One communication step from `current` \[s\]: CPU and wall time of `fmi3DoStep`, wall time of the other calls.
fn one(instance: &Instance, case: &Case<'_>, current: f64) -> Result<(f64, f64, f64)> {
    let omega = TAU * FREQUENCY;
    let amplitude = GAMMA * 9.81 / (omega * omega);
    let (sine, cosine) = (omega * current).sin_cos();
    let mut read = [0.0; OUTPUTS.len()];
    let setting = Instant::now();
    instance.set(case.inputs, &[amplitude * sine, amplitude * omega * cosine])?;
    let set = setting.elapsed();
    let wall = Instant::now();
    let cpu = ThreadTime::now();
    let status = instance.step(current, case.step);
    let cpu = cpu.elapsed();
    let wall = wall.elapsed();
    instance.check(status)?;
    let getting = Instant::now();
    instance.get(case.outputs, &mut read)?;
    let others = set + getting.elapsed();
    std::hint::black_box(read);
    Ok((cpu.as_secs_f64(), wall.as_secs_f64(), others.as_secs_f64()))
}

/// What the clock of CPU time adds to each reading \[s\]: the median of readings with nothing between them.
pub fn clock_cost() -> f64 {
    let mut readings: Vec<f64> = (0..10_001).map(|_| ThreadTime::now().elapsed().as_secs_f64()).collect();
    readings.sort_by(f64::total_cmp);
    readings[readings.len() / 2]
}

/// Page faults of this thread that needed no disk; 0 where the system does not say.
fn page_faults() -> u64 {
    let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap_or_default();
    // Behind the name in brackets, which may hold blanks: state, five numbers, flags, then the faults.
    let fields = stat.rsplit(')').next().unwrap_or_default();
    let faults = fields.split_whitespace().nth(7);
    faults.and_then(|faults| faults.parse().ok()).unwrap_or(0)
}

/// What a table says of two runs of the same steps. Times in seconds.
#[derive(Debug, PartialEq)]
pub struct Summary {
    /// Timed steps of each run.
    pub steps: usize,
    /// Mean CPU time of a step.
    pub mean: f64,
    /// CPU time that 99 and 99.99 of a hundred steps keep below, both runs together.
    pub percentiles: [f64; 2],
    /// Longest CPU time of a step.
    pub worst: f64,
    /// The same of the shorter of both times of each step: the runs do the same to the bit, so that what is long in one of them
    /// alone is not the library's.
    pub worst_twice: f64,
    /// Wall time that 99.99 of a hundred steps keep below, and the longest.
    pub wall: [f64; 2],
    /// Mean wall time of setting inputs and reading outputs.
    pub exchange: f64,
    /// Page faults of both runs.
    pub page_faults: u64,
}

/// Steps of both runs together that a percentile of 99.99 needs: two are beyond it then.
pub const ENOUGH: usize = 20_000;

impl Summary {
    /// Of two runs with as many steps.
    pub fn of([first, second]: [&Run; 2]) -> Self {
        let twice = first.cpu.iter().zip(&second.cpu).map(|(one, other)| one.min(*other));
        let worst_twice = twice.fold(0.0, f64::max);
        let cpu = sorted(first.cpu.iter().chain(&second.cpu));
        let wall = sorted(first.wall.iter().chain(&second.wall));
        let tail = |times: &[f64]| {
            if times.len() < ENOUGH {
                f64::NAN
            } else {
                percentile(times, 0.9999)
            }
        };
        Self {
            steps: first.cpu.len(),
            mean: cpu.iter().sum::<f64>() / cpu.len().max(1) as f64,
            percentiles: [percentile(&cpu, 0.99), tail(&cpu)],
            worst: cpu.last().copied().unwrap_or(f64::NAN),
            worst_twice,
            wall: [tail(&wall), wall.last().copied().unwrap_or(f64::NAN)],
            exchange: 0.5 * (first.exchange + second.exchange),
            page_faults: first.page_faults + second.page_faults,
        }
    }
}

fn sorted<'a>(times: impl Iterator<Item = &'a f64>) -> Vec<f64> {
    let mut times: Vec<f64> = times.copied().collect();
    times.sort_by(f64::total_cmp);
    times
}

/// The smallest of the sorted `times` that the `share` of them does not exceed.
fn percentile(times: &[f64], share: f64) -> f64 {
    let rank = (share * times.len() as f64).ceil() as usize;
    times.get(rank.saturating_sub(1)).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(cpu: Vec<f64>) -> Run {
        Run {
            wall: cpu.iter().map(|time| 2.0 * time).collect(),
            cpu,
            exchange: 1.0,
            page_faults: 3,
        }
    }

    #[test]
    fn percentiles_are_ranks() {
        let times: Vec<f64> = (1..=10_000).map(f64::from).collect();
        assert_eq!(
            (
                percentile(&times, 0.9999),
                percentile(&times, 0.99),
                percentile(&times, 1.0)
            ),
            (9999.0, 9900.0, 10_000.0)
        );
        assert!(percentile(&[], 0.5).is_nan());
    }

    #[test]
    fn what_is_long_in_one_run_alone_is_not_worst_twice() {
        let (first, second) = (run(vec![1.0, 9.0, 1.0, 4.0]), run(vec![1.0, 1.0, 7.0, 5.0]));
        let summary = Summary::of([&first, &second]);
        assert_eq!((summary.steps, summary.worst, summary.worst_twice), (4, 9.0, 4.0));
        assert_eq!((summary.wall[1], summary.mean, summary.page_faults), (18.0, 3.625, 6));
        assert!(summary.percentiles[1].is_nan(), "four steps have no 99.99th percentile");
    }
}
