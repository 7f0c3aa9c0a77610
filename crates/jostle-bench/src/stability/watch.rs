//! Bounds that hold at every sample of a run, read from its outputs alone.

use std::f64::consts::PI;

use jostle::scene::{AnySimulation, Causality, Value};

use super::matrix::Probe;

/// Largest share of the energy throughput that soft contacts may create, and by which their balance may be off, at a
/// hundredth of a contact a step: errors of first order in the step, from the steps in which contacts close and open.
/// That they are of that kind is a criterion of its own.
const SOFT_SHARES: [f64; 2] = [0.01, 0.02];
/// The same for impacts, whose balance is exact but for rounding.
const HARD_SHARES: [f64; 2] = [1e-9, 1e-9];
/// Pairs are compared one by one up to this number of disks.
const MOST_COMPARED: usize = 1000;

/// Energies and momentum at one sample.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Balance {
    kinetic: f64,
    /// Kinetic, potential, elastic.
    total: f64,
    input: f64,
    lost: f64,
}

/// A run under watch.
pub struct Watch {
    pub simulation: AnySimulation,
    columns: Columns,
    start: Balance,
    /// Largest energy observed, exchanged or stored: what an error is measured by.
    scale: f64,
    collisions: f64,
    /// Vertical impulse of the disks on the base so far \[N.s\].
    impulse: f64,
    most_kinetic: f64,
    /// Mean kinetic energy over each interval between samples of the second half.
    pub kinetic: Vec<f64>,
    /// Criteria that failed, with numbers; each but once.
    pub violated: Vec<(&'static str, String)>,
    /// Largest |residual| / scale observed.
    pub energy_error: f64,
    /// Deepest overlap over the smallest radius.
    pub overlap: f64,
}

/// Where the outputs are in the table.
#[derive(Debug, Clone, Default)]
struct Columns {
    radii: Vec<f64>,
    masses: f64,
    x: Option<usize>,
    y: Option<usize>,
    base: Option<usize>,
    kinetic: Option<usize>,
    potential: Option<usize>,
    elastic: Option<usize>,
    input: Option<usize>,
    lost: Option<usize>,
    collisions: Option<usize>,
    reaction: Option<usize>,
}

impl Watch {
    pub fn new(simulation: AnySimulation) -> Self {
        let columns = Columns::of(&simulation);
        let mut watch = Self {
            columns,
            start: Balance {
                kinetic: 0.0,
                total: 0.0,
                input: 0.0,
                lost: 0.0,
            },
            scale: 0.0,
            collisions: 0.0,
            impulse: 0.0,
            most_kinetic: 0.0,
            kinetic: Vec::new(),
            violated: Vec::new(),
            energy_error: 0.0,
            overlap: 0.0,
            simulation,
        };
        watch.start = watch.balance();
        watch
    }

    fn real(&self, column: Option<usize>) -> f64 {
        column.map_or(0.0, |column| at(&self.simulation, column))
    }

    fn balance(&self) -> Balance {
        let columns = &self.columns;
        let kinetic = self.real(columns.kinetic);
        Balance {
            kinetic,
            total: kinetic + self.real(columns.potential) + self.real(columns.elastic),
            input: self.real(columns.input),
            lost: self.real(columns.lost),
        }
    }

    fn violate(&mut self, criterion: &'static str, what: String) {
        if self.violated.iter().all(|(known, _)| *known != criterion) {
            self.violated.push((criterion, what));
        }
    }

    /// Takes a sample after a step from `before` \[s\]; `probe` gives the geometry.
    pub fn sample(&mut self, probe: &Probe, before: f64, keep: bool) {
        let time = self.simulation.time();
        if time <= before {
            self.violate("time", format!("{time} s after {before} s"));
        }
        let variables = self.simulation.variables();
        if let Some(bad) = (0..variables.len()).find(|&position| !at(&self.simulation, position).is_finite()) {
            let what = format!("{} at t = {time} s", variables[bad].name);
            self.violate("finite", what);
        }
        let collisions = self.real(self.columns.collisions);
        if collisions < self.collisions {
            self.violate(
                "time",
                format!("collisions fell from {} to {collisions}", self.collisions),
            );
        }
        self.collisions = collisions;
        self.impulse += self.real(self.columns.reaction) * (time - before);
        self.energy(probe, time);
        self.places(probe, time);
        if keep {
            self.kinetic.push(self.real(self.columns.kinetic));
        }
    }

    fn energy(&mut self, probe: &Probe, time: f64) {
        let now = self.balance();
        let change = now.total - self.start.total;
        let residual = change - (now.input - self.start.input) + (now.lost - self.start.lost);
        self.most_kinetic = self.most_kinetic.max(now.kinetic);
        let largest = [now.kinetic, change.abs(), now.input.abs(), now.lost.abs()];
        self.scale = largest.into_iter().fold(self.scale, f64::max);
        if self.scale == 0.0 {
            return;
        }
        // Rounding of the potential energy counts too.
        let rounding = 1e-13 * (self.start.total.abs() + now.total.abs());
        let [created, off] = if probe.is_soft() { SOFT_SHARES } else { HARD_SHARES };
        let error = (residual.abs() - rounding).max(0.0) / self.scale;
        self.energy_error = self.energy_error.max(error);
        if error > off || residual > 0.0 && error > created {
            let what = format!("residual {residual:.2e} J of {:.2e} J at t = {time} s", self.scale);
            self.violate("energy", what);
        }
    }

    /// Change of momentum against weight and the force on the base, where no other wall takes vertical force.
    pub fn momentum(&mut self, probe: &Probe, gravity: f64) -> bool {
        let frictionless = probe
            .changes
            .iter()
            .any(|(name, value)| *name == "contact.friction" && value.to_f64() == 0.0);
        if !(probe.scene == "wedge" || probe.scene == "packing" && frictionless) || self.columns.masses == 0.0 {
            return false;
        }
        let (mass, time) = (self.columns.masses, self.simulation.time());
        let change = -self.impulse - mass * gravity * time;
        let most = 2.0 * (2.0 * mass * self.most_kinetic).sqrt();
        if change.abs() > 1.01 * most + 1e-9 * mass * gravity * time {
            self.violate(
                "momentum",
                format!("changed by {change:.3e} N.s, at most {most:.3e} N.s is there"),
            );
        }
        true
    }

    fn places(&mut self, probe: &Probe, time: f64) {
        let (Some(x), Some(y)) = (self.columns.x, self.columns.y) else {
            return;
        };
        let count = self.columns.radii.len();
        let place = |disk: usize| [at(&self.simulation, x + disk), at(&self.simulation, y + disk)];
        let places: Vec<[f64; 2]> = (0..count).map(place).collect();
        let base = self.real(self.columns.base);
        let smallest = self.columns.radii.iter().copied().fold(f64::INFINITY, f64::min);
        // Soft disks may sink in by half of the smallest radius, hard ones by rounding of their places.
        let far = places
            .iter()
            .flatten()
            .fold(0.0, |most: f64, part| most.max(part.abs()))
            + base.abs();
        let allowed = if probe.is_soft() {
            0.5 * smallest
        } else {
            1e-10 * smallest + 1e-14 * far
        };
        for (disk, (place, radius)) in places.iter().zip(&self.columns.radii).enumerate() {
            let outside = self.outside(probe, *place, *radius, base);
            if outside > allowed {
                self.violate(
                    "lost",
                    format!("disk {} is {outside:.2e} m outside at t = {time} s", disk + 1),
                );
                break;
            }
        }
        if count <= MOST_COMPARED && probe.scene == "packing" {
            let deepest = deepest(&places, &self.columns.radii);
            self.overlap = self.overlap.max(deepest / smallest);
            if deepest > allowed {
                self.violate(
                    "overlap",
                    format!("{deepest:.2e} m at t = {time} s, allowed {allowed:.2e} m"),
                );
            }
        }
    }

    /// How far \[m\] a disk reaches beyond its walls.
    fn outside(&self, probe: &Probe, [x, y]: [f64; 2], radius: f64, base: f64) -> f64 {
        let parameter = |name: &str| given(&self.simulation, name);
        let below = base - (y - radius);
        match probe.scene {
            "packing" => {
                let half = 0.5 * parameter("box.width");
                below.max(x + radius - half).max(-half - x + radius)
            }
            "wedge" => {
                let (critical, tilt) = (0.5 * (PI - parameter("wedge.aperture")), parameter("wedge.tilt"));
                let height = y - base;
                let distance = |slope: f64| height * slope.cos() - x * slope.sin();
                let nearest = distance(-(critical - tilt)).min(distance(critical + tilt));
                radius - nearest
            }
            // Valleys are at the base; the gap to the teeth is the engine's own test.
            "ratchet" => below.max(y + radius - parameter("cell.height")),
            // Two supports confine no disk.
            _ => f64::NEG_INFINITY,
        }
    }
}

impl Columns {
    fn of(simulation: &AnySimulation) -> Self {
        let position = |name: &str| simulation.position(name).ok();
        let mut radii: Vec<f64> = simulation
            .variables()
            .iter()
            .enumerate()
            .filter(|(_, row)| row.causality == Causality::CalculatedParameter && row.name.starts_with("disk.radius["))
            .map(|(position, _)| at(simulation, position))
            .collect();
        if radii.is_empty() && position("disk.radius").is_some() {
            radii.push(given(simulation, "disk.radius"));
        }
        let masses = if position("disk.surface_density").is_some() {
            let area: f64 = radii.iter().map(|radius| PI * radius * radius).sum();
            given(simulation, "disk.surface_density") * area
        } else if position("wedge.tilt").is_some() {
            given(simulation, "disk.mass")
        } else {
            0.0
        };
        Self {
            radii,
            masses,
            x: position("disk.x[1]"),
            y: position("disk.y[1]"),
            base: position("base.position"),
            kinetic: position("energy.kinetic"),
            potential: position("energy.potential"),
            elastic: position("energy.elastic"),
            input: position("energy.input"),
            lost: position("energy.lost"),
            collisions: position("collisions"),
            reaction: position("base.reaction_force"),
        }
    }
}

/// The parameter or input called `name`; 0 if the scene has none of it.
pub fn given(simulation: &AnySimulation, name: &str) -> f64 {
    simulation.given(name).map_or(0.0, Value::to_f64)
}

/// Value of the variable at `position` as a number.
fn at(simulation: &AnySimulation, position: usize) -> f64 {
    simulation.value(position).map_or(f64::NAN, Value::to_f64)
}

/// Deepest overlap of two disks \[m\].
fn deepest(places: &[[f64; 2]], radii: &[f64]) -> f64 {
    let mut deepest = 0.0_f64;
    for (i, a) in places.iter().enumerate() {
        for (j, b) in places[..i].iter().enumerate() {
            let radius_sum = radii[i] + radii[j];
            if (a[1] - b[1]).abs() < radius_sum {
                deepest = deepest.max(radius_sum - (a[0] - b[0]).hypot(a[1] - b[1]));
            }
        }
    }
    deepest
}
