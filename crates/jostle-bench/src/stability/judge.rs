//! One case from start to verdict.

use cpu_time::ProcessTime;
use jostle::Error;
use jostle::scene::Value;

use super::matrix::Probe;
use super::watch::{Watch, given};

/// Samples of a run whose communication step does not matter.
const SAMPLES: f64 = 400.0;
/// Standard errors by which two means may differ.
const SIGMAS: f64 = 5.0;
/// Runs of which such a mean is made.
const SEEDS: i64 = 8;
/// Part of the time step with which the energy's error must shrink, to this part of it or below what is small.
const FINER: f64 = 0.125;
const SHRUNK: f64 = 0.5;
const SMALL: f64 = 1e-4;
/// Growth of the resident memory over the second half of a run that is still called flat \[bytes\].
const FLAT: f64 = 2e6;

/// Outcome of a case.
pub enum Outcome {
    /// Every criterion that applies holds.
    Holds,
    /// The scene said no: before it started, or at a time.
    Refused(String),
    /// Criteria that failed, with numbers.
    Violated(String),
}

/// A case with its verdict.
pub struct Judged {
    outcome: Outcome,
    /// Simulated time reached \[s\].
    reached: f64,
    /// CPU seconds of the run itself.
    cpu_seconds: f64,
    /// Criteria that were checked.
    criteria: Vec<&'static str>,
    energy_error: f64,
    overlap: f64,
}

impl Judged {
    pub const HEADER: [&'static str; 12] = [
        "scene",
        "engine",
        "drive",
        "dimension",
        "value",
        "disks",
        "result",
        "why",
        "simulated_seconds",
        "energy_error",
        "overlap",
        "criteria",
    ];

    fn new() -> Self {
        Self {
            outcome: Outcome::Holds,
            reached: 0.0,
            cpu_seconds: 0.0,
            criteria: vec!["finite", "time", "energy", "lost"],
            energy_error: 0.0,
            overlap: 0.0,
        }
    }

    /// 0 holds, 1 refused, 2 violated.
    pub fn rank(&self) -> usize {
        match self.outcome {
            Outcome::Holds => 0,
            Outcome::Refused(_) => 1,
            Outcome::Violated(_) => 2,
        }
    }

    fn words(&self) -> (&'static str, &str) {
        match &self.outcome {
            Outcome::Holds => ("holds", ""),
            Outcome::Refused(why) => ("refused", why),
            Outcome::Violated(why) => ("violated", why),
        }
    }

    /// One line for the terminal.
    pub fn line(&self, probe: &Probe) -> String {
        let (result, why) = self.words();
        format!(
            "{result:9} {} {} {}: {} = {} {why} ({:.2} s)",
            probe.scene, probe.engine, probe.drive, probe.dimension, probe.value, self.cpu_seconds
        )
    }

    /// One row of the CSV file.
    pub fn record(&self, probe: &Probe) -> [String; 12] {
        let (result, why) = self.words();
        [
            model(probe),
            probe.engine.into(),
            probe.drive.into(),
            probe.dimension.into(),
            probe.value.clone(),
            probe.disks.to_string(),
            result.into(),
            why.into(),
            format!("{:.3e}", self.reached),
            format!("{:.1e}", self.energy_error),
            format!("{:.1e}", self.overlap),
            self.criteria.join(" "),
        ]
    }
}

/// Scene, with the model of the base where there are two.
fn model(probe: &Probe) -> String {
    let random = probe
        .changes
        .iter()
        .any(|(name, value)| *name == "base.model" && *value == Value::Integer(1));
    let suffix = if random { " (random phase)" } else { "" };
    format!("{}{suffix}", probe.scene)
}

/// Runs a case for `budget` CPU seconds at most and judges it.
pub fn judge(probe: &Probe, budget: f64) -> Judged {
    let mut judged = Judged::new();
    if probe.scene == "packing" {
        judged.criteria.push("overlap");
    }
    let simulation = match probe.simulation(&probe.changes) {
        Ok(simulation) => simulation,
        Err(error) => {
            judged.outcome = Outcome::Refused(format!("before it starts: {error}"));
            return judged;
        }
    };
    let gravity = given(&simulation, "gravity");
    let mut watch = Watch::new(simulation);
    let refusal = run(&mut watch, probe, budget, &mut judged);
    if watch.momentum(probe, gravity) {
        judged.criteria.push("momentum");
    }
    if refusal.is_none() {
        limits(&mut watch, probe, budget, &mut judged);
    }
    judged.reached = watch.simulation.time();
    judged.energy_error = watch.energy_error;
    judged.overlap = watch.overlap;
    if !watch.violated.is_empty() {
        let violations: Vec<String> = watch
            .violated
            .iter()
            .map(|(criterion, what)| format!("{criterion}: {what}"))
            .collect();
        judged.outcome = Outcome::Violated(violations.join("; "));
    } else if let Some(error) = refusal {
        judged.outcome = Outcome::Refused(error.to_string());
    }
    judged
}

/// Advances to the end or the budget; a refusal ends the run.
fn run(watch: &mut Watch, probe: &Probe, budget: f64, judged: &mut Judged) -> Option<Error> {
    let start = ProcessTime::now();
    let longest = probe.communication.unwrap_or(probe.seconds / SAMPLES);
    let mut step = probe.communication.unwrap_or(1e-5 * longest);
    let (mut samples, mut memory) = (0_u32, None);
    while watch.simulation.time() < probe.seconds * (1.0 - 1e-9) && start.elapsed().as_secs_f64() < budget {
        let before = watch.simulation.time();
        let end = (before + step).min(probe.seconds);
        if let Err(error) = jump(watch, probe, end) {
            return Some(error);
        }
        let began = ProcessTime::now();
        let outcome = watch.simulation.advance_to(end);
        if let Err(error) = outcome {
            judged.cpu_seconds = start.elapsed().as_secs_f64();
            return Some(error);
        }
        watch.sample(probe, before, end > 0.5 * probe.seconds);
        samples += 1;
        if samples == 100 {
            memory = resident();
        }
        if probe.communication.is_none() && began.elapsed().as_secs_f64() < 0.005 * budget {
            step = (2.0 * step).min(longest);
        }
    }
    judged.cpu_seconds = start.elapsed().as_secs_f64();
    if let (Some(before), Some(now)) = (memory, resident()) {
        judged.criteria.push("memory");
        if now - before > FLAT {
            watch
                .violated
                .push(("memory", format!("grew by {:.1} MB", 1e-6 * (now - before))));
        }
    }
    None
}

/// When a base jumps \[s\]: before hard disks that are not shaken have come to rest.
const JUMP: f64 = 0.02;

/// The base's inputs, which jump once.
fn jump(watch: &mut Watch, probe: &Probe, end: f64) -> Result<(), Error> {
    let Some(height) = probe.jump else {
        return Ok(());
    };
    let now = if end > JUMP { height } else { 0.0 };
    watch.simulation.set("base.displacement", now)
}

/// Compares with the neighbour: the same bits where only the samples differ, the same mean where a limit is reached.
fn limits(watch: &mut Watch, probe: &Probe, budget: f64, judged: &mut Judged) {
    if probe.communication.is_some() && probe.jump.is_none() {
        judged.criteria.push("same bits");
        if let Err(what) = same_bits(watch, probe) {
            watch.violated.push(("same bits", what));
        }
    }
    if probe.is_soft() && watch.energy_error > SMALL {
        judged.criteria.push("shrinks");
        if let Err(what) = shrinks(watch, probe, budget) {
            watch.violated.push(("shrinks", what));
        }
    }
    let Some(tame) = &probe.tame else {
        return;
    };
    let neighbour = Probe {
        changes: tame.clone(),
        ..probe.clone()
    };
    let (Some([a, a_error]), Some([b, b_error])) = (ensemble(probe, budget), ensemble(&neighbour, budget)) else {
        return;
    };
    judged.criteria.push("tame neighbour");
    if (a - b).abs() > SIGMAS * a_error.hypot(b_error) {
        let what = format!("kinetic energy {a:.3e} +- {a_error:.1e} J, neighbour {b:.3e} +- {b_error:.1e} J");
        watch.violated.push(("tame neighbour", what));
    }
}

/// Whether the energy's error is the integrator's own: over an eighth of the run, so that it costs no more than the run,
/// with the step as it is and with an eighth of it.
fn shrinks(watch: &Watch, probe: &Probe, budget: f64) -> Result<(), String> {
    let step = watch
        .simulation
        .real("chosen_time_step")
        .map_err(|error| error.to_string())?;
    let seconds = FINER * watch.simulation.time();
    let error_at = |step: f64| {
        let mut changes = probe.changes.clone();
        changes.retain(|(name, _)| *name != "time_step");
        changes.push(("time_step", step.into()));
        let shorter = Probe {
            changes,
            seconds,
            communication: None,
            ..probe.clone()
        };
        let simulation = shorter
            .simulation(&shorter.changes)
            .map_err(|error| format!("step {step} s: {error}"))?;
        let mut watch = Watch::new(simulation);
        match run(&mut watch, &shorter, 10.0 * budget, &mut Judged::new()) {
            Some(error) => Err(format!("step {step} s: {error}")),
            None => Ok(watch.energy_error),
        }
    };
    let (coarse, fine) = (error_at(step)?, error_at(FINER * step)?);
    if fine <= (SHRUNK * coarse).max(SMALL) {
        Ok(())
    } else {
        Err(format!(
            "energy error {coarse:.1e} over {seconds:.1e} s, {fine:.1e} at an eighth of the step"
        ))
    }
}

/// Mean kinetic energy over the second half and its standard error, from several seeds; none if one is refused.
///
/// Seeds and not batches of time: what is frozen in a packing's order does not average out in one run.
fn ensemble(probe: &Probe, budget: f64) -> Option<[f64; 2]> {
    let mut means = Vec::new();
    for seed in 1..=SEEDS {
        let mut changes = probe.changes.clone();
        changes.push(("seed", seed.into()));
        let mut watch = Watch::new(probe.simulation(&changes).ok()?);
        if run(&mut watch, probe, budget, &mut Judged::new()).is_some() || watch.kinetic.is_empty() {
            return None;
        }
        means.push(watch.kinetic.iter().sum::<f64>() / watch.kinetic.len() as f64);
    }
    let count = means.len() as f64;
    let mean = means.iter().sum::<f64>() / count;
    let variance = means.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / (count - 1.0);
    Some([mean, (variance / count).sqrt()])
}

/// Whether one step to the same time gives the same angle to the last bit.
fn same_bits(watch: &Watch, probe: &Probe) -> Result<(), String> {
    let end = watch.simulation.time();
    let mut once = probe.simulation(&probe.changes).map_err(|error| error.to_string())?;
    once.advance_to(end).map_err(|error| format!("in one step: {error}"))?;
    let angles = [&watch.simulation, &once].map(|run| run.real("disk.angle[1]").unwrap_or(f64::NAN));
    if angles[0].to_bits() == angles[1].to_bits() {
        Ok(())
    } else {
        Err(format!("angle {} rad, in one step {} rad", angles[0], angles[1]))
    }
}

/// Resident memory of this process \[bytes\].
fn resident() -> Option<f64> {
    let pages: f64 = std::fs::read_to_string("/proc/self/statm")
        .ok()?
        .split_whitespace()
        .nth(1)?
        .parse()
        .ok()?;
    Some(4096.0 * pages)
}
