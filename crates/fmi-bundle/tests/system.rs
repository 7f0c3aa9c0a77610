//! Systems that do not fit together are refused before anything is written.
#![allow(clippy::unwrap_used)]

use fmi_bundle::system::{Connection, Element, System};
use fmi_bundle::{Component, Libraries};
use fmi_component::{ModelType, Value, Version};
use oscillators::Oscillators;

fn refusal(change: impl FnOnce(&mut System<'_>)) -> String {
    let component = Component::new(&ModelType::of::<Oscillators>(), &[]).unwrap();
    let libraries = Libraries::default();
    let element = |name| Element {
        name,
        component: &component,
        libraries: &libraries,
        parameters: Vec::new(),
        outputs: Vec::new(),
        place: (0.0, 0.0),
    };
    let mut system = System {
        name: "two",
        description: "Two sets of oscillators.",
        elements: vec![element("upper"), element("lower")],
        connections: vec![connect("body.position[1]", "frame.position")],
        stop_time: 1.0,
        step_size: 0.01,
    };
    change(&mut system);
    let out = std::env::temp_dir().join(format!("jostle-refused-{}.ssp", std::process::id()));
    let message = system.write(Version::Two, &out).unwrap_err().to_string();
    assert!(!out.exists());
    message
}

fn connect(from: &'static str, to: &'static str) -> Connection {
    Connection {
        from: ("lower", from),
        to: ("upper", to),
    }
}

#[test]
fn connections_that_do_not_fit_are_refused_by_their_names() {
    // The system as it is gets as far as the library, which is not there.
    assert!(refusal(|_| ()).contains("there is no library for this system"));
    for (from, to, said) in [
        ("frame.reaction_force", "frame.position", "goes from N to m"),
        (
            "body.position[1]",
            "spring.stiffness",
            "upper.spring.stiffness is no input of reals",
        ),
        (
            "frame.position",
            "frame.position",
            "lower.frame.position is no output of reals",
        ),
        ("steps", "frame.position", "lower.steps is no output of reals"),
        (
            "body.position[9]",
            "frame.position",
            "lower has no variable body.position[9]",
        ),
        (
            "body.position[2]",
            "frame.position",
            "upper.frame.position has two sources",
        ),
    ] {
        let message = refusal(|system| {
            if !said.contains("two sources") {
                system.connections.clear();
            }
            system.connections.push(connect(from, to));
        });
        assert!(message.contains(said), "{from} to {to}: {message}");
    }
    let message = refusal(|system| system.connections[0].to.0 = "middle");
    assert!(message.contains("two has no element middle"), "{message}");
}

#[test]
fn elements_and_parameters_that_do_not_fit_are_refused_by_their_names() {
    let message = refusal(|system| system.elements[1].name = "upper");
    assert!(message.contains("two elements are called upper"), "{message}");
    for (name, value, said) in [
        ("spring.stiffness", -1.0, "spring.stiffness = -1 N/m is not allowed"),
        (
            "frame.reaction_force",
            1.0,
            "upper.frame.reaction_force is an output, and cannot be set",
        ),
        ("spring.length", 1.0, "upper has no variable spring.length"),
    ] {
        let message = refusal(|system| system.elements[0].parameters.push((name, Value::Real(value))));
        assert!(message.contains(said), "{name}: {message}");
    }
}
