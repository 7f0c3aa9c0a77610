//! What the scene computes: calculated parameters and outputs, each with how it is read and what it depends on before the
//! first step, when the disk is at rest on its supports, or lifted off them, and may spin.

use crate::engine::disk_on_two_supports::{ContactPhase, ENERGY_INPUT, ENERGY_LOST, Sense, SlidingPoint};
use crate::scene::disks_on_base::names;
use crate::scene::soft_disks::STEP_OF_ONE_DISK;
use crate::scene::{Row, TIME, Unit};

use super::{DiskOnTwoSupportsDrive, DiskOnTwoSupportsScene};

/// Where the disk would rest.
const REST: &[&str] = &[
    "gravity",
    "tilt",
    "support.angle",
    "support.shape",
    "disk.radius",
    "disk.mass",
    "contact.normal_stiffness",
];

const DROP: &[&str] = &["disk.drop_height"];
const SPIN: &[&str] = &["disk.initial_angular_velocity"];

const CONTACT_STATES: &[(&str, &str)] = &[
    ("open", "No force acts"),
    ("stick", "The tangential spring holds"),
    (
        "slip_counter_clockwise",
        "The contact slips as under a disk that turns counter-clockwise",
    ),
    (
        "slip_clockwise",
        "The contact slips as under a disk that turns clockwise",
    ),
];

const REGIMES: &[(&str, &str)] = &[
    ("none", "Both contacts never slipped the same way at once"),
    ("unidirectional", "They did in one sense only"),
    ("bidirectional", "They did in both senses"),
];

impl<E: DiskOnTwoSupportsDrive> DiskOnTwoSupportsScene<E> {
    /// All rows in their order.
    pub(super) fn computed_rows() -> Vec<Row<Self>> {
        let time_step = Row::calculated(
            "chosen_time_step",
            Unit::SECOND,
            1e-5,
            "Time step of the integration in use",
            |scene: &Self| scene.engine.setup().time_step,
        );
        let mut rows = vec![time_step.depending_on(&names(&[STEP_OF_ONE_DISK, E::PERIOD]))];
        rows.extend(Self::means());
        rows.extend(E::outputs());
        rows.extend(Self::energies());
        rows.extend(Self::friction());
        rows.extend(Self::contact_rows::<0>("left"));
        rows.extend(Self::contact_rows::<1>("right"));
        rows.extend(Self::sums());
        rows.extend(Self::sliding_rows::<{ SlidingPoint::S1 as usize }>(
            "s1",
            "S1: both contacts slip clockwise",
        ));
        rows.extend(Self::sliding_rows::<{ SlidingPoint::S2 as usize }>(
            "s2",
            "S2: both contacts slip counter-clockwise",
        ));
        rows.extend(Self::sliding_rows::<{ SlidingPoint::T1 as usize }>(
            "t1",
            "T1: both slip, the tangential springs pulling the disk up",
        ));
        rows.extend(Self::sliding_rows::<{ SlidingPoint::T2 as usize }>(
            "t2",
            "T2: both slip, the tangential springs pushing the disk down",
        ));
        rows.extend(Self::motion());
        rows
    }

    fn means() -> [Row<Self>; 5] {
        [
            Row::output(
                "mean_velocity",
                Unit::METRE_PER_SECOND,
                0.01,
                "Horizontal velocity of the disk now",
                |scene| scene.now().disk[3],
            ),
            Row::output(
                "mean_angular_velocity",
                Unit::RADIAN_PER_SECOND,
                0.1,
                "Angular velocity of the disk now, counter-clockwise",
                |scene: &Self| scene.now().disk[5],
            )
            .depending_on(&names(&[SPIN])),
            Row::output(
                "time_averaged_angular_velocity",
                Unit::RADIAN_PER_SECOND,
                0.01,
                "Angular velocity, mean over the time since measure.start",
                |scene| {
                    let report = &scene.report;
                    report.turning.mean(report.time, scene.now().angle())
                },
            ),
            Row::output(
                "time_averaged_angular_velocity.standard_error",
                Unit::RADIAN_PER_SECOND,
                0.01,
                "Its standard error by batch means; 0 until there are eight batches",
                |scene| scene.report.turning.standard_error(),
            ),
            Row::output(
                "base.reaction_force",
                Unit::NEWTON,
                1.0,
                "Vertical force of the disk on both supports, up: impulse over the last communication step divided by its length",
                |scene| scene.report.reaction_force,
            ),
        ]
    }

    fn energies() -> [Row<Self>; 6] {
        let energy = |name: &str, description: &str, read: fn(&Self) -> f64| {
            Row::output(name, Unit::JOULE, 1e-3, description, read)
        };
        let of_position = names(&[REST, DROP, E::POSITIONS_AT_START]);
        [
            energy(
                "energy.kinetic",
                "Kinetic energy of translation and rotation",
                Self::kinetic_energy,
            )
            .depending_on(&names(&[SPIN, &["disk.mass", "disk.radius"]])),
            energy(
                "energy.potential",
                "Energy in gravity, zero where the disk just touches both supports at rest",
                Self::potential_energy,
            )
            .depending_on(&of_position),
            energy(
                "energy.elastic",
                "Energy in the normal and tangential springs of the contacts",
                Self::elastic_energy,
            )
            .depending_on(&of_position),
            energy(
                "energy.input",
                "Work of torque and supports on the disk since the start",
                |scene| scene.now().disk[ENERGY_INPUT],
            ),
            energy(
                "energy.lost",
                "Energy lost in dashpots and by slip since the start",
                |scene| scene.now().disk[ENERGY_LOST],
            ),
            energy(
                "energy.residual",
                "What the balance of energies misses: kinetic + potential + elastic + lost - input, less its value at the start",
                |scene| {
                    let disk = &scene.now().disk;
                    scene.energy() + disk[ENERGY_LOST] - disk[ENERGY_INPUT] - scene.start_energy
                },
            ),
        ]
    }

    fn friction() -> [Row<Self>; 3] {
        let angle = |name: &str, description: &str, read: fn(&Self) -> f64| {
            Row::output(name, Unit::RADIAN, 1e-7, description, read)
        };
        let limits = names(&[
            REST,
            DROP,
            E::POSITIONS_AT_START,
            E::VELOCITIES_AT_START,
            &["contact.friction"],
        ]);
        [
            angle(
                "skin.stretch",
                "Stretch Theta of the tangential springs against each other, (tau_2 - tau_1) / (2 k_t R)",
                |scene| {
                    let [left, right] = scene.tangential_forces();
                    (right - left) / scene.force_per_angle()
                },
            ),
            angle(
                "skin.departure",
                "Departure delta_theta of the disk from its equilibrium angle, -(tau_2 + tau_1) / (2 k_t R)",
                |scene| {
                    let [left, right] = scene.tangential_forces();
                    -(left + right) / scene.force_per_angle()
                },
            ),
            Row::output(
                "amonton_margin",
                Unit::NEWTON,
                0.1,
                "Distance to the nearest limit of friction: the smaller mu n - |tau| of both contacts",
                |scene: &Self| {
                    let friction = scene.engine.setup().tangential.friction;
                    let margin = scene
                        .contacts
                        .map(|contact| (friction * contact.normal - contact.tangential.abs()).max(0.0));
                    margin[0].min(margin[1])
                },
            )
            .depending_on(&limits),
        ]
    }

    /// Contact `INDEX`, which is the `which` one.
    fn contact_rows<const INDEX: usize>(which: &str) -> [Row<Self>; 6] {
        let name = |member: &str| format!("contact[{}].{member}", INDEX + 1);
        let row = |member: &str, unit: Unit, nominal: f64, what: &str, read: fn(&Self) -> f64| {
            Row::output(name(member), unit, nominal, format!("{what} the {which} contact"), read)
        };
        let of_position = names(&[REST, DROP, E::POSITIONS_AT_START]);
        // A dashpot may pull a contact open.
        let of_force = names(&[REST, DROP, E::POSITIONS_AT_START, E::VELOCITIES_AT_START]);
        [
            row("normal_force", Unit::NEWTON, 1.0, "Normal force n at", |scene| {
                scene.contacts[INDEX].normal
            })
            .depending_on(&of_force),
            row(
                "tangential_force",
                Unit::NEWTON,
                0.1,
                "Tangential force tau on the disk, positive where it turns it counter-clockwise, at",
                |scene| scene.contacts[INDEX].tangential,
            ),
            row(
                "overlap",
                Unit::METRE,
                1e-3,
                "Overlap delta, negative while apart, at",
                |scene| scene.contacts[INDEX].overlap,
            )
            .depending_on(&of_position),
            Row::enumeration_output(
                name("state"),
                "contact_state",
                CONTACT_STATES,
                format!("What the {which} contact does"),
                |scene: &Self| contact_state(scene.now().contacts[INDEX].phase),
            )
            .depending_on(&of_force),
            row(
                "slip_time",
                Unit::SECOND,
                1.0,
                "Time since measure.start of slip at",
                |scene| scene.record().slipping[INDEX],
            ),
            row(
                "open_time",
                Unit::SECOND,
                1.0,
                "Time since measure.start without force at",
                |scene| scene.record().open[INDEX],
            ),
        ]
    }

    fn sums() -> [Row<Self>; 4] {
        [
            Row::enumeration_output(
                "sliding_regime",
                "sliding_regime",
                REGIMES,
                "Senses in which the disk slid on both contacts since measure.start",
                |scene| {
                    let sliding = scene.record().sliding;
                    let slid = |point: SlidingPoint| i64::from(sliding[point as usize] > 0.0);
                    1 + slid(SlidingPoint::S1) + slid(SlidingPoint::S2)
                },
            ),
            Row::count_output(
                "slips",
                "Times that a contact began to slip since measure.start",
                |scene| count(scene.record().slips),
            ),
            Row::count_output(
                "detachments",
                "Times that a contact opened since the start of the run",
                |scene| count(scene.record().detachments),
            ),
            Row::output(
                "detachment.time",
                Unit::SECOND,
                1.0,
                "When a contact opened for the first time; while none has, one second before the start and before zero, which is -1 \
                 for runs that start at 0 or later",
                |scene: &Self| {
                    let never = scene.start_time.min(0.0) - 1.0;
                    scene.record().first_detachment.unwrap_or(never)
                },
            )
            .depending_on(&names(&[&[TIME]])),
        ]
    }

    /// Sliding point `POINT`, counted as in [`SlidingPoint`], whose description is `what`.
    fn sliding_rows<const POINT: usize>(point: &str, what: &str) -> [Row<Self>; 2] {
        [
            Row::output(
                format!("sliding.{point}.time"),
                Unit::SECOND,
                1.0,
                format!("Time since measure.start at {what}"),
                |scene| scene.record().sliding[POINT],
            ),
            Row::count_output(
                format!("sliding.{point}.count"),
                format!("Times since measure.start that the contacts came to {what}"),
                |scene| count(scene.record().slides[POINT]),
            ),
        ]
    }

    fn motion() -> [Row<Self>; 4] {
        let in_terminal = |row: Row<Self>, member| match E::TERMINAL {
            Some(terminal) => row.in_terminal(terminal, member),
            None => row,
        };
        let angle = Row::output(
            "disk.angle[1]",
            Unit::RADIAN,
            1.0,
            "Angle turned, counter-clockwise and unwrapped",
            |scene: &Self| scene.now().angle(),
        );
        let angular_velocity = Row::output(
            "disk.angular_velocity[1]",
            Unit::RADIAN_PER_SECOND,
            0.1,
            "Angular velocity, counter-clockwise",
            |scene: &Self| scene.now().disk[5],
        );
        [
            in_terminal(angle.with_derivative("disk.angular_velocity[1]"), "angle"),
            in_terminal(angular_velocity.depending_on(&names(&[SPIN])), "angular_velocity"),
            Row::output(
                "disk.x[1]",
                Unit::METRE,
                1e-3,
                "Displacement to the right from where the disk just touches both supports at rest",
                |scene: &Self| scene.now().disk[0],
            )
            .depending_on(&names(&[REST, E::POSITIONS_AT_START])),
            Row::output(
                "disk.y[1]",
                Unit::METRE,
                1e-3,
                "Displacement up from where the disk just touches both supports at rest",
                |scene: &Self| scene.now().disk[1],
            )
            .depending_on(&names(&[REST, DROP, E::POSITIONS_AT_START])),
        ]
    }
}

/// Number of a contact's phase in the enumeration `contact_state`.
fn contact_state(phase: ContactPhase) -> i64 {
    match phase {
        ContactPhase::Apart | ContactPhase::Relaxing => 1,
        ContactPhase::Stick => 2,
        ContactPhase::Slip(Sense::CounterClockwise) => 3,
        ContactPhase::Slip(Sense::Clockwise) => 4,
    }
}

fn count(count: u64) -> i64 {
    count.min(i32::MAX as u64) as i64
}
