//! What a contact gives to its two bodies in one step.

use super::frame::{Cubic, Frame};

/// Integrals of a contact's own force over a step: impulse and first moment about the end of the step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Own {
    /// Of the normal force \[N.s\], \[N.s2\].
    pub normal: [f64; 2],
    /// Of the tangential force \[N.s\], \[N.s2\].
    pub tangential: [f64; 2],
}

/// Impulse, moment and energies of one contact in one step.
#[derive(Debug, Clone, Copy, Default)]
pub struct Push {
    /// Impulse on the first body's centre \[N.s\].
    pub impulse: [f64; 2],
    /// First moment of that force about the end of the step \[N.s2\].
    pub moment: [f64; 2],
    /// The same in the frame of the contact.
    pub own: Own,
    /// Energy lost in the dashpot and by slip \[J\].
    pub lost: f64,
    /// Work of the wall's motion \[J\].
    pub work: f64,
}

/// Forces at one node of a quadrature.
pub struct Forces {
    /// N \[N\].
    pub normal: f64,
    /// tau \[N\], along the normal turned clockwise by a right angle.
    pub tangential: f64,
    /// delta \[m\].
    pub overlap: f64,
}

/// One node of a quadrature over a step.
pub struct At {
    /// Time that it stands for \[s\].
    pub span: f64,
    /// Time from it to the end of the step \[s\].
    pub ahead: f64,
    /// Hermite's cubics there.
    pub value: Cubic,
    /// Their derivatives.
    pub slope: Cubic,
}

impl Push {
    /// Adds a node.
    #[inline(always)]
    pub fn add<F: Frame>(&mut self, frame: &F, forces: &Forces, at: &At) {
        let [nx, ny] = frame.normal(&at.value);
        let (normal, tangential) = (at.span * forces.normal, at.span * forces.tangential);
        let sideways = tangential * frame.lever(forces.overlap);
        let (x, y) = (normal * nx + sideways * ny, normal * ny - sideways * nx);
        self.impulse[0] += x;
        self.impulse[1] += y;
        self.moment[0] += at.ahead * x;
        self.moment[1] += at.ahead * y;
        self.own.normal[0] += normal;
        self.own.normal[1] += at.ahead * normal;
        self.own.tangential[0] += tangential;
        self.own.tangential[1] += at.ahead * tangential;
        self.work += y * frame.carried(&at.slope);
    }
}
