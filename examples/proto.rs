use jostle::contact::{ElasticSkin, LinearDashpot};
use jostle::drive::{FollowsInput, Sine};
use jostle::engine::located_dynamics::LocatedDynamics;
use jostle::engine::molecular_dynamics::{ContactLaws, MolecularDynamics, Setup, VelocityVerlet};
use jostle::geometry::{Disk, Wall};
use cpu_time::ProcessTime;
#[path = "../tests/support/reference_impact.rs"]
mod reference_impact;
use reference_impact::Impact;

const RADIUS: f64 = 0.02;
fn mass(r: f64) -> f64 { 3.57 * std::f64::consts::PI * r * r }
fn laws(damping: f64, ratio: f64, friction: f64) -> ContactLaws {
    ContactLaws { normal: LinearDashpot { stiffness: 1e4, damping }, skin: ElasticSkin { stiffness: ratio * 1e4, friction } }
}
fn impact(laws: ContactLaws, v: [f64; 3], h: f64, phase: f64, passes: u32) -> [f64; 3] {
    let setup = Setup { laws, walls: vec![Wall::vibrating_floor()], masses: vec![mass(RADIUS)], gravity: 0.0, time_step: h, start_time: 0.0 };
    let gap = -v[1] * h * (3.0 + phase);
    let disk = Disk { x: 0.0, y: RADIUS + gap, radius: RADIUS };
    let mut e = LocatedDynamics::new(setup, &[disk], FollowsInput::uniform(0.0, 0.0, 0.0));
    e.passes = passes;
    e.set_motion(|s| s.rates[0] = v);
    e.advance_to(0.01).unwrap();
    e.now().rates[0]
}
fn impacts() {
    let cases = [
        ("sticking", laws(0.1, 0.77, 0.8), [0.02, -0.3, 0.0]),
        ("rolling back", laws(0.1, 0.77, 0.1), [0.05, -0.3, 2.0]),
        ("sliding", laws(0.1, 0.77, 0.1), [0.5, -0.2, 0.0]),
        ("damped", laws(3.0, 0.3, 0.3), [0.2, -0.2, -3.0]),
        ("elastic", laws(0.0, 0.77, 0.1), [0.05, -0.3, 2.0]),
    ];
    for (name, laws, v) in cases {
        let m = mass(RADIUS);
        let duration = std::f64::consts::PI * (m / 1e4_f64).sqrt();
        let ut = v[0] + RADIUS * v[2];
        let r = Impact { mass: m, normal_stiffness: 1e4, normal_damping: laws.normal.damping, tangential_stiffness: laws.skin.stiffness, friction: laws.skin.friction, normal_velocity: v[1], tangential_velocity: ut };
        let (_, after) = r.velocities_after(4000);
        let en = laws.normal.restitution(m);
        for passes in [1, 2, 3] {
            print!("{name:13} passes {passes}:");
            for n in [5.0, 10.0, 20.0, 40.0, 80.0, 160.0, 320.0] {
                let (mut a, mut b) = (0.0, 0.0);
                for p in 0..16 {
                    let w = impact(laws, v, duration / n, (p as f64 + 0.5) / 16.0, passes);
                    a += (w[1] / -v[1] - en).powi(2);
                    b += ((w[0] + RADIUS * w[2] - after) / ut).powi(2);
                }
                print!("  {:.1e} {:.1e}", (a / 16.0).sqrt(), (b / 16.0).sqrt());
            }
            println!();
        }
    }
}
type Disks = (Vec<Disk>, Vec<[f64; 3]>, f64);
fn read(path: &str) -> Disks {
    let text = std::fs::read_to_string(path).unwrap();
    let mut numbers = text.split_whitespace().map(|w| w.parse::<f64>().unwrap());
    let n = numbers.next().unwrap() as usize;
    let width = numbers.next().unwrap();
    numbers.next();
    let (mut disks, mut rates) = (vec![], vec![]);
    for _ in 0..n {
        let a: Vec<f64> = numbers.by_ref().take(6).collect();
        disks.push(Disk { radius: a[0], x: a[1] - 0.5 * width, y: a[2] });
        rates.push([a[3], a[4], a[5]]);
    }
    (disks, rates, width)
}
fn setup(d: &Disks, h: f64) -> (Setup, Sine) {
    let masses = d.0.iter().map(|d| mass(d.radius)).collect();
    let walls = vec![Wall::vibrating_floor(), Wall::left(-0.5 * d.2), Wall::right(0.5 * d.2)];
    (Setup { laws: laws(0.1, 0.77, 0.1), walls, masses, gravity: 9.8, time_step: h, start_time: 0.0 },
     Sine { amplitude: Sine::amplitude_of(4.0, 80.0, 9.8), frequency: 80.0, phase: 0.0 })
}
fn located(d: &Disks, h: f64, end: f64, passes: u32) -> (Vec<[f64; 3]>, f64, f64, f64) {
    let (s, drive) = setup(d, h);
    let mut e = LocatedDynamics::new(s, &d.0, drive);
    e.passes = passes;
    e.set_motion(|s| s.rates.clone_from(&d.1));
    let t = ProcessTime::now();
    e.advance_to(end).unwrap();
    let cpu = t.elapsed().as_secs_f64();
    (e.now().places.clone(), cpu, e.events as f64 * h / end, e.now().contacts as f64)
}
fn verlet(d: &Disks, h: f64, end: f64) -> (Vec<[f64; 3]>, f64) {
    let (s, drive) = setup(d, h);
    let mut e = MolecularDynamics::<VelocityVerlet, _>::new(s, &d.0, drive);
    e.set_motion(|s| s.velocity[..3 * d.1.len()].copy_from_slice(d.1.as_flattened()));
    let t = ProcessTime::now();
    e.advance_to(end).unwrap();
    let cpu = t.elapsed().as_secs_f64();
    (e.now().places()[..d.1.len()].to_vec(), cpu)
}
fn error(a: &[[f64; 3]], b: &[[f64; 3]]) -> (f64, f64) {
    let n = a.len() as f64;
    let angle = a.iter().zip(b).map(|(a, b)| (a[2] - b[2]).powi(2)).sum::<f64>();
    let size = b.iter().map(|b| b[2].powi(2)).sum::<f64>();
    let place = a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sum::<f64>();
    ((angle / size).sqrt(), (place / n).sqrt())
}
fn main() {
    let arg: Vec<String> = std::env::args().collect();
    if arg.len() < 2 { impacts(); return; }
    let d = read(&arg[1]);
    let end: f64 = arg[2].parse().unwrap();
    let (reference, ..) = located(&d, 5e-7, end, 3);
    for passes in [3] {
        let (x, ..) = located(&d, 1e-6, end, passes);
        println!("reference against itself at 2h: {:?}", error(&x, &reference));
    }
    for passes in [1, 2, 3] {
        for h in [2e-4, 1e-4, 5e-5, 2.5e-5, 1.25e-5, 6e-6, 3e-6] {
            let (x, cpu, events, contacts) = located(&d, h, end, passes);
            let (a, p) = error(&x, &reference);
            println!("located {passes} h {h:.2e}: angle {a:.2e} place {p:.2e} cpu {cpu:.5} us/step {:.2} events/step {events:.2} contacts {contacts}", cpu / end * h * 1e6);
        }
    }
    for h in [1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8] {
        let (x, cpu) = verlet(&d, h, end);
        let (a, p) = error(&x, &reference);
        println!("verlet h {h:.2e}: angle {a:.2e} place {p:.2e} cpu {cpu:.5} us/step {:.2}", cpu / end * h * 1e6);
    }
}
