//! A file with room reserved after its end, so that what must be written last still fits when the disk is full.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

/// A file that is written from its beginning on.
pub struct ReservedFile {
    file: File,
    /// Where the next byte goes.
    end: u64,
    /// Bytes of the file, of which those after `end` are zeros.
    reserved: u64,
}

impl ReservedFile {
    /// An empty file; a file that was there is replaced.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(path: &Path) -> io::Result<Self> {
        Ok(Self {
            file: File::create(path)?,
            end: 0,
            reserved: 0,
        })
    }

    /// Makes sure that so many bytes more can be written.
    ///
    /// # Errors
    /// They cannot. What was reserved before still is.
    pub fn reserve(&mut self, bytes: u64) -> io::Result<()> {
        let needed = (self.end + bytes).saturating_sub(self.reserved);
        self.file.seek(SeekFrom::Start(self.reserved))?;
        let filled = io::copy(&mut io::Read::take(io::repeat(0), needed), &mut self.file);
        self.file.seek(SeekFrom::Start(self.end))?;
        self.reserved += filled?;
        Ok(())
    }

    /// Gives back what is reserved.
    ///
    /// # Errors
    /// The file cannot be cut.
    pub fn cut(&mut self) -> io::Result<()> {
        self.file.set_len(self.end)?;
        self.reserved = self.end;
        Ok(())
    }
}

impl Write for ReservedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.end += written as u64;
        self.reserved = self.reserved.max(self.end);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_reserved_is_written_over_and_the_rest_is_given_back() {
        let path = std::env::temp_dir().join(format!("jostle-reserved-{}", std::process::id()));
        let mut file = ReservedFile::create(&path).unwrap();
        file.reserve(10).unwrap();
        file.write_all(b"one").unwrap();
        assert_eq!(std::fs::metadata(&path).unwrap().len(), 10);
        file.reserve(4).unwrap(); // there already
        assert_eq!(std::fs::metadata(&path).unwrap().len(), 10);
        file.reserve(20).unwrap();
        file.write_all(b"two").unwrap();
        assert_eq!(std::fs::metadata(&path).unwrap().len(), 23);
        file.cut().unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"onetwo");
        std::fs::remove_file(path).unwrap();
    }
}
