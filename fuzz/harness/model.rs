//! Random sequences of calls of all functions of both versions, on one small model: what the tests of the example models share. What
//! includes this file says in `super::library` which model is called.
//!
//! `fuzz/calls` runs the ignored test on every model.

#[path = "fmi.rs"]
mod fmi;
#[path = "fmi_calls.rs"]
mod fmi_calls;
#[path = "hand.rs"]
mod hand;
#[path = "lives.rs"]
mod lives;
#[path = "rewind.rs"]
mod rewind;
#[path = "tokens.rs"]
pub mod tokens;

use super::library;

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// Makes the calls that `bytes` ask for, and goes back and on with the instances at the end.
pub fn run(bytes: &[u8]) {
    fmi_calls::run_and(bytes, rewind::rewind);
}

fn sequence() -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 0..1000)
}

proptest! {
    #[test]
    fn any_sequence_of_calls_is_answered(bytes in sequence()) {
        run(&bytes);
    }
}

#[test]
#[ignore = "takes as long as RANDOM_CALLS says: fuzz/calls"]
fn as_many_calls_as_asked_for_are_answered() {
    let asked = std::env::var("RANDOM_CALLS").expect("RANDOM_CALLS: how many calls");
    let asked: u64 = asked.parse().expect("RANDOM_CALLS: a whole number");
    let (mut runner, mut sequences) = (TestRunner::default(), 0_u64);
    while hand::counted()[0] < asked {
        run(&sequence().new_tree(&mut runner).expect("any bytes do").current());
        sequences += 1;
    }
    let [calls, inside, steps] = hand::counted();
    println!("sequences: {sequences} inside: {inside} calls: {calls} steps: {steps}");
}
