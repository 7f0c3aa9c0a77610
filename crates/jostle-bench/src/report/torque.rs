//! A disk on two supports under a slow harmonic torque: mean rotation against the closed form of P 5.9.

use std::f64::consts::{PI, TAU};
use std::rc::Rc;
use std::sync::OnceLock;

use jostle::measure::disk_on_two_supports::{
    HarmonicTorque, Setting, closed_form, closed_form_with_inertia, limits, relaxed,
};
use jostle::scene::Simulation;
use jostle::scene::disk_on_two_supports::DiskOnTwoSupportsOnHarmonicTorque;

use super::case::{Case, Done, Point, Stopwatch, Trouble, known, ladder};

const TORQUE: HarmonicTorque = HarmonicTorque {
    amplitude: 0.125,
    angular_frequency: 2.0,
};
const TILT: f64 = 0.08 * PI;
const STIFFNESS: f64 = 1e3;
/// Periods before and during the measurement.
const FORGOTTEN: f64 = 1.0;
const MEASURED: f64 = 1.0;
const METHOD: &str = "located events";

/// By the time step, and by the stiffness.
pub fn cases() -> Vec<Case> {
    let reference: Rc<OnceLock<f64>> = Rc::default();
    let steps = ladder(1.0, 0.5, 7).map(|share| {
        let reference = Rc::clone(&reference);
        Point::new(METHOD, share, move |watch: &mut Stopwatch| {
            let tight = || Ok(run(STIFFNESS, 1.0 / 512.0, &mut Stopwatch::default())?.0);
            let exact = known(&reference, tight)?;
            let (found, evaluations) = run(STIFFNESS, share, watch)?;
            let theory = with_corrections(STIFFNESS)?;
            let errors = [found / exact - 1.0, found / theory - 1.0].map(f64::abs);
            Ok(Done::exact(errors, evaluations))
        })
    });
    let stiffnesses = ladder(1e3, 10.0, 4).map(|stiffness| {
        Point::new(METHOD, stiffness, move |watch: &mut Stopwatch| {
            let (found, evaluations) = run(stiffness, 1.0, watch)?;
            let errors = [printed()?, with_corrections(stiffness)?].map(|theory| (found / theory - 1.0).abs());
            Ok(Done::exact(errors, evaluations))
        })
    });
    let problem = "A disk on two supports tilted by 14.4 degrees under a torque of 0.125 N.m at 2 rad/s turns";
    vec![
        Case {
            name: "torque",
            problem: format!("{problem}; k_n = 1e3 N/m, k_t = 1e6 N/m, mu = 0.1."),
            setting: "time step over the default one",
            reference: "a step of a 512th of the default; P 5.9 with overlap and inertia",
            quantities: &[
                ("rotation", "relative error of the mean angular velocity"),
                ("theory", "relative difference from P 5.9 with overlap and inertia"),
            ],
            points: steps.collect(),
        },
        Case {
            name: "torque_stiffness",
            problem: format!("{problem}; k_t = 1e6 N/m, mu = 0.1: P 5.9 is for rigid disks, the scene's are soft."),
            setting: "normal stiffness k_n [N/m], at the default time step",
            reference: "P 5.9",
            quantities: &[
                (
                    "printed",
                    "relative difference of the mean angular velocity from P 5.9 as printed",
                ),
                ("corrected", "the same from P 5.9 with overlap and inertia"),
            ],
            points: stiffnesses.collect(),
        },
    ]
}

fn setting() -> Setting {
    Setting::THESIS.tilted(TILT)
}

fn printed() -> Result<f64, Trouble> {
    closed_form(&setting(), &limits(&setting()), TORQUE).ok_or_else(|| "beyond the range of P 5.9".into())
}

fn with_corrections(stiffness: f64) -> Result<f64, Trouble> {
    let soft = relaxed(&setting(), stiffness, setting().radius)?.limits();
    closed_form_with_inertia(&setting(), &soft, stiffness, TORQUE).ok_or_else(|| "beyond the range of P 5.9".into())
}

/// Mean angular velocity \[rad/s\] over whole periods, and the time steps done; `share` of the default time step.
fn run(stiffness: f64, share: f64, watch: &mut Stopwatch) -> Result<(f64, f64), Trouble> {
    let setting = setting();
    let mut given = vec![
        ("tilt", TILT.into()),
        ("contact.normal_stiffness", stiffness.into()),
        (
            "contact.stiffness_ratio",
            (setting.tangential_stiffness / stiffness).into(),
        ),
        ("torque.amplitude", TORQUE.amplitude.into()),
        ("torque.angular_frequency", TORQUE.angular_frequency.into()),
    ];
    let default = Simulation::<DiskOnTwoSupportsOnHarmonicTorque>::new(&[], &given)?.real("chosen_time_step")?;
    given.push(("time_step", (share * default).into()));
    let mut disk = Simulation::<DiskOnTwoSupportsOnHarmonicTorque>::new(&[], &given)?;
    let period = TAU / TORQUE.angular_frequency;
    let end = (FORGOTTEN + MEASURED) * period;
    let turned = watch.measure(1, || -> Result<f64, Trouble> {
        disk.advance_to(FORGOTTEN * period)?;
        let before = disk.real("disk.angle[1]")?;
        disk.advance_to(end)?;
        Ok(disk.real("disk.angle[1]")? - before)
    })?;
    Ok((turned / (MEASURED * period), end / (share * default)))
}
