//! Saved states with some bytes damaged.

use std::sync::Arc;

use jostle::scene::{Choice, Scene, Table, Value, Values};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::checks::check_outputs;
use super::{MOST_WORK, pick};

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

pub fn damaged<S: Scene>(seed: u64) -> Result<String, String> {
    let mut generator = Pcg64::seed_from_u64(seed);
    let disks = pick(&mut generator, &[1, 5]).min(*S::card().disks.end());
    let choice = Choice { disks };
    let mut values = Values::new(Arc::new(Table::new(S::variables(choice))));
    if let Some(row) = values.table().position("base.model") {
        values
            .set(row, Value::Integer(generator.random_range(1..=2)))
            .expect("an option");
    }
    let mut scene = S::new(choice, 0.0, &values).map_err(|error| error.to_string())?;
    scene.limit_work(MOST_WORK);
    scene.advance_to(0.02, &values).map_err(|error| error.to_string())?;
    let mut bytes = postcard::to_allocvec(&scene.state()).expect("serialises");
    let before = bytes.clone();
    damage(&mut generator, &mut bytes);
    let Ok(state) = postcard::from_bytes::<S::State>(&bytes) else {
        return Ok("no state".into());
    };
    if scene.restore(&state).is_err() {
        if postcard::to_allocvec(&scene.state()).expect("serialises") != before {
            return Err("a refused state changed the scene".into());
        }
        return Ok("refused".into());
    }
    scene.write_outputs(values.writer());
    check_outputs(&values).map_err(|what| format!("after restoring: {what}"))?;
    let mut refused = 0;
    for step in 1..=100 {
        let end = 0.02 + 1e-3 * f64::from(step);
        if scene.advance_to(end, &values).is_err() {
            refused += 1;
            continue;
        }
        scene.write_outputs(values.writer());
        check_outputs(&values).map_err(|what| format!("at {end}: {what}"))?;
    }
    Ok(if refused == 0 {
        "ran".into()
    } else {
        "ran, with steps refused".into()
    })
}
