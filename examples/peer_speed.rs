use jostle::contact::{ElasticSkin, LinearDashpot};
use jostle::drive::Sine;
use jostle::engine::molecular_dynamics::*;
use jostle::geometry::{Disk, Wall};
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(&args[1]).unwrap();
    let steps: usize = args[2].parse().unwrap();
    let dt: f64 = args[3].parse().unwrap();
    let v: Vec<f64> = text.split_whitespace().map(|x| x.parse().unwrap()).collect();
    let (n, w) = (v[0] as usize, v[1]);
    let rows: Vec<&[f64]> = v[3..3 + 6 * n].chunks(6).collect();
    let disks: Vec<Disk> = rows.iter().map(|r| Disk { radius: r[0], x: r[1] - w / 2.0, y: r[2] }).collect();
    let setup = Setup {
        laws: ContactLaws { normal: LinearDashpot { stiffness: 1e4, damping: 0.1 }, skin: ElasticSkin { stiffness: 7.7e3, friction: 0.1 } },
        walls: vec![Wall::vibrating_floor(), Wall::left(-w / 2.0), Wall::right(w / 2.0)],
        masses: disks.iter().map(|d| 3.57 * std::f64::consts::PI * d.radius * d.radius).collect(),
        gravity: 9.8, time_step: dt, start_time: 0.0,
    };
    let drive = Sine { amplitude: 1.5514e-4, frequency: 80.0, phase: 0.0 };
    let mut md = MolecularDynamics::<VelocityVerlet, Sine>::new(setup, &disks, drive);
    md.set_motion(|s| for (i, r) in rows.iter().enumerate() { for k in 0..3 { s.velocity[3 * i + k] = r[3 + k]; } });
    let t = std::time::Instant::now();
    md.advance_to(steps as f64 * dt).unwrap();
    let e = t.elapsed().as_secs_f64();
    println!("jostle N={n} ns/particle-step={:.2} contacts {} energies {:?}", e * 1e9 / steps as f64 / n as f64, md.now().contacts, md.energies());
}
