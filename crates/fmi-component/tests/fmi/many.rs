//! Many instances, one after the other, at once, and each on a thread of its own.

use std::ptr::null;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use fmi_component::c_api::Opaque;
use fmi_component::c_api::Status::{Error, Ok};
use oscillators::fmi3::*;

use crate::client::{Client, reference};
use crate::listener::{ListeningClient, RAISED};

#[test]
fn a_thousand_instances_live_side_by_side() {
    let clients: Vec<_> = (0..1000).map(|_| Client::three().ready(&[])).collect();
    let expected = clients[0].run((0, 3), 0.01);
    assert!(clients[1..].iter().all(|client| client.run((0, 3), 0.01) == expected));
}

#[test]
fn ten_threads_give_the_bits_of_one_run_alone() {
    let alone = Client::three().ready(&[]).run((0, 200), 0.01);
    std::thread::scope(|scope| {
        let runs: Vec<_> = (0..10)
            .map(|index| {
                scope.spawn(move || {
                    let client = if index % 2 == 0 { Client::two() } else { Client::three() };
                    client.ready(&[]).run((0, 200), 0.01)
                })
            })
            .collect();
        for run in runs {
            assert_eq!(run.join().unwrap(), alone);
        }
    });
}

#[test]
fn two_thousand_lives_in_one_process() {
    for _ in 0..2000 {
        let client = Client::three().ready(&[]);
        client.save(); // freed with its instance
        client.run((0, 1), 0.01);
    }
}

/// An instance in the hands of several threads.
#[derive(Clone, Copy)]
struct Shared(Opaque);
unsafe impl Send for Shared {}

impl Shared {
    fn get(self) -> Opaque {
        self.0
    }
}

/// A step that resumes after an intermediate update waits until other threads have read.
#[test]
fn other_threads_may_only_read_during_an_intermediate_update() {
    let (inside, height) = (Arc::new(AtomicBool::new(false)), reference("body.position[1]"));
    let begun = Arc::clone(&inside);
    let listening = ListeningClient::reacting(move |listener, _| {
        begun.store(true, Ordering::Release);
        let shared = Shared(listener.pointer.get());
        let other = std::thread::spawn(move || unsafe {
            fmi3FreeInstance(shared.get());
            fmi3Reset(shared.get())
        });
        assert_eq!(other.join().unwrap(), Error);
        None
    });
    assert_eq!(
        unsafe { fmi3SetDebugLogging(listening.client.pointer, 0, 0, null()) },
        Ok,
        "the log is no thread's but ours"
    );
    let (shared, done) = (Shared(listening.client.pointer), AtomicBool::new(false));
    let reads = std::thread::scope(|scope| {
        let (inside, done) = (&inside, &done);
        let reader = scope.spawn(move || {
            let (mut reads, mut value) = (0, 0.0);
            while !done.load(Ordering::Acquire) {
                let began = inside.load(Ordering::Acquire);
                let pointer = shared.get();
                reads += u32::from(began && unsafe { fmi3GetFloat64(pointer, &height, 1, &mut value, 1) } == Ok);
            }
            reads
        });
        let status = listening.client.step(0.0, 20.0);
        done.store(true, Ordering::Release);
        assert_eq!(status, Ok);
        reader.join().unwrap()
    });
    assert!(reads > 0 && listening.listener.times().len() > 100);
    let plain = Client::three().ready(RAISED);
    assert_eq!(plain.step(0.0, 20.0), Ok);
    assert_eq!(listening.client.outputs(), plain.outputs());
}
