//! Amplifier voltage and the force of the grains in, motion of the base out.
//!
//! ```text
//! L di/dt = u - R i - Bl v                       coil: resistance, inductance, back-EMF
//! dx/dt   = v
//! m dv/dt = Bl i - R_ms v - k x + (F + W)        F: force of the grains on the base [N], up positive
//! u       = U sin(2 pi turns) + u_1              turns: integral of the drive's frequency
//! ```
//! x counts from the equilibrium under the weight of the moving parts and of the grains, W: grains at rest, F = -W, leave the base at rest.
//! The system is linear and is stepped exactly, whatever the step: U, frequency, u_1 and F are constant over a step, the sine is not
//! sampled. Start values are those of a Tymphany GBS-250F38CP01-04 (data sheet, revision 3, 2019) that carries the rail of P 2.4.1.

use std::f64::consts::TAU;

use fmi_component::{CoSimulation, Component, Error, Result, Step, Warning};
use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize};

use crate::transition::Transition;

/// Rounding of times by the importer, in units of the last place: a step that differs by less is as long as the one before.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Of a communication step \[s\]: the matrix exponential of a longer one loses digits.
const LONGEST_STEP: f64 = 10.0;

/// Loudspeaker that shakes a load: voltage and force in, displacement, velocity, acceleration and current out, stepped exactly.
#[derive(Component)]
#[component(name = "loudspeaker", stop_time = 1.0, step_size = 3.125e-4)]
pub struct Loudspeaker {
    /// Resistance of the coil.
    #[parameter(name = "coil.resistance", start = 3.45, min = 1e-3, max = 1e4, unit = "Ohm")]
    resistance: f64,
    /// Inductance of the coil.
    #[parameter(name = "coil.inductance", start = 2.36e-3, min = 1e-7, max = 10, unit = "H")]
    inductance: f64,
    /// Force factor Bl: force of the coil on a current, and back-EMF on a velocity.
    #[parameter(name = "coil.force_factor", start = 13.11, min = 0, max = 1e3, unit = "N/A")]
    force_factor: f64,
    /// Mass of cone, coil and air, M_ms.
    #[parameter(start = 0.1034, min = 1e-4, max = 1e3, unit = "kg")]
    moving_mass: f64,
    /// Mass that is bolted to the cone: rail and bottom of the box, estimated from P 2.4.1.
    #[parameter(start = 1.5581309000000005, min = 0, max = 1e4, unit = "kg")]
    carried_mass: f64,
    /// Stiffness of the suspension, 1 / C_ms.
    #[parameter(
        name = "suspension.stiffness",
        start = 5797.101449275363,
        min = 0,
        max = 1e8,
        unit = "N/m"
    )]
    stiffness: f64,
    /// Damping of the suspension, R_ms.
    #[parameter(
        name = "suspension.damping",
        start = 4.356416598645457,
        min = 0,
        max = 1e5,
        unit = "kg/s"
    )]
    damping: f64,
    /// Largest linear excursion, one way; beyond it a warning is given.
    #[parameter(
        name = "suspension.maximum_excursion",
        start = 6e-3,
        min = 1e-6,
        max = 10,
        unit = "m"
    )]
    maximum_excursion: f64,
    /// Weight of the load that the suspension carries at displacement 0: a force of minus this leaves the base at rest.
    #[parameter(name = "load.weight", start = 0, min = 0, max = 1e5, unit = "N")]
    load_weight: f64,
    /// Amplitude of the sine that the amplifier gives.
    #[input(name = "drive.voltage", start = 0, unit = "V", nominal = 10.0)]
    drive_voltage: f64,
    /// Frequency of that sine, whose phase goes on without a jump where it changes.
    #[input(name = "drive.frequency", start = 80, min = 1e-3, max = 1e5, unit = "Hz")]
    drive_frequency: f64,
    /// Voltage beside the sine, constant over a step.
    #[input(start = 0, unit = "V", nominal = 10.0)]
    voltage: f64,
    /// Force of the load on the base, up positive, constant over a step.
    #[input(start = 0, unit = "N")]
    reaction_force: f64,
    /// Displacement of the base from equilibrium, up.
    #[output(unit = "m", nominal = 1e-3, derivative = "velocity")]
    displacement: f64,
    /// Velocity of the base.
    #[output(unit = "m/s", nominal = 0.1, derivative = "acceleration")]
    velocity: f64,
    /// Acceleration of the base under the force and the voltage of the step that has ended.
    #[output(unit = "m/s2", nominal = 10.0)]
    acceleration: f64,
    /// Current in the coil.
    #[output(unit = "A", nominal = 1.0)]
    current: f64,
    /// Phase of the sine in turns, from 0 to 1.
    #[output(name = "drive.turns")]
    turns: f64,
    clock: Clock,
    #[state(skip)]
    steps: Option<Steps>,
}

/// Time and phase counted from the last change of step or frequency: no running sums.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Clock {
    time: f64,
    turns: f64,
    step: f64,
    frequency: f64,
    count: u64,
}

impl Clock {
    fn turns(&self) -> f64 {
        (self.turns + self.frequency * self.count as f64 * self.step) % 1.0
    }

    /// Gets ready for a step from `begin` to `end` \[s\] at `frequency` \[Hz\].
    fn prepare(&mut self, begin: f64, end: f64, frequency: f64) {
        let next = self.time + (self.count + 1) as f64 * self.step;
        let same_step = self.step > 0.0 && (next - end).abs() <= ROUNDING * begin.abs().max(end.abs());
        if same_step && frequency == self.frequency {
            return;
        }
        *self = Self {
            time: begin,
            turns: self.turns(),
            step: if same_step { self.step } else { end - begin },
            frequency,
            count: 0,
        };
    }
}

/// The matrices of steps of one length and frequency: computed from the parameters when they are needed, no part of the state.
#[derive(Debug)]
struct Steps {
    step: f64,
    frequency: f64,
    held: Transition,
    driven: Transition,
}

impl Loudspeaker {
    fn mass(&self) -> f64 {
        self.moving_mass + self.carried_mass
    }

    /// The matrices for the next step.
    fn steps(&mut self) -> &Steps {
        let (step, frequency) = (self.clock.step, self.clock.frequency);
        let known = self
            .steps
            .take()
            .filter(|steps| steps.step == step && steps.frequency == frequency);
        let steps = known.unwrap_or_else(|| self.matrices(step, frequency));
        self.steps.insert(steps)
    }

    fn matrices(&self, step: f64, frequency: f64) -> Steps {
        let (inductance, mass) = (self.inductance, self.mass());
        #[rustfmt::skip]
        let system = SMatrix::<f64, 3, 3>::new(
            -self.resistance / inductance, 0.0, -self.force_factor / inductance,
            0.0, 0.0, 1.0,
            self.force_factor / mass, -self.stiffness / mass, -self.damping / mass,
        );
        // Columns: force, voltage.
        let held = SMatrix::<f64, 3, 2>::new(0.0, 1.0 / inductance, 0.0, 0.0, 1.0 / mass, 0.0);
        let driven = SMatrix::<f64, 3, 2>::new(1.0 / inductance, 0.0, 0.0, 0.0, 0.0, 0.0);
        Steps {
            step,
            frequency,
            held: Transition::held(&system, &held, step),
            driven: Transition::oscillating(&system, &driven, TAU * frequency, step),
        }
    }

    fn observe(&mut self) {
        let coil = self.force_factor * self.current;
        let force = coil - self.damping * self.velocity - self.stiffness * self.displacement;
        self.acceleration = (force + self.reaction_force + self.load_weight) / self.mass();
        self.turns = self.clock.turns();
    }
}

impl CoSimulation for Loudspeaker {
    fn initialize(&mut self, start_time: f64) -> Result<()> {
        self.clock.time = start_time;
        self.observe();
        Ok(())
    }

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        if step.size() > LONGEST_STEP {
            let asked = format!("{} s at once", step.size());
            return Err(Error::too_much_work("loudspeaker", step.begin(), asked));
        }
        self.clock.prepare(step.begin(), step.end(), self.drive_frequency);
        let (sine, cosine) = libm::sincos(TAU * self.clock.turns());
        let drive = [self.drive_voltage * sine, self.drive_voltage * cosine];
        let held = [self.reaction_force + self.load_weight, self.voltage];
        let state = SVector::from([self.current, self.displacement, self.velocity]);
        let steps = self.steps();
        let end = steps.held.end(&state, held) + steps.driven.effect(drive);
        [self.current, self.displacement, self.velocity] = end.into();
        self.clock.count += 1;
        self.observe();
        Ok(())
    }

    fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        const TOPIC: &str = "excursion";
        if self.displacement.abs() <= self.maximum_excursion || told.contains(&TOPIC) {
            return Vec::new();
        }
        let text = format!(
            "the base is at {:.3e} m, the driver is linear up to suspension.maximum_excursion = {} m. An unstable exchange? Take shorter \
             communication steps; or lower the drive.",
            self.displacement, self.maximum_excursion
        );
        vec![Warning { topic: TOPIC, text }]
    }
}
