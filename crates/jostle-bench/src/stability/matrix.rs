//! The cases: every scene and engine, one dimension at a time from tame to extreme.

use std::f64::consts::{PI, TAU};

use jostle::scene::{AnySimulation, Selection, Value};

/// One case.
#[derive(Debug, Clone)]
pub struct Probe {
    pub scene: &'static str,
    pub engine: &'static str,
    pub drive: &'static str,
    /// What is extreme.
    pub dimension: &'static str,
    /// How much of it, with its unit.
    pub value: String,
    pub disks: u32,
    /// Parameters that differ from the start values.
    pub changes: Vec<(&'static str, Value)>,
    /// Simulated time \[s\].
    pub seconds: f64,
    /// Communication step \[s\], if it matters; else the budget decides.
    pub communication: Option<f64>,
    /// Displacement \[m\] to which the base is made to jump after 20 ms.
    pub jump: Option<f64>,
    /// Parameters of the tame neighbour, whose mean kinetic energy must agree.
    pub tame: Option<Vec<(&'static str, Value)>>,
}

impl Probe {
    /// The simulation with these changes of its parameters.
    ///
    /// # Errors
    /// The scene refuses them.
    pub fn simulation(&self, changes: &[(&str, Value)]) -> jostle::Result<AnySimulation> {
        let selection = Selection {
            scene: self.scene,
            engine: Some(self.engine),
            drive: Some(self.drive),
            disks: Some(self.disks),
        };
        AnySimulation::with_values(selection, changes)
    }

    /// Contacts are springs, integrated in steps.
    pub fn is_soft(&self) -> bool {
        self.engine.starts_with("molecular-dynamics")
    }
}

/// A scene with an engine, and what its cases have in common.
#[derive(Debug, Clone, Copy)]
struct Kind {
    scene: &'static str,
    engine: &'static str,
    disks: u32,
    gravity: f64,
    /// Parameters of all its cases.
    base: &'static [(&'static str, i64)],
}

const SOFT_PACKING: Kind = kind("packing", "molecular-dynamics", 60, 9.8);
const LOCATED_PACKING: Kind = kind("packing", "molecular-dynamics-located", 60, 9.8);
const HARD_PACKING: Kind = kind("packing", "event-driven", 60, 9.8);
const RANDOM_PACKING: Kind = Kind {
    base: &[("base.model", 1)],
    ..HARD_PACKING
};
const MAP: Kind = kind("wedge", "map", 1, 9.81);
const HARD_WEDGE: Kind = kind("wedge", "event-driven", 1, 9.81);
const SOFT_WEDGE: Kind = kind("wedge", "molecular-dynamics", 1, 9.81);
const RATCHET: Kind = kind("ratchet", "event-driven", 20, 9.81);

const THREE_DISK: Kind = kind("three_disk", "molecular-dynamics", 1, 10.0);

const fn kind(scene: &'static str, engine: &'static str, disks: u32, gravity: f64) -> Kind {
    let base = &[];
    Kind {
        scene,
        engine,
        disks,
        gravity,
        base,
    }
}

impl Kind {
    fn probe(self, dimension: &'static str, value: String, changes: Vec<(&'static str, Value)>) -> Probe {
        let base = self.base.iter().map(|&(name, option)| (name, Value::from(option)));
        Probe {
            scene: self.scene,
            engine: self.engine,
            drive: "sine",
            dimension,
            value,
            disks: self.disks,
            changes: base.chain(changes).collect(),
            seconds: 2.0,
            communication: None,
            jump: None,
            tame: None,
        }
    }

    /// One case for each value of one parameter.
    fn over(self, dimension: &'static str, name: &'static str, values: &[f64]) -> Vec<Probe> {
        let one = |&value: &f64| self.probe(dimension, format!("{value:e}"), vec![(name, value.into())]);
        values.iter().map(one).collect()
    }

    /// The last value of [`Kind::over`] must agree with the one before it: the limit is reached.
    fn to_limit(self, dimension: &'static str, name: &'static str, values: &[f64]) -> Vec<Probe> {
        let mut probes = self.over(dimension, name, values);
        let count = probes.len();
        let tame = probes[count - 2].changes.clone();
        probes[count - 1].tame = Some(tame);
        probes
    }

    fn shaken(self, gamma: f64, frequency: f64) -> Vec<(&'static str, Value)> {
        let amplitude = gamma * self.gravity / (TAU * frequency).powi(2);
        vec![
            ("drive.amplitude", amplitude.into()),
            ("drive.frequency", frequency.into()),
        ]
    }

    fn shakings(self) -> Vec<Probe> {
        let strong = [0.01, 0.5, 1.0, 10.0, 100.0, 1000.0];
        let strengths = strong.map(|gamma| self.probe("Gamma at 80 Hz", format!("{gamma}"), self.shaken(gamma, 80.0)));
        let fast = [(0.1, 0.01), (1.0, 2.0), (1e3, 2.0), (1e4, 2.0)];
        let frequencies = fast.map(|(frequency, gamma)| {
            let value = format!("{frequency} Hz, Gamma {gamma}");
            let mut probe = self.probe("frequency", value, self.shaken(gamma, frequency));
            probe.seconds = f64::max(2.0, 2.0 / frequency);
            probe
        });
        strengths.into_iter().chain(frequencies).collect()
    }

    /// On a sine, sampling must change no bit: `tame` is the same run with another communication step.
    fn samplings(self) -> Vec<Probe> {
        [(1e-9, 1e-5), (1e-6, 1e-3), (1e-3, 1.0), (1.0, 10.0), (10.0, 20.0)]
            .map(|(step, seconds)| {
                let mut probe = self.probe("communication step", format!("{step:e} s"), Vec::new());
                (probe.communication, probe.seconds) = (Some(step), seconds);
                probe
            })
            .into()
    }

    fn jumps(self) -> Vec<Probe> {
        [1e-4, 1e-2, 1.0, 1e3]
            .map(|jump| {
                let changes = Vec::new();
                let mut probe = Kind { base: &[], ..self }.probe("base jump", format!("{jump:e} m in 1 ms"), changes);
                (probe.drive, probe.jump, probe.communication) = ("input", Some(jump), Some(1e-3));
                probe.seconds = 0.5;
                probe
            })
            .into()
    }

    fn counts(self, counts: &[u32]) -> Vec<Probe> {
        let width = |count: u32| 0.4 * (f64::from(count) / 60.0).sqrt().max(0.2);
        let one = |&count: &u32| {
            let changes = if self.scene == "packing" {
                vec![("box.width", width(count).into())]
            } else {
                vec![("tooth.count", i64::from(count.div_ceil(4).max(4)).into())]
            };
            let mut probe = self.probe("disks", format!("{count}"), changes);
            probe.disks = count;
            probe
        };
        counts.iter().map(one).collect()
    }
}

/// Everything but the long runs.
pub fn all() -> Vec<Probe> {
    let mut probes = Vec::new();
    for packing in [SOFT_PACKING, LOCATED_PACKING, HARD_PACKING, RANDOM_PACKING] {
        probes.extend(packings(packing));
    }
    for wedge in [MAP, HARD_WEDGE, SOFT_WEDGE] {
        probes.extend(wedges(wedge));
    }
    probes.extend(ratchets(RATCHET));
    for kind in [SOFT_PACKING, HARD_PACKING, HARD_WEDGE, SOFT_WEDGE, RATCHET] {
        probes.extend(kind.jumps());
    }
    probes.extend(three_disks(THREE_DISK));
    probes
}

/// Runs of 1e8 to 1e9 steps, bounces or impacts, of one disk.
pub fn long() -> Vec<Probe> {
    let lasting = |kind: Kind, what: &str, seconds: f64, changes: Vec<(&'static str, Value)>| {
        let mut probe = kind.probe("long run", what.into(), changes);
        (probe.disks, probe.seconds) = (1, seconds);
        probe
    };
    let box_of_one = || vec![("box.width", 0.1.into())];
    let box_and_step = || vec![("box.width", 0.1.into()), ("time_step", 1e-5.into())];
    vec![
        lasting(SOFT_PACKING, "1e9 time steps", 1e4, box_and_step()),
        lasting(LOCATED_PACKING, "1e9 time steps", 1e4, box_and_step()),
        lasting(HARD_PACKING, "1e8 impacts", 7e6, box_of_one()),
        lasting(MAP, "1e9 bounces", 2e7, Vec::new()),
        lasting(HARD_WEDGE, "1e9 bounces", 2e7, Vec::new()),
        lasting(SOFT_WEDGE, "1e9 time steps", 1e3, vec![("time_step", 1e-6.into())]),
        lasting(RATCHET, "1e8 impacts", 5.2e6, Vec::new()),
        Probe {
            drive: "harmonic-torque",
            ..lasting(THREE_DISK, "1e8 time steps", 6.4e3, Vec::new())
        },
    ]
}

fn packings(kind: Kind) -> Vec<Probe> {
    let mut probes = kind.over(
        "stiffness [N/m]",
        "contact.normal_stiffness",
        &[1e2, 1e4, 1e6, 1e8, 1e10],
    );
    let ratios = [1e-3, 1.0, 1e2, 1e4];
    probes.extend(kind.over("stiffness ratio", "contact.stiffness_ratio", &ratios));
    probes.extend(kind.to_limit("friction", "contact.friction", &[0.0, 0.1, 1.0, 5.0, 10.0]));
    // Critical damping of two disks of 2 cm at 1e4 N/m is 9.5 kg/s.
    probes.extend(kind.over(
        "damping [kg/s]",
        "contact.normal_damping",
        &[0.0, 1.0, 9.5, 30.0, 100.0],
    ));
    probes.extend(kind.shakings());
    probes.extend([1e2, 1e3].map(|ratio| {
        let small = 0.02 / ratio;
        let radii = vec![
            ("disk.radius_small", small.into()),
            ("disk.radius_medium", 0.02.into()),
            ("disk.radius_large", 0.02.into()),
        ];
        let mut probe = kind.probe("radius ratio", format!("{ratio}, masses {:e}", ratio * ratio), radii);
        probe.seconds = 0.5;
        probe
    }));
    probes.extend(kind.counts(&[1, 2, 1000, 100_000]));
    probes.extend(kind.samplings());
    probes
}

fn wedges(kind: Kind) -> Vec<Probe> {
    let mut probes = Vec::new();
    if kind.engine == "molecular-dynamics" {
        probes.extend(kind.over(
            "stiffness [N/m]",
            "contact.normal_stiffness",
            &[1e2, 1e4, 1e6, 1e8, 1e10],
        ));
        // Critical damping of a disk of 4.5 g at 4.5e6 N/m is 285 kg/s.
        probes.extend(kind.over("damping [kg/s]", "contact.normal_damping", &[0.0, 285.0, 1000.0]));
    } else {
        let losses = [1.0, 0.5, 0.05, 1e-3, 0.0];
        probes.extend(kind.over("restitution", "collision.restitution", &losses));
    }
    probes.extend(kind.over("stiffness ratio", "contact.stiffness_ratio", &[1e-3, 1.0, 1e2, 1e4]));
    probes.extend(kind.to_limit("friction", "contact.friction", &[0.0, 0.1, 1.0, 5.0, 10.0]));
    probes.extend(kind.over("mass [kg]", "disk.mass", &[1e-9, 1e-3, 1e3]));
    probes.extend(kind.shakings());
    let angle = |degrees: f64| Value::from(degrees.to_radians());
    probes.extend([60.0, 90.0, 150.0, 179.0, 179.5, 179.8, 179.9].map(|aperture| {
        let changes = vec![("wedge.aperture", angle(aperture)), ("wedge.tilt", 0.0.into())];
        kind.probe("aperture", format!("{aperture} degrees"), changes)
    }));
    let critical = 0.5 * (PI - 2.0944);
    probes.extend([1e-2, 1e-6, 1e-12, 0.0, -1e-6].map(|below| {
        let value = format!("critical less {below:e} rad");
        let mut probe = kind.probe("tilt", value, vec![("wedge.tilt", (critical - below).into())]);
        if (0.0..1e-4).contains(&below) && below > 0.0 {
            probe.tame = Some(vec![("wedge.tilt", (critical - 1e-4).into())]);
        }
        probe
    }));
    probes.extend(kind.samplings());
    probes
}

fn ratchets(kind: Kind) -> Vec<Probe> {
    let mut probes = kind.over("restitution", "collision.restitution", &[1.0, 0.5, 0.05, 0.0]);
    probes.extend(kind.to_limit("friction", "collision.friction", &[0.0, 0.1, 1.0, 5.0, 10.0]));
    probes.extend(kind.shakings());
    probes.extend(kind.over("vertical tooth", "tooth.asymmetry", &[0.0, 1e-9, 1.0]));
    probes.extend(
        [("tooth.tip_radius", 0.0), ("tooth.height", 0.0), ("tooth.height", 0.06)]
            .map(|(name, value)| kind.probe("tooth", format!("{name} = {value}"), vec![(name, value.into())])),
    );
    probes.extend([(1e-4, 1e-2), (1e-5, 1e-2)].map(|(small, large): (f64, f64)| {
        let changes = vec![
            ("disk.radius_min", small.into()),
            ("disk.radius_max", large.into()),
            ("disk.mass_rule", 2_i64.into()),
            ("tooth.width", 0.03.into()),
            ("tooth.height", 0.03.into()),
        ];
        kind.probe("radius ratio", format!("{:e}", large / small), changes)
    }));
    probes.extend(kind.counts(&[1, 2, 1000]));
    probes.extend(kind.samplings());
    probes
}

/// A disk on two supports under a harmonic torque.
fn three_disks(kind: Kind) -> Vec<Probe> {
    let mut probes = kind.over(
        "stiffness [N/m]",
        "contact.normal_stiffness",
        &[1e2, 1e4, 1e6, 1e8, 1e10],
    );
    probes.extend(kind.over("stiffness ratio", "contact.stiffness_ratio", &[1e-2, 1.0, 1e2, 1e4]));
    probes.extend(kind.over("friction", "contact.friction", &[0.0, 0.1, 1.0, 10.0]));
    // Critical damping of 0.1 kg at 1e3 N/m is 20 kg/s.
    probes.extend(kind.over("damping [kg/s]", "contact.normal_damping", &[0.0, 20.0, 200.0]));
    probes.extend(kind.over("mass [kg]", "disk.mass", &[1e-6, 1e-3, 1.0]));
    let critical = PI / 6.0;
    probes.extend([1e-2, 1e-6, 1e-12, 0.0, -1e-6].map(|below| {
        let value = format!("critical less {below:e} rad");
        kind.probe("tilt", value, vec![("tilt", (critical - below).into())])
    }));
    probes.extend(kind.over("torque [N.m]", "torque.amplitude", &[1e-6, 0.1, 1.0, 100.0]));
    probes.extend(kind.over("torque [rad/s]", "torque.angular_frequency", &[0.1, 10.0, 1e3, 1e5]));
    probes.iter_mut().for_each(|probe| probe.drive = "harmonic-torque");
    probes
}
