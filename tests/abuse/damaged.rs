//! Saved states with some bytes damaged.

use jostle::scene::{Model, Value};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::checks::check_outputs;
use super::pick;
use super::trial::Trial;

/// Damages some bytes.
fn damage(generator: &mut Pcg64, bytes: &mut Vec<u8>) {
    for _ in 0..pick(generator, &[1, 1, 2, 4]) {
        let at = generator.random_range(0..bytes.len());
        match generator.random_range(0..6) {
            0 => bytes.truncate(at.max(1)),
            1 | 2 => bytes[at] ^= 1 << generator.random_range(0..8),
            3 => bytes[at] = generator.next_u64() as u8,
            4 => bytes[at..].iter_mut().take(9).for_each(|byte| *byte = 0xff),
            _ => {
                let number = pick(generator, &[f64::NAN, 1e300, -1e300, f64::INFINITY, 0.0, -1.0]);
                for (byte, new) in bytes[at..].iter_mut().zip(number.to_le_bytes()) {
                    *byte = new;
                }
            }
        }
    }
}

pub fn damaged<M: Model>(seed: u64) -> Result<String, String> {
    let mut generator = Pcg64::seed_from_u64(seed);
    let mut trial = Trial::<M>::of_disks(pick(&mut generator, &[1, 5]));
    if let Some(position) = trial.values.table().position("base.model") {
        trial
            .values
            .set(position, Value::Integer(generator.random_range(1..=2)))
            .expect("an option");
    }
    let mut model = trial.model(0.0, &trial.values).map_err(|error| error.to_string())?;
    model
        .advance_to(0.02, &trial.values)
        .map_err(|error| error.to_string())?;
    let mut bytes = postcard::to_allocvec(&model.state()).expect("serialises");
    let before = bytes.clone();
    damage(&mut generator, &mut bytes);
    let Ok(state) = postcard::from_bytes::<M::State>(&bytes) else {
        return Ok("no state".into());
    };
    if model.restore(&state).is_err() {
        if postcard::to_allocvec(&model.state()).expect("serialises") != before {
            return Err("a refused state changed the model".into());
        }
        return Ok("refused".into());
    }
    check_outputs(&trial.observe(&model)).map_err(|what| format!("after restoring: {what}"))?;
    let mut refused = 0;
    for step in 1..=100 {
        let end = 0.02 + 1e-3 * f64::from(step);
        if model.advance_to(end, &trial.values).is_err() {
            refused += 1;
            continue;
        }
        check_outputs(&trial.observe(&model)).map_err(|what| format!("at {end}: {what}"))?;
    }
    Ok(if refused == 0 {
        "ran".into()
    } else {
        "ran, with steps refused".into()
    })
}
