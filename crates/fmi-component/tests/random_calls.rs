//! Random sequences of calls of all functions of both versions of FMI, on the oscillators: a short run of what `fuzz/run`
//! does for hours, and the inputs that it has found worth keeping.
#![allow(unsafe_code, dead_code, clippy::undocumented_unsafe_blocks)]

#[path = "../../../fuzz/harness/corpus.rs"]
mod corpus;
#[path = "../../../fuzz/harness/fmi.rs"]
mod fmi;
#[path = "../../../fuzz/harness/fmi_calls.rs"]
mod fmi_calls;
#[path = "../../../fuzz/harness/hand.rs"]
mod hand;
#[path = "../../../fuzz/harness/oscillators.rs"]
mod library;
#[path = "../../../fuzz/harness/lives.rs"]
mod lives;
#[path = "../../../fuzz/harness/tokens.rs"]
mod tokens;

use proptest::prelude::*;

proptest! {
    #[test]
    fn any_sequence_of_calls_is_answered(bytes in prop::collection::vec(any::<u8>(), 0..1000)) {
        fmi_calls::run(&bytes);
    }
}

#[test]
fn the_corpus_is_answered() {
    let inputs = corpus::replay(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../fuzz/corpus/fmi_probe"),
        |bytes| {
            fmi_calls::run(bytes);
        },
    );
    assert!(inputs > 20, "{inputs} inputs");
}
