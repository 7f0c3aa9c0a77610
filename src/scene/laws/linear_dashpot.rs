//! The linear spring and dashpot of P 4.2 from the parameters `contact.normal_stiffness` and `contact.normal_damping`, which all
//! scenes of soft disks have.

use crate::contact::LinearDashpot;
use crate::scene::soft_disks::SceneNormalForce;
use crate::scene::{Row, Values};

impl SceneNormalForce for LinearDashpot {
    const ENGINE: &'static str = "molecular-dynamics";
    const PACKING: &'static str = "jostle_packing";
    const PARAMETERS: &'static [&'static str] = &[];

    fn rows<M>() -> Vec<Row<M>> {
        Vec::new()
    }

    fn from_values(values: &Values) -> Self {
        Self {
            stiffness: values.real("contact.normal_stiffness"),
            damping: values.real("contact.normal_damping"),
        }
    }
}
