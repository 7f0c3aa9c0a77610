//! Tunable parameters: set between steps in both versions, part of the state, refused where the standards do not allow them. Those of
//! the oscillators are the stiffness of the springs and their damping.

use fmi_component::c_api::Status::{Discard, Error, Ok};
use fmi_component::instance::{Access, Part};
use fmi_component::{Importer, Instance, Value};
use oscillators::fmi3::*;

use crate::client::{Client, MODEL, reference, token};
use crate::listener::{EARLY, ListeningClient, RAISED};

fn both() -> [Client; 2] {
    [Client::two(), Client::three()]
}

/// A start at rest: nothing of the state at time 0 depends on the tunable parameters.
#[test]
fn a_value_set_before_the_first_step_is_that_of_a_start_with_it() {
    for (tuned, started) in both().into_iter().zip(both()) {
        let tuned = tuned.ready(&[]);
        assert_eq!(tuned.set("spring.stiffness", 250.0), Ok);
        assert_eq!(tuned.set("damper.damping", 0.7), Ok);
        let started = started.ready(&[("spring.stiffness", 250.0), ("damper.damping", 0.7)]);
        assert_eq!(tuned.run((0, 20), 0.01), started.run((0, 20), 0.01));
        assert_eq!(tuned.get("natural.angle_rate"), started.get("natural.angle_rate"));
    }
}

#[test]
fn a_value_is_read_at_once_and_reaches_the_model_with_the_next_step() {
    for client in both() {
        let client = client.ready(&[]);
        client.run((0, 5), 0.01);
        let outputs = client.outputs();
        assert_eq!(client.set("spring.stiffness", 400.0), Ok, "{}", client.last_message());
        assert_eq!(client.get("spring.stiffness"), (Ok, 400.0));
        assert_eq!(client.outputs(), outputs);
        assert_eq!(client.get("natural.angle_rate"), (Ok, (100.0_f64 / 0.1).sqrt()));
        client.run((5, 6), 0.01);
        assert_eq!(client.get("natural.angle_rate"), (Ok, (400.0_f64 / 0.1).sqrt()));
    }
}

#[test]
fn values_that_are_set_back_or_set_again_change_no_bit() {
    for (client, twin) in both().into_iter().zip(both()) {
        let (client, twin) = (client.ready(&[]), twin.ready(&[]));
        client.run((0, 7), 0.01);
        twin.run((0, 7), 0.01);
        for stiffness in [400.0, 100.0, 100.0] {
            assert_eq!(client.set("spring.stiffness", stiffness), Ok);
        }
        assert_eq!(client.run((7, 20), 0.01), twin.run((7, 20), 0.01));
    }
}

#[test]
fn states_hold_the_values_of_their_time() {
    for client in both() {
        let client = client.ready(&[]);
        client.run((0, 5), 0.01);
        let soft = client.save();
        assert_eq!(client.set("spring.stiffness", 400.0), Ok);
        let waiting = client.save();
        let first = client.run((5, 20), 0.01);
        let stiff = client.save();
        let second = client.run((20, 30), 0.01);
        for _ in 0..2 {
            assert_eq!(client.restore(waiting), Ok);
            assert_eq!(client.get("spring.stiffness"), (Ok, 400.0));
            assert_eq!(client.get("natural.angle_rate"), (Ok, (100.0_f64 / 0.1).sqrt()));
            assert_eq!(client.run((5, 20), 0.01), first);
            assert_eq!(client.restore(soft), Ok);
            assert_eq!(client.get("spring.stiffness"), (Ok, 100.0));
            assert_ne!(client.run((5, 20), 0.01), first);
            assert_eq!(client.restore(stiff), Ok);
            assert_eq!(client.get("natural.angle_rate"), (Ok, (400.0_f64 / 0.1).sqrt()));
            assert_eq!(client.run((20, 30), 0.01), second);
        }
    }
}

#[test]
fn bytes_carry_the_values_to_another_instance() {
    let one = Client::three().ready(&[("damper.damping", 0.3)]);
    one.run((0, 5), 0.01);
    assert_eq!(one.set("spring.stiffness", 400.0), Ok);
    one.run((5, 9), 0.01);
    assert_eq!(one.set("damper.damping", 0.0), Ok);
    let bytes = one.bytes(one.save());
    let rest = one.run((9, 20), 0.01);
    // A new instance, one of another start, and one that is elsewhere.
    let elsewhere = Client::three().ready(&[("damper.damping", 0.3)]);
    elsewhere.run((0, 2), 0.01);
    for other in [
        Client::three(),
        Client::three().ready(&[("spring.stiffness", 50.0)]),
        elsewhere,
    ] {
        let (status, state) = other.deserialize(&bytes);
        assert_eq!(status, Ok, "{}", other.last_message());
        assert_eq!(other.restore(state), Ok, "{}", other.last_message());
        assert_eq!(other.bytes(other.save()), bytes);
        assert_eq!(other.get("spring.stiffness"), (Ok, 400.0));
        assert_eq!(other.get("damper.damping"), (Ok, 0.0));
        assert_eq!(other.run((9, 20), 0.01), rest);
    }
}

#[test]
fn wrong_values_are_refused_when_they_are_set() {
    for client in both() {
        let client = client.ready(&[]);
        client.run((0, 3), 0.01);
        for wrong in [0.0, -1.0, 1e9, f64::NAN, f64::INFINITY] {
            assert_eq!(client.set("spring.stiffness", wrong), Error, "{wrong}");
            assert!(
                client.last_message().contains("spring.stiffness"),
                "{}",
                client.last_message()
            );
            assert_eq!(client.get("spring.stiffness"), (Ok, 100.0));
        }
        assert_eq!(client.set("body.mass", 0.2), Error);
        assert!(client.last_message().contains("frozen"), "{}", client.last_message());
    }
}

/// The damping that a time step allows depends on the mass: only the model knows.
#[test]
fn values_that_do_not_go_together_refuse_the_step_by_name() {
    for (client, twin) in both().into_iter().zip(both()) {
        let (client, twin) = (client.ready(&[("body.mass", 0.01)]), twin.ready(&[("body.mass", 0.01)]));
        client.run((0, 5), 0.01);
        twin.run((0, 5), 0.01);
        let before = client.outputs();
        assert_eq!(client.set("damper.damping", 99.0), Ok);
        for _ in 0..2 {
            assert_eq!(client.step(0.05, 0.01), Error);
            let message = client.last_message();
            assert!(
                message.contains("damper.damping = 99") && message.contains("at most 10"),
                "{message}"
            );
            assert_eq!(client.outputs(), before);
            assert_eq!(
                client.get("damper.damping"),
                (Ok, 99.0),
                "what was set stays, to be corrected"
            );
        }
        assert_eq!(client.set("damper.damping", 0.2), Ok);
        assert_eq!(client.run((5, 20), 0.01), twin.run((5, 20), 0.01));
    }
}

#[test]
fn a_refused_step_takes_back_what_was_tuned_for_it() {
    for (client, twin) in both().into_iter().zip(both()) {
        let faults = &[("fault.refuse_time", 0.0755)];
        let (client, twin) = (client.ready(faults), twin.ready(faults));
        client.run((0, 7), 0.01);
        twin.run((0, 7), 0.01);
        let before = client.outputs();
        assert_eq!(client.set("spring.stiffness", 400.0), Ok);
        assert_eq!(client.step(0.07, 0.01), Discard, "{}", client.last_message());
        assert_eq!(client.outputs(), before);
        assert_eq!(client.get("natural.angle_rate"), (Ok, (100.0_f64 / 0.1).sqrt()));
        assert_eq!(client.set("spring.stiffness", 300.0), Ok);
        assert_eq!(
            client.step(0.07, 0.01),
            Discard,
            "with other parameters it is another step"
        );
        assert_eq!(client.set("spring.stiffness", 400.0), Ok);
        assert_eq!(twin.set("spring.stiffness", 400.0), Ok);
        assert_eq!(client.step(0.07, 0.005), Ok, "{}", client.last_message());
        assert_eq!(twin.step(0.07, 0.005), Ok);
        assert_eq!(client.outputs(), twin.outputs());
    }
}

#[test]
fn they_are_set_in_event_mode_too_and_not_inside_of_a_step() {
    let events = Importer {
        event_mode: true,
        early_return: true,
    };
    let client = Client::three_with(&token(), events).ready(RAISED);
    assert_eq!(client.set("spring.stiffness", 400.0), Ok, "{}", client.last_message());
    assert_eq!(unsafe { fmi3EnterStepMode(client.pointer) }, Ok);
    let (_, _, time) = client.step_to_event(0.0, 1.0);
    let plain = Client::three().ready(&[RAISED, &[("spring.stiffness", 400.0)]].concat());
    assert_eq!(plain.step(0.0, time), Ok);
    assert_eq!(client.outputs(), plain.outputs());

    let mut instance = Instance::new(&MODEL, token().to_str().unwrap(), EARLY).unwrap();
    instance.set_up(0.0, None).unwrap();
    instance.enter_initialization().unwrap();
    instance.exit_initialization().unwrap();
    let set =
        |instance: &mut Instance, name, value| instance.set(&[reference(name)], Access::Real, |_| Value::Real(value));
    set(&mut instance, "spring.stiffness", 120.0).unwrap();
    let Part::Event(_) = instance.begin_step(0.0, 10.0).unwrap() else {
        panic!("the model swings");
    };
    let refusal = set(&mut instance, "spring.stiffness", 100.0).unwrap_err().to_string();
    assert!(refusal.contains("between steps"), "{refusal}");
}

/// The whole step is taken back, and the change waits again.
#[test]
fn a_step_refused_after_an_event_takes_back_what_was_tuned_for_it() {
    let listening = ListeningClient::new(EARLY, &[("fault.refuse_time", 0.7)], None);
    let client = &listening.client;
    assert_eq!(client.step(0.0, 0.1), Ok);
    assert_eq!(client.set("spring.stiffness", 400.0), Ok);
    let before = client.bytes(client.save());
    assert_eq!(client.step(0.1, 0.9), Discard);
    assert!(
        listening.listener.reported.borrow().len() > 2,
        "events of the step were reported"
    );
    assert_eq!(client.bytes(client.save()), before);
    let plain = Client::three().ready(&[RAISED, &[("fault.refuse_time", 0.7)]].concat());
    assert_eq!(plain.step(0.0, 0.1), Ok);
    assert_eq!(plain.set("spring.stiffness", 400.0), Ok);
    assert_eq!(plain.step(0.1, 0.5), Ok);
    assert_eq!(client.step(0.1, 0.5), Ok, "{}", listening.listener.last_message());
    assert_eq!(client.outputs(), plain.outputs());
}

#[test]
fn terminated_and_reset_instances_forget_them() {
    for client in both() {
        let client = client.ready(&[]);
        client.run((0, 3), 0.01);
        assert_eq!(client.set("spring.stiffness", 400.0), Ok);
        client.run((3, 5), 0.01);
        assert_eq!(client.reset(), Ok);
        assert_eq!(client.get("spring.stiffness"), (Ok, 100.0));
        let (client, new) = (client.ready(&[]), Client::three().ready(&[]));
        assert_eq!(client.run((0, 5), 0.01), new.run((0, 5), 0.01));
        if client.three {
            assert_eq!(unsafe { fmi3Terminate(client.pointer) }, Ok);
            assert_eq!(client.set("spring.stiffness", 400.0), Error);
            assert!(
                client.last_message().contains("between steps"),
                "{}",
                client.last_message()
            );
        }
    }
}

/// What becomes doubtful by a change is told once, with its value.
#[test]
fn a_change_to_a_doubtful_value_is_logged() {
    let client = Client::two().ready(&[]);
    client.run((0, 3), 0.01);
    assert_eq!(client.last_message(), "");
    for (index, damping) in [(3, 20.0), (4, 0.2), (5, 20.0)] {
        assert_eq!(client.set("damper.damping", damping), Ok);
        client.run((index, index + 1), 0.01);
        let lines = client.log.borrow();
        assert_eq!(lines.len(), 1, "{lines:?}");
        let told = "DoStep: damper.damping = 20 kg/s makes the damping ratio 3.16";
        assert!(lines[0].2.contains(told), "{lines:?}");
    }
}
