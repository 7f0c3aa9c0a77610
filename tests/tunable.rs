//! Tunable parameters of every scene: a value set before the first step is that of a start with it, states hold the values of their
//! time, and a change keeps the balances closed.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::scene::catalogue::{MODELS, Names};
use jostle::scene::packing::event_driven::HardPackingOnSine;
use jostle::scene::packing::{LocatedPackingOnSine, PackingOnFixedBottom, PackingOnSine};
use jostle::scene::ratchet::RatchetOnSine;
use jostle::scene::wedge::{WedgeEventDrivenOnSine, WedgeMap, WedgeMolecularDynamicsOnSine};
use jostle::scene::{AnySimulation, Kind, Model, Selection, Value};
use support::simulation_of;

/// A scene, what it is started with, and its tunable parameters with another value each.
struct Tried {
    selection: Selection<'static>,
    /// A settled packing is one that has felt gravity before its start.
    start: Vec<(&'static str, &'static str)>,
    changes: Vec<(String, f64)>,
}

impl Tried {
    fn start(&self) -> AnySimulation {
        self.start_with(&[])
    }

    fn start_with(&self, given: &[(&str, &str)]) -> AnySimulation {
        AnySimulation::new(self.selection, &[&self.start, given].concat()).unwrap()
    }
}

/// Some disks of every scene that has tunable parameters: more than stand on the floor.
fn tunable_scenes() -> Vec<Tried> {
    let mut scenes = Vec::new();
    for model in MODELS {
        let info = (model.info)();
        let names = Names::from(&info);
        let selection = Selection {
            scene: names.scene,
            engine: Some(names.engine),
            drive: Some(names.drive),
            disks: Some(30.min(*info.structure[0].range.end())),
        };
        let simulation = AnySimulation::new(selection, &[]).unwrap();
        let other = |kind: &Kind| match kind {
            Kind::Real(quantity) => (0.75 * quantity.start).clamp(quantity.min, quantity.max),
            other => panic!("{other:?}"),
        };
        let rows = simulation.variables().iter().filter(|row| row.tunable);
        let changes: Vec<_> = rows.map(|row| (row.name.clone(), other(&row.kind))).collect();
        let settles = simulation.given("initial.settled").is_some();
        if !changes.is_empty() {
            scenes.push(Tried {
                selection,
                start: settles.then_some(("initial.settled", "0")).into_iter().collect(),
                changes,
            });
        }
    }
    assert!(scenes.len() > 10, "{}", scenes.len());
    scenes
}

fn all_but(simulation: &AnySimulation, left_out: &[&str]) -> Vec<(String, Value)> {
    let values = simulation.all_values().unwrap();
    let names = simulation.variables().iter().map(|row| row.name.clone());
    let named = names.zip(values);
    named.filter(|(name, _)| !left_out.contains(&name.as_str())).collect()
}

/// Steps that end between points of a time grid; a base that follows inputs shakes.
fn run(simulation: &mut AnySimulation, until: f64) {
    while simulation.time() < until {
        if simulation.given("base.displacement").is_some() {
            let phase = 2e2 * simulation.time();
            simulation.set("base.displacement", 1e-3 * phase.sin()).unwrap();
            simulation.set("base.velocity", 0.2 * phase.cos()).unwrap();
        }
        let next = (simulation.time() + 0.003_7).min(until);
        simulation.advance_to(next).unwrap();
    }
}

/// The disk in the wedge is thrown with a velocity that depends on gravity; the sum of energies at the start is rounded otherwise.
#[test]
fn a_value_set_before_the_first_step_gives_the_bits_of_a_start_with_it() {
    for tried in tunable_scenes() {
        let Tried { selection, changes, .. } = &tried;
        for (name, value) in changes {
            if selection.scene == "wedge" && name == "gravity" {
                continue;
            }
            let mut tuned = tried.start();
            tuned.set(name, *value).unwrap();
            let mut started = tried.start_with(&[(name, &value.to_string())]);
            for simulation in [&mut tuned, &mut started] {
                run(simulation, 0.1);
            }
            let left_out = ["energy.residual"];
            assert_eq!(
                all_but(&tuned, &left_out),
                all_but(&started, &left_out),
                "{selection:?}: {name}"
            );
        }
    }
}

#[test]
fn every_tunable_parameter_acts() {
    for tried in tunable_scenes() {
        let Tried { selection, changes, .. } = &tried;
        for (name, value) in changes {
            let (mut tuned, mut plain) = (tried.start(), tried.start());
            run(&mut tuned, 0.1);
            run(&mut plain, 0.1);
            tuned.set(name, *value).unwrap();
            // Molecular dynamics of one disk takes its time between impacts.
            run(&mut tuned, 0.5);
            run(&mut plain, 0.5);
            assert_ne!(
                all_but(&tuned, &[name]),
                all_but(&plain, &[name]),
                "{selection:?}: {name}"
            );
        }
    }
}

#[test]
fn states_hold_the_values_of_their_time() {
    for tried in tunable_scenes() {
        let Tried { selection, changes, .. } = &tried;
        let mut one = tried.start();
        run(&mut one, 0.05);
        let before = one.to_bytes().unwrap();
        for (name, value) in changes {
            one.set(name, *value).unwrap();
        }
        let waiting = one.to_bytes().unwrap();
        run(&mut one, 0.1);
        let tuned = one.to_bytes().unwrap();
        run(&mut one, 0.15);
        let end = one.all_values().unwrap();
        let elsewhere = tried.start_with(&[(&changes[0].0, "0.5")]);
        for mut other in [one, tried.start(), elsewhere] {
            for (bytes, is_tuned) in [(&tuned, true), (&before, false), (&waiting, true), (&tuned, true)] {
                other.restore_bytes(bytes).unwrap();
                assert_eq!(&other.to_bytes().unwrap(), bytes, "{selection:?}");
                for (name, value) in changes {
                    assert_eq!(other.real(name) == Ok(*value), is_tuned, "{selection:?}: {name}");
                }
                run(&mut other, 0.1);
                run(&mut other, 0.15);
                assert_eq!(other.all_values().unwrap() == end, is_tuned, "{selection:?}");
            }
        }
    }
}

/// A step that is refused for its work leaves the parameters to the next try.
#[test]
fn a_refused_step_takes_back_what_was_tuned_for_it() {
    for tried in tunable_scenes() {
        let Tried { selection, changes, .. } = &tried;
        let mut one = tried.start();
        run(&mut one, 0.05);
        let mut twin = tried.start();
        twin.restore_bytes(&one.to_bytes().unwrap()).unwrap();
        for (name, value) in changes {
            one.set(name, *value).unwrap();
            twin.set(name, *value).unwrap();
        }
        let before = one.to_bytes().unwrap();
        one.limit_work(0);
        assert!(one.advance_to(5.0).is_err(), "{selection:?}");
        assert_eq!(one.to_bytes().unwrap(), before, "{selection:?}");
        one.limit_work(u64::MAX);
        run(&mut one, 0.1);
        run(&mut twin, 0.1);
        assert_eq!(one.all_values(), twin.all_values(), "{selection:?}");
    }
}

/// The ends of the ranges, and far steps between: computed, or refused with nothing changed but what was set.
#[test]
fn extreme_changes_are_computed_or_refused() {
    for tried in tunable_scenes() {
        let Tried { selection, changes, .. } = &tried;
        let mut one = tried.start();
        one.limit_work(200_000);
        run(&mut one, 0.05);
        let mut refused = 0;
        for (name, value) in changes {
            let position = one.position(name).unwrap();
            let [least, most] = one.variables()[position].kind.bounds();
            for extreme in [least, most, *value, 1e-3 * value, most, least, *value] {
                let extreme = extreme.clamp(least, most);
                let until = one.time() + 0.01;
                one.set(name, extreme).unwrap();
                let before = one.to_bytes().unwrap();
                match one.advance_to(until) {
                    Ok(()) => {
                        let values = one.all_values().unwrap();
                        assert!(
                            values.iter().all(|value| value.to_f64().is_finite()),
                            "{selection:?}: {name} = {extreme}"
                        );
                    }
                    Err(error) => {
                        refused += 1;
                        assert_eq!(
                            one.to_bytes().unwrap(),
                            before,
                            "{selection:?}: {name} = {extreme}: {error}"
                        );
                    }
                }
            }
            one.set(name, *value).unwrap();
        }
        println!("{selection:?}: {refused} refused");
    }
}

/// [`Model::tune`] called at every step with the values that the model has.
fn tune_anew<M: Model>(disks: u32) {
    let (mut tuned, mut plain) = (simulation_of::<M>(disks, &[]), simulation_of::<M>(disks, &[]));
    for index in 1..=40 {
        let time = 0.003 * f64::from(index);
        tuned
            .advance_by(time, |model, values| {
                model.tune(values)?;
                model.advance_to(time, values)
            })
            .unwrap();
        plain.advance_to(time).unwrap();
        assert!(tuned.save() == plain.save(), "{:?} at {time} s", M::info().variant);
    }
}

#[test]
fn the_values_that_a_model_has_change_no_bit() {
    tune_anew::<PackingOnSine>(12);
    tune_anew::<LocatedPackingOnSine>(12);
    tune_anew::<PackingOnFixedBottom>(30);
    tune_anew::<HardPackingOnSine>(12);
    tune_anew::<RatchetOnSine>(12);
    tune_anew::<WedgeMap>(1);
    tune_anew::<WedgeEventDrivenOnSine>(1);
    tune_anew::<WedgeMolecularDynamicsOnSine>(1);
}
