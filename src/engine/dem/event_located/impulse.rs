//! Impulse of one contact on its two bodies in one step.

use super::frame::{ContactFrame, HermiteCubic};

/// Integrals of a contact's own force over a step: impulse and first moment about the end of the step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OwnImpulse {
    /// Of the normal force \[N.s\], \[N.s2\].
    pub normal: [f64; 2],
    /// Of the tangential force \[N.s\], \[N.s2\].
    pub tangential: [f64; 2],
}

/// Impulse, moment and energies of one contact in one step.
#[derive(Debug, Clone, Copy, Default)]
pub struct ContactImpulse {
    /// Impulse on the first body's centre \[N.s\].
    pub impulse: [f64; 2],
    /// First moment of that force about the end of the step \[N.s2\].
    pub moment: [f64; 2],
    /// Both in the frame of the contact.
    pub own: OwnImpulse,
    /// Energy lost in the dashpot and by slip \[J\].
    pub lost: f64,
    /// Work of the wall's motion \[J\].
    pub work: f64,
}

/// Forces at one node of a quadrature.
pub struct ContactForces {
    /// N \[N\].
    pub normal: f64,
    /// tau \[N\], along the normal turned clockwise by a right angle.
    pub tangential: f64,
    /// delta \[m\].
    pub overlap: f64,
}

/// One node of a quadrature over a step.
pub struct QuadratureNode {
    /// Weight: the time that the node stands for \[s\].
    pub span: f64,
    /// Time from it to the end of the step \[s\].
    pub ahead: f64,
    /// Hermite's cubics there.
    pub value: HermiteCubic,
    /// Their derivatives.
    pub slope: HermiteCubic,
}

impl ContactImpulse {
    /// Adds a node.
    #[inline(always)]
    pub fn add<F: ContactFrame>(&mut self, frame: &F, forces: &ContactForces, node: &QuadratureNode) {
        let [nx, ny] = frame.normal(&node.value);
        let (normal, tangential) = (node.span * forces.normal, node.span * forces.tangential);
        let sideways = tangential * frame.lever(forces.overlap);
        let (x, y) = (normal * nx + sideways * ny, normal * ny - sideways * nx);
        self.impulse[0] += x;
        self.impulse[1] += y;
        self.moment[0] += node.ahead * x;
        self.moment[1] += node.ahead * y;
        self.own.normal[0] += normal;
        self.own.normal[1] += node.ahead * normal;
        self.own.tangential[0] += tangential;
        self.own.tangential[1] += node.ahead * tangential;
        self.work += y * frame.wall_velocity(&node.slope);
    }
}
