//! `include/jostle.h` is what cbindgen makes of `capi/src`.
//!
//! Regression test: it shows each change of the interface in the diff. To accept one:
//! `UPDATE_HEADER=1 cargo test -p jostle-c --test header`, and a line in the change log.
#![allow(clippy::unwrap_used)]

use std::path::Path;

#[test]
fn the_header_is_generated() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut generated = Vec::new();
    cbindgen::generate(folder).unwrap().write(&mut generated);
    let generated = String::from_utf8(generated).unwrap();
    let path = folder.join("../include/jostle.h");
    if std::env::var_os("UPDATE_HEADER").is_some() {
        std::fs::write(&path, &generated).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == generated,
        "include/jostle.h is not what cbindgen makes; see the head of this test"
    );
}
