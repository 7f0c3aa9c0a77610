//! In which senses a slow harmonic torque makes the disk slide: the phase diagram of P Fig. 5.1.

use super::{Limits, Setting, detachment_tilt, limits};

/// Sliding regime, P 5.2.1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// The torque stays below both limits: no rotation.
    None,
    /// One limit is passed.
    Unidirectional,
    /// Both limits are passed.
    Bidirectional,
    /// Tilted so far that a slide can open a contact; the theory of lasting contacts ends here.
    Detaching,
}

impl Regime {
    /// Regime of a torque of this amplitude \[N m\] between these limits.
    pub fn between(limits: &Limits, amplitude: f64) -> Self {
        match (amplitude > limits.lower(), amplitude > limits.upper()) {
            (false, _) => Self::None,
            (true, false) => Self::Unidirectional,
            (true, true) => Self::Bidirectional,
        }
    }

    /// Its number: 0 none, 1 unidirectional, 2 bidirectional, 3 detaching.
    pub fn number(self) -> u8 {
        self as u8
    }
}

/// Regime of a torque of this amplitude \[N m\].
pub fn regime(setting: &Setting, amplitude: f64) -> Regime {
    if setting.tilt.abs() < detachment_tilt(setting) {
        Regime::between(&limits(setting), amplitude)
    } else {
        Regime::Detaching
    }
}
