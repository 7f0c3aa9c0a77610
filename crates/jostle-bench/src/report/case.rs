//! What a work-precision diagram is made of: a case, its curves, and one run of one point.

use std::error::Error as StdError;
use std::sync::OnceLock;

use cpu_time::ProcessTime;
use jostle::scene::{Model, Simulation, Value};

/// Why a point has no number; the report says so instead of leaving it out.
pub type Trouble = Box<dyn StdError>;

/// One run of one point: work inside [`Stopwatch::measure`] is timed, the rest is not.
pub type Work = Box<dyn FnMut(&mut Stopwatch) -> Result<Done, Trouble>>;

/// One problem with a known answer, solved by several methods at several settings.
pub struct Case {
    /// Short name, the key of the CSV files.
    pub name: &'static str,
    /// The problem in a sentence, with its numbers.
    pub problem: String,
    /// What the setting of a point is, with its unit.
    pub setting: &'static str,
    /// What the errors are measured against.
    pub reference: &'static str,
    /// What is measured: name, and what the error is, with its unit.
    pub quantities: &'static [(&'static str, &'static str)],
    /// The points, method by method.
    pub points: Vec<Point>,
}

/// One point of a curve.
pub struct Point {
    /// The curve.
    pub method: &'static str,
    /// Where on the curve.
    pub setting: f64,
    /// Solves the problem once.
    pub work: Work,
}

/// What one run found.
#[derive(Debug, Clone, PartialEq)]
pub struct Done {
    /// Error of each quantity, not negative, with its statistical error (0 where there is none).
    pub errors: Vec<(f64, f64)>,
    /// Work of one solution: force evaluations, impacts or bounces.
    pub evaluations: f64,
}

impl Done {
    /// Errors without statistical errors.
    pub fn exact(errors: impl IntoIterator<Item = f64>, evaluations: f64) -> Self {
        let errors = errors.into_iter().map(|error| (error, 0.0)).collect();
        Self { errors, evaluations }
    }
}

impl Point {
    /// A point of the curve `method` at `setting`.
    pub fn new(
        method: &'static str,
        setting: f64,
        work: impl FnMut(&mut Stopwatch) -> Result<Done, Trouble> + 'static,
    ) -> Self {
        let work = Box::new(work);
        Self { method, setting, work }
    }
}

/// CPU time of this process while it solved, and how often it did.
#[derive(Debug, Default)]
pub struct Stopwatch {
    seconds: f64,
    solutions: u32,
}

impl Stopwatch {
    /// Times `work`, which solves the problem `solutions` times: many where one is too short for a clock.
    pub fn measure<T>(&mut self, solutions: u32, work: impl FnOnce() -> T) -> T {
        let start = ProcessTime::now();
        let done = work();
        self.seconds += start.elapsed().as_secs_f64();
        self.solutions += solutions;
        done
    }

    /// CPU seconds of one solution.
    pub fn each(&self) -> f64 {
        self.seconds / f64::from(self.solutions.max(1))
    }

    /// CPU seconds so far.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }
}

/// What `cell` holds, computed the first time.
pub fn known<T>(cell: &OnceLock<T>, compute: impl FnOnce() -> Result<T, Trouble>) -> Result<&T, Trouble> {
    if let Some(known) = cell.get() {
        return Ok(known);
    }
    let computed = compute()?;
    Ok(cell.get_or_init(|| computed))
}

/// `count` settings from `first` on, each `ratio` times the one before.
pub fn ladder(first: f64, ratio: f64, count: i32) -> impl Iterator<Item = f64> {
    (0..count).map(move |step| first * ratio.powi(step))
}

/// A count among the outputs of a scene, whole or real; NaN where the scene has none.
pub fn count<M: Model>(simulation: &Simulation<M>, name: &str) -> f64 {
    let value = simulation
        .position(name)
        .and_then(|position| simulation.value(position));
    value.map_or(f64::NAN, Value::to_f64)
}

/// Mean of independent numbers and its standard error.
pub fn mean_and_error(numbers: &[f64]) -> (f64, f64) {
    let count = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / count;
    let variance = numbers.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / (count - 1.0);
    (mean, (variance / count).sqrt())
}

/// Root of the mean square.
pub fn root_mean_square(numbers: &[f64]) -> f64 {
    (numbers.iter().map(|number| number * number).sum::<f64>() / numbers.len() as f64).sqrt()
}
