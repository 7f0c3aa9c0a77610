//! Event mode and early return of FMI 3.0. The model's event: body 1 passes height zero at a grid point.

use fmi_component::Importer;
use fmi_component::Instance;
use fmi_component::c_api::Status::{Error, Ok};
use oscillators::fmi3::*;

use crate::client::{Client, token, token_of};
use crate::decay::DECAY;

/// Raised by m g / k, so that body 1 swings about height zero.
const RAISED: &[(&str, f64)] = &[("frame.position", 9.8e-3)];
const EVENTS: Importer = Importer {
    event_mode: true,
    early_return: true,
};

fn events() -> Client {
    let client = Client::three_with(&token(), EVENTS).ready(RAISED);
    assert_eq!(client.step(0.0, 0.01), Error, "initialisation ends in event mode");
    leave_event_mode(&client);
    client
}

fn leave_event_mode(client: &Client) {
    let (mut flags, mut next) = ([7_u8; 5], f64::NAN);
    let [update, terminate, nominals, states, time] = &mut flags;
    let status =
        unsafe { fmi3UpdateDiscreteStates(client.pointer, update, terminate, nominals, states, time, &mut next) };
    assert_eq!(
        (status, flags),
        (Ok, [0; 5]),
        "one round is enough and no event is known ahead"
    );
    assert_eq!(unsafe { fmi3EnterStepMode(client.pointer) }, Ok);
}

/// Runs to `end`, by steps of at most `step`; times of the events.
fn run(client: &Client, end: f64, step: f64) -> Vec<f64> {
    let (mut time, mut times) = (0.0, Vec::new());
    while time < end {
        let next = (time + step).min(end);
        let (event, early, reached) = client.step_to_event(time, next - time);
        assert_eq!(
            early,
            reached < time + (next - time),
            "early return says that the end was not reached"
        );
        assert!(event || !early, "this model returns early for events only");
        if event {
            assert_eq!(unsafe { fmi3EnterEventMode(client.pointer) }, Ok);
            leave_event_mode(client);
            times.push(reached);
        }
        time = reached;
    }
    times
}

#[test]
fn steps_end_at_events_and_give_the_bits_of_a_run_without() {
    let plain = Client::three().ready(RAISED);
    let (client, fine) = (events(), events());
    let times = run(&client, 1.0, 0.3);
    assert_eq!(plain.step(0.0, 1.0), Ok);
    assert_eq!(client.outputs(), plain.outputs());
    // The signs of the displacement on the grid of 1 ms, observed by an importer without event mode.
    let watch = Client::three().ready(RAISED);
    let heights: Vec<_> = (0..1000)
        .map(|index| {
            assert_eq!(watch.step(f64::from(index) * 1e-3, 1e-3), Ok);
            watch.get("body.position[1]").1
        })
        .collect();
    let mut before = false;
    let mut observed = Vec::new();
    for (index, height) in heights.into_iter().enumerate() {
        if (height < 0.0) != before {
            observed.push((index + 1) as f64 * 1e-3);
        }
        before = height < 0.0;
    }
    assert!(observed.len() > 2, "{observed:?}");
    assert_eq!(times.len(), observed.len(), "{times:?} {observed:?}");
    assert!(
        times
            .iter()
            .zip(&observed)
            .all(|(one, other)| (one - other).abs() < 1e-9)
    );
    let fine_times = run(&fine, 1.0, 0.0037);
    assert!(
        fine_times
            .iter()
            .zip(&observed)
            .all(|(one, other)| (one - other).abs() < 1e-9)
    );
    assert_eq!(fine.outputs(), plain.outputs());
}

#[test]
fn without_early_return_or_event_mode_steps_reach_their_end() {
    let plain = Client::three().ready(RAISED);
    let early_only = Importer {
        event_mode: false,
        ..EVENTS
    };
    let whole_steps = Importer {
        early_return: false,
        ..EVENTS
    };
    let early_only = Client::three_with(&token(), early_only).ready(RAISED);
    assert_eq!(unsafe { fmi3EnterEventMode(early_only.pointer) }, Error);
    let whole_steps = Client::three_with(&token(), whole_steps).ready(RAISED);
    leave_event_mode(&whole_steps);
    for client in [&plain, &early_only, &whole_steps] {
        assert_eq!(client.step_to_event(0.0, 1.0), (false, false, 1.0));
        assert_eq!(client.outputs(), plain.outputs());
    }
}

#[test]
fn inputs_can_be_set_and_states_restored_in_event_mode() {
    let client = events();
    let (_, _, time) = client.step_to_event(0.0, 1.0);
    assert_eq!(unsafe { fmi3EnterEventMode(client.pointer) }, Ok);
    assert_eq!(client.set("frame.position", 1e-3), Ok);
    assert_eq!(client.set("body.mass", 0.2), Error, "a parameter is frozen");
    let state = client.save();
    let bytes = client.bytes(state);
    leave_event_mode(&client);
    let first = client.step_to_event(time, 0.5);
    let outputs = client.outputs();
    assert_eq!(client.restore(state), Ok);
    assert_eq!(client.step(time, 0.5), Error, "back in event mode");
    leave_event_mode(&client);
    assert_eq!(client.step_to_event(time, 0.5), first);
    assert_eq!(client.outputs(), outputs);
    let plain = Client::three();
    assert_eq!(
        plain.deserialize(&bytes).0,
        Error,
        "an instance without event mode cannot be in it"
    );
    assert_eq!(unsafe { fmi3Terminate(client.pointer) }, Ok);
}

#[test]
fn reset_keeps_what_the_importer_can_do() {
    let client = events();
    run(&client, 0.5, 0.1);
    assert_eq!(client.reset(), Ok);
    let (client, new) = (client.ready(RAISED), events());
    leave_event_mode(&client);
    assert_eq!(run(&client, 0.5, 0.1), run(&new, 0.5, 0.1));
    assert_eq!(client.outputs(), new.outputs());
}

#[test]
fn models_without_events_refuse_event_mode_as_their_flags_say() {
    let token = token_of(&DECAY, false);
    let message = Instance::new(&DECAY, token.to_str().unwrap(), EVENTS)
        .unwrap_err()
        .to_string();
    assert!(message.contains("hasEventMode"), "{message}");
}
