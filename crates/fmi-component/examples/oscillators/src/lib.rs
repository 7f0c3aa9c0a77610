//! Oscillators on a moving frame: a model as small as can be that has a variable of each kind, an event (body 1 passes height
//! zero), a structural parameter for the number of bodies, tunable parameters (spring and damper), and that can be set to refuse a
//! step or to panic. The tests use it.
//!
//! x'' = -(k / m) (x - frame) - (c / m) (v - frame') - g, semi-implicit Euler on the fixed grid start + n time step.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

use fmi_component::{
    DataSheet, Derived, Error, Model, ModelInfo, Reached, Result, Row, StructuralParameter, StructuralParameters,
    Symbol, Unit, Values, Warning,
};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

fmi_component::export_fmu!(crate::Oscillators);

const TIME_STEP: f64 = 1e-3;
/// Communication points carry the importer's rounding: a grid point that is late by this part of a step counts as reached.
const GRID_TOLERANCE: f64 = 1e-6;
const GRAVITY: f64 = 9.8;
/// Time steps that one call may ask for, unless it is limited otherwise: a step of 100 s.
const MOST_STEPS: u64 = 100_000;
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
    positions: Vec<f64>,
    velocities: Vec<f64>,
    force: f64,
}

/// The model.
#[derive(Debug)]
pub struct Oscillators {
    start: f64,
    stiffness: f64,
    mass: f64,
    damping: f64,
    panic_time: f64,
    refuse_time: f64,
    most_steps: u64,
    state: State,
}

impl Model for Oscillators {
    type State = State;

    const EVENTS: bool = true;

    fn info() -> ModelInfo {
        ModelInfo {
            package: "fmi-component",
            version: env!("CARGO_PKG_VERSION"),
            name: "oscillators",
            variant: vec![("drive", "input")],
            identifier: "oscillators".into(),
            description: "Oscillators on a frame that follows an input",
            equations: "<p>m x'' = -k (x - frame) - c (x' - frame') - m g</p>",
            structure: vec![StructuralParameter {
                name: "bodies",
                description: "Number of bodies.",
                range: 1..=100,
                default: 3,
            }],
            stop_time: 1.0,
            step_size: 0.01,
            sheet: DataSheet {
                purpose: "Springs &amp; masses to try an importer with.",
                limits: vec!["<b>Linear.</b> Springs of any length."],
                without_inputs: "The frame stands still.",
                picture: vec!["<circle class=\"body\" cx=\"160\" cy=\"120\" r=\"40\"/>"],
                outputs: vec!["frame.reaction_force", "body.position"],
                parameters: vec!["spring.stiffness"],
                symbols: vec![Symbol {
                    symbol: "<i>k</i>",
                    variable: "spring.stiffness",
                    meaning: "stiffness",
                }],
                example: None,
            },
        }
    }

    fn variables(structure: &StructuralParameters) -> Vec<Row<Self>> {
        let mut rows = parameters();
        rows.extend([
            Row::input("frame.position", Unit::METRE, 1e-3, "Height of the frame.").with_derivative("frame.velocity"),
            Row::input("frame.velocity", Unit::METRE_PER_SECOND, 0.1, "Velocity of the frame."),
            Row::calculated(
                "natural.angle_rate",
                Unit::RADIAN_PER_SECOND,
                10.0,
                "Natural angular frequency.",
                |model: &Self| (model.stiffness / model.mass).sqrt(),
            )
            .depending_on(&Arc::from(["spring.stiffness", "body.mass"])),
            Row::output(
                "frame.reaction_force",
                Unit::NEWTON,
                1.0,
                "Force on the frame.",
                |model: &Self| model.state.force,
            ),
            Row::count_output("steps", "Internal steps since the start.", |model: &Self| {
                model.state.steps as i64
            }),
        ]);
        let bodies = structure.get("bodies");
        let read = |model: &Self, body: usize| model.state.positions[body];
        rows.extend(Row::outputs(
            "body.position",
            bodies,
            Unit::METRE,
            1e-3,
            "Position of body {}.",
            read,
        ));
        rows
    }

    fn new(structure: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        let mass = values.real("body.mass");
        let [stiffness, damping] = stiffness_and_damping(values)?;
        let bodies = structure.get("bodies") as usize;
        let mut state = State {
            time: start_time,
            steps: 0,
            random: values.integer("seed") as u64,
            positions: vec![values.real("frame.position"); bodies],
            velocities: vec![0.0; bodies],
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
            most_steps: MOST_STEPS,
            state,
        })
    }

    fn tune(&mut self, values: &Values) -> Result<()> {
        [self.stiffness, self.damping] = stiffness_and_damping(values)?;
        Ok(())
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
            let before = self.state.positions[0];
            self.step(values);
            // A grid finer than the resolution of time, or a damaged count of steps, has points that are no later.
            event = time > from && (before < 0.0) != (self.state.positions[0] < 0.0);
        }
        let time = if event { time } else { end_time };
        // Faults show where they are, so that events before them are met.
        self.check_faults(time).inspect_err(|_| self.state = before_all)?;
        self.state.time = time;
        Ok(Reached { time, event })
    }

    fn limit_work(&mut self, most: u64) {
        self.most_steps = most;
    }

    fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        let topic = "damper.damping";
        let doubtful = self.damping == 0.0 && !told.contains(&topic);
        let text = "damper.damping = 0: the bodies never come to rest. Set it above 0 if they should.";
        let warning = || Warning {
            topic,
            text: text.into(),
        };
        doubtful.then(warning).into_iter().collect()
    }

    fn state(&self) -> State {
        self.state.clone()
    }

    fn time_of(state: &State) -> f64 {
        state.time
    }

    fn restore(&mut self, state: &State) -> Result<()> {
        if state.positions.len() != self.state.positions.len() || state.velocities.len() != state.positions.len() {
            return Err(Error::state(
                "it has another number of bodies",
                "Restore it with the FMU that wrote it.",
            ));
        }
        self.state.clone_from(state);
        Ok(())
    }
}

fn parameters() -> Vec<Row<Oscillators>> {
    vec![
        Row::parameter(
            "spring.stiffness",
            Unit::NEWTON_PER_METRE,
            1.0..=1e6,
            100.0,
            "Stiffness of all springs.",
        )
        .tunable(),
        Row::parameter(
            "body.mass",
            Unit::KILOGRAM,
            1e-3..=10.0,
            0.1,
            "Mass of the first body, \"m\" < 10.",
        ),
        Row::parameter(
            "damper.damping",
            Unit::KILOGRAM_PER_SECOND,
            0.0..=100.0,
            0.2,
            "Damping of all springs.",
        )
        .tunable()
        .recommended_by(
            Derived {
                name: "damping ratio",
                unit: Unit::ONE,
                value: |real| real("damper.damping") / (2.0 * (real("spring.stiffness") * real("body.mass")).sqrt()),
            },
            0.0..=1.0,
            "the bodies creep; 1 < c is no oscillator.",
        ),
        Row::long_parameter("seed", 0..=i64::MAX, 42, "Seed of the starting velocities."),
        Row::enumeration_parameter("start.pattern", "start_pattern", PATTERNS, 1, "How the bodies start."),
        Row::parameter(
            "fault.panic_time",
            Unit::SECOND,
            0.0..=1e9,
            1e9,
            "Panics when time passes this.",
        ),
        Row::parameter(
            "fault.refuse_time",
            Unit::SECOND,
            0.0..=1e9,
            1e9,
            "Refuses steps beyond this.",
        ),
    ]
}

/// The tunable parameters, if the mass is not too small for them.
fn stiffness_and_damping(values: &Values) -> Result<[f64; 2]> {
    let (stiffness, damping, mass) = (
        values.real("spring.stiffness"),
        values.real("damper.damping"),
        values.real("body.mass"),
    );
    if damping * TIME_STEP > mass {
        return Err(Error::parameter(
            "damper.damping",
            damping,
            format!("at most {}", mass / TIME_STEP),
            "Lower it or raise body.mass.",
        ));
    }
    Ok([stiffness, damping])
}

/// The latest grid point that a step to `end_time` reaches.
fn latest(end_time: f64) -> f64 {
    end_time + GRID_TOLERANCE * TIME_STEP
}

impl Oscillators {
    fn check_faults(&self, end_time: f64) -> Result<()> {
        if end_time > self.refuse_time {
            return Err(Error::Step {
                model: "oscillators",
                time: self.refuse_time,
                what: format!("the end {end_time} s lies beyond fault.refuse_time; 100% sure"),
                remedy: "Take a shorter step.".into(),
            });
        }
        assert!(end_time <= self.panic_time, "set to panic at {} s", self.panic_time);
        Ok(())
    }

    fn check_work(&self, end_time: f64) -> Result<()> {
        let now = self.start + self.state.steps as f64 * TIME_STEP;
        let asked = (end_time - now) / TIME_STEP;
        if asked > self.most_steps as f64 {
            return Err(Error::too_much_work(
                "oscillators",
                now,
                format!("{asked:e} time steps"),
            ));
        }
        Ok(())
    }

    fn next_point(&self) -> f64 {
        self.start + (self.state.steps + 1) as f64 * TIME_STEP
    }

    fn step(&mut self, values: &Values) {
        let (height, rate) = (values.real("frame.position"), values.real("frame.velocity"));
        let state = &mut self.state;
        state.steps += 1;
        state.force = 0.0;
        for (index, (x, v)) in state.positions.iter_mut().zip(&mut state.velocities).enumerate() {
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
