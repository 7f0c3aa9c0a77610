//! A disk on two supports by the engine of three disks: between walls against a closed form, and coming down onto two
//! disks, at rest and shaken, against itself in much smaller steps.

use std::rc::Rc;
use std::sync::OnceLock;

use jostle::scene::disk_on_two_supports::DiskOnTwoSupportsOnSine;
use jostle::scene::{Simulation, Value};

use super::case::{Case, Done, Point, Stopwatch, Trouble, known, ladder};
use super::lasting::{
    AMPLITUDE, DAMPING, FREQUENCY, GRAVITY, Oscillator, QUANTITIES, RADIUS, SLOPE, STIFFNESS, STIFFNESS_RATIO,
};

const METHOD: &str = "three disks, located events";
/// Steps a period.
const COARSEST: f64 = 22.0;
const LADDER: i32 = 7;
/// Steps a period of the reference.
const FINEST: f64 = 45_056.0;
/// Height from which the disk comes down \[m\].
const DROP: f64 = 1e-5;

/// Points of the case of a wedge, whose closed form is that of the same oscillator.
pub fn between_walls() -> impl Iterator<Item = Point> {
    let rig = Rig {
        shape: 2,
        amplitude: AMPLITUDE,
        drop: 0.0,
        friction: 10.0,
    };
    // With so much friction the scene takes no larger steps.
    ladder(8.0 * COARSEST, 2.0, 4).map(move |steps| {
        let exact = rig.oscillator().departure(rig.oscillator().end());
        rig.point(steps, move || Ok(exact))
    })
}

/// A disk that comes down onto two disks, at rest and shaken.
pub fn cases() -> Vec<Case> {
    let shaken = format!("that shake at {FREQUENCY} Hz, A = {AMPLITUDE:e} m");
    vec![
        on_disks("three_disks_at_rest", "at rest", 0.0),
        on_disks("three_disks_shaken", &shaken, AMPLITUDE),
    ]
}

fn on_disks(name: &'static str, what: &str, amplitude: f64) -> Case {
    let rig = Rig {
        shape: 1,
        amplitude,
        drop: DROP,
        friction: 0.5,
    };
    let reference: Rc<OnceLock<f64>> = Rc::default();
    let points = ladder(COARSEST, 2.0, LADDER).map(|steps| {
        let reference = Rc::clone(&reference);
        rig.point(steps, move || {
            known(&reference, || rig.risen(FINEST, &mut Stopwatch::default())).copied()
        })
    });
    Case {
        name,
        problem: format!(
            "A disk comes down by 10 um onto two disks of its size {what}, for eight periods of its contact."
        ),
        setting: "time steps a period of the contact",
        reference: "45,056 steps a period",
        quantities: QUANTITIES,
        points: points.collect(),
    }
}

/// What differs between the cases.
#[derive(Debug, Clone, Copy)]
struct Rig {
    /// Option of `support.shape`.
    shape: i64,
    amplitude: f64,
    drop: f64,
    friction: f64,
}

impl Rig {
    /// The disk between walls as a linear oscillator.
    fn oscillator(&self) -> Oscillator {
        Oscillator::on(&[-SLOPE, SLOPE])
    }

    fn simulation(&self, steps: f64) -> Result<Simulation<DiskOnTwoSupportsOnSine>, Trouble> {
        let oscillator = self.oscillator();
        let given: [(&str, Value); 13] = [
            ("gravity", GRAVITY.into()),
            ("support.shape", self.shape.into()),
            ("support.angle", SLOPE.into()),
            ("disk.radius", RADIUS.into()),
            ("disk.mass", oscillator.mass.into()),
            ("contact.normal_stiffness", STIFFNESS.into()),
            ("contact.stiffness_ratio", STIFFNESS_RATIO.into()),
            ("contact.normal_damping", DAMPING.into()),
            ("contact.friction", self.friction.into()),
            ("disk.drop_height", self.drop.into()),
            ("drive.amplitude", self.amplitude.into()),
            ("drive.frequency", FREQUENCY.into()),
            ("time_step", (oscillator.period() / steps).into()),
        ];
        Ok(Simulation::new(&[], &given)?)
    }

    /// How far the disk has risen at the end \[m\].
    fn risen(&self, steps: f64, watch: &mut Stopwatch) -> Result<f64, Trouble> {
        let mut disk = self.simulation(steps)?;
        let start = disk.real("disk.y[1]")?;
        watch.measure(1, || disk.advance_to(self.oscillator().end()))?;
        Ok(disk.real("disk.y[1]")? - start)
    }

    fn point(self, steps: f64, mut exact: impl FnMut() -> Result<f64, Trouble> + 'static) -> Point {
        Point::new(METHOD, steps, move |watch: &mut Stopwatch| {
            let error = (self.risen(steps, watch)? - exact()?).abs() / AMPLITUDE;
            Ok(Done::exact(
                [error],
                steps * self.oscillator().end() / self.oscillator().period(),
            ))
        })
    }
}
