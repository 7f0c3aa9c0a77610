//! What the ratchet computes: calculated parameters and outputs, each with how it is read and what it depends on before the
//! first step, when the disks are in loose rows above the teeth, at rest.

use crate::drive::BoundedDrive;
use crate::engine::event_driven::{Moving, ToothImpacts};
use crate::geometry::ToothPart;
use crate::scene::base_drive::{BaseDrive, TERMINAL};
use crate::scene::disks_on_base::{
    BaseRows, DisksOnBase, heights, horizontal_positions, mean_angular_velocity, mean_velocity, names, radii,
    rotations, velocities,
};
use crate::scene::hard_disks::{EnergyRows, HardBase, HardDisksOnBase};
use crate::scene::{Row, Unit};

use super::{Averages, Ratchet};

/// The highest point of the base at rest, and the pitch of the rows of disks.
const ROWS_OF_DISKS: &[&str] = &[
    "tooth.width",
    "tooth.height",
    "tooth.asymmetry",
    "tooth.tip_radius",
    "tooth.count",
    "disk.radius_max",
];

/// What the weights of the disks depend on.
const WEIGHTS: &[&str] = &["gravity", "seed", "disk.radius_min", "disk.mass", "disk.mass_rule"];

impl<D> Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: HardBase<Drive = D>,
{
    /// All calculated parameters and outputs for this many disks.
    pub(super) fn computed_rows(disks: u32) -> Vec<Row<Self>> {
        let mut rows = Self::calculated(disks);
        rows.extend(Self::velocities());
        rows.extend(Self::base());
        rows.extend(Self::energy_rows());
        rows.extend(Self::collisions());
        rows.extend(Self::impacts_by_part_of_tooth());
        rows.extend(Self::motion_of_each(disks));
        rows
    }

    fn calculated(disks: u32) -> Vec<Row<Self>> {
        let drawn = names(&[&["seed", "disk.radius_min", "disk.radius_max"]]);
        let layers = Row::calculated(
            "layers",
            Unit::ONE,
            1.0,
            "Layer count n: disks over those of the smallest radius that lie side by side across the cell",
            |ratchet: &Self| ratchet.layers,
        )
        .depending_on(&names(&[&["disk.radius_min", "tooth.count", "tooth.width"]]));
        let radii = radii(disks, 1e-3, &drawn, Self::radius);
        [layers].into_iter().chain(radii).collect()
    }

    fn velocities() -> [Row<Self>; 5] {
        let transport = |name: &str, nominal: f64, description: &str, read: fn(&Self) -> f64| {
            Row::output(name, Unit::METRE_PER_SECOND, nominal, description, read)
        };
        [
            mean_velocity(0.1, "Mean horizontal velocity of the disks now"),
            transport(
                "transport_velocity",
                0.1,
                "Mean horizontal velocity of the disks since measure.start or the last change of measure.mark: their \
                 displacement over the time; 0 before",
                |ratchet| {
                    let (time, positions) = ratchet.horizontal_positions();
                    ratchet.averages.transport.velocity(time, positions)
                },
            ),
            transport(
                "transport_velocity.standard_error",
                1e-2,
                "Standard error of transport_velocity from batch means; 0 in the first 0.8 s",
                |ratchet| ratchet.averages.transport.standard_error(ratchet.report.time),
            ),
            transport(
                "transport_velocity.spread",
                1e-2,
                "Standard deviation over the disks of each one's own mean velocity over the same time",
                |ratchet| {
                    let (time, positions) = ratchet.horizontal_positions();
                    ratchet.averages.transport.spread(time, positions)
                },
            ),
            mean_angular_velocity(10.0, "Mean angular velocity of the disks now, counter-clockwise"),
        ]
    }

    fn base() -> impl Iterator<Item = Row<Self>> {
        let shared = BaseRows {
            force: 1e-3,
            bodies: "disks on the base",
            note: "",
            position_at_start: &names(&[D::DISPLACEMENT_AT_START]),
            velocity_at_start: &names(&[D::VELOCITY_AT_START]),
            acceleration_at_start: &names(&[D::ACCELERATION_AT_START]),
        };
        let mean_power = Row::output(
            "base.mean_power",
            Unit::WATT,
            1e-4,
            "Work of the base on the disks over the time that transport_velocity is averaged over, divided by it",
            |ratchet: &Self| {
                let work = ratchet.counts().energy_input;
                ratchet.averages.transport.mean_power(ratchet.report.time, work)
            },
        )
        .in_terminal(TERMINAL, "mean_power");
        shared.rows().into_iter().chain([mean_power])
    }

    fn energy_rows() -> [Row<Self>; 5] {
        EnergyRows {
            nominal: 1e-6,
            potential: "Energy in gravity, zero at the height of the valleys at rest",
            lost: "Energy lost in impacts since the start",
            residual: "Change of energy less work of the base plus losses: rounding. What a change of gravity adds to the potential energy \
                       does not count",
            kinetic_at_start: &names(&[]),
            potential_at_start: &names(&[ROWS_OF_DISKS, D::DISPLACEMENT_AT_START, WEIGHTS]),
        }
        .rows()
    }

    fn collisions() -> [Row<Self>; 4] {
        let count = |name: &str, description: &str, read: fn(&Self) -> f64| {
            Row::output(name, Unit::ONE, 1e4, description, read)
        };
        [
            count(
                "collisions",
                "Impacts so far, of disks, on the base and on the ceiling",
                |ratchet| {
                    let counts = ratchet.counts();
                    (counts.disk_impacts + counts.wall_impacts) as f64
                },
            ),
            count("collisions.disks", "Impacts of two disks so far", |ratchet| {
                ratchet.counts().disk_impacts as f64
            }),
            count("collisions.base", "Impacts on the base so far", |ratchet| {
                (ratchet.counts().wall_impacts - ratchet.ceiling_hits()) as f64
            }),
            count("collisions.ceiling", "Impacts on the ceiling so far", |ratchet| {
                ratchet.ceiling_hits() as f64
            }),
        ]
    }

    /// F Figs 13, 14: which sides the disks meet, and what these give them.
    fn impacts_by_part_of_tooth() -> impl Iterator<Item = Row<Self>> {
        type Read<M> = fn(&M) -> f64;
        const LEFT: usize = ToothPart::LeftSide as usize;
        const RIGHT: usize = ToothPart::RightSide as usize;
        const TIP: usize = ToothPart::Tip as usize;
        let left = "left sides of teeth, of horizontal extent asymmetry times width,";
        let parts: [(&str, &str, Read<Self>, Read<Self>); 3] = [
            ("left_side", left, Self::impacts_on::<LEFT>, Self::impulse_of::<LEFT>),
            (
                "right_side",
                "right sides of teeth",
                Self::impacts_on::<RIGHT>,
                Self::impulse_of::<RIGHT>,
            ),
            (
                "tip",
                "rounded tips of teeth",
                Self::impacts_on::<TIP>,
                Self::impulse_of::<TIP>,
            ),
        ];
        let since = "since measure.start or the last change of measure.mark; 0 before";
        let counts = parts.map(|(name, what, read, _)| {
            let description = format!("Impacts of disks on {what} {since}");
            Row::output(format!("tooth.{name}_impacts"), Unit::ONE, 1e4, description, read)
        });
        let impulses = parts.map(|(name, what, _, read)| {
            let description = format!("Horizontal impulse, to the right, that {what} gave to the disks {since}");
            Row::output(
                format!("tooth.{name}_impulse"),
                Unit::NEWTON_SECOND,
                1e-4,
                description,
                read,
            )
        });
        counts.into_iter().chain(impulses)
    }

    fn motion_of_each(disks: u32) -> impl Iterator<Item = Row<Self>> {
        let across = names(&[&["seed", "disk.radius_max", "tooth.count", "tooth.width"]]);
        let up = names(&[ROWS_OF_DISKS, D::DISPLACEMENT_AT_START]);
        let x = horizontal_positions(disks, 0.1, "Place of the centre to the right, unwrapped, of disk {}");
        let y = heights(
            disks,
            0.01,
            "Height of the centre above the valleys of the base at rest of disk {}",
        );
        let angle = "Angle turned, counter-clockwise and unwrapped, of disk {}";
        rotations(disks, angle, 10.0, "Angular velocity, counter-clockwise, of disk {}")
            .chain(x.map(move |row| row.depending_on(&across)))
            .chain(y.map(move |row| row.depending_on(&up)))
            .chain(velocities(disks, 0.1, &[], &[]))
    }

    /// Time \[s\] reached, and the horizontal positions \[m\] of all disks then, periods undone.
    fn horizontal_positions(&self) -> (f64, impl ExactSizeIterator<Item = f64> + Clone) {
        let positions = (0..self.disk_count()).map(|disk| self.disk(disk).position.x);
        (self.report.time, positions)
    }

    fn impacts_on<const PART: usize>(&self) -> f64 {
        self.since_mark(|teeth| teeth[PART].count as f64)
    }

    fn impulse_of<const PART: usize>(&self) -> f64 {
        self.since_mark(|teeth| teeth[PART].impulse)
    }

    /// What a sum over impacts on the teeth has grown by since the averages began.
    fn since_mark(&self, sum: impl Fn(&ToothImpacts) -> f64) -> f64 {
        let Averages { transport, teeth, .. } = &self.averages;
        if transport.has_begun() {
            sum(self.engine.state().boundary.tooth_impacts()) - sum(teeth)
        } else {
            0.0
        }
    }

    fn ceiling_hits(&self) -> u64 {
        self.engine.state().boundary.ceiling_hits()
    }
}
