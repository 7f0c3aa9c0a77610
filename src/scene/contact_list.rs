//! The list `contacts`: the closed contacts of engines with contacts that last.

use fmi_component::{Column, ListInfo, Listing};

use crate::engine::{ContactNow, Touched};

use super::Unit;

const COLUMNS: &[Column] = &[
    column("first", Unit::ONE, "Number of the disk, from 1"),
    column(
        "second",
        Unit::ONE,
        "Number of the other disk, from 1; 0: a wall or support",
    ),
    column("wall", Unit::ONE, "Number of the wall or support, from 1; 0: a disk"),
    column("x", Unit::METRE, "Middle of the overlap, to the right"),
    column("y", Unit::METRE, "Middle of the overlap, up"),
    column(
        "normal_x",
        Unit::ONE,
        "Unit normal towards the first disk, to the right",
    ),
    column("normal_y", Unit::ONE, "Unit normal towards the first disk, up"),
    column("normal_force", Unit::NEWTON, "Force along the normal, which pushes"),
    column(
        "tangential_force",
        Unit::NEWTON,
        "Force on the first disk along the normal turned clockwise by a right angle",
    ),
];

const fn column(name: &'static str, unit: Unit, description: &'static str) -> Column {
    Column {
        name,
        unit,
        description,
    }
}

/// The list, read from a model by `read`.
pub fn listing<M>(read: fn(&M, &mut Vec<f64>)) -> Listing<M> {
    let info = ListInfo {
        name: "contacts",
        description: "Closed contacts",
        columns: COLUMNS,
    };
    Listing { info, read }
}

/// Appends the rows of these contacts.
pub fn append(contacts: impl IntoIterator<Item = ContactNow>, numbers: &mut Vec<f64>) {
    for contact in contacts {
        let (second, wall) = match contact.other {
            Touched::Disk(disk) => (disk + 1, 0),
            Touched::Wall(wall) => (0, wall + 1),
        };
        numbers.extend([contact.first + 1, second, wall].map(f64::from));
        numbers.extend(contact.point.iter().chain(&contact.normal));
        numbers.extend([contact.normal_force, contact.tangential_force]);
    }
}
