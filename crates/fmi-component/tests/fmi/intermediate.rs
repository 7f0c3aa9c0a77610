//! Intermediate update of FMI 3.0: every event inside of a step is reported to the importer, which may read values and end the step.

use std::ffi::CStr;
use std::ptr::{null, null_mut};

use fmi_component::c_api::Status::{Discard, Error, Ok};
use fmi_component::c_api::fmi3::{self, Instantiation};
use fmi_component::c_api::{IntermediateUpdate, free};
use fmi_component::instance::Part;
use fmi_component::{Importer, Instance, Phase, TIME_REFERENCE, Version};
use oscillators::fmi3::*;

use crate::client::{Client, MODEL, reference, token, token_of};
use crate::decay::DECAY;
use crate::listener::{EARLY, Listener, ListeningClient, RAISED, events, instantiate, keep, update};

#[test]
fn every_event_of_a_step_is_reported_and_changes_nothing() {
    let plain = Client::three().ready(RAISED);
    assert_eq!(plain.step(0.0, 100.0), Ok);
    let listening = ListeningClient::new(Importer::default(), &[], None);
    assert_eq!(listening.client.step_to_event(0.0, 100.0), (false, false, 100.0));
    assert_eq!(listening.client.outputs(), plain.outputs());
    assert!(listening.listener.reported.borrow().len() > 900);
    assert_eq!(listening.listener.times(), events(100.0));
    let fine = ListeningClient::new(Importer::default(), &[], None);
    let mut ends = 0.0;
    while ends < 1.0 {
        assert_eq!(fine.client.step(ends, 1.0 / 64.0), Ok);
        ends += 1.0 / 64.0;
    }
    let first: Vec<_> = events(1.0);
    assert_eq!(
        fine.listener.times(),
        first,
        "no event of these falls on the end of a step"
    );
}

#[test]
fn an_event_at_the_end_of_a_step_is_not_reported() {
    let first = events(1.0)[0];
    let listening = ListeningClient::new(EARLY, &[], None);
    assert_eq!(listening.client.step_to_event(0.0, first), (false, false, first));
    assert_eq!(listening.listener.times(), []);
    let (step, second) = (1.0 - first, events(1.0)[1]);
    assert_eq!(
        listening.client.step_to_event(first, step),
        (false, false, first + step)
    );
    assert_eq!(listening.listener.times()[0], second);
}

#[test]
fn values_are_those_of_the_event() {
    let (times, height) = (events(1.0), reference("body.position[1]"));
    let plain: Vec<_> = times
        .iter()
        .map(|time| {
            let client = Client::three().ready(RAISED);
            assert_eq!(client.step(0.0, *time), Ok);
            client.get("body.position[1]")
        })
        .collect();
    let listening = ListeningClient::reacting(move |listener, time| {
        assert_eq!(listener.real(TIME_REFERENCE), (Ok, time));
        assert_eq!(listener.real(height), plain[listener.reported.borrow().len() - 1]);
        let (pointer, mut whole, mut rate) = (listener.pointer.get(), 0_i32, f64::NAN);
        let steps = reference("steps");
        let status = unsafe { fmi3GetInt32(pointer, &steps, 1, &mut whole, 1) };
        assert_eq!((status, f64::from(whole)), (Ok, (time * 1e3).round()));
        assert_eq!(
            unsafe { fmi3GetString(pointer, null(), 0, null_mut(), 0) },
            Ok,
            "of no variable"
        );
        // The model has no rates, so that this is refused as always, and not for the phase.
        let status = unsafe { fmi3GetOutputDerivatives(pointer, &height, 1, &1, &mut rate, 1) };
        assert_eq!(status, Error);
        assert!(
            listener.last_message().contains("is not offered"),
            "{}",
            listener.last_message()
        );
        assert_eq!(unsafe { CStr::from_ptr(fmi3GetVersion()) }, c"3.0");
        None
    });
    assert_eq!(listening.client.step(0.0, 1.0), Ok);
    assert_eq!(listening.listener.times(), times);
}

#[test]
fn all_but_reading_is_refused_and_freeing_ignored() {
    let base = reference("frame.position");
    let listening = ListeningClient::reacting(move |listener, time| {
        let (pointer, mut state, mut size) = (listener.pointer.get(), null_mut(), 0_usize);
        let (mut flags, mut reached) = ([0_u8; 5], 0.0);
        let [one, two, three, four, five] = &mut flags;
        let statuses = unsafe {
            fmi3FreeInstance(pointer);
            [
                fmi3SetFloat64(pointer, &base, 1, &0.5, 1),
                fmi3DoStep(pointer, time, 0.1, 0, one, two, three, &mut reached),
                fmi3Reset(pointer),
                fmi3Terminate(pointer),
                fmi3EnterInitializationMode(pointer, 0, 0.0, 0.0, 0, 0.0),
                fmi3ExitInitializationMode(pointer),
                fmi3EnterEventMode(pointer),
                fmi3EnterStepMode(pointer),
                fmi3UpdateDiscreteStates(pointer, one, two, three, four, five, &mut reached),
                fmi3GetFMUState(pointer, &mut state),
                fmi3SetFMUState(pointer, state),
                fmi3FreeFMUState(pointer, &mut state),
                fmi3SerializedFMUStateSize(pointer, state, &mut size),
                fmi3DeserializeFMUState(pointer, [0_u8; 4].as_ptr(), 4, &mut state),
                fmi3SetDebugLogging(pointer, 0, 0, null()),
            ]
        };
        assert_eq!(statuses, [Error; 15]);
        let log = listener.log.borrow();
        let refused: Vec<_> = log.iter().rev().take(15).map(|entry| &entry.2).collect();
        for message in refused {
            assert!(message.contains("in the phase intermediate update mode"), "{message}");
            assert!(message.contains("Read values only"), "{message}");
        }
        None
    });
    let plain = Client::three().ready(RAISED);
    for client in [&plain, &listening.client] {
        assert_eq!(client.step(0.0, 1.0), Ok);
        assert_eq!(client.set("frame.position", 0.0), Ok);
        assert_eq!(client.step(1.0, 0.01), Ok);
    }
    assert_eq!(listening.client.outputs(), plain.outputs());
}

#[test]
fn a_step_ends_early_when_that_is_asked_for() {
    let times = events(1.0);
    let (first, third) = (times[0], times[2]);
    let between = f64::midpoint(times[1], third);
    let late = 1.0_f64;
    // What is asked for at the first event, at the second, and where the step ends after how many reported events.
    let cases = [
        (Some(first), None, first, 1),
        (Some(0.0), None, first, 1),
        (Some(f64::NAN), None, first, 1),
        (Some(f64::INFINITY), None, first, 1),
        (Some(between), None, between, 2),
        (Some(third), None, third, 2),
        (Some(third), Some(between), between, 2),
        (Some(between), Some(late), between, 2),
        (None, Some(0.0), times[1], 2),
        (Some(7.0), None, late, times.len()),
    ];
    for (one, two, end, count) in cases {
        let wishes = [one, two];
        let listening = ListeningClient::reacting(move |listener, _| {
            let index = listener.reported.borrow().len() - 1;
            wishes.get(index).copied().flatten()
        });
        let case = format!("{wishes:?}");
        assert_eq!(
            listening.client.step_to_event(0.0, 1.0),
            (false, end < 1.0, end),
            "{case}"
        );
        assert_eq!(listening.listener.times(), times[..count], "{case}");
        assert!(listening.listener.reported.borrow().iter().all(|(_, early)| *early));
        let plain = Client::three().ready(RAISED);
        assert_eq!(plain.step(0.0, end), Ok);
        assert_eq!(listening.client.outputs(), plain.outputs(), "{case}");
        if end < 1.0 {
            assert_eq!(
                listening.client.step_to_event(end, 1e-4),
                (false, false, end + 1e-4),
                "{case}"
            );
        }
    }
}

#[test]
fn a_step_goes_on_where_early_return_is_not_allowed() {
    for event_mode in [false, true] {
        let importer = Importer {
            event_mode,
            early_return: false,
        };
        let listening = ListeningClient::new(importer, &[], Some(Box::new(|_, time| Some(time))));
        if event_mode {
            assert_eq!(unsafe { fmi3EnterStepMode(listening.client.pointer) }, Ok);
        }
        assert_eq!(listening.client.step_to_event(0.0, 1.0), (false, false, 1.0));
        assert_eq!(listening.listener.times(), events(1.0));
        assert!(listening.listener.reported.borrow().iter().all(|(_, early)| !early));
    }
}

#[test]
fn in_event_mode_no_intermediate_update_is_reported() {
    let importer = Importer {
        event_mode: true,
        ..EARLY
    };
    let listening = ListeningClient::new(importer, &[], Some(Box::new(|_, time| Some(time))));
    assert_eq!(unsafe { fmi3EnterStepMode(listening.client.pointer) }, Ok);
    let first = events(1.0)[0];
    assert_eq!(listening.client.step_to_event(0.0, 1.0), (true, true, first));
    assert_eq!(listening.listener.times(), []);
}

/// Bits of the outputs and of the saved state, which holds time, values and phase.
fn all(client: &Client) -> (Vec<u64>, Vec<u8>) {
    (client.outputs(), client.bytes(client.save()))
}

#[test]
fn a_refused_step_undoes_the_events_that_were_reported() {
    let listening = ListeningClient::new(EARLY, &[("fault.refuse_time", 0.7)], None);
    assert_eq!(listening.client.step(0.0, 0.1), Ok);
    let before = all(&listening.client);
    let count = listening.listener.reported.borrow().len();
    assert_eq!(listening.client.step(0.1, 0.9), Discard);
    assert!(listening.listener.reported.borrow().len() > count + 2);
    assert_eq!(all(&listening.client), before);
    assert_eq!(listening.client.step(0.1, 0.9), Error, "the same step again");
    assert_eq!(all(&listening.client), before);
    let plain = Client::three().ready(&[RAISED, &[("fault.refuse_time", 0.7)]].concat());
    assert_eq!(plain.step(0.0, 0.6), Ok);
    assert_eq!(
        listening.client.step(0.1, 0.5),
        Ok,
        "{}",
        listening.listener.last_message()
    );
    assert_eq!(listening.client.outputs(), plain.outputs());
}

#[test]
fn a_panic_after_an_event_fails_this_instance_alone() {
    let listening = ListeningClient::new(EARLY, &[("fault.panic_time", 0.7)], None);
    assert_eq!(listening.client.step(0.0, 1.0), Error);
    assert!(listening.listener.reported.borrow().len() > 2);
    assert!(listening.listener.last_message().contains("has failed"));
    assert_eq!(listening.client.step(0.0, 0.1), Error);
    assert_eq!(listening.client.reset(), Ok);
    assert_eq!(listening.client.enter(), Ok, "as new");
}

#[test]
fn required_variables_are_checked() {
    let (listener, good) = (Listener::default(), [reference("steps"), TIME_REFERENCE]);
    let refused = |required: &[u32], callback| {
        let pointer = instantiate(&listener, EARLY, (required.as_ptr(), required.len()), callback);
        assert!(pointer.is_null());
        listener.last_message()
    };
    let unknown = refused(&[1, 77, 2, u32::MAX], Some(update as IntermediateUpdate));
    assert!(unknown.contains("[77, 4294967295]"), "{unknown}");
    let deaf = refused(&good, None);
    assert!(deaf.contains("intermediateUpdate is null"), "{deaf}");
    assert!(instantiate(&listener, EARLY, (null(), 2), Some(update)).is_null());
    let missing = listener.last_message();
    assert!(missing.contains("requiredIntermediateVariables is a null"), "{missing}");
    let pointer = instantiate(&listener, EARLY, (good.as_ptr(), 2), Some(update));
    assert!(!pointer.is_null());
    drop(Client::of(pointer));
}

#[test]
fn models_without_events_have_none_to_report() {
    let (text, listener) = (token_of(&DECAY, false), Listener::default());
    let environment = std::ptr::from_ref(&listener).cast_mut().cast();
    let make = |required: &[u32]| unsafe {
        let asked = Instantiation {
            name: c"decay".as_ptr(),
            token: text.as_ptr(),
            logging_on: 0,
            event_mode_used: 0,
            early_return_allowed: 0,
            required_intermediate_variables: required.as_ptr(),
            required_count: required.len(),
            environment,
            log: Some(keep),
            intermediate_update: Some(update),
        };
        fmi3::instantiate(&DECAY, asked)
    };
    assert!(make(&[1]).is_null());
    assert!(listener.last_message().contains("providesIntermediateUpdate = false"));
    let pointer = make(&[]);
    assert!(!pointer.is_null(), "a callback alone is ignored");
    unsafe { free(pointer, Version::Three) };
}

/// The same from Rust, where nothing but the instance itself stands guard.
#[test]
fn an_instance_guards_a_step_under_way() {
    let mut instance = Instance::new(&MODEL, token().to_str().unwrap(), EARLY).unwrap();
    instance.set_up(0.0, None).unwrap();
    instance.enter_initialization().unwrap();
    instance.exit_initialization().unwrap();
    assert!(instance.resume_step(None).is_err(), "no step is under way");
    let before = instance.save().unwrap();
    let Part::Event(time) = instance.begin_step(0.0, 10.0).unwrap() else {
        panic!("the model swings");
    };
    assert_eq!((instance.phase(), instance.time()), (Phase::IntermediateUpdate, time));
    assert!(instance.save().is_err() && instance.restore(&before).is_err() && instance.do_step(time, 0.1).is_err());
    instance.reset();
    assert!(instance.resume_step(None).is_err(), "the step is forgotten");
    assert_eq!(instance.phase(), Phase::Instantiated);
}
