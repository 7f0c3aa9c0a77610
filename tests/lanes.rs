//! Velocity Verlet with two, four and eight numbers in a register: the same bits, whatever the processor has.
//!
//! Where it has no AVX2 or AVX-512, the wider runs are narrower ones once more; `dem::lanes` tests registers of eight
//! everywhere. `JOSTLE_LANES=2 cargo test` runs all tests with two.

#![allow(clippy::unwrap_used)]

use jostle::drive::Sine;
use jostle::engine::dem::{lanes, limit_lanes};
use jostle::scene::Simulation;
use jostle::scene::packing::PackingOnSine;

/// Bytes of the state after `end_time` \[s\] of a packing at Gamma 4 and friction `friction`, part of the way taken twice.
fn state_after(disks: u32, friction: f64, end_time: f64) -> Vec<u8> {
    let given = [
        ("box.width", (0.4 * (f64::from(disks) / 60.0).sqrt()).into()),
        ("drive.amplitude", Sine::amplitude_of(4.0, 80.0, 9.8).into()),
        ("contact.friction", friction.into()),
    ];
    let mut packing = Simulation::<PackingOnSine>::new(&[("disks", disks)], &given).unwrap();
    packing.advance_to(0.5 * end_time).unwrap();
    let (saved, before) = (packing.save(), packing.model().unwrap().engine().now().contacts);
    packing.advance_to(0.75 * end_time).unwrap();
    packing.restore(&saved).unwrap();
    packing.advance_to(end_time).unwrap();
    let engine = packing.model().unwrap().engine();
    assert_ne!(engine.now().contacts, before, "contacts change on the way");
    postcard::to_stdvec(engine.state()).unwrap()
}

/// Also with friction and without, for lists whose last registers are full and not.
#[test]
fn the_bits_do_not_depend_on_the_width() {
    for (disks, friction, end_time) in [(60, 0.1, 0.1), (60, 0.0, 0.1), (61, 0.3, 0.05), (3000, 0.1, 0.01)] {
        limit_lanes(2);
        assert_eq!(lanes(), 2);
        let two = state_after(disks, friction, end_time);
        for most in [4, 8] {
            limit_lanes(most);
            println!("{disks} disks, friction {friction}: {} lanes", lanes());
            assert!(
                state_after(disks, friction, end_time) == two,
                "{disks} disks, {} lanes",
                lanes()
            );
        }
    }
}
