//! `jostle-bench report`: error against CPU time, measured and written as CSV.
//!
//! One file a family of cases; a new case is a [`Case`] in one of them, a new method a few [`Point`]s in a case. The
//! page with its diagrams is drawn from these files by `python -m jostle_lab report`, which adds what needs an FMU or
//! another program.

mod case;
mod engines;
mod ensemble;
mod impact;
mod lasting;
mod packing;
mod ratchet;
mod roots;
mod supports;
mod tables;
mod torque;
mod wedge;

use std::path::PathBuf;

use crate::nearest::unknown;
use anyhow::{Context, Result};
use case::{Case, Done, Point, Stopwatch};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use crate::machine;

/// CPU seconds that make one measurement, if one solution is shorter.
const SHORTEST: f64 = 0.02;
/// CPU seconds from which on a point is not measured again: a long run is its own mean.
const LONG_ENOUGH: f64 = 4.0;

/// Measures error against CPU time, for every scene and engine.
///
/// Writes points_CASE.csv (case, quantity, method, setting, error, error_bar, cpu_seconds, evaluations), cases.csv (what
/// these words mean) and machine.csv into a folder, and the 60-disk packing at its start and end for other programs. CPU
/// times are medians over rounds in which all points of a case take turns. `python -m jostle_lab report` draws them.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  jostle-bench report --out results/report --only one_impact\n\n\
    All cases take some five minutes on an idle core."
)]
pub struct ReportCommand {
    /// Folder for the files; made if it does not exist.
    #[arg(long, value_name = "FOLDER", default_value = "results/report")]
    out: PathBuf,
    /// Rounds; each point is measured once in each.
    #[arg(long, default_value = "5", value_parser = clap::value_parser!(u32).range(1..=100), allow_negative_numbers = true)]
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
    outcome: std::result::Result<(Done, f64), String>,
}

impl ReportCommand {
    pub fn execute(self) -> Result<()> {
        let cases = self.chosen()?;
        if self.list {
            for case in &cases {
                println!("{:20} {}", case.name, case.problem);
            }
            return Ok(());
        }
        std::fs::create_dir_all(&self.out)
            .with_context(|| format!("the folder {} cannot be made", self.out.display()))?;
        machine::write(&self.out.join("machine.csv"), &[("rounds", self.rounds.to_string())])?;
        tables::write_cases(&self.out.join("cases.csv"), &all_cases())?;
        for mut case in cases {
            let path = self.out.join(format!("points_{}.csv", case.name));
            let measured = measure(&mut case, self.rounds);
            tables::write_points(&path, &case, &measured)?;
            println!("{}", path.display());
            if case.name == packing::NAME {
                packing::write_states(&self.out)?;
            }
        }
        Ok(())
    }

    fn chosen(&self) -> Result<Vec<Case>> {
        let mut cases = all_cases();
        let names: Vec<&str> = cases.iter().map(|case| case.name).collect();
        if let Some(wrong) = self.only.iter().find(|name| !names.contains(&name.as_str())) {
            return Err(unknown("--only", wrong, &names).into());
        }
        cases.retain(|case| self.only.is_empty() || self.only.iter().any(|name| name == case.name));
        Ok(cases)
    }
}

fn all_cases() -> Vec<Case> {
    let mut lasting = lasting::cases();
    if let Some(wedge) = lasting.last_mut() {
        wedge.points.extend(supports::between_walls());
    }
    let families = [
        impact::cases(),
        lasting,
        supports::cases(),
        packing::cases(),
        vec![
            impact::by_tolerance(case::ladder(1e-4, 0.1, 6)),
            packing::by_tolerance(case::ladder(1e-4, 0.1, 6)),
        ],
        ensemble::cases(),
        wedge::cases(),
        ratchet::cases(),
        torque::cases(),
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
    let mut outcomes: Vec<Option<std::result::Result<Done, String>>> = vec![None; case.points.len()];
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
fn once(point: &mut Point) -> (std::result::Result<Done, String>, f64) {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// First error of a method at a setting.
    fn error(case: &mut Case, method: &str, setting: f64) -> f64 {
        let mut points = case.points.iter_mut();
        let point = points.find(|point| point.method == method && point.setting == setting);
        let done = (point.unwrap().work)(&mut Stopwatch::default()).unwrap();
        done.errors[0].0
    }

    /// The closed forms of the plane and the wedge are those of the engine: its error goes as the square of the step.
    #[test]
    fn lasting_contacts_show_the_order_of_the_integrator() {
        for mut case in lasting::cases() {
            let coarse = error(&mut case, "velocity Verlet", 44.0);
            let fine = error(&mut case, "velocity Verlet", 352.0);
            let order = (coarse / fine).log2() / 3.0;
            assert!(
                (order - 2.0).abs() < 0.1,
                "{}: {coarse:e}, {fine:e}, order {order}",
                case.name
            );
            assert!(error(&mut case, "Gear 5", 352.0) < 1e-3 * fine, "{}", case.name);
        }
    }

    #[test]
    fn one_impact_converges_to_the_closed_form() {
        for mut case in impact::cases() {
            let (coarse, fine) = (
                error(&mut case, "velocity Verlet", 160.0),
                error(&mut case, "velocity Verlet", 1280.0),
            );
            assert!(
                fine < 0.2 * coarse && fine < 3e-4,
                "{}: {coarse:e}, {fine:e}",
                case.name
            );
            assert!(error(&mut case, "impulse, table", 1.0) < 1e-14, "{}", case.name);
        }
    }

    #[test]
    fn no_flight_passes_its_first_root() {
        let mut case = roots::cases().remove(0);
        assert!(error(&mut case, "march to the root", 0.0) < 1e-12);
    }

    #[test]
    fn an_unknown_case_is_refused_with_the_known_ones() {
        let report = ReportCommand {
            out: PathBuf::new(),
            rounds: 1,
            only: vec!["one_impcat".into()],
            list: false,
        };
        let message = report.execute().unwrap_err().to_string();
        assert!(
            message.starts_with("--only = one_impcat is not allowed: one of: one_impact"),
            "{message}"
        );
        assert!(message.contains("Did you mean one_impact?"), "{message}");
    }

    #[test]
    fn medians_of_odd_and_even_counts() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }
}
