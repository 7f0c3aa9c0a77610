//! Fields of the flow over a sine: a resolution in, the observer that accumulates them out.

use crate::drive::Sine;
use crate::engine::event_driven::Space;
use crate::measure::{FlowFields, Grid};
use crate::scene::Result;

use super::RatchetOnSine;

/// Resolution of the fields in space and phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolution {
    /// Square boxes across a tooth.
    pub boxes: u32,
    /// Windows of a period of the base.
    pub phases: u32,
    /// Boxes across the whole cell instead of one tooth into which all are folded.
    pub whole_cell: bool,
}

impl Default for Resolution {
    /// F Figs 13, 14: six and six. All teeth are alike, so that one holds what ten do with a third of the scatter.
    fn default() -> Self {
        Self {
            boxes: 6,
            phases: 6,
            whole_cell: false,
        }
    }
}

impl RatchetOnSine {
    /// An observer for [`super::Ratchet::advance_observed`] from now on.
    ///
    /// # Errors
    /// A base at rest, more boxes than memory should hold.
    pub fn flow_fields(&self, resolution: Resolution) -> Result<FlowFields> {
        let state = self.engine.state();
        let (profile, drive): (_, Sine) = (state.boundary.profile(), state.boundary.base().drive);
        let teeth = if resolution.whole_cell {
            (self.engine.space().region().size.x / profile.width()).round() as u32
        } else {
            1
        };
        let grid = Grid {
            side: profile.width() / f64::from(resolution.boxes),
            columns: resolution.boxes.saturating_mul(teeth),
            phases: resolution.phases,
            ceiling: state.boundary.ceiling(),
        };
        let (masses, start) = (self.masses.clone(), self.report.time);
        let fields = FlowFields::new(grid, masses, self.gravity, drive, start, state.epoch)?;
        Ok(fields)
    }

    /// Shows the flights that still go on: once, when nothing more is to be observed. Returns the present time \[s\].
    pub fn show_last_flights(&self, fields: &mut FlowFields) -> f64 {
        self.engine.show_flights(self.report.time, fields);
        self.report.time
    }
}
