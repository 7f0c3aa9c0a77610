//! No disk is ever inside the base, whatever its tips and however long the run.

use super::transport::POSITIVE;
use super::*;

/// Deepest penetration into the base and deepest overlap of two disks [m], now and, for the base, at the last event of each
/// disk.
fn depths(ratchet: &RatchetOnSine, profile: &Profile, time: f64, count: usize, width: f64) -> [f64; 2] {
    let state = ratchet.engine().state();
    let base_at = |local: f64| state.boundary.local_motion(local).displacement;
    let base = base_at(time - state.epoch);
    let positions: Vec<[f64; 2]> = (0..count)
        .map(|disk| ratchet.engine().sample_at(time, disk).position.into())
        .collect();
    let radius = |disk: usize| ratchet.engine().state().bodies[disk].radius;
    let (mut into_base, mut into_disk) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
    for i in 0..count {
        let [x, y] = positions[i];
        assert!(y - base > 0.0 && y + radius(i) < 0.6 + 1e-9, "disk {i} lost at {x} {y}");
        into_base = f64::max(into_base, radius(i) - profile.distance(x, y - base));
        let last = &state.bodies[i];
        let lift = base_at(last.time);
        into_base = f64::max(
            into_base,
            last.radius - profile.distance(last.position.x, last.position.y - lift),
        );
        for (j, other) in positions[..i].iter().enumerate() {
            let apart = (x - other[0]).rem_euclid(width);
            let distance = apart.min(width - apart).hypot(y - other[1]);
            into_disk = f64::max(into_disk, radius(i) + radius(j) - distance);
        }
    }
    [into_base, into_disk]
}

/// F's hardest: deep steep teeth, strong shaking, many layers; and shapes at the edges of what exists.
#[test]
fn no_disk_penetrates_the_base_and_none_is_lost() {
    let amplitude = 2e-3;
    let frequency = |gamma: f64| (gamma * 9.81_f64 / amplitude).sqrt() / std::f64::consts::TAU;
    for (disks, height, asymmetry, tip, gamma, seconds) in [
        (120, 16e-3, 0.05, 4e-5, 40.0, 4.0),
        (120, 16e-3, 0.05, 1e-4, 40.0, 4.0),
        (30, 6e-3, 0.0, 4e-4, 40.0, 4.0),
        (30, 6e-3, 1.0, 4e-4, 40.0, 4.0),
        (30, 5e-3, 0.25, 0.0, 40.0, 4.0),
        (60, 3e-3, 0.1, 4e-4, 5.0, 4.0),
    ] {
        let changes = [
            ("tooth.height", height),
            ("tooth.asymmetry", asymmetry),
            ("tooth.tip_radius", tip),
            ("drive.frequency", frequency(gamma)),
        ];
        let profile = Profile::new(6e-3, height, asymmetry, tip);
        let mut ratchet = on_sine(disks, &changes);
        let mut deepest = [f64::NEG_INFINITY; 2];
        for sample in 1..=2000 {
            let time = f64::from(sample) * seconds / 2000.0;
            ratchet.advance_to(time).unwrap();
            let now = depths(ratchet.model().unwrap(), &profile, time, disks as usize, 60e-3);
            deepest = [deepest[0].max(now[0]), deepest[1].max(now[1])];
        }
        let events = ratchet.real("collisions").unwrap();
        println!(
            "h {height} a {asymmetry} s {tip} Gamma {gamma}: {events} impacts, into base {:.1e} m, into disks {:.1e} m",
            deepest[0], deepest[1]
        );
        assert!(events > 1e3 && deepest[0] < 1e-9 && deepest[1] < 1e-9);
    }
}

/// The hardest case over a thousand million events, also as a second variant with sharper tips. Reports every
/// hundred million: `cargo test --release --test ratchet -- --ignored --nocapture billion`.
fn nothing_penetrates_in(events: u64, tip: f64) {
    let frequency = (40.0 * 9.81_f64 / 2e-3).sqrt() / std::f64::consts::TAU;
    let changes = [
        ("tooth.height", 16e-3),
        ("tooth.asymmetry", 0.05),
        ("tooth.tip_radius", tip),
        ("drive.frequency", frequency),
    ];
    let profile = Profile::new(6e-3, 16e-3, 0.05, tip);
    let mut ratchet = on_sine(120, &changes);
    let (mut deepest, mut sample, mut reported) = ([f64::NEG_INFINITY; 2], 0_u32, 0);
    let begin = cpu_time::ProcessTime::now();
    loop {
        sample += 1;
        let time = 0.1 * f64::from(sample);
        ratchet.advance_to(time).unwrap();
        let now = depths(ratchet.model().unwrap(), &profile, time, 120, 60e-3);
        deepest = [deepest[0].max(now[0]), deepest[1].max(now[1])];
        let counts = &ratchet.model().unwrap().engine().state().counts;
        let impacts = counts.disk_impacts + counts.wall_impacts;
        let done = impacts + counts.list_renewals + counts.stale;
        if done / 100_000_000 > reported || done >= events {
            reported = done / 100_000_000;
            println!(
                "tip {tip} m: {done} events, {impacts} impacts ({} on base and ceiling) in {time:.0} s, CPU {:.0} s; deepest \
                 into base {:.1e} m, into disks {:.1e} m; resident {} kB",
                counts.wall_impacts,
                begin.elapsed().as_secs_f64(),
                deepest[0],
                deepest[1],
                resident_kilobytes()
            );
        }
        assert!(deepest[0] < 1e-9 && deepest[1] < 1e-9);
        if done >= events {
            return;
        }
    }
}

/// Memory of this process as the system reports it; 0 where there is no /proc.
fn resident_kilobytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS"));
    line.and_then(|line| line.split_whitespace().nth(1)?.parse().ok())
        .unwrap_or(0)
}

#[test]
#[ignore = "takes tens of minutes"]
fn nothing_penetrates_in_a_billion_events() {
    nothing_penetrates_in(1_000_000_000, 1e-4);
}

#[test]
#[ignore = "takes tens of minutes"]
fn nothing_penetrates_in_a_billion_events_with_sharp_tips() {
    nothing_penetrates_in(1_000_000_000, 4e-5);
}

/// A base on inputs sampled finely carries what the sine carries, and nothing gets through it.
#[test]
fn a_base_on_inputs_is_hard_and_moves_disks() {
    let mut ratchet = simulation_of::<RatchetOnInput>(20, &POSITIVE[..2]);
    let profile = Profile::new(6e-3, 3e-3, 0.1, 4e-4);
    let step = 1e-3;
    for index in 0..20_000_u32 {
        let time = f64::from(index) * step;
        set_base(&mut ratchet, time);
        ratchet.advance_to(time + step).unwrap();
        let engine = ratchet.model().unwrap().engine();
        let base = engine.state().boundary.base().drive.motion(time + step).displacement;
        for disk in 0..20 {
            let [x, y] = engine.sample_at(time + step, disk).position.into();
            let radius = engine.state().bodies[disk].radius;
            assert!(profile.distance(x, y - base) > radius - 1e-9);
        }
    }
    let transport = ratchet.real("transport_velocity").unwrap();
    println!("on inputs: {:.2} cm/s", 100.0 * transport);
    assert!(transport > 0.015 && transport < 0.06);
}
