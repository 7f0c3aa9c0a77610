//! Random sequences of calls of all functions of both versions of FMI, on the oscillators: a short run of what `fuzz/run`
//! does for hours, and the inputs that it has found worth keeping.
#![allow(unsafe_code, dead_code, clippy::undocumented_unsafe_blocks)]

#[path = "../../../fuzz/harness/corpus.rs"]
mod corpus;
#[path = "../../../fuzz/harness/model.rs"]
mod harness;
#[path = "../../../fuzz/harness/oscillators.rs"]
mod library;

use harness::tokens;

#[test]
fn the_corpus_is_answered() {
    let inputs = corpus::replay(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../fuzz/corpus/fmi_probe"),
        |bytes| {
            harness::run(bytes);
        },
    );
    assert!(inputs > 20, "{inputs} inputs");
}
