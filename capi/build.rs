//! Passes `JOSTLE_C_LINK_ARGUMENT` on to the linker of the shared library: the name under which a program looks for it, which
//! `scripts/release` gives. A build for tests has none, so that the file is found under its own name.

fn main() {
    println!("cargo::rerun-if-env-changed=JOSTLE_C_LINK_ARGUMENT");
    if let Ok(argument) = std::env::var("JOSTLE_C_LINK_ARGUMENT") {
        println!("cargo::rustc-cdylib-link-arg={argument}");
    }
}
