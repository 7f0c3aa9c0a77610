//! Ensemble means of a shaken packing: bias and statistical error apart.
//!
//! The mean over disks and time of the squared angular velocity, after settling, for the same seeds by every method.
//! The bias is the mean over the seeds of the difference to the reference; its bar is the standard error of that mean.

use std::rc::Rc;
use std::sync::OnceLock;

use jostle::drive::Sine;
use jostle::scene::packing::PackingOnSine;
use jostle::scene::packing::event_driven::HardPackingOnSine;
use jostle::scene::{Model, Simulation, Value};

use super::case::{Case, Done, Point, Stopwatch, Trouble, count, known, ladder, mean_and_error};

const DISKS: u32 = 60;
const GAMMA: f64 = 4.0;
const SEEDS: i64 = 24;
const SETTLED: f64 = 0.5;
const SECONDS: f64 = 2.0;
const SAMPLE: f64 = 0.01;
const QUANTITIES: &[(&str, &str)] = &[(
    "omega_square",
    "relative bias of the mean squared angular velocity, with its statistical error",
)];

/// Mean squared angular velocity of each seed \[rad2/s2\], and the work done.
struct Ensemble {
    means: Vec<f64>,
    work: f64,
}

/// Soft disks by step; rules against inelastic collapse by threshold.
pub fn cases() -> Vec<Case> {
    let reference: Rc<OnceLock<Vec<f64>>> = Rc::default();
    let soft = ladder(5e-5, 0.5, 4).map(|step| {
        let reference = Rc::clone(&reference);
        Point::new("velocity Verlet", step, move |watch: &mut Stopwatch| {
            let exact = known(&reference, || Ok(soft(5e-5 / 16.0, &mut Stopwatch::default())?.means))?;
            Ok(compared(&soft(step, watch)?, exact))
        })
    });
    let rule_reference: Rc<OnceLock<Vec<f64>>> = Rc::default();
    let rules = ladder(1e-3, 0.1, 6).chain([0.0]).map(|time| {
        let reference = Rc::clone(&rule_reference);
        Point::new("contact time", time, move |watch: &mut Stopwatch| {
            let exact = known(&reference, || Ok(hard(1e-9, &mut Stopwatch::default())?.means))?;
            Ok(compared(&hard(time, watch)?, exact))
        })
    });
    let problem = format!(
        "{DISKS} disks at 80 Hz, Gamma {GAMMA}: mean of omega^2 over {SECONDS} s after {SETTLED} s, {SEEDS} packings"
    );
    vec![
        Case {
            name: "packing60_mean",
            problem: format!("{problem}, soft contacts."),
            setting: "time step [s]",
            reference: "velocity Verlet at a time step of 3.1 us, the same packings",
            quantities: QUANTITIES,
            points: soft.collect(),
        },
        Case {
            name: "hard_packing60_rule",
            problem: format!("{problem}, hard disks on a moving bottom: the rule that keeps impacts from piling up."),
            setting: "collision.contact_time [s]; 0: no rule",
            reference: "contact time of 1 ns, the same packings",
            quantities: QUANTITIES,
            points: rules.collect(),
        },
    ]
}

fn soft(time_step: f64, watch: &mut Stopwatch) -> Result<Ensemble, Trouble> {
    let further = [("time_step", Value::from(time_step))];
    ensemble::<PackingOnSine>(&further, |_| (SETTLED + SECONDS) / time_step, watch)
}

fn hard(contact_time: f64, watch: &mut Stopwatch) -> Result<Ensemble, Trouble> {
    let further = [("collision.contact_time", Value::from(contact_time))];
    ensemble::<HardPackingOnSine>(&further, |packing| count(packing, "collisions"), watch)
}

fn ensemble<M: Model>(
    further: &[(&str, Value)],
    work: impl Fn(&Simulation<M>) -> f64,
    watch: &mut Stopwatch,
) -> Result<Ensemble, Trouble> {
    let mut found = Ensemble {
        means: Vec::new(),
        work: 0.0,
    };
    for seed in 1..=SEEDS {
        let amplitude = Sine::amplitude_of(GAMMA, 80.0, 9.8);
        let mut parameters = vec![("drive.amplitude", amplitude.into()), ("seed", seed.into())];
        parameters.extend_from_slice(further);
        let mut packing = Simulation::<M>::new(&[("disks", DISKS)], &parameters)?;
        let spins = packing.position("disk.angular_velocity[1]")?;
        let samples = (SECONDS / SAMPLE).round() as u32;
        let sum = watch.measure(u32::from(seed == 1), || {
            packing.advance_to(SETTLED)?;
            (1..=samples).try_fold(0.0, |sum, sample| -> jostle::Result<f64> {
                packing.advance_to(SETTLED + f64::from(sample) * SAMPLE)?;
                let squares = (spins..spins + DISKS as usize).map(|spin| Ok(packing.value(spin)?.to_f64().powi(2)));
                Ok(sum + squares.sum::<jostle::Result<f64>>()?)
            })
        })?;
        found.means.push(sum / f64::from(samples * DISKS));
        found.work += work(&packing);
    }
    Ok(found)
}

/// Relative bias and its standard error, seed by seed.
fn compared(found: &Ensemble, exact: &[f64]) -> Done {
    let scale = exact.iter().sum::<f64>() / exact.len() as f64;
    let differences: Vec<f64> = found.means.iter().zip(exact).map(|(a, b)| (a - b) / scale).collect();
    let (bias, error) = mean_and_error(&differences);
    Done {
        errors: vec![(bias.abs(), error)],
        evaluations: found.work,
    }
}
