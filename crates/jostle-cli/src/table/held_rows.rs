//! Rows that wait to be written column by column: in memory if they are few numbers, else in a temporary file.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

/// Bytes of a number.
const NUMBER: usize = 8;

/// Rows of numbers, each as its 64 bits.
pub struct HeldRows {
    columns: usize,
    rows: usize,
    place: Place,
}

enum Place {
    Memory(Vec<u64>),
    /// It has no name, and is gone when the program ends, however it ends.
    File(File),
}

impl HeldRows {
    /// No rows, to be held in memory.
    pub fn in_memory(columns: usize) -> Self {
        Self {
            columns,
            rows: 0,
            place: Place::Memory(Vec::new()),
        }
    }

    /// No rows, to be held in a temporary file of this folder.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn in_file(columns: usize, folder: &Path) -> io::Result<Self> {
        Ok(Self {
            columns,
            rows: 0,
            place: Place::File(tempfile::tempfile_in(folder)?),
        })
    }

    /// How many there are.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Adds a row.
    ///
    /// # Errors
    /// It cannot be written; the rows before it are still there.
    pub fn push(&mut self, row: impl Iterator<Item = u64>) -> io::Result<()> {
        match &mut self.place {
            Place::Memory(numbers) => numbers.extend(row),
            Place::File(file) => {
                let bytes: Vec<u8> = row.flat_map(u64::to_le_bytes).collect();
                file.seek(SeekFrom::Start((self.rows * self.columns * NUMBER) as u64))?;
                file.write_all(&bytes)?;
            }
        }
        self.rows += 1;
        Ok(())
    }

    /// All rows of these columns, row after row.
    ///
    /// # Errors
    /// They cannot be read.
    pub fn block(&mut self, columns: &Range<usize>) -> io::Result<Vec<u64>> {
        let mut block = Vec::with_capacity(self.rows * columns.len());
        let mut bytes = vec![0; columns.len() * NUMBER];
        for row in 0..self.rows {
            let first = row * self.columns + columns.start;
            match &mut self.place {
                Place::Memory(numbers) => block.extend(&numbers[first..first + columns.len()]),
                Place::File(file) => {
                    file.seek(SeekFrom::Start((first * NUMBER) as u64))?;
                    file.read_exact(&mut bytes)?;
                    let (numbers, _) = bytes.as_chunks::<NUMBER>();
                    block.extend(numbers.iter().map(|number| u64::from_le_bytes(*number)));
                }
            }
        }
        Ok(block)
    }

    /// Leaves no row.
    pub fn clear(&mut self) {
        self.rows = 0;
        if let Place::Memory(numbers) = &mut self.place {
            numbers.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_columns_are_the_same_from_memory_and_from_a_file() {
        for mut held in [
            HeldRows::in_memory(5),
            HeldRows::in_file(5, &std::env::temp_dir()).unwrap(),
        ] {
            for turn in 0..2 {
                for row in 0..3 {
                    held.push((0..5).map(|column| 100 * turn + 10 * row + column)).unwrap();
                }
                let plus = |number: u64| 100 * turn + number;
                assert_eq!(held.rows(), 3);
                assert_eq!(held.block(&(1..3)).unwrap(), [1, 2, 11, 12, 21, 22].map(plus));
                assert_eq!(held.block(&(4..5)).unwrap(), [4, 14, 24].map(plus));
                held.clear();
            }
        }
    }
}
