//! Inputs that are small, or simple, and once gave wrong results or none.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::contact::LinearDashpot;
use jostle::drive::Sine;
use jostle::engine::dem::event_located::EventStepper;
use jostle::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};
use jostle::engine::threads::ThreadPool;
use jostle::scene::disk_on_two_supports::DiskOnTwoSupportsOnInput;
use jostle::scene::disks_on_base::DisksOnBase;
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::packing::soft::SoftMethod;
use jostle::scene::packing::{LocatedPackingOnInput, LocatedPackingOnSine, PackingOnInput, PackingOnSine, SoftPacking};
use jostle::scene::{Model, Simulation, StructuralParameters, Value};
use support::simulation_of;

type Verlet = PredictorCorrector<VelocityVerlet, LinearDashpot, ThreadPool>;

/// A packing of soft disks on a sine of 1 mm at 50 Hz.
fn shaken<M: SoftMethod>(disks: u32, given: &[(&str, f64)]) -> Simulation<SoftPacking<M, Sine>> {
    let base = [("drive.amplitude", 1e-3), ("drive.frequency", 50.0)];
    simulation_of(disks, &[&base[..], given].concat())
}

/// Angular velocities of the disks after `end` \[s\] with this time step \[s\].
fn spins(time_step: f64, end: f64) -> Vec<f64> {
    let mut packing = shaken::<EventStepper>(12, &[("time_step", time_step)]);
    packing.advance_to(end).unwrap();
    let spin = |disk| packing.real(&format!("disk.angular_velocity[{disk}]")).unwrap();
    (1..=12).map(spin).collect()
}

/// Steps of a nanosecond made contacts change at the very end of a step, and the time that was left divided by.
#[test]
fn errors_of_located_events_fall_with_the_step_down_to_rounding() {
    let end = 4e-5;
    let reference = spins(1e-7, end);
    let error = |step: f64| {
        let squares = spins(step, end)
            .into_iter()
            .zip(&reference)
            .map(|(one, other)| (one - other).powi(2));
        (squares.sum::<f64>() / 12.0).sqrt()
    };
    let errors = [2e-5, 1e-5, 5e-6, 2e-6, 1e-6].map(error);
    println!("errors at 20, 10, 5, 2, 1 us: {errors:?} rad/s");
    assert!(errors.is_sorted_by(|longer, shorter| shorter < longer), "{errors:?}");
    assert!(errors[4] < 1e-2 * errors[0], "{errors:?}");
    for step in [1e-8, 3e-9, 1e-9] {
        let rounding = error(step);
        println!("error at {step:e} s: {rounding:e} rad/s");
        assert!(rounding < errors[3], "{step:e} s: {rounding:e} rad/s");
    }
}

/// Slip just before a contact opens made a loss of the rounding of its force, divided by the stiffness of the spring.
#[test]
fn a_tangential_spring_too_soft_to_matter_does_not_matter() {
    let energies = |given: &[(&str, f64)]| {
        let mut packing = shaken::<EventStepper>(20, given);
        packing.advance_to(0.05).unwrap();
        ["energy.lost", "energy.residual", "energy.kinetic"].map(|name| packing.real(name).unwrap())
    };
    let [lost, residual, kinetic] = energies(&[("contact.friction", 0.0)]);
    for kappa in [1e-12, 1e-20, 1e-60, 1e-99, 1e-105, 1e-160, 1e-300, 5e-324] {
        let soft = energies(&[("contact.stiffness_ratio", kappa)]);
        let close = |one: f64, other: f64| (one - other).abs() < 1e-6 * lost;
        assert!(
            close(soft[0], lost) && close(soft[1], residual) && close(soft[2], kinetic),
            "{kappa:e}: {soft:?}, without friction {lost} {residual} {kinetic}"
        );
    }
}

/// A quotient by -0.0 is minus infinity, smaller than any time step.
#[test]
fn a_damping_or_frequency_of_negative_zero_is_zero() {
    fn outcome<M: SoftMethod>(given: &[(&str, f64)]) -> Vec<Value> {
        let mut packing = shaken::<M>(3, given);
        packing.advance_to(0.01).unwrap();
        packing.all_values().unwrap()
    }
    for name in ["contact.normal_damping", "drive.frequency"] {
        assert_eq!(
            outcome::<Verlet>(&[(name, -0.0)]),
            outcome::<Verlet>(&[(name, 0.0)]),
            "{name}"
        );
        assert_eq!(
            outcome::<EventStepper>(&[(name, -0.0)]),
            outcome::<EventStepper>(&[(name, 0.0)]),
            "{name}"
        );
    }
}

/// Equal radii, as a set of parameters.
const EQUAL: [(&str, f64); 3] = [
    ("disk.radius_small", 0.019),
    ("disk.radius_medium", 0.019),
    ("disk.radius_large", 0.019),
];

/// With equal radii the order of the radii is no order; a start that is displaced by chance makes runs that differ.
fn seeds_decide_with_a_perturbation<M: Model>() {
    let run = |seed: f64, perturbation: f64| {
        let own = [("seed", seed), ("initial.perturbation", perturbation)];
        let mut packing = simulation_of::<M>(20, &[&EQUAL[..], &own].concat());
        let warnings = packing.warnings(&[]).to_vec();
        // Hard disks that come to rest have no headway later on.
        packing.advance_to(0.02).unwrap();
        let outputs = packing
            .all_values()
            .unwrap()
            .split_off(packing.values().as_slice().len());
        (outputs, warnings)
    };
    let (first, warnings) = run(1.0, 0.0);
    assert!(run(2.0, 0.0).0 == first);
    assert!(
        warnings.len() == 1 && warnings[0].text.contains("initial.perturbation"),
        "{warnings:?}"
    );
    let (perturbed, warnings) = run(1.0, 0.01);
    assert!(warnings.is_empty() && run(1.0, 0.01).0 == perturbed && run(2.0, 0.01).0 != perturbed);
}

#[test]
fn a_perturbed_start_makes_seeds_differ_where_radii_are_equal() {
    seeds_decide_with_a_perturbation::<PackingOnInput>();
    seeds_decide_with_a_perturbation::<LocatedPackingOnInput>();
    seeds_decide_with_a_perturbation::<HardPackingOnInput>();
    let different = simulation_of::<PackingOnInput>(20, &[]);
    assert!(different.warnings(&[]).is_empty(), "{:?}", different.warnings(&[]));
    let phases = [&EQUAL[..], &[("base.model", 1.0)]].concat();
    assert!(
        simulation_of::<HardPackingOnSine>(20, &phases).warnings(&[]).is_empty(),
        "the seed draws phases"
    );
}

/// Displaced disks neither overlap nor leave the box, and are where they were to within the perturbation.
#[test]
fn displaced_disks_have_room() {
    for perturbation in [1e-6, 0.01, 0.5] {
        let given = [("initial.perturbation", perturbation), ("initial.settled", 0.0)];
        let packing = simulation_of::<PackingOnInput>(60, &given);
        assert_eq!(packing.integer("contacts").unwrap(), 0, "{perturbation}");
        let read = |name: &str, disk: usize| packing.real(&format!("disk.{name}[{disk}]")).unwrap();
        for disk in 1..=60 {
            let (x, y, radius) = (read("x", disk), read("y", disk), read("radius", disk));
            assert!(x.abs() + radius < 0.2 && y > radius, "{perturbation}: disk {disk}");
        }
        assert_eq!(packing.real("energy.elastic").unwrap(), 0.0);
    }
    let none = simulation_of::<PackingOnInput>(60, &[("initial.perturbation", 0.0)]);
    assert!(none.model().unwrap().state() == simulation_of::<PackingOnInput>(60, &[]).model().unwrap().state());
}

/// Options of `wall.motion`.
const FIXED: f64 = 1.0;
const WITH_BASE: f64 = 2.0;

/// Energy lost and residual of the balance \[J\] of disks that touch both side walls while the base rises ever faster for 0.2 s.
fn rubbed<M: Model>(motion: f64) -> (f64, f64) {
    let given = [("wall.motion", motion), ("box.width", 0.055), ("contact.friction", 0.5)];
    let mut packing = simulation_of::<M>(6, &given);
    for step in 1..=200 {
        let time = f64::from(step) * 1e-3;
        packing.set("base.displacement", 0.1 * time * time).unwrap();
        packing.set("base.velocity", 0.2 * time).unwrap();
        packing.advance_to(time).unwrap();
    }
    let lost = packing.real("energy.lost").unwrap();
    (lost, packing.real("energy.residual").unwrap())
}

/// A box that rises as a whole carries disks that are at rest in it; walls that stay brake them and wear their energy.
#[test]
fn side_walls_that_move_with_the_floor_do_not_rub_on_what_moves_with_it() {
    fn compare<M: Model>(name: &str) {
        let ((fixed, fixed_residual), (moving, residual)) = (rubbed::<M>(FIXED), rubbed::<M>(WITH_BASE));
        println!("{name}: lost {fixed:e} J at walls that stay, {moving:e} J at walls that move");
        assert!(fixed > 2.0 * moving, "{name}: {fixed:e} {moving:e}");
        let balance = |residual: f64, lost: f64| residual.abs() < 1e-3 * lost;
        assert!(
            balance(fixed_residual, fixed) && balance(residual, fixed),
            "{name}: {fixed_residual:e} {residual:e}"
        );
    }
    compare::<PackingOnInput>("velocity Verlet");
    compare::<LocatedPackingOnInput>("located events");
    let still = [("base.model", 1.into()), ("wall.motion", 2.into())];
    let refusal = Simulation::<HardPackingOnSine>::new(&[("disks", 3)], &still)
        .unwrap_err()
        .to_string();
    assert!(
        refusal.contains("wall.motion = with_base") && refusal.contains("base.model"),
        "{refusal}"
    );
}

/// What momentum misses of the disks after half a second on a sine of 4 g, over what gravity gives: change less gravity less the
/// force on the base as it is reported.
fn missing_momentum<M: Model + DisksOnBase>(motion: f64) -> f64 {
    let given = [
        ("wall.motion", motion),
        ("box.width", 0.055),
        ("contact.friction", 0.5),
        ("drive.amplitude", Sine::amplitude_of(4.0, 30.0, 9.8)),
        ("drive.frequency", 30.0),
    ];
    let (mut packing, step, steps) = (simulation_of::<M>(6, &given), 1e-2, 50);
    let mut reported = 0.0;
    for count in 1..=steps {
        packing.advance_to(f64::from(count) * step).unwrap();
        reported += packing.real("base.reaction_force").unwrap() * step;
    }
    let mass = |disk: usize| {
        let radius = packing.real(&format!("disk.radius[{}]", disk + 1)).unwrap();
        3.57 * std::f64::consts::PI * radius * radius
    };
    let model = packing.model().unwrap();
    let momentum: f64 = (0..6).map(|disk| mass(disk) * model.disk(disk).velocity.y).sum();
    let pushed = (0..6).map(mass).sum::<f64>() * 9.8 * f64::from(steps) * step;
    let lost = packing.real("energy.lost").unwrap();
    let residual = packing.real("energy.residual").unwrap();
    assert!(lost > 0.0 && residual.abs() < 1e-2 * lost, "{residual:e} of {lost:e}");
    (momentum + pushed + reported).abs() / pushed
}

/// Side walls that move with the floor are part of the base: their friction is in the force that is reported.
#[test]
fn the_force_on_the_base_holds_the_friction_of_side_walls_that_move_with_it() {
    fn compare<M: Model + DisksOnBase>(name: &str) {
        let (fixed, with_base) = (missing_momentum::<M>(FIXED), missing_momentum::<M>(WITH_BASE));
        println!("{name}: momentum misses {fixed:e} with walls that stay, {with_base:e} with walls that move");
        assert!(fixed > 1e-4 && with_base < 1e-9, "{name}: {fixed:e} {with_base:e}");
    }
    compare::<PackingOnSine>("velocity Verlet");
    compare::<LocatedPackingOnSine>("located events");
    compare::<HardPackingOnSine>("event-driven");
}

/// Ten disks of 2 cm fill a box of 40 cm exactly: they collide a million times where others do it a hundred times.
#[test]
fn a_packing_that_collides_without_end_is_refused_with_the_reason_and_the_parameter() {
    let equal = EQUAL.map(|(name, _)| (name, 0.02));
    let given = [("drive.amplitude", 7.757e-5), ("base.model", 1.0), ("work.limit", 2e5)];
    let mut packing = simulation_of::<HardPackingOnSine>(60, &[&equal[..], &given].concat());
    let refusal = (1..=100)
        .find_map(|step| packing.advance_to(f64::from(step) * 1e-2).err())
        .unwrap()
        .to_string();
    for part in ["events", "work.limit", "box.width", "molecular-dynamics"] {
        assert!(refusal.contains(part), "{refusal}");
    }
    assert!(
        packing.time() < 0.2 && packing.real("collisions").unwrap() < 2e5,
        "{}",
        packing.time()
    );
    let mut usual = simulation_of::<HardPackingOnSine>(60, &[("work.limit", 2e5)]);
    (1..=20).for_each(|step| usual.advance_to(f64::from(step) * 0.1).unwrap());
}

#[test]
fn a_detachment_that_has_not_happened_is_before_the_start() {
    for (start, never) in [(0.0, -1.0), (3.0, -1.0), (-1.0, -2.0), (-1e6, -1e6 - 1.0)] {
        let structure = StructuralParameters::defaults(&DiskOnTwoSupportsOnInput::info());
        let mut disk = Simulation::<DiskOnTwoSupportsOnInput>::prepare(structure);
        disk.start(start).unwrap();
        assert_eq!(
            (disk.real("detachment.time"), disk.integer("detachments")),
            (Ok(never), Ok(0))
        );
        disk.advance_to(start + 0.01).unwrap();
        assert_eq!(disk.real("detachment.time"), Ok(never));
    }
}

#[test]
fn supports_that_hold_nothing_are_refused_by_the_name_of_what_was_set() {
    let refusal = |name: &str, value: f64| {
        let refused = Simulation::<DiskOnTwoSupportsOnInput>::new(&[], &[(name, value.into())]);
        refused.err().map(|error| error.to_string()).unwrap_or_default()
    };
    for (name, value) in [
        ("support.angle", std::f64::consts::FRAC_PI_2),
        ("contact.normal_stiffness", 1e-3),
        ("disk.mass", 1e6),
        ("gravity", 1e4),
    ] {
        let message = refusal(name, value);
        assert!(
            message.starts_with(&format!("{name} = ")) && message.contains("contact.normal_stiffness"),
            "{message}"
        );
    }
}
