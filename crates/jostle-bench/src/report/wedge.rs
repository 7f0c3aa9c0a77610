//! Rotation in a tilted wedge: map, random phase and moving wedge against each other.
//!
//! Setting: simulated time. The statistical error falls with its root; what remains is the bias of a method.

use std::rc::Rc;
use std::sync::OnceLock;

use jostle::drive::Sine;
use jostle::scene::wedge::{WedgeEventDrivenOnSine, WedgeMap, WedgeMolecularDynamicsOnSine};
use jostle::scene::{Model, Simulation, Value};

use super::case::{Case, Done, Point, Stopwatch, Trouble, count, known, ladder, mean_and_error};

const TILT: f64 = 21.0;
const GAMMA: f64 = 2.0;
const SEEDS: i64 = 16;
const SETTLED: f64 = 1.0;
const REFERENCE_SECONDS: f64 = 1000.0;
const QUANTITIES: &[(&str, &str)] = &[(
    "scaled_angular_velocity",
    "difference of R omega / (A omega_b) from the moving wedge, with its statistical error",
)];

/// Mean over the seeds, its standard error, impacts.
#[derive(Debug, Clone, Copy)]
struct Mean {
    mean: f64,
    error: f64,
    collisions: f64,
}

/// The wedge of 120 degrees.
pub fn cases() -> Vec<Case> {
    let reference: Rc<OnceLock<Mean>> = Rc::default();
    let mut points = Vec::new();
    for seconds in ladder(0.25, 4.0, 6) {
        points.push(point::<WedgeMap>("map, random phase", &reference, seconds));
        points.push(point::<WedgeEventDrivenOnSine>(
            "event-driven, moving wedge",
            &reference,
            seconds,
        ));
    }
    for seconds in ladder(0.25, 4.0, 3) {
        points.push(point::<WedgeMolecularDynamicsOnSine>(
            "molecular dynamics",
            &reference,
            seconds,
        ));
    }
    vec![Case {
        name: "wedge_rotation",
        problem: format!(
            "A disk in a wedge of 120 degrees tilted by {TILT} degrees, 80 Hz, Gamma {GAMMA}, e_n = 0.9: mean rotation, {SEEDS} seeds."
        ),
        setting: "simulated time of each seed [s]",
        reference: "the exactly moving wedge, other seeds, 1000 s each",
        quantities: QUANTITIES,
        points,
    }]
}

fn point<M: Model>(method: &'static str, reference: &Rc<OnceLock<Mean>>, seconds: f64) -> Point {
    let reference = Rc::clone(reference);
    Point::new(method, seconds, move |watch: &mut Stopwatch| {
        let exact = known(&reference, || {
            mean::<WedgeEventDrivenOnSine>(1001, REFERENCE_SECONDS, &mut Stopwatch::default())
        })?;
        let found = mean::<M>(1, seconds, watch)?;
        Ok(Done {
            errors: vec![((found.mean - exact.mean).abs(), found.error.hypot(exact.error))],
            evaluations: found.collisions,
        })
    })
}

fn mean<M: Model>(first_seed: i64, seconds: f64, watch: &mut Stopwatch) -> Result<Mean, Trouble> {
    let (mut means, mut collisions) = (Vec::new(), 0.0);
    for seed in first_seed..first_seed + SEEDS {
        let parameters: [(&str, Value); 4] = [
            ("drive.amplitude", Sine::amplitude_of(GAMMA, 80.0, 9.81).into()),
            ("wedge.tilt", TILT.to_radians().into()),
            ("measure.start", SETTLED.into()),
            ("seed", seed.into()),
        ];
        let mut wedge = Simulation::<M>::new(&[], &parameters)?;
        watch.measure(u32::from(seed == first_seed), || wedge.advance_to(SETTLED + seconds))?;
        means.push(wedge.real("scaled_angular_velocity")?);
        collisions += count(&wedge, "collisions");
    }
    let (mean, error) = mean_and_error(&means);
    Ok(Mean {
        mean,
        error,
        collisions,
    })
}
