//! The library that an FMU holds: every function of both headers is in it.

use libloading::Library;

/// Functions that an export table writes, from its source.
fn functions(source: &str) -> Vec<&str> {
    let lines = source.lines().filter_map(|line| line.trim().strip_prefix("fn "));
    lines.map(|line| line.split('(').next().unwrap()).collect()
}

#[test]
fn the_library_exports_all_functions_of_both_versions() {
    let name = format!(
        "{}oscillators{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    );
    let mut path = std::env::current_exe().unwrap().with_file_name(&name);
    if !path.exists() {
        path = path.with_file_name("..").join(name);
    }
    let library = unsafe { Library::new(path) }.unwrap();
    let two = functions(include_str!("../../src/c_api/export_fmi2.rs"));
    let three = functions(include_str!("../../src/c_api/export_fmi3.rs"));
    assert_eq!((two.len(), three.len()), (44, 75));
    for name in two.into_iter().chain(three) {
        assert!(unsafe { library.get::<unsafe extern "C" fn()>(name) }.is_ok(), "{name}");
    }
}
