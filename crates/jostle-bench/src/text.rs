//! Numbers as text, and rows of text as a CSV file.

use std::path::Path;

use anyhow::{Context, Result};

/// Shortest text that reads back as the same bits; powers of ten where zeros would fill the line.
pub fn number(value: f64) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-4..1e6).contains(&value.abs());
    if plain {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Writes a CSV file.
///
/// # Errors
/// The file cannot be written.
pub fn write_csv<const N: usize>(path: &Path, rows: impl IntoIterator<Item = [String; N]>) -> Result<()> {
    let cannot = || {
        format!(
            "{} cannot be written: check the folder, its permissions and the free space",
            path.display()
        )
    };
    let mut writer = csv::Writer::from_path(path).with_context(cannot)?;
    for row in rows {
        writer.write_record(&row).with_context(cannot)?;
    }
    writer.flush().with_context(cannot)
}
