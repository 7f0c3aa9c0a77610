//! `jostle report`: error against CPU time, measured and written as CSV.
//!
//! One file a family of cases; a new case is a [`Case`] in one of them, a new method a few [`Point`]s in a case. The
//! page with its diagrams is drawn from these files by `python -m jostle_lab report`, which adds what needs an FMU or
//! another program.

mod case;
mod ensemble;
mod impact;
mod lasting;
mod packing;
mod ratchet;
mod roots;
mod tables;
mod wedge;

use std::path::PathBuf;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use jostle::Error;

use super::Failure;
use case::{Case, Done, Point, Stopwatch};

/// CPU seconds that make one measurement, if one solution is shorter.
const SHORTEST: f64 = 0.02;
/// CPU seconds from which on a point is not measured again: a long run is its own mean.
const LONG_ENOUGH: f64 = 4.0;

/// Measures error against CPU time, for every scene and engine.
///
/// Writes points.csv (case, quantity, method, setting, error, error_bar, cpu_seconds, evaluations), cases.csv (what
/// these words mean) and machine.csv into a folder, and the 60-disk packing at its start and end for other programs. CPU
/// times are medians over rounds in which all points of a case take turns. `python -m jostle_lab report` draws them.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  jostle report --out results/report --only one_impact\n\n\
    All cases take some five minutes on an idle core.")]
pub struct Report {
    /// Folder for the files; made if it does not exist.
    #[arg(long, value_name = "FOLDER", default_value = "results/report")]
    out: PathBuf,
    /// Rounds; each point is measured once in each.
    #[arg(long, default_value = "5", value_parser = clap::value_parser!(u32).range(1..=100))]
    rounds: u32,
    /// Only the case of this name; may be repeated.
    #[arg(long, value_name = "CASE")]
    only: Vec<String>,
    /// List the cases and do nothing.
    #[arg(long)]
    list: bool,
}

/// What became of one point: the last errors and the median CPU time, or why there are none.
pub struct Measured {
    method: &'static str,
    setting: f64,
    outcome: Result<(Done, f64), String>,
}

impl Report {
    pub fn execute(self) -> Result<(), Failure> {
        let cases = self.chosen()?;
        if self.list {
            for case in &cases {
                println!("{:20} {}", case.name, case.problem);
            }
            return Ok(());
        }
        std::fs::create_dir_all(&self.out).map_err(|error| Failure::file(&self.out, error))?;
        tables::write_machine(&self.out.join("machine.csv"), self.rounds)?;
        tables::write_cases(&self.out.join("cases.csv"), &cases)?;
        let mut points = tables::Points::create(&self.out.join("points.csv"))?;
        for mut case in cases {
            let measured = measure(&mut case, self.rounds);
            points.write(&case, &measured)?;
            if case.name == packing::NAME {
                packing::write_states(&self.out)?;
            }
        }
        println!("points.csv, cases.csv, machine.csv in {}", self.out.display());
        Ok(())
    }

    fn chosen(&self) -> Result<Vec<Case>, Error> {
        let mut cases = all_cases();
        let names: Vec<&str> = cases.iter().map(|case| case.name).collect();
        if let Some(unknown) = self.only.iter().find(|name| !names.contains(&name.as_str())) {
            let allowed = format!("one of: {}", names.join(", "));
            return Err(Error::parameter("--only", unknown, allowed, "Name one of these."));
        }
        cases.retain(|case| self.only.is_empty() || self.only.iter().any(|name| name == case.name));
        Ok(cases)
    }
}

fn all_cases() -> Vec<Case> {
    let families = [
        impact::cases(),
        lasting::cases(),
        packing::cases(),
        ensemble::cases(),
        wedge::cases(),
        ratchet::cases(),
        roots::cases(),
    ];
    families.into_iter().flatten().collect()
}

/// Measures all points of a case in turn, round by round.
fn measure(case: &mut Case, rounds: u32) -> Vec<Measured> {
    let bar = ProgressBar::new(u64::from(rounds) * case.points.len() as u64);
    let style = ProgressStyle::with_template("{msg:20} {wide_bar} {percent} % {elapsed}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message(case.name);
    let mut times = vec![Vec::new(); case.points.len()];
    let mut outcomes: Vec<Option<Result<Done, String>>> = vec![None; case.points.len()];
    for _ in 0..rounds {
        for (index, point) in case.points.iter_mut().enumerate() {
            let failed = matches!(outcomes[index], Some(Err(_)));
            if !failed && times[index].iter().sum::<f64>() < LONG_ENOUGH {
                let (outcome, each) = once(point);
                outcomes[index] = Some(outcome);
                times[index].push(each);
            }
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let points = case.points.iter().zip(outcomes).zip(times);
    points
        .map(|((point, outcome), times)| Measured {
            method: point.method,
            setting: point.setting,
            outcome: outcome
                .unwrap_or_else(|| Err("not measured".into()))
                .map(|done| (done, median(times))),
        })
        .collect()
}

/// Solves one point until the clock can be trusted; CPU seconds of one solution.
fn once(point: &mut Point) -> (Result<Done, String>, f64) {
    let mut watch = Stopwatch::default();
    loop {
        match (point.work)(&mut watch) {
            Ok(done) if watch.seconds() >= SHORTEST => return (Ok(done), watch.each()),
            Ok(_) => {}
            Err(trouble) => return (Err(trouble.to_string()), watch.each()),
        }
    }
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    let middle = times.len() / 2;
    if times.len().is_multiple_of(2) {
        0.5 * (times[middle - 1] + times[middle])
    } else {
        times[middle]
    }
}
