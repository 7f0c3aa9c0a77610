//! One contact over one step: its relative motion at both ends in, its impulse on the two bodies out.
//!
//! The motion between the ends is Hermite's cubic. While the contact stays in its phase the force is integrated along it
//! by Gauss's rule with two nodes; the step in which the phase changes is left to `pieces`.

use crate::contact::{ElasticSkin, LinearDashpot};

use super::frame::{Cubic, Frame};
use super::state::{Kinematics, Phase};

/// Contact laws with the constants that the steps need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Laws {
    /// Normal force.
    pub normal: LinearDashpot,
    /// Tangential force.
    pub skin: ElasticSkin,
    /// mu / k_t: stretch of the slipping skin over the normal force; 0 without friction \[m/N\].
    pub slip_compliance: f64,
}

impl Laws {
    /// Constants of these laws.
    pub fn new(normal: LinearDashpot, skin: ElasticSkin) -> Self {
        let has_skin = skin.stiffness > 0.0 && skin.friction > 0.0;
        Self {
            normal,
            skin,
            slip_compliance: if has_skin { skin.friction / skin.stiffness } else { 0.0 },
        }
    }

    /// Whether there are tangential forces.
    #[inline]
    pub fn has_skin(&self) -> bool {
        self.slip_compliance > 0.0
    }

    /// Normal force \[N\] before the cut-off at zero.
    #[inline(always)]
    pub fn normal_force(&self, overlap: f64, closing: f64) -> f64 {
        self.normal.stiffness * overlap + self.normal.damping * closing
    }
}

/// Integrals of a contact's own force over a step: impulse and first moment about the end of the step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Own {
    /// Of the normal force \[N.s\], \[N.s2\].
    pub normal: [f64; 2],
    /// Of the tangential force \[N.s\], \[N.s2\].
    pub tangential: [f64; 2],
}

/// What a contact gives to its first body in one step.
#[derive(Debug, Clone, Copy, Default)]
pub struct Push {
    /// Impulse on the centre \[N.s\].
    pub impulse: [f64; 2],
    /// First moment of the force about the end of the step \[N.s2\].
    pub moment: [f64; 2],
    /// The same in the frame of the contact.
    pub own: Own,
    /// Energy lost in the dashpot \[J\].
    pub dissipated: f64,
    /// Energy lost by slip \[J\].
    pub slip_heat: f64,
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

impl Push {
    /// Adds a node that stands for `span` \[s\] and lies `ahead` \[s\] before the end of the step, a fraction x into it.
    #[inline(always)]
    pub fn add<F: Frame>(&mut self, frame: &F, forces: &Forces, span: f64, ahead: f64, x: (&Cubic, &Cubic)) {
        let [nx, ny] = frame.normal(x.0);
        let (normal, tangential) = (span * forces.normal, span * forces.tangential);
        let sideways = tangential * frame.lever(forces.overlap);
        let (px, py) = (normal * nx + sideways * ny, normal * ny - sideways * nx);
        self.impulse[0] += px;
        self.impulse[1] += py;
        self.moment[0] += ahead * px;
        self.moment[1] += ahead * py;
        self.own.normal[0] += normal;
        self.own.normal[1] += ahead * normal;
        self.own.tangential[0] += tangential;
        self.own.tangential[1] += ahead * tangential;
        self.work += py * frame.carried(x.1);
    }
}

/// What comes of a contact's step.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// Phase at the end.
    pub phase: Phase,
    /// lambda* at the end \[m\].
    pub reference: f64,
    /// Rate of the closing velocity at the end \[m/s2\].
    pub closing_rate: f64,
    /// Impulses and energies.
    pub push: Push,
}

/// One contact in one step.
#[derive(Debug, Clone, Copy)]
pub struct Passage<'step, F> {
    /// Relative motion at the start.
    pub start: &'step Kinematics,
    /// Relative motion at the end, as known so far.
    pub end: &'step Kinematics,
    /// Phase at the start.
    pub phase: Phase,
    /// lambda* at the start \[m\].
    pub reference: f64,
    /// Integrals of the contact's own force that are contained in `end`.
    pub own: Own,
    /// Inverse of the effective mass \[1/kg\].
    pub mobility: f64,
    /// Frame over the step.
    pub frame: &'step F,
    /// Length \[s\].
    pub step: f64,
}

struct Node {
    x: f64,
    value: Cubic,
    slope: Cubic,
    bend: Cubic,
}

impl Node {
    const fn at(x: f64) -> Self {
        Self {
            x,
            value: Cubic::value(x),
            slope: Cubic::slope(x),
            bend: Cubic::bend(x),
        }
    }
}

/// (1 -+ 1/sqrt 3) / 2.
const GAUSS: [Node; 2] = [Node::at(0.211_324_865_405_187_12), Node::at(0.788_675_134_594_812_9)];

impl<F: Frame> Passage<'_, F> {
    /// Integrals over the step if the phase does not change in it.
    #[inline]
    pub fn within_phase(&self, laws: &Laws) -> Option<Outcome> {
        let (start, end) = (self.start, self.end);
        match self.phase {
            Phase::Open => (end.overlap <= 0.0).then(|| self.resting(Phase::Open)),
            Phase::Unpressed => (laws.normal_force(end.overlap, end.closing) <= 0.0).then(|| {
                let phase = if end.overlap > 0.0 { Phase::Unpressed } else { Phase::Open };
                let mut outcome = self.resting(phase);
                let left = laws.normal.energy(end.overlap.max(0.0));
                outcome.push.dissipated = laws.normal.energy(start.overlap) - left;
                outcome
            }),
            Phase::Stick => self.sticking(laws),
            Phase::SlipForward => self.slipping(laws, 1.0),
            Phase::SlipBackward => self.slipping(laws, -1.0),
        }
    }

    fn resting(&self, phase: Phase) -> Outcome {
        Outcome {
            phase,
            reference: self.reference,
            closing_rate: 0.0,
            push: Push::default(),
        }
    }

    #[inline(always)]
    fn overlap(&self, x: &Cubic) -> f64 {
        let (start, end, step) = (self.start, self.end, self.step);
        x.of(start.overlap, step * start.closing, end.overlap, step * end.closing)
    }

    #[inline(always)]
    fn stretch(&self, x: &Cubic) -> f64 {
        let (start, end, step) = (self.start, self.end, self.step);
        let (from, to) = (start.surface - self.reference, end.surface - self.reference);
        x.of(from, step * start.sliding, to, step * end.sliding)
    }

    /// Rate of the closing velocity at the end \[m/s2\].
    #[inline(always)]
    fn end_closing_rate(&self) -> f64 {
        const END: Cubic = Cubic::bend(1.0);
        self.overlap(&END) / (self.step * self.step)
    }

    #[inline(always)]
    fn sticking(&self, laws: &Laws) -> Option<Outcome> {
        let end = self.end;
        let end_force = laws.normal_force(end.overlap, end.closing);
        let end_stretch = end.surface - self.reference;
        if end_force <= 0.0 || end_stretch.abs() > laws.slip_compliance * end_force {
            return None;
        }
        let mut push = Push::default();
        let span = 0.5 * self.step;
        for node in &GAUSS {
            let overlap = self.overlap(&node.value);
            let closing = self.overlap(&node.slope) / self.step;
            let forces = Forces {
                normal: laws.normal_force(overlap, closing),
                tangential: laws.skin.force(self.stretch(&node.value)),
                overlap,
            };
            let ahead = (1.0 - node.x) * self.step;
            push.add(self.frame, &forces, span, ahead, (&node.value, &node.slope));
            push.dissipated += span * laws.normal.damping * closing * closing;
        }
        Some(Outcome {
            phase: Phase::Stick,
            reference: self.reference,
            closing_rate: self.end_closing_rate(),
            push,
        })
    }

    #[inline(always)]
    fn slipping(&self, laws: &Laws, sense: f64) -> Option<Outcome> {
        let end = self.end;
        let end_force = laws.normal_force(end.overlap, end.closing);
        let closing_rate = self.end_closing_rate();
        let end_slip = sense * end.sliding - laws.slip_compliance * laws.normal_force(end.closing, closing_rate);
        if end_force <= 0.0 || (laws.has_skin() && end_slip <= 0.0) {
            return None;
        }
        let mut push = Push::default();
        let span = 0.5 * self.step;
        for node in &GAUSS {
            let overlap = self.overlap(&node.value);
            let closing = self.overlap(&node.slope) / self.step;
            let normal = laws.normal_force(overlap, closing);
            let limit = if laws.has_skin() { laws.skin.friction * normal } else { 0.0 };
            let forces = Forces {
                normal,
                tangential: -sense * limit,
                overlap,
            };
            let ahead = (1.0 - node.x) * self.step;
            push.add(self.frame, &forces, span, ahead, (&node.value, &node.slope));
            push.dissipated += span * laws.normal.damping * closing * closing;
            let bend = self.overlap(&node.bend) / (self.step * self.step);
            let sliding = self.stretch(&node.slope) / self.step;
            let slip = sense * sliding - laws.slip_compliance * laws.normal_force(closing, bend);
            push.slip_heat += span * limit * slip;
        }
        Some(Outcome {
            phase: self.phase,
            reference: end.surface - sense * laws.slip_compliance * end_force,
            closing_rate,
            push,
        })
    }
}
