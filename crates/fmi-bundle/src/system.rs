//! Several components and their connections in, an SSP 1.0 archive out: a system that simulation tools open as it is.
//!
//! ```text
//! SystemStructure.ssd          elements, connectors with units, connections, geometry of the diagram, default experiment
//! resources/<identifier>.fmu   each FMU once, however many elements it has
//! resources/<element>.ssv      parameter set of an element, where it has any
//! ```
//! Needs: connections that fit. Guarantees: an output goes to inputs of the same unit, an input has one source, parameters exist and are in
//! range: everything else is refused. Source: System Structure and Parameterization 1.0, Modelica Association, 2019.

mod description;
mod parameters;
mod structure;

use std::path::Path;

use fmi_component::{Result, Version};

pub use structure::{Connection, Element, HEIGHT, System, WIDTH};

use crate::archive::{self, Member};
use crate::bundle::{checked, write_file};

impl System<'_> {
    /// Writes the system with FMUs of `version` to `out`; each library for this system is run along its reference trajectory.
    ///
    /// # Errors
    /// What does not fit together; what [`write()`](crate::write()) refuses of an FMU; the file cannot be written, and is then as before.
    pub fn write(&self, version: Version, out: &Path) -> Result<()> {
        self.check()?;
        let mut members = vec![Member {
            path: "SystemStructure.ssd".into(),
            bytes: description::write(self)?.into_bytes(),
        }];
        for element in &self.elements {
            let path = element.source();
            if !members.iter().any(|member| member.path == path) {
                let bytes = checked(element.component, version, element.libraries)?;
                members.push(Member { path, bytes });
            }
            if !element.parameters.is_empty() {
                members.push(Member {
                    path: element.parameter_source(),
                    bytes: parameters::write(self.name, element)?.into_bytes(),
                });
            }
        }
        write_file(out, &archive::write(&members)?)
    }
}
