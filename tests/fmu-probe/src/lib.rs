//! Oscillators on a shaken base: a scene as small as can be that has one variable of each kind, for the tests of the FMI
//! boundary, and that can be told to refuse a step or to panic. It has an event: disk 1 passes height zero.
//!
//! x'' = -(k / m) (x - base) - (c / m) (v - base'), semi-implicit Euler on the fixed grid start + n time step.

use jostle::scene::{Card, Choice, OutputWriter, Reached, Scene, Unit, Values, Variable};
use jostle::{Error, Result};
use serde::{Deserialize, Serialize};

jostle::export_fmu!(crate::Probe);

const TIME_STEP: f64 = 1e-3;
/// Communication points carry the importer's rounding: a grid point that is late by this part of a step counts as reached.
const GRID_TOLERANCE: f64 = 1e-6;
const GRAVITY: f64 = 9.8;
/// Time steps that one call may ask for: a step of 100 s.
const MOST_STEPS: f64 = 1e5;
const PATTERNS: &[(&str, &str)] = &[
    ("random", "With velocities that the seed decides."),
    ("at_rest", "Without velocity, < 1 m/s."),
];

/// State of all oscillators.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    time: f64,
    steps: u64,
    random: u64,
    displacements: Vec<f64>,
    velocities: Vec<f64>,
    force: f64,
}

/// The scene.
pub struct Probe {
    start: f64,
    stiffness: f64,
    mass: f64,
    damping: f64,
    panic_time: f64,
    refuse_time: f64,
    state: State,
}

impl Scene for Probe {
    type State = State;

    const EVENTS: bool = true;

    fn card() -> Card {
        Card {
            scene: "probe",
            identifier: "fmu_probe",
            engine: "oscillators",
            drive: "input",
            description: "Oscillators on a base that follows an input",
            equations: "<p>m x'' = -k (x - base) - c (x' - base')</p>",
            disks: 1..=100,
            default_disks: 3,
            stop_time: 1.0,
            step_size: 0.01,
        }
    }

    fn variables(choice: Choice) -> Vec<Variable> {
        let mut rows = vec![
            Variable::parameter(
                "spring.stiffness",
                Unit::NewtonPerMetre,
                1.0..=1e6,
                100.0,
                "Stiffness of all springs.",
            ),
            Variable::parameter(
                "disk.mass",
                Unit::Kilogram,
                1e-3..=10.0,
                0.1,
                "Mass of the first disk, \"m\" < 10.",
            ),
            Variable::parameter(
                "damper.damping",
                Unit::KilogramPerSecond,
                0.0..=100.0,
                0.2,
                "Damping of all springs.",
            ),
            Variable::long_parameter("seed", 0..=i64::MAX, 42, "Seed of the starting velocities."),
            Variable::enumeration_parameter("start.pattern", "start_pattern", PATTERNS, 1, "How the disks start."),
            Variable::parameter(
                "fault.panic_time",
                Unit::Second,
                0.0..=1e9,
                1e9,
                "Panics when time passes this.",
            ),
            Variable::parameter(
                "fault.refuse_time",
                Unit::Second,
                0.0..=1e9,
                1e9,
                "Refuses steps beyond this.",
            ),
            Variable::input("base.displacement", Unit::Metre, 1e-3, "Height of the base."),
            Variable::input("base.velocity", Unit::MetrePerSecond, 0.1, "Velocity of the base."),
            Variable::calculated(
                "natural.angle_rate",
                Unit::RadianPerSecond,
                10.0,
                "Natural angular frequency.",
            ),
            Variable::output("base.reaction_force", Unit::Newton, 1.0, "Force on the base."),
            Variable::count_output("steps", "Internal steps since the start."),
        ];
        rows.extend((1..=choice.disks).map(|disk| {
            let name = format!("disk.displacement[{disk}]");
            Variable::output(name, Unit::Metre, 1e-3, format!("Displacement of disk {disk}."))
        }));
        rows
    }

    fn new(choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
        let (stiffness, damping) = (values.real("spring.stiffness"), values.real("damper.damping"));
        let mass = values.real("disk.mass");
        if damping * TIME_STEP > mass {
            return Err(Error::parameter(
                "damper.damping",
                damping,
                format!("at most {}", mass / TIME_STEP),
                "Lower it or raise disk.mass.",
            ));
        }
        let mut state = State {
            time: start_time,
            steps: 0,
            random: values.integer("seed") as u64,
            displacements: vec![values.real("base.displacement"); choice.disks as usize],
            velocities: vec![0.0; choice.disks as usize],
            force: 0.0,
        };
        if values.integer("start.pattern") == 1 {
            for velocity in &mut state.velocities {
                *velocity = draw(&mut state.random);
            }
        }
        Ok(Self {
            start: start_time,
            stiffness,
            mass,
            damping,
            panic_time: values.real("fault.panic_time"),
            refuse_time: values.real("fault.refuse_time"),
            state,
        })
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        self.check_faults(end_time)?;
        self.check_work(end_time)?;
        while self.next_point() <= latest(end_time) {
            self.step(values);
        }
        self.state.time = end_time;
        Ok(())
    }

    fn advance_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.check_work(end_time)?;
        let before_all = self.state.clone();
        let (from, mut event, mut time) = (self.state.time, false, end_time);
        while !event && self.next_point() <= latest(end_time) {
            time = self.next_point().min(end_time);
            let before = self.state.displacements[0];
            self.step(values);
            // A grid finer than the resolution of time, or a damaged count of steps, has points that are no later.
            event = time > from && (before < 0.0) != (self.state.displacements[0] < 0.0);
        }
        let time = if event { time } else { end_time };
        // Faults show where they are, so that events before them are met.
        self.check_faults(time).inspect_err(|_| self.state = before_all)?;
        self.state.time = time;
        Ok(Reached { time, event })
    }

    fn write_outputs(&self, mut outputs: OutputWriter<'_>) {
        outputs.real("natural.angle_rate", (self.stiffness / self.mass).sqrt());
        outputs.real("base.reaction_force", self.state.force);
        outputs.integer("steps", self.state.steps as i64);
        outputs.reals("disk.displacement", self.state.displacements.iter().copied());
        outputs.finish();
    }

    fn state(&self) -> State {
        self.state.clone()
    }

    fn time_of(state: &State) -> f64 {
        state.time
    }

    fn restore(&mut self, state: &State) -> Result<()> {
        if state.displacements.len() != self.state.displacements.len()
            || state.velocities.len() != state.displacements.len()
        {
            return Err(Error::state(
                "it has another number of disks",
                "Restore it with the FMU that wrote it.",
            ));
        }
        self.state.clone_from(state);
        Ok(())
    }
}

/// The latest grid point that a step to `end_time` reaches.
fn latest(end_time: f64) -> f64 {
    end_time + GRID_TOLERANCE * TIME_STEP
}

impl Probe {
    fn check_faults(&self, end_time: f64) -> Result<()> {
        if end_time > self.refuse_time {
            return Err(Error::Step {
                scene: "probe",
                time: self.refuse_time,
                what: format!("the end {end_time} s lies beyond fault.refuse_time; 100% sure"),
                remedy: "Take a shorter step.".into(),
            });
        }
        assert!(end_time <= self.panic_time, "told to panic at {} s", self.panic_time);
        Ok(())
    }

    fn check_work(&self, end_time: f64) -> Result<()> {
        let now = self.start + self.state.steps as f64 * TIME_STEP;
        let asked = (end_time - now) / TIME_STEP;
        if asked > MOST_STEPS {
            return Err(Error::too_much_work("probe", now, format!("{asked:e} time steps")));
        }
        Ok(())
    }

    fn next_point(&self) -> f64 {
        self.start + (self.state.steps + 1) as f64 * TIME_STEP
    }

    fn step(&mut self, values: &Values) {
        let (height, rate) = (values.real("base.displacement"), values.real("base.velocity"));
        let state = &mut self.state;
        state.steps += 1;
        state.force = 0.0;
        for (index, (x, v)) in state.displacements.iter_mut().zip(&mut state.velocities).enumerate() {
            let mass = self.mass * (1.0 + index as f64);
            let force = -self.stiffness * (*x - height) - self.damping * (*v - rate);
            let kick = 1e-3 * draw(&mut state.random);
            *v += TIME_STEP * (force / mass - GRAVITY) + kick;
            *x += TIME_STEP * *v;
            state.force -= force;
        }
    }
}

/// Uniform in [-1, 1): a linear congruential generator is enough to notice a state that was not restored.
fn draw(random: &mut u64) -> f64 {
    *random = random
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*random >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
