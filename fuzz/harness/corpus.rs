//! The inputs that were worth keeping, once more.

/// Runs every input in `folder`; says how many there are.
pub fn replay(folder: &str, run: impl Fn(&[u8])) -> usize {
    let files = std::fs::read_dir(folder).expect("the corpus");
    files
        .map(|file| run(&std::fs::read(file.expect("a file").path()).expect("readable")))
        .count()
}
