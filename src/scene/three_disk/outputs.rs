//! What the scene shows: the engine's state in the rows of the variable table.

use crate::engine::Engine;
use crate::engine::disk_on_two_supports::{
    DiskOnTwoSupports, ENERGY_INPUT, ENERGY_LOST, Node, Observables, Phase, Record, Sense, Setup, SlidingPoint,
};
use crate::scene::OutputWriter;

use super::{Report, ThreeDiskDrive, rows};

/// Energies \[J\].
pub struct Energies {
    /// Translation and rotation.
    pub kinetic: f64,
    /// In gravity, zero where the disk just touches both supports at rest.
    pub potential: f64,
    /// In the springs of the contacts, normal and tangential.
    pub elastic: f64,
}

/// Energies now; `seen` is [`DiskOnTwoSupports::observe`].
pub fn energies<E: ThreeDiskDrive>(engine: &DiskOnTwoSupports<E>, seen: &Observables) -> Energies {
    let (setup, disk) = (engine.setup(), &engine.state().now.disk);
    let [_, y, _, vx, vy, spin, ..] = *disk;
    let stored = seen.contacts.map(|contact| {
        let spring = if contact.overlap > 0.0 {
            setup.normal.energy(contact.overlap)
        } else {
            0.0
        };
        spring + setup.tangential.energy(contact.stretch)
    });
    Energies {
        kinetic: 0.5 * (setup.mass * (vx * vx + vy * vy) + setup.inertia() * spin * spin),
        potential: setup.mass * setup.gravity * y,
        elastic: stored[0] + stored[1],
    }
}

/// Number of a contact's phase in the enumeration `contact_state`.
fn contact_state(phase: Phase) -> i64 {
    match phase {
        Phase::Apart | Phase::Relaxing => 1,
        Phase::Stick => 2,
        Phase::Slip(Sense::CounterClockwise) => 3,
        Phase::Slip(Sense::Clockwise) => 4,
    }
}

fn counted(count: u64) -> i64 {
    count.min(i32::MAX as u64) as i64
}

/// Writes every calculated parameter and output.
pub fn write<E: ThreeDiskDrive>(
    engine: &DiskOnTwoSupports<E>,
    report: &Report,
    start_energy: f64,
    mut outputs: OutputWriter<'_>,
) {
    let (seen, now) = (engine.observe(), &engine.state().now);
    let Report { time, turning, .. } = report;
    let Node { disk, .. } = now;
    let record = now.record.since(report.before.as_ref().unwrap_or(&now.record));
    outputs.real("chosen_time_step", engine.setup().time_step);
    outputs.real("mean_velocity", disk[3]);
    outputs.real("mean_angular_velocity", disk[5]);
    outputs.real("time_averaged_angular_velocity", turning.mean(*time, now.angle()));
    outputs.real(
        "time_averaged_angular_velocity.standard_error",
        turning.standard_error(),
    );
    outputs.real("base.reaction_force", report.reaction_force);
    let (torque, supports) = engine.driven();
    E::write(&mut outputs, torque, &supports);
    let Energies {
        kinetic,
        potential,
        elastic,
    } = energies(engine, &seen);
    let (input, lost) = (disk[ENERGY_INPUT], disk[ENERGY_LOST]);
    outputs.real("energy.kinetic", kinetic);
    outputs.real("energy.potential", potential);
    outputs.real("energy.elastic", elastic);
    outputs.real("energy.input", input);
    outputs.real("energy.lost", lost);
    outputs.real(
        "energy.residual",
        kinetic + potential + elastic + lost - input - start_energy,
    );
    write_skins(&mut outputs, engine.setup(), &seen);
    write_contacts(&mut outputs, now, &seen, &record);
    write_slides(&mut outputs, &record);
    outputs.real("disk.angle[1]", now.angle());
    outputs.real("disk.angular_velocity[1]", disk[5]);
    outputs.real("disk.x[1]", disk[0]);
    outputs.real("disk.y[1]", disk[1]);
    outputs.finish();
}

fn write_skins(outputs: &mut OutputWriter<'_>, setup: &Setup, seen: &Observables) {
    let [left, right] = seen.contacts.map(|contact| contact.tangential);
    let per_angle = 2.0 * setup.tangential.stiffness * setup.radius;
    outputs.real("skin.stretch", (right - left) / per_angle);
    outputs.real("skin.departure", -(left + right) / per_angle);
    let margin = seen
        .contacts
        .map(|contact| (setup.tangential.friction * contact.normal - contact.tangential.abs()).max(0.0));
    outputs.real("amonton_margin", margin[0].min(margin[1]));
}

fn write_contacts(outputs: &mut OutputWriter<'_>, now: &Node, seen: &Observables, since: &Record) {
    for index in 0..2 {
        let (force, number) = (&seen.contacts[index], index + 1);
        let name = |name: &str| format!("contact[{number}].{name}");
        outputs.real(&name("normal_force"), force.normal);
        outputs.real(&name("tangential_force"), force.tangential);
        outputs.real(&name("overlap"), force.overlap);
        outputs.integer(&name("state"), contact_state(now.contacts[index].phase));
        outputs.real(&name("slip_time"), since.slipping[index]);
        outputs.real(&name("open_time"), since.open[index]);
    }
}

fn write_slides(outputs: &mut OutputWriter<'_>, record: &Record) {
    let slid = |point: SlidingPoint| record.sliding[point as usize] > 0.0;
    let regime = 1 + i64::from(slid(SlidingPoint::S1)) + i64::from(slid(SlidingPoint::S2));
    outputs.integer("sliding_regime", regime);
    outputs.integer("slips", counted(record.slips));
    outputs.integer("detachments", counted(record.detachments));
    outputs.real("detachment.time", record.first_detachment.unwrap_or(-1.0));
    for (index, (point, _)) in rows::POINTS.iter().enumerate() {
        outputs.real(&format!("sliding.{point}.time"), record.sliding[index]);
        outputs.integer(&format!("sliding.{point}.count"), counted(record.slides[index]));
    }
}
