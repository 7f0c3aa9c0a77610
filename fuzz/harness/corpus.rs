//! The inputs that were worth keeping, run once more. A corpus is one ZIP archive with one entry for each input.

use std::io::Read;

/// Runs every input of the archive `corpus.zip` in the order of the archive; returns the number of inputs.
pub fn replay(corpus: &str, run: impl Fn(&[u8])) -> usize {
    let file = std::fs::File::open(format!("{corpus}.zip")).expect("the corpus");
    let mut archive = zip::ZipArchive::new(file).expect("a ZIP archive");
    for index in 0..archive.len() {
        let mut input = Vec::new();
        let mut entry = archive.by_index(index).expect("an entry");
        entry.read_to_end(&mut input).expect("readable");
        run(&input);
    }
    archive.len()
}
