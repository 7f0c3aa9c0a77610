//! Saved states: bit for bit, in every phase, as bytes in another instance, and never a stale one.

use std::ptr::null_mut;

use fmi_component::c_api::Status::{Error, Ok};
use fmi_component::{DynSimulation, Importer, Instance, Phase, StructuralParameters, saved_bytes};
use oscillators::fmi3::*;

use crate::client::{Client, MODEL, token};

#[test]
fn rollback_gives_the_same_bits() {
    for client in [Client::two(), Client::three()] {
        let client = client.ready(&[("body.mass", 0.2)]);
        client.run((0, 13), 0.01);
        let state = client.save();
        let first = client.run((13, 40), 0.01);
        assert_eq!(client.restore(state), Ok);
        assert_eq!(client.run((13, 40), 0.01), first);
    }
}

#[test]
fn bytes_carry_a_run_to_another_instance() {
    let (one, other) = (Client::three().ready(&[("body.mass", 0.2)]), Client::three());
    one.run((0, 13), 0.01);
    let bytes = one.bytes(one.save());
    let (status, state) = other.deserialize(&bytes);
    assert_eq!(status, Ok, "{}", other.last_message());
    assert_eq!(other.restore(state), Ok, "{}", other.last_message());
    assert_eq!(other.bytes(other.save()), bytes);
    assert_eq!(other.run((13, 40), 0.01), one.run((13, 40), 0.01));
}

#[test]
fn states_of_every_phase_are_restored() {
    let client = Client::three();
    assert_eq!(client.set("body.mass", 0.3), Ok);
    let instantiated = client.save();
    assert_eq!(client.enter(), Ok);
    assert_eq!(client.set("body.mass", 0.4), Ok);
    let initializing = client.save();
    assert_eq!(client.exit(), Ok);
    let started = client.save();
    let run = client.run((0, 5), 0.01);
    assert_eq!(unsafe { fmi3Terminate(client.pointer) }, Ok);
    let terminated = client.save();

    assert_eq!(client.restore(started), Ok);
    assert_eq!(client.run((0, 5), 0.01), run);
    assert_eq!(client.restore(initializing), Ok);
    assert_eq!(client.get("body.mass"), (Ok, 0.4));
    assert_eq!(client.exit(), Ok);
    assert_eq!(client.run((0, 5), 0.01), run);
    assert_eq!(client.restore(instantiated), Ok);
    assert_eq!(client.get("body.mass"), (Ok, 0.3));
    assert_eq!(client.enter(), Ok);
    assert_eq!(client.restore(terminated), Ok);
    assert_eq!(client.step(0.05, 0.01), Error);
    assert_eq!(client.outputs(), run[run.len() - 4..]);
}

#[test]
fn altered_bytes_are_refused() {
    let client = Client::three().ready(&[]);
    client.run((0, 5), 0.01);
    let bytes = client.bytes(client.save());
    for length in 0..bytes.len() {
        assert_eq!(client.deserialize(&bytes[..length]).0, Error, "{length} bytes");
    }
    for index in 0..bytes.len() {
        let mut altered = bytes.clone();
        altered[index] ^= 1 << (index % 8);
        let (status, state) = client.deserialize(&altered);
        assert_eq!((status, state), (Error, null_mut()), "byte {index}");
        assert!(
            client.last_message().contains("state refused"),
            "{}",
            client.last_message()
        );
    }
    let longer = [bytes.as_slice(), &[0]].concat();
    assert_eq!(client.deserialize(&longer).0, Error);
    assert_eq!(client.deserialize(b"<xml>").0, Error);
    assert_eq!(client.deserialize(&bytes).0, Ok);
}

#[test]
fn stale_and_foreign_states_are_refused_with_a_message() {
    let (client, other) = (Client::three().ready(&[]), Client::three().ready(&[]));
    let mut state = client.save();
    let stale = state;
    assert_eq!(other.restore(state), Error, "of another instance");
    assert_eq!(unsafe { fmi3GetFMUState(client.pointer, &mut state) }, Ok);
    assert_eq!(state, stale, "a known state is overwritten");
    assert_eq!(unsafe { fmi3FreeFMUState(client.pointer, &mut state) }, Ok);
    assert!(state.is_null());
    assert_eq!(
        unsafe { fmi3FreeFMUState(client.pointer, &mut state) },
        Ok,
        "null is ignored"
    );
    assert_eq!(unsafe { fmi3FreeFMUState(client.pointer, null_mut()) }, Ok);
    let mut again = stale;
    assert_eq!(
        unsafe { fmi3FreeFMUState(client.pointer, &mut again) },
        Error,
        "freed twice"
    );
    assert_eq!(client.restore(stale), Error);
    assert_eq!(client.restore(null_mut()), Error);
    assert!(
        client.last_message().contains("not one of this instance"),
        "{}",
        client.last_message()
    );
    let mut size = 0;
    assert_eq!(
        unsafe { fmi3SerializedFMUStateSize(client.pointer, stale, &mut size) },
        Error
    );
    let state = client.save();
    let mut small = [0_u8; 8];
    assert_eq!(
        unsafe { fmi3SerializeFMUState(client.pointer, state, small.as_mut_ptr(), 8) },
        Error
    );
    assert_eq!(small, [0; 8]);
}

/// Bytes as an instance writes them, with whatever phase, stop time and state of the simulation.
#[test]
fn impossible_phases_and_times_are_refused() {
    let structure = StructuralParameters::defaults(&(MODEL.info)());
    let mut simulation = (MODEL.prepare)(structure);
    let payload = |simulation: &dyn DynSimulation| simulation.saved_to_payload(&simulation.save()).unwrap();
    let fresh = payload(&*simulation);
    simulation.start(0.0).unwrap();
    simulation.advance_to(0.5).unwrap();
    let good = payload(&*simulation);
    let token = token();
    let token = token.to_str().unwrap();
    let mut instance = Instance::new(&MODEL, token, Importer::default()).unwrap();
    instance.set_up(0.0, None).unwrap();
    instance.enter_initialization().unwrap();
    instance.exit_initialization().unwrap();
    instance.do_step(0.0, 0.5).unwrap();
    let saved = instance.snapshot_to_bytes(&instance.save().unwrap()).unwrap();
    let bytes = |phase, stop: Option<f64>, payload: &[u8]| saved_bytes::write(&(phase, stop, payload), token).unwrap();
    assert_eq!(bytes(Phase::Step, None, &good), saved);
    assert_eq!(
        instance.restore(&instance.snapshot_from_bytes(&saved).unwrap()),
        Result::Ok(())
    );
    for now in [0.0, 0.4, 0.6] {
        let mut moved = good.clone();
        moved[8..16].copy_from_slice(&f64::to_le_bytes(now));
        let message = instance
            .snapshot_from_bytes(&bytes(Phase::Step, None, &moved))
            .unwrap_err();
        assert!(message.to_string().contains("its model's 0.5 s"), "{message}");
    }
    for (phase, stop, payload) in [
        (Phase::IntermediateUpdate, None, &good),
        (Phase::Failed, None, &good),
        (Phase::Event, None, &good),
        (Phase::Instantiated, None, &good),
        (Phase::Step, Some(f64::NAN), &good),
        (Phase::Step, None, &fresh),
    ] {
        let message = instance.snapshot_from_bytes(&bytes(phase, stop, payload)).unwrap_err();
        assert!(
            message.to_string().contains("times are impossible"),
            "{phase:?}: {message}"
        );
    }
    assert_eq!(instance.snapshot_to_bytes(&instance.save().unwrap()).unwrap(), saved);
}
