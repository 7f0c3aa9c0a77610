//! Tangential restitution e_t against |u_t / u_n| as CSV, the data of P Fig. 4.5:
//! `cargo run --release -p jostle-bench --example tangential_restitution`.
//!
//! A disk of 4.5 g at a wall: k_n = 4.5e6 N/m, gamma_n = 9.84 kg/s, mu = 0.1. Columns: stiffness ratio kappa,
//! |u_t / u_n|, e_t, e_t of the full-sliding formula (4.75), e_n, and from which ratio on the law slides to the end.

use jostle::collision::{Dashpot, tangential_mass};

const MASS: f64 = 4.5e-3;
const NORMAL_STIFFNESS: f64 = 4.5e6;
const NORMAL_DAMPING: f64 = 9.84;
const FRICTION: f64 = 0.1;
const STIFFNESS_RATIOS: [f64; 5] = [0.01, 0.1, 1.0, 10.0, 100.0];

/// 1e-3 to 1e2 evenly in the logarithm, and 0 to 2 evenly.
fn ratios() -> Vec<f64> {
    let mut ratios: Vec<f64> = (0..=2000).map(|i| 1e-3 * 1e5_f64.powf(f64::from(i) / 2000.0)).collect();
    ratios.extend((1..=2000).map(|i| f64::from(i) * 1e-3));
    ratios.sort_by(f64::total_cmp);
    ratios.dedup();
    ratios
}

fn main() -> jostle::Result<()> {
    println!("stiffness_ratio,velocity_ratio,restitution,full_sliding,normal_restitution,slides_from");
    let tangential = tangential_mass(1.0 / MASS, 0.0, 2.0 / MASS, 0.0);
    for kappa in STIFFNESS_RATIOS {
        let law = Dashpot::new(NORMAL_STIFFNESS, NORMAL_DAMPING, kappa, FRICTION)?;
        let normal = law.normal_restitution(MASS);
        let slides_from = law.slides_throughout_from(MASS, tangential);
        for ratio in ratios() {
            let restitution = law.tangential_restitution(MASS, tangential, ratio);
            let full_sliding = 1.0 - MASS / tangential * FRICTION * (1.0 + normal) / ratio;
            println!("{kappa},{ratio:.9e},{restitution:.12e},{full_sliding:.12e},{normal:.12e},{slides_from:.9e}");
        }
    }
    Ok(())
}
