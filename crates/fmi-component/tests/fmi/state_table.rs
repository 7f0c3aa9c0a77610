//! The state tables of both standards (FMI 2.0 section 4.2.4, FMI 3.0 sections 2.3 and 4.2), cell by cell.

use std::ptr::null_mut;

use fmi_component::Importer;
use fmi_component::c_api::Status::{self, Error, Ok};
use oscillators::fmi2::*;
use oscillators::fmi3::*;

use crate::client::{Client, reference, token};

const PHASES: [&str; 5] = [
    "instantiated",
    "initialization mode",
    "event mode",
    "step mode",
    "terminated",
];

fn in_phase(phase: &str, three: bool) -> Client {
    let importer = Importer {
        event_mode: phase == "event mode",
        early_return: false,
    };
    let client = match three {
        true => Client::three_with(&token(), importer),
        false => Client::two(),
    };
    if phase == "instantiated" {
        return client;
    }
    assert_eq!(client.enter(), Ok);
    if phase == "initialization mode" {
        return client;
    }
    assert_eq!(client.exit(), Ok);
    if phase == "terminated" {
        assert_eq!(terminate(&client), Ok);
    }
    client
}

fn terminate(client: &Client) -> Status {
    match client.three {
        true => unsafe { fmi3Terminate(client.pointer) },
        false => unsafe { fmi2Terminate(client.pointer) },
    }
}

fn update(client: &Client) -> Status {
    let (mut flags, mut next) = ([0_u8; 5], 0.0);
    let [one, two, three, four, five] = &mut flags;
    unsafe { fmi3UpdateDiscreteStates(client.pointer, one, two, three, four, five, &mut next) }
}

fn save(client: &Client) -> Status {
    let mut state = null_mut();
    match client.three {
        true => unsafe { fmi3GetFMUState(client.pointer, &mut state) },
        false => unsafe { fmi2GetFMUstate(client.pointer, &mut state) },
    }
}

fn enter(client: &Client) -> Status {
    match client.three {
        true => client.enter(),
        false => unsafe { fmi2EnterInitializationMode(client.pointer) },
    }
}

fn set_rate(client: &Client) -> Status {
    unsafe { fmi2SetRealInputDerivatives(client.pointer, &reference("frame.position"), 1, &1, &0.1) }
}

type Call = fn(&Client) -> Status;

/// Each call with the phases in which it is legal, one letter each: instantiated, initialization, event, step, terminated.
const BOTH: [(&str, Call, &str); 10] = [
    ("enter initialization", enter, "I...."),
    ("exit initialization", |client| client.exit(), ".N..."),
    ("step", |client| client.step(0.0, 0.01), "...S."),
    ("terminate", terminate, "..ES."),
    ("get a parameter", |client| client.get("body.mass").0, "INEST"),
    ("get an output", |client| client.get("frame.reaction_force").0, ".NEST"),
    ("set a parameter", |client| client.set("body.mass", 0.2), "IN..."),
    (
        "set a tunable parameter",
        |client| client.set("spring.stiffness", 200.0),
        "INES.",
    ),
    ("set an input", |client| client.set("frame.velocity", 0.2), "INES."),
    ("save", save, "INEST"),
];
const TWO: [(&str, Call, &str); 3] = [
    (
        "set up",
        |client| unsafe { fmi2SetupExperiment(client.pointer, 0, 0.0, 0.0, 0, 0.0) },
        "I....",
    ),
    ("set an input's rate", set_rate, "INES."),
    ("reset", |client| client.reset(), "INEST"),
];
const THREE: [(&str, Call, &str); 4] = [
    (
        "enter event mode",
        |client| unsafe { fmi3EnterEventMode(client.pointer) },
        ".....", // and step mode, where it was asked for: see `events`
    ),
    (
        "enter step mode",
        |client| unsafe { fmi3EnterStepMode(client.pointer) },
        "..E..",
    ),
    ("update discrete states", update, "..E.."),
    ("reset", |client| client.reset(), "INEST"),
];

fn check((name, call, legal): (&str, Call, &str), three: bool) {
    for (phase, letter) in PHASES.into_iter().zip(legal.chars()) {
        if phase == "event mode" && !three {
            continue;
        }
        let client = in_phase(phase, three);
        let status = call(&client);
        let expected = if letter == '.' { Error } else { Ok };
        assert_eq!(status, expected, "{name}, {phase}: {}", client.last_message());
        if status == Error {
            let message = client.last_message();
            let explained = ["phase", "not computed yet", "was not asked for"]
                .iter()
                .any(|word| message.contains(word));
            let expected = [
                "legal in: ",
                "first",
                "reset",
                "Inputs may",
                "between steps",
                "Instantiate with",
            ];
            assert!(
                explained && expected.iter().any(|word| message.contains(word)),
                "{name}, {phase}: {message}"
            );
            assert_eq!(client.reset(), Ok, "it lives on");
        }
    }
}

#[test]
fn every_call_is_legal_where_the_standards_say() {
    for three in [false, true] {
        BOTH.into_iter().for_each(|row| check(row, three));
    }
    TWO.into_iter().for_each(|row| check(row, false));
    THREE.into_iter().for_each(|row| check(row, true));
}
