//! Random sequences of calls of all functions of the C library: a short run of what `fuzz/run` does for hours, and the
//! inputs that it has found worth keeping.
#![allow(unsafe_code, dead_code, clippy::undocumented_unsafe_blocks)]

#[path = "../../fuzz/harness/c_calls.rs"]
mod c_calls;
#[path = "../../fuzz/harness/corpus.rs"]
mod corpus;
#[path = "../../fuzz/harness/hand.rs"]
mod hand;

use proptest::prelude::*;

proptest! {
    #[test]
    fn any_sequence_of_calls_is_answered(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        c_calls::run(&bytes);
    }
}

#[test]
fn the_corpus_is_answered() {
    let inputs = corpus::replay(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/corpus/c_library"),
        |bytes| {
            c_calls::run(bytes);
        },
    );
    assert!(inputs > 20, "{inputs} inputs");
}
