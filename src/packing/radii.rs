//! Radii of a packing: a distribution, a count and a seed in, a list of radii out.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::check_radius;
use crate::error::{Error, Result, Shortest};

/// One class of equal disks.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RadiusClass {
    /// Radius \[m\].
    pub radius: f64,
    /// Parts of the whole, at least 1: classes with 1, 1 and 2 parts hold 25, 25 and 50 percent of the disks.
    pub parts: u32,
}

/// How large the disks are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum RadiusDistribution {
    /// Classes filled exactly by their parts and shuffled; disks left over go one each to the first classes.
    Classes(Vec<RadiusClass>),
    /// Drawn evenly from `min` to `max` \[m\].
    Uniform {
        /// Smallest radius \[m\].
        min: f64,
        /// Largest radius \[m\].
        max: f64,
    },
    /// These radii \[m\] in this order; the seed has no say.
    Given(Vec<f64>),
}

impl Default for RadiusDistribution {
    /// Thirds of 1.5, 2.0 and 2.5 cm, as in P, chapter 2.4.1.
    fn default() -> Self {
        let classes = [0.015, 0.020, 0.025].map(|radius| RadiusClass { radius, parts: 1 });
        Self::Classes(classes.to_vec())
    }
}

impl RadiusDistribution {
    /// Draws `count` radii \[m\].
    ///
    /// The generator is PCG XSL 128/64 (`rand_pcg::Pcg64`, started by `seed_from_u64`), the shuffle is Fisher and Yates
    /// from the last place down. The same seed gives the same bits on every machine.
    ///
    /// # Errors
    /// A radius that is not a positive length, no class, a class without parts, `min` above `max`, or a list of another
    /// length than `count`.
    pub fn sample(&self, count: usize, seed: u64) -> Result<Vec<f64>> {
        self.check(count)?;
        let mut generator = Pcg64::seed_from_u64(seed);
        match self {
            Self::Classes(classes) => {
                let mut radii = fill(classes, count);
                shuffle(&mut radii, &mut generator);
                Ok(radii)
            }
            Self::Uniform { min, max } => Ok((0..count)
                .map(|_| (min + (max - min) * unit(&mut generator)).min(*max))
                .collect()),
            Self::Given(radii) => Ok(radii.clone()),
        }
    }

    fn check(&self, count: usize) -> Result<()> {
        match self {
            Self::Classes(classes) => {
                if classes.is_empty() {
                    let remedy = "Name a radius and its parts.";
                    return Err(Error::parameter(
                        "disk.radius",
                        "no class",
                        "at least one class",
                        remedy,
                    ));
                }
                for class in classes {
                    check_radius(class.radius, "")?;
                    if class.parts == 0 {
                        let value = format!("0 parts of radius {} m", Shortest(class.radius));
                        let remedy = "Leave the class out or give it parts.";
                        return Err(Error::parameter("disk.radius", value, "1 part or more", remedy));
                    }
                }
                Ok(())
            }
            Self::Uniform { min, max } => {
                check_radius(*min, " (smallest)")?;
                check_radius(*max, " (largest)")?;
                if min > max {
                    let value = format!("{} m to {} m", Shortest(*min), Shortest(*max));
                    let remedy = "Give the smaller radius first.";
                    return Err(Error::parameter("disk.radius", value, "min up to max", remedy));
                }
                Ok(())
            }
            Self::Given(radii) => {
                radii.iter().try_for_each(|&radius| check_radius(radius, ""))?;
                if radii.len() == count {
                    return Ok(());
                }
                let value = format!("a list of {} radii", radii.len());
                let remedy = "Give one radius for each disk.";
                Err(Error::parameter("disk.radius", value, format!("{count} radii"), remedy))
            }
        }
    }
}

/// Classes one after the other, in whole numbers so that thirds are thirds.
fn fill(classes: &[RadiusClass], count: usize) -> Vec<f64> {
    let total: u128 = classes.iter().map(|class| u128::from(class.parts)).sum();
    // At most `count`, which is a usize.
    let share = |class: &RadiusClass| (count as u128 * u128::from(class.parts) / total) as usize;
    let left_over = count - classes.iter().map(share).sum::<usize>();
    let mut radii = Vec::with_capacity(count);
    for (index, class) in classes.iter().enumerate() {
        let members = share(class) + usize::from(index < left_over);
        radii.extend(std::iter::repeat_n(class.radius, members));
    }
    radii
}

/// Fisher and Yates. Written out, so that the order depends on nothing but the generator.
fn shuffle(radii: &mut [f64], generator: &mut Pcg64) {
    for last in (1..radii.len()).rev() {
        // The high half of a 64 x 64 bit product: below last + 1, biased by less than 1 in 2^40 for any list that fits.
        let pick = (u128::from(generator.next_u64()) * (last as u128 + 1)) >> 64;
        radii.swap(last, pick as usize);
    }
}

/// Even on [0, 1), 53 bits.
fn unit(generator: &mut Pcg64) -> f64 {
    (generator.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
}
