//! Rows of text as a CSV file.

use std::path::Path;

use anyhow::{Context, Result};

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
