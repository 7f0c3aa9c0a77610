//! The wedge scene: engines against each other, refusals, and bits that must not depend on how it is stepped.

#![allow(clippy::unwrap_used)]

mod support;

use std::f64::consts::TAU;

use jostle::Error;
use jostle::contact::LinearDashpot;
use jostle::scene::wedge::{
    WedgeEventDrivenOnInput, WedgeEventDrivenOnSine, WedgeMap, WedgeMolecularDynamicsOnInput,
    WedgeMolecularDynamicsOnSine,
};
use jostle::scene::{Model, Simulation};
use support::{order, simulation_of};

fn wedge<M: Model>(parameters: &[(&str, f64)]) -> Simulation<M> {
    simulation_of(1, parameters)
}

fn scaled<M: Model>(simulation: &Simulation<M>) -> (f64, f64) {
    (
        simulation.real("scaled_angular_velocity").unwrap(),
        simulation.real("scaled_angular_velocity.standard_error").unwrap(),
    )
}

/// One step of 2 h, two of h, outputs read or not, saved and restored through bytes: the same bits.
fn same_bits<M: Model>() {
    let changes = [("measure.start", 0.25)];
    let (mut long, mut short) = (wedge::<M>(&changes), wedge::<M>(&changes));
    for step in 1..=40 {
        let time = f64::from(step) * 0.02;
        long.advance_to(time).unwrap();
        short.advance_to(time - 0.013).unwrap();
        short.all_values().unwrap();
        let bytes = short.to_bytes().unwrap();
        short.advance_to(time).unwrap();
        let after = short.all_values().unwrap();
        short.restore_bytes(&bytes).unwrap();
        short.advance_to(time).unwrap();
        assert_eq!(short.all_values().unwrap(), after, "rollback at {time}");
        let names = long.variables().iter().map(|variable| &variable.name);
        for (name, (a, b)) in names.zip(long.all_values().unwrap().iter().zip(&after)) {
            // The reaction is a mean over the last step.
            assert!(
                a == b || name == "base.reaction_force",
                "{name} at {time}: {a:?}, {b:?}"
            );
        }
    }
}

#[test]
fn stepping_changes_no_bit() {
    same_bits::<WedgeMap>();
    same_bits::<WedgeEventDrivenOnSine>();
    same_bits::<WedgeMolecularDynamicsOnSine>();
}

/// With inputs a step may change what comes, but a state that is restored still gives the same bits.
#[test]
fn rollback_under_inputs_gives_the_same_bits() {
    let mut wedge = wedge::<WedgeEventDrivenOnInput>(&[]);
    for step in 1..=3000 {
        let time = f64::from(step) * 1e-3;
        let phase = TAU * 80.0 * (time - 1e-3);
        wedge.set("base.displacement", 7.757e-5 * phase.sin()).unwrap();
        wedge.set("base.velocity", 7.757e-5 * TAU * 80.0 * phase.cos()).unwrap();
        let saved = wedge.save();
        wedge.advance_to(time).unwrap();
        let after = wedge.save();
        wedge.restore(&saved).unwrap();
        wedge.advance_to(time).unwrap();
        assert!(wedge.save() == after);
    }
    assert!(wedge.integer("collisions").unwrap() > 50);
}

/// Inputs sampled from a sine in short steps move the disk as the sine does, for a few impacts.
#[test]
fn inputs_of_a_sine_are_the_sine() {
    let (amplitude, speed) = (7.757e-5, 7.757e-5 * TAU * 80.0);
    let mut sine = wedge::<WedgeEventDrivenOnSine>(&[]);
    let mut driven = wedge::<WedgeEventDrivenOnInput>(&[("base.velocity", speed)]);
    let mut soft = wedge::<WedgeMolecularDynamicsOnInput>(&[("base.velocity", speed)]);
    let step = 2e-5;
    for index in 1..=3000 {
        let phase = TAU * 80.0 * f64::from(index - 1) * step;
        for (name, value) in [
            ("base.displacement", amplitude * phase.sin()),
            ("base.velocity", speed * phase.cos()),
        ] {
            driven.set(name, value).unwrap();
            soft.set(name, value).unwrap();
        }
        driven.advance_to(f64::from(index) * step).unwrap();
        soft.advance_to(f64::from(index) * step).unwrap();
    }
    sine.advance_to(3000.0 * step).unwrap();
    assert!(sine.integer("collisions").unwrap() >= 3);
    for name in ["disk.x[1]", "disk.y[1]"] {
        let exact = sine.real(name).unwrap();
        let (rigid, soft) = (driven.real(name).unwrap(), soft.real(name).unwrap());
        assert!((rigid - exact).abs() < 1e-5, "{name}: {rigid} for {exact}");
        assert!((soft - exact).abs() < 1e-4, "{name}: {soft} for {exact}");
    }
}

/// Steps of several sizes: the reaction forces add up to the change of momentum, and energies balance.
fn bookkeeping<M: Model>(tolerance: f64) {
    let mut wedge = wedge::<M>(&[]);
    let total = |wedge: &Simulation<M>| {
        let elastic = wedge.real("energy.elastic").unwrap_or(0.0);
        wedge.real("energy.kinetic").unwrap() + wedge.real("energy.potential").unwrap() + elastic
    };
    let (start, mut pushed, mut time) = (total(&wedge), 0.0, 0.0);
    for index in 1..=500 {
        let step = 1e-3 * f64::from(1 + index % 7);
        wedge.advance_to(time + step).unwrap();
        pushed += wedge.real("base.reaction_force").unwrap() * step;
        time += step;
    }
    let gained = wedge.real("energy.input").unwrap() - wedge.real("energy.lost").unwrap();
    let residual = (total(&wedge) - start - gained) / wedge.real("energy.lost").unwrap();
    println!(
        "{}: energy residual {residual:.1e}",
        M::info().variant_of("engine").unwrap()
    );
    assert!(residual.abs() < tolerance, "{residual:e}");
    // The weight, up to the momentum of the disk.
    let weight = 4.5e-3 * 9.81 * time;
    assert!((-pushed / weight - 1.0).abs() < 0.05, "{pushed} against {weight}");
}

#[test]
fn energy_and_reaction_are_accounted_for() {
    bookkeeping::<WedgeMap>(1e-12);
    bookkeeping::<WedgeEventDrivenOnSine>(1e-12);
    bookkeeping::<WedgeMolecularDynamicsOnSine>(2e-2);
}

/// Without tilt there is no rotation; with it there is, and in the opposite sense with the opposite tilt.
fn symmetric<M: Model>(seconds: f64) {
    let at = |tilt: f64| {
        let mut wedge = wedge::<M>(&[("wedge.tilt", tilt), ("measure.start", 1.0)]);
        wedge.advance_to(seconds).unwrap();
        scaled(&wedge)
    };
    let [(level, level_error), (ahead, error), (back, _)] = [0.0, 0.15, -0.15].map(at);
    println!(
        "{}: {level} +- {level_error}, {ahead} +- {error}, {back}",
        M::info().variant_of("engine").unwrap()
    );
    assert!(level.abs() < 4.0 * level_error && level_error > 0.0);
    assert!(ahead > 8.0 * error && (ahead + back).abs() < 6.0 * error);
}

#[test]
fn only_tilted_wedges_turn_the_disk() {
    symmetric::<WedgeMap>(3000.0);
    symmetric::<WedgeEventDrivenOnSine>(1500.0);
}

/// P Fig 6.5: molecular dynamics turns the disk as the moving wedge does, and as the map does, at tilts of both signs of
/// rotation.
#[test]
fn engines_agree_in_the_mean() {
    for tilt in [0.15, 0.36] {
        let mut soft = wedge::<WedgeMolecularDynamicsOnSine>(&[("wedge.tilt", tilt), ("measure.start", 1.0)]);
        let mut rigid = wedge::<WedgeEventDrivenOnSine>(&[("wedge.tilt", tilt), ("measure.start", 1.0)]);
        let mut map = wedge::<WedgeMap>(&[("wedge.tilt", tilt), ("measure.start", 1.0)]);
        soft.advance_to(40.0).unwrap();
        rigid.advance_to(1000.0).unwrap();
        map.advance_to(1000.0).unwrap();
        let [soft, rigid, map] = [scaled(&soft), scaled(&rigid), scaled(&map)];
        println!("tilt {tilt}: molecular dynamics {soft:?}, moving wedge {rigid:?}, map {map:?}");
        assert!((soft.0 - rigid.0).abs() < 4.0 * soft.1.hypot(rigid.1));
        assert!((map.0 - rigid.0).abs() < 0.15 * rigid.0.abs());
        assert!(rigid.0.signum() == if tilt < 0.2 { 1.0 } else { -1.0 });
    }
}

/// One bounce of given restitution: contacts that last for a time of order sqrt(m / k_n) become instantaneous.
#[test]
fn stiff_contacts_become_impacts() {
    let (mass, ratio) = (4.5e-3, 0.0346);
    let restitution = LinearDashpot::restitution_at(ratio);
    let names = ["mean_velocity", "mean_angular_velocity", "disk.x[1]", "disk.y[1]"];
    let after = |wedge: &dyn Fn(&str) -> f64| names.map(wedge);
    let mut rigid = wedge::<WedgeEventDrivenOnSine>(&[("collision.restitution", restitution)]);
    // After the first bounce and well before the second.
    let mut time = 0.0;
    while rigid.integer("collisions").unwrap() == 0 {
        time += 1e-3;
        rigid.advance_to(time).unwrap();
    }
    time += 2e-3;
    rigid.advance_to(time).unwrap();
    assert_eq!(rigid.integer("collisions").unwrap(), 1);
    let exact = after(&|name| rigid.real(name).unwrap());
    let errors: Vec<f64> = [1e6, 1e8, 1e10]
        .into_iter()
        .map(|stiffness: f64| {
            let damping = 2.0 * ratio * (stiffness * mass).sqrt();
            let mut soft = wedge::<WedgeMolecularDynamicsOnSine>(&[
                ("contact.normal_stiffness", stiffness),
                ("contact.normal_damping", damping),
                ("time_step", (mass / stiffness).sqrt() / 300.0),
            ]);
            soft.advance_to(time).unwrap();
            let observed = after(&|name| soft.real(name).unwrap());
            let parts = observed
                .iter()
                .zip(exact)
                .map(|(observed, exact)| (observed / exact - 1.0).abs());
            parts.fold(0.0, f64::max)
        })
        .collect();
    println!("errors of one bounce at 1e6, 1e8, 1e10 N/m: {errors:?}");
    assert!(errors[2] < 2e-4 && order(errors[0], errors[2], 1e4) > 0.4, "{errors:?}");
}

#[test]
fn what_confines_nothing_is_refused_by_name() {
    let message_of = |parameters: &[(&str, f64)]| {
        let given: Vec<_> = parameters
            .iter()
            .map(|(name, value)| (*name, (*value).into()))
            .collect();
        Simulation::<WedgeMap>::new(&[], &given).unwrap_err().to_string()
    };
    for tilt in [0.5237, -0.5237, 1.0] {
        let text = message_of(&[("wedge.tilt", tilt), ("wedge.aperture", 2.0944)]);
        assert!(text.starts_with(&format!("wedge.tilt = {tilt} rad is not allowed: between -0.523596")));
        assert!(text.contains("smaller wedge.aperture"), "{text}");
    }
    assert!(message_of(&[("drive.amplitude", 0.0)]).starts_with("drive.amplitude = 0"));
    let flat = Simulation::<WedgeMap>::new(&[], &[("wedge.aperture", 3.2.into())]);
    assert!(flat.unwrap_err().to_string().contains("from 1.047 to 3.14"));
}

/// Weakly bouncing disks: the map never piles impacts up; the moving wedge ends them at the floor and says how many, and
/// without a floor place and time are reported, and the state is that before the step.
#[test]
fn chatter_ends_or_is_reported() {
    let mut map = wedge::<WedgeMap>(&[("collision.restitution", 0.05)]);
    map.advance_to(300.0).unwrap();
    assert!(map.integer("collisions").unwrap() < 100_000);
    let mut floored = wedge::<WedgeEventDrivenOnSine>(&[("collision.restitution", 0.3)]);
    floored.advance_to(30.0).unwrap();
    let (all, slow) = (floored.integer("collisions"), floored.integer("slow_collisions"));
    assert!(slow.clone().unwrap() > 1000 && slow.unwrap() < all.unwrap());

    let parameters = [
        ("collision.restitution", 0.3),
        ("collision.minimum_normal_velocity", 0.0),
    ];
    let mut bare = wedge::<WedgeEventDrivenOnSine>(&parameters);
    bare.advance_to(1e-3).unwrap();
    let before = bare.save();
    let error = bare.advance_to(100.0).unwrap_err();
    let text = error.to_string();
    assert!(matches!(error, Error::Step { model: "wedge", time, .. } if time > 1e-3 && time < 100.0));
    for part in ["no progress", "wall", "Raise collision.minimum_normal_velocity"] {
        assert!(text.contains(part), "{text}");
    }
    assert!(bare.save() == before);
    bare.advance_to(2e-3).unwrap();
}

/// Work counts, pinned within the time that trajectories can be predicted: a change shows in the diff.
#[test]
fn collision_counts_of_the_first_quarter_second_are_pinned() {
    fn counted<M: Model>() -> i64 {
        let mut wedge = wedge::<M>(&[]);
        wedge.advance_to(0.25).unwrap();
        wedge.integer("collisions").unwrap()
    }
    assert_eq!((counted::<WedgeMap>(), counted::<WedgeEventDrivenOnSine>()), (15, 14));
}

/// P: "Rejection events are unusual" where disks bounce well. Each impact of the map keeps one draw, and the counts come back
/// with a state.
#[test]
fn rejections_are_few_in_a_wedge_that_bounces_well() {
    for (restitution, most) in [(0.9, 0.03), (0.3, 0.5)] {
        let mut map = wedge::<WedgeMap>(&[("collision.restitution", restitution)]);
        map.advance_to(50.0).unwrap();
        let counts = |map: &Simulation<WedgeMap>| {
            ["base.draws", "base.rejected_draws", "collisions"].map(|name| map.integer(name).unwrap())
        };
        let (saved, [draws, rejected, collisions]) = (map.to_bytes().unwrap(), counts(&map));
        println!("e_n {restitution}: {rejected} of {draws} draws rejected");
        assert!(draws - rejected == collisions && (rejected as f64) < most * draws as f64);
        map.advance_to(60.0).unwrap();
        map.restore_bytes(&saved).unwrap();
        assert_eq!(counts(&map), [draws, rejected, collisions]);
    }
}

/// P 2.3.3: with a sawtooth instead of the sine the disk turns as before but for a constant factor, some 3.4 here. There is no
/// rotation without tilt, and a wall that hangs over is refused.
#[test]
fn the_map_on_a_sawtooth_turns_as_on_a_sine_but_for_a_factor() {
    let at = |tilt: f64, profile: f64| {
        let changes = [
            ("wedge.tilt", tilt.to_radians()),
            ("base.profile", profile),
            ("measure.start", 10.0),
        ];
        let mut map = wedge::<WedgeMap>(&changes);
        map.advance_to(600.0).unwrap();
        assert!((map.integer("base.draws").unwrap() == 0) == (profile == 2.0));
        scaled(&map)
    };
    for tilt in [-9.0, 0.0, 6.0, 9.0, 15.0, 21.0, 27.0] {
        let [(sine, spread), (sawtooth, error)] = [1.0, 2.0].map(|profile| at(tilt, profile));
        println!("{tilt} degrees: sine {sine:.3}, sawtooth {sawtooth:.3} +- {error:.3}");
        let off = (sawtooth - 3.4 * sine).abs();
        assert!(
            off < 4.0 * error.hypot(3.4 * spread) + 0.15 * sawtooth.abs(),
            "{tilt} degrees"
        );
    }
    let given = [
        ("base.profile", 2_i64.into()),
        ("wedge.aperture", 1.2.into()),
        ("wedge.tilt", 0.7.into()),
    ];
    let refusal = Simulation::<WedgeMap>::new(&[], &given).unwrap_err().to_string();
    assert!(
        refusal.starts_with("base.profile = sawtooth") && refusal.contains("hangs over"),
        "{refusal}"
    );
}
