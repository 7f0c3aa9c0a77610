//! Events of the scene `three_disk` in event mode: none is lost.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::scene::three_disk::ThreeDiskOnInput;
use jostle::scene::{Choice, Scene, Values};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};
use support::{outputs_of, values_of};

const ONE: Choice = Choice { disks: 1 };

fn start(tilt: f64, height: f64) -> (Values, ThreeDiskOnInput) {
    let given = [
        ("tilt", tilt),
        ("disk.drop_height", height),
        ("contact.stiffness_ratio", 30.0),
    ];
    let values = values_of::<ThreeDiskOnInput>(ONE, &given);
    let scene = ThreeDiskOnInput::new(ONE, 0.0, &values).unwrap();
    (values, scene)
}

fn states(scene: &ThreeDiskOnInput, values: &Values) -> [i64; 2] {
    let outputs = outputs_of(scene, values);
    [1, 2].map(|index| outputs.integer(&format!("contact[{index}].state")))
}

/// A torque \[N.m\] that is as likely to hold the disk as to turn it.
fn torque(random: &mut Pcg64) -> f64 {
    0.4 * (random.next_u32() as f64 / f64::from(u32::MAX) - 0.5)
}

/// The torque jumps at every second event and once a millisecond. What the contacts do is then seen to change where a step
/// says so and nowhere else. A disk dropped straight onto supports that are mirror images touches both at one instant, to
/// rounding, so that the second of two events may have no time of its own.
fn contacts_change_at_events_alone(tilt: f64, height: f64) {
    let (mut values, mut scene) = start(tilt, height);
    let mut random = Pcg64::seed_from_u64(3);
    let (mut announced, mut together, mut at_once) = (0, 0, 0);
    let (mut last, mut force) = (0.0_f64, 0.0);
    let mut known = states(&scene, &values);
    for step in 1..=20_000 {
        let end = 1e-4 * f64::from(step);
        loop {
            let reached = scene.advance_to_event(end, &values).unwrap();
            let now = states(&scene, &values);
            if !reached.event {
                assert_eq!(now, known, "changed in the step to {end} s, and none said so");
                break;
            }
            announced += 1;
            // The second contact of an instant: no time passes, so that the mean force is that of the step before.
            let mean = outputs_of(&scene, &values).real("base.reaction_force");
            if reached.time == last.next_up() {
                at_once += 1;
                assert_eq!(mean, force, "at {last} s");
            }
            (last, force) = (reached.time, mean);
            together += u32::from(now[0] != known[0] && now[1] != known[1]);
            known = now;
            if random.next_u32() % 2 == 0 {
                values.set_by_name("torque", torque(&mut random).into()).unwrap();
            }
            if reached.time == end {
                break;
            }
        }
        if step % 10 == 0 {
            values.set_by_name("torque", torque(&mut random).into()).unwrap();
        }
    }
    println!(
        "{announced} events announced, in {together} of them both contacts changed, {at_once} at once with another"
    );
    assert!(announced > 100, "{announced}");
}

#[test]
fn of_a_tilted_disk() {
    contacts_change_at_events_alone(0.2, 0.0);
}

#[test]
fn of_a_disk_that_meets_both_supports_at_once() {
    contacts_change_at_events_alone(0.0, 0.02);
}
