//! Progress bars of long commands.

use indicatif::{ProgressBar, ProgressStyle};

/// Bar of so many rows or other pieces, if it is `wanted`; shown on a terminal only.
pub fn bar(pieces: u64, wanted: bool) -> ProgressBar {
    if !wanted {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(pieces);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {elapsed} gone, {eta} to go") {
        bar.set_style(style);
    }
    bar
}
