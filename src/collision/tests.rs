use nalgebra::Vector2;

use super::*;
use crate::geometry::clockwise;

/// A disk, a ball or a wall in an impact: motion and what moves it.
#[derive(Clone, Copy)]
struct Body {
    mass: f64,
    radius: f64,
    inertia: f64,
    velocity: Vector2<f64>,
    spin: f64,
}

impl Body {
    fn inverse_mass(&self) -> f64 {
        1.0 / self.mass
    }

    fn inverse_inertia(&self) -> f64 {
        if self.mass.is_finite() {
            self.radius.powi(2) / self.inertia
        } else {
            0.0
        }
    }

    fn energy(&self) -> f64 {
        0.5 * self.mass * self.velocity.norm_squared() + 0.5 * self.inertia * self.spin * self.spin
    }
}

fn impact_of(first: &Body, second: &Body, n: Vector2<f64>) -> Impact {
    let relative = first.velocity - second.velocity;
    let (a, b) = (first.inverse_mass(), second.inverse_mass());
    Impact {
        effective_mass: effective_mass(a, b),
        tangential_mass: tangential_mass(a, b, first.inverse_inertia(), second.inverse_inertia()),
        normal_velocity: relative.dot(&n),
        tangential_velocity: relative.dot(&clockwise(&n)) + first.radius * first.spin + second.radius * second.spin,
        time_since_last: f64::INFINITY,
    }
}

fn apply(body: &mut Body, sign: f64, n: Vector2<f64>, impulse: Impulse) {
    if body.mass.is_infinite() {
        return;
    }
    body.velocity += sign * (impulse.normal * n + impulse.tangential * clockwise(&n)) / body.mass;
    // The surfaces at the contact turn in the same sense on both bodies.
    body.spin += body.radius * impulse.tangential / body.inertia;
}

/// Even numbers in [0, 1), the same on every run.
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn body(&mut self, inertia_factor: f64) -> Body {
        let (mass, radius) = (0.1 + self.next(), 0.01 + self.next());
        Body {
            mass,
            radius,
            inertia: inertia_factor * mass * radius * radius,
            velocity: Vector2::new(2.0 * self.next() - 1.0, 2.0 * self.next() - 1.0),
            spin: (2.0 * self.next() - 1.0) / radius,
        }
    }
}

const WALL: Body = Body {
    mass: f64::INFINITY,
    radius: 0.0,
    inertia: f64::INFINITY,
    velocity: Vector2::new(0.0, 0.0),
    spin: 0.0,
};

/// Approaching pairs, disks and balls, disks and walls, with the normal.
fn pairs(count: usize) -> Vec<(Body, Body, Vector2<f64>)> {
    let mut random = Uniform(7);
    let mut pairs = Vec::new();
    while pairs.len() < count {
        let inertia_factor = if random.next() < 0.5 { 0.5 } else { 0.4 };
        let first = random.body(inertia_factor);
        let second = if random.next() < 0.7 {
            random.body(inertia_factor)
        } else {
            WALL
        };
        let (sine, cosine) = (std::f64::consts::TAU * random.next()).sin_cos();
        let normal = Vector2::new(cosine, sine);
        if impact_of(&first, &second, normal).normal_velocity < 0.0 {
            pairs.push((first, second, normal));
        }
    }
    pairs
}

/// Momentum, angular momentum about the contact, u_n', the friction limit; returns the largest gain of energy.
fn check<L: CollisionLaw>(law: &L, friction: f64) -> (f64, f64) {
    let (mut most, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
    for (first, second, n) in pairs(20_000) {
        let impact = impact_of(&first, &second, n);
        let impulse = law.impulse(&impact);
        let (mut a, mut b) = (first, second);
        apply(&mut a, 1.0, n, impulse);
        apply(&mut b, -1.0, n, impulse);
        let after = impact_of(&a, &b, n);
        assert!((after.normal_velocity - law.separation_velocity(&impact)).abs() < 1e-14);
        assert!(impulse.normal >= 0.0 && impulse.tangential.abs() <= friction * impulse.normal);
        let t = clockwise(&n);
        let mut gain = a.energy() - first.energy();
        for (body, was, arm) in [(a, first, 1.0), (b, second, -1.0)] {
            if body.mass.is_finite() {
                // About the contact, at distance R from the centre, m R v_t and I omega exchange (P 2.13, 2.14).
                let change = body.velocity.dot(&t) - was.velocity.dot(&t);
                let spin = body.inertia * (body.spin - was.spin);
                assert!((arm * body.mass * body.radius * change - spin).abs() < 1e-14);
            }
        }
        if second.mass.is_finite() {
            gain += b.energy() - second.energy();
            for axis in 0..2 {
                let momentum = |x: &Body, y: &Body| x.mass * x.velocity[axis] + y.mass * y.velocity[axis];
                assert!((momentum(&a, &b) - momentum(&first, &second)).abs() < 1e-14);
            }
        }
        most = most.max(gain);
        least = least.min(gain);
    }
    (least, most)
}

#[test]
fn every_law_conserves_momentum_and_creates_no_energy() {
    let rounding = 1e-14;
    let masses: Vec<f64> = pairs(20_000)
        .iter()
        .take(5)
        .map(|(a, b, _)| effective_mass(a.inverse_mass(), b.inverse_mass()))
        .collect();
    assert!(check(&Smooth::new(0.6).unwrap(), 0.0).1 < rounding);
    let (least, most) = check(&Smooth::ELASTIC, 0.0);
    assert!(most < rounding && least > -rounding);
    assert!(check(&Coulomb::new(0.8, 0.2).unwrap(), 0.2).1 < rounding);
    assert!(check(&Coulomb::new(1.0, 5.0).unwrap(), 5.0).1 < rounding);
    for (kappa, friction) in [(0.1, 0.1), (0.773, 0.1), (30.0, 0.6)] {
        let law = Dashpot::new(1e4, 20.0, kappa, friction).unwrap();
        assert!(check(&law, friction).1 < rounding);
        assert!(check(&TabulatedDashpot::new(law, &masses, 0.5), friction).1 < rounding);
        let law = Dashpot::new(1e4, 0.0, kappa, friction).unwrap();
        assert!(check(&law, friction).1 < rounding);
        assert!(check(&ContactTime::new(law, 1.0).unwrap(), friction).1 < rounding);
        check(&VelocityFloor::new(law, 0.5).unwrap(), friction);
    }
}

/// F A31, A32 on (v_n, v_t, v_c) with v_n > 0 on approach, and A28: sliding or sticking.
#[test]
fn coulomb_is_the_printed_matrices() {
    let (epsilon, mu) = (0.8, 0.2);
    let law = Coulomb::new(epsilon, mu).unwrap();
    let (mut slid, mut stuck) = (0, 0);
    for (first, second, n) in pairs(5_000) {
        let impact = impact_of(&first, &second, n);
        let l = first.inertia / (first.mass * first.radius.powi(2));
        let split = |a: &Body, b: &Body| {
            let v_c = a.radius * a.spin + b.radius * b.spin;
            let now = impact_of(a, b, n);
            [-now.normal_velocity, now.tangential_velocity - v_c, v_c]
        };
        let [v_n, v_t, v_c] = split(&first, &second);
        let v_r = v_t + v_c;
        let expected = if v_r.abs() >= (l + 1.0) / l * mu * (1.0 + epsilon) * v_n {
            slid += 1;
            let brake = mu * (1.0 + epsilon) * v_n * v_r.signum();
            [-epsilon * v_n, v_t - brake, v_c - brake / l]
        } else {
            stuck += 1;
            [-epsilon * v_n, (v_t - l * v_c) / (l + 1.0), (l * v_c - v_t) / (l + 1.0)]
        };
        let (mut a, mut b) = (first, second);
        let impulse = law.impulse(&impact);
        apply(&mut a, 1.0, n, impulse);
        apply(&mut b, -1.0, n, impulse);
        for (got, want) in split(&a, &b).iter().zip(expected) {
            assert!((got - want).abs() < 1e-14);
        }
    }
    assert!(slid > 100 && stuck > 100);
}

fn disk_on_wall(normal_velocity: f64, tangential_velocity: f64) -> Impact {
    Impact {
        effective_mass: 1.0,
        tangential_mass: 1.0 / 3.0,
        normal_velocity,
        tangential_velocity,
        time_since_last: f64::INFINITY,
    }
}

/// Without damping, and beyond `max(mu/kappa, 6 mu - mu/kappa)`, the dashpot law is Coulomb's law while that slides; below
/// it is not: the threshold is sharp.
#[test]
fn full_sliding_is_coulomb() {
    for kappa in [0.1, 1.0 / 3.0, 0.773, 10.0] {
        let mu = 0.1;
        let law = Dashpot::new(1.0, 0.0, kappa, mu).unwrap();
        let coulomb = Coulomb::new(1.0, mu).unwrap();
        let threshold = law.slides_throughout_from(1.0, 1.0 / 3.0);
        assert!((threshold - (mu / kappa).max(6.0 * mu - mu / kappa)).abs() < 1e-15);
        for factor in [1.0 + 1e-9, 1.1, 2.0, 1e3, 1e9, 1e20] {
            let impact = disk_on_wall(-0.7, -0.7 * threshold * factor);
            let (a, b) = (law.impulse(&impact), coulomb.impulse(&impact));
            assert!((a.normal - b.normal).abs() < 1e-15);
            let slide = mu * a.normal;
            assert!(
                (a.tangential - slide).abs() < 1e-12,
                "kappa {kappa}, factor {factor}: {a:?}"
            );
            if threshold * factor > 6.0 * mu {
                assert!((a.tangential - b.tangential).abs() < 1e-12);
            }
        }
        let below = law.impulse(&disk_on_wall(-0.7, 0.7 * threshold * 0.98));
        assert!(
            below.tangential.abs() < mu * below.normal * (1.0 - 1e-7),
            "kappa {kappa}"
        );
    }
}

/// With damping there is one stick, then sliding to the end: `e_t` exceeds full sliding by that stick's share alone.
#[test]
fn one_stick_then_sliding_exceeds_full_sliding_by_the_stick_alone() {
    for (kappa, mu, c) in [(0.1, 0.1, 0.1), (1.0, 0.3, 0.5), (10.0, 1.0, 1.2), (100.0, 0.1, 0.02)] {
        let law = Dashpot::of_damping_ratio(1.0, c, 1.0, kappa, mu).unwrap();
        let restitution = law.normal_restitution(1.0);
        for factor in [1.0, 3.0, 100.0] {
            let ratio = factor * law.slides_throughout_from(1.0, 1.0 / 3.0);
            let full = 1.0 - 3.0 * mu * (1.0 + restitution) / ratio;
            let excess = law.tangential_restitution(1.0, 1.0 / 3.0, ratio) - full;
            // The spring is at its limit after t_1 <= mu N_max / (kappa u_min), and takes less than mu N until then.
            let most_force = (1.0 + 4.0 * c * c).sqrt();
            let first_stick = mu * most_force / (kappa * (ratio - 3.0 * mu * (1.0 + restitution)));
            assert!(
                excess > 0.0 && excess < 3.0 * mu * most_force * first_stick / ratio,
                "{kappa} {factor} {excess}"
            );
        }
    }
}

#[test]
fn velocity_floor_and_contact_time_replace_the_restitution() {
    let law = Coulomb::new(0.5, 0.1).unwrap();
    let floor = VelocityFloor::new(law, 0.01).unwrap();
    assert_eq!(floor.separation_velocity(&disk_on_wall(-1.0, 0.0)), 0.5);
    let slow = floor.impulse(&disk_on_wall(-0.004, 10.0));
    assert!((slow.normal - 0.014).abs() < 1e-17);
    assert!((slow.tangential + 0.1 * 0.014).abs() < 1e-18);
    assert_eq!(floor.impulse(&disk_on_wall(0.0, 0.0)).normal, 0.01);

    let lasting = ContactTime::new(law, 1e-4).unwrap();
    let late = disk_on_wall(-1.0, 0.0);
    let soon = Impact {
        time_since_last: 0.9e-4,
        ..late
    };
    assert_eq!(lasting.separation_velocity(&late), 0.5);
    assert_eq!(lasting.separation_velocity(&soon), 1.0);
    const { assert!(!Coulomb::REMEMBERS && <ContactTime<Coulomb>>::REMEMBERS && !<ContactTime<Smooth>>::ROTATES) };
}

/// Impacts without approach, without slide, with enormous slide: finite impulses, none where there is none.
#[test]
fn degenerate_impacts_have_finite_impulses() {
    let law = Dashpot::new(1e4, 0.1, 0.773, 0.1).unwrap();
    let table = TabulatedDashpot::new(law, &[1.0], 0.5);
    for (u_n, u_t) in [
        (0.0, 0.0),
        (0.0, 1.0),
        (-1.0, 0.0),
        (-1e-300, 1.0),
        (-1.0, 1e300),
        (-1.0, 1e-300),
    ] {
        let impact = disk_on_wall(u_n, u_t);
        for impulse in [law.impulse(&impact), table.impulse(&impact)] {
            assert!(
                impulse.normal.is_finite() && impulse.tangential <= 0.0,
                "{impact:?} {impulse:?}"
            );
            assert!(impulse.tangential.abs() <= 0.1 * impulse.normal);
        }
        let smooth = Dashpot::new(1e4, 0.1, 0.773, 0.0).unwrap();
        assert_eq!(smooth.impulse(&impact).tangential, 0.0);
        assert_eq!(
            TabulatedDashpot::new(smooth, &[1.0], 0.5).impulse(&impact).tangential,
            0.0
        );
    }
    // A mass that was not announced.
    let other = Impact {
        effective_mass: 0.7,
        tangential_mass: 0.7 / 3.0,
        ..disk_on_wall(-0.5, 0.1)
    };
    assert_eq!(table.impulse(&other), law.impulse(&other));
}

/// A spring too stiff for tables is found out once, not for each of the masses.
#[test]
fn a_table_without_end_is_given_up_once() {
    let masses: Vec<f64> = (1..=40).map(|mass| 1e-3 * f64::from(mass)).collect();
    let stiff = Dashpot::new(1e4, 0.1, 1e4, 0.2).unwrap();
    let table = TabulatedDashpot::new(stiff, &masses, 0.5);
    assert!(table.pieces() == 0 && table.samples() < 25_000, "{}", table.samples());
    assert!(table.most_work() > 1000);
    let usual = Dashpot::new(1e4, 0.1, 2.0 / 7.0, 0.2).unwrap();
    let table = TabulatedDashpot::new(usual, &masses, 0.5);
    assert!(table.pieces() > 40 && table.most_work() == 1);
}

/// Numbers so small that they have lost digits made a table of pieces without end, for a minute and more.
#[test]
fn a_friction_or_stiffness_that_rounding_leaves_nothing_of_is_none() {
    for (kappa, friction) in [(0.77, 5e-324), (0.77, 1e-300), (5e-324, 0.1), (1e-310, 1e-310)] {
        let law = Dashpot::new(1e4, 0.1, kappa, friction).unwrap();
        let table = TabulatedDashpot::new(law, &[1.0], 0.5);
        assert_eq!((table.samples(), table.most_work()), (0, 1), "{kappa:e} {friction:e}");
        for impulse in [
            law.impulse(&disk_on_wall(-0.5, 0.1)),
            table.impulse(&disk_on_wall(-0.5, 0.1)),
        ] {
            assert!(impulse.tangential == 0.0 && impulse.normal > 0.0);
        }
    }
}

#[test]
fn refuses_what_is_out_of_range() {
    assert!(
        Smooth::new(1.1)
            .unwrap_err()
            .to_string()
            .contains("collision.restitution = 1.1")
    );
    assert!(
        Coulomb::new(0.5, -0.1)
            .unwrap_err()
            .to_string()
            .contains("collision.friction")
    );
    assert!(Dashpot::new(0.0, 0.0, 1.0, 0.1).is_err());
    assert!(Dashpot::new(1.0, f64::NAN, 1.0, 0.1).is_err());
    assert!(VelocityFloor::new(Smooth::ELASTIC, f64::INFINITY).is_err());
    assert!(ContactTime::new(Smooth::ELASTIC, -1.0).is_err());
}
