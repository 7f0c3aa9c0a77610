//! The machine on which times were taken.

use std::path::Path;

use anyhow::Result;

use crate::csv_file::write_csv;

/// Writes `machine.csv`: where CPU times come from, with `further` rows of name and value.
///
/// # Errors
/// The file cannot be written.
pub fn write(path: &Path, further: &[(&str, String)]) -> Result<()> {
    let information = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let mut models = information.lines().filter(|line| line.starts_with("model name"));
    let model = models
        .next()
        .and_then(|line| line.split_once(": "))
        .map_or("unknown", |(_, model)| model);
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    let build = if cfg!(debug_assertions) { "debug" } else { "optimised" };
    let target = format!(
        "{}-{}, {build}, any processor of that kind (no target-cpu)",
        std::env::consts::ARCH,
        std::env::consts::OS
    );
    let rows = [
        ["name".into(), "value".into()],
        ["version".into(), env!("CARGO_PKG_VERSION").into()],
        ["processor".into(), model.to_string()],
        ["cores".into(), cores.to_string()],
        ["target".into(), target],
    ];
    let further = further.iter().map(|(name, value)| [(*name).to_string(), value.clone()]);
    write_csv(path, rows.into_iter().chain(further))
}
