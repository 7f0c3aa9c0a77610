//! The same four disks by both engines: hard, and soft with contacts of a given stiffness.

use jostle::collision::Dashpot;
use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Sine;
use jostle::engine::Engine;
use jostle::engine::dem::{ContactLaws, SoftDiskSetup, TimeStepLimits, Verlet};
use jostle::engine::event_driven::{EventDriven, Model, Moving, Open, Region, Settings, Walls};
use jostle::geometry::{Disk, Vector2, Wall};

const DISKS: [Disk; 4] = [
    Disk {
        x: -0.05,
        y: 0.06,
        radius: 0.020,
    },
    Disk {
        x: 0.004,
        y: 0.09,
        radius: 0.015,
    },
    Disk {
        x: 0.012,
        y: 0.05,
        radius: 0.020,
    },
    Disk {
        x: -0.03,
        y: 0.12,
        radius: 0.025,
    },
];
const VELOCITIES: [[f64; 3]; 4] = [[0.4, 0.0, 5.0], [-0.3, -0.2, -20.0], [0.1, 0.3, 0.0], [0.2, -0.5, 10.0]];
const END: f64 = 0.12;
const WALLS: [Wall; 3] = [Wall::vibrating_floor(), Wall::left(-0.08), Wall::right(0.06)];

fn drive() -> Sine {
    Sine {
        amplitude: 2e-4,
        frequency: 60.0,
        phase: 0.3,
    }
}

fn masses() -> Vec<f64> {
    DISKS
        .iter()
        .map(|disk| 3.57 * std::f64::consts::PI * disk.radius.powi(2))
        .collect()
}

/// x, y, angle of each disk by hard impacts.
fn hard(stiffness: f64, damping: f64) -> Vec<[f64; 3]> {
    let law = Dashpot::new(stiffness, damping, 0.77, 0.2).unwrap();
    let base = Moving {
        drive: drive(),
        farthest: 2e-4,
    };
    let boundary = Walls {
        walls: WALLS.to_vec(),
        base,
        origin: 0.0,
    };
    let space = Open(Region {
        corner: Vector2::new(-0.08, 0.0),
        size: Vector2::new(0.14, 0.3),
    });
    let model = Model {
        law,
        boundary,
        gravity: 9.8,
        space,
    };
    let mut engine = EventDriven::new(model, &DISKS, &masses(), &VELOCITIES, Settings::default());
    engine.advance_to(END).unwrap();
    let counts = engine.state().counts;
    assert!(counts.disk_impacts >= 3 && counts.wall_impacts >= 4, "{counts:?}");
    (0..4)
        .map(|disk| engine.sample_at(END, disk))
        .map(|motion| [motion.position.x, motion.position.y, motion.angle])
        .collect()
}

/// The same by soft contacts.
fn soft(stiffness: f64, damping: f64) -> Vec<[f64; 3]> {
    let laws = ContactLaws {
        normal: LinearDashpot { stiffness, damping },
        tangential: TangentialSpring {
            stiffness: 0.77 * stiffness,
            friction: 0.2,
        },
    };
    let time_step = 0.3 * TimeStepLimits::verlet(&laws, &masses(), None).default;
    let walls = WALLS.to_vec();
    let setup = SoftDiskSetup {
        laws,
        walls,
        masses: masses(),
        gravity: 9.8,
        time_step,
        start_time: 0.0,
    };
    let mut engine = Verlet::new(setup, &DISKS, drive());
    engine.set_motion(|state| {
        state
            .velocity
            .iter_mut()
            .zip(VELOCITIES.as_flattened())
            .for_each(|(to, from)| *to = *from);
    });
    engine.advance_to(END).unwrap();
    engine.observables().positions[..4].to_vec()
}

/// Distance \[m\] in place, and in angle by the radius, of the two engines after the same flight, at a stiffness k_n.
pub fn difference(stiffness: f64) -> f64 {
    // Damping that keeps the restitution as the contact stiffens.
    let damping = 1e-3 * stiffness.sqrt();
    let pairs = hard(stiffness, damping)
        .into_iter()
        .zip(soft(stiffness, damping))
        .zip(DISKS);
    pairs
        .map(|((a, b), disk)| (a[0] - b[0]).hypot(a[1] - b[1]) + disk.radius * (a[2] - b[2]).abs())
        .fold(0.0, f64::max)
}
