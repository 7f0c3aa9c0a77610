//! Lists of a simulation: see [`Model::listings`].

use crate::error::{Error, Result};
use crate::listing::{Listed, Listing};
use crate::model::Model;

use super::Simulation;
use super::refusal::named;

impl<M: Model> Simulation<M> {
    /// The list called `name` as of now. Reading changes nothing.
    ///
    /// # Errors
    /// The model has no such list, or has not started.
    pub fn list(&self, name: &str) -> Result<Listed> {
        let listings = M::listings();
        let Some(Listing { info, read }) = listings.iter().find(|listing| listing.info.name == name) else {
            let known: Vec<_> = listings.iter().map(|listing| listing.info.name).collect();
            let remedy = match known.as_slice() {
                [] => "Take another variant of the model that has it, if there is one.".into(),
                known => format!("It has {}.", known.join(", ")),
            };
            return Err(Error::call(
                format!("the model {} has no list {name}", named(&M::info())),
                remedy,
            ));
        };
        let mut numbers = Vec::new();
        read(self.model()?, &mut numbers);
        Ok(Listed { info: *info, numbers })
    }
}
