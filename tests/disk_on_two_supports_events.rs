//! Events of the scene `three_disk` in event mode: none is lost.

#![allow(clippy::unwrap_used)]

use jostle::scene::Simulation;
use jostle::scene::disk_on_two_supports::DiskOnTwoSupportsOnInput;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn start(tilt: f64, height: f64) -> Simulation<DiskOnTwoSupportsOnInput> {
    let given = [
        ("tilt", tilt.into()),
        ("disk.drop_height", height.into()),
        ("contact.stiffness_ratio", 30.0.into()),
    ];
    Simulation::new(&[], &given).unwrap()
}

fn states(disk: &Simulation<DiskOnTwoSupportsOnInput>) -> [i64; 2] {
    [1, 2].map(|index| disk.integer(&format!("contact[{index}].state")).unwrap())
}

/// A torque \[N.m\] that is as likely to hold the disk as to turn it.
fn torque(random: &mut Pcg64) -> f64 {
    0.4 * (random.next_u32() as f64 / f64::from(u32::MAX) - 0.5)
}

/// The torque jumps at every second event and once a millisecond. The states of the contacts then change where a step
/// reports an event and nowhere else. A disk dropped straight onto supports that are mirror images touches both at one instant, to
/// rounding, so that the second of two events may have no time of its own.
fn contacts_change_at_events_alone(tilt: f64, height: f64) {
    let mut disk = start(tilt, height);
    let mut random = Pcg64::seed_from_u64(3);
    let (mut announced, mut together, mut at_once) = (0, 0, 0);
    let (mut last, mut force) = (0.0_f64, 0.0);
    let mut known = states(&disk);
    for step in 1..=20_000 {
        let end = 1e-4 * f64::from(step);
        loop {
            let reached = disk.advance_to_event(end).unwrap();
            let now = states(&disk);
            if !reached.event {
                assert_eq!(now, known, "changed in the step to {end} s without an event");
                break;
            }
            announced += 1;
            // The second contact of an instant: no time passes, so that the mean force is that of the step before.
            let mean = disk.real("base.reaction_force").unwrap();
            if reached.time == last.next_up() {
                at_once += 1;
                assert_eq!(mean, force, "at {last} s");
            }
            (last, force) = (reached.time, mean);
            together += u32::from(now[0] != known[0] && now[1] != known[1]);
            known = now;
            if random.next_u32() % 2 == 0 {
                disk.set("torque", torque(&mut random)).unwrap();
            }
            if reached.time == end {
                break;
            }
        }
        if step % 10 == 0 {
            disk.set("torque", torque(&mut random)).unwrap();
        }
    }
    println!(
        "{announced} events announced, in {together} of them both contacts changed, {at_once} at once with another"
    );
    assert!(announced > 100, "{announced}");
}

#[test]
fn contacts_of_a_tilted_disk_change_at_events_alone() {
    contacts_change_at_events_alone(0.2, 0.0);
}

#[test]
fn contacts_of_a_disk_that_meets_both_supports_at_once_change_at_events_alone() {
    contacts_change_at_events_alone(0.0, 0.02);
}
