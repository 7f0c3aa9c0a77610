//! A contact in a step in which its phase changes: the contact's own equation is solved piece by piece.
//!
//! What the other contacts, gravity and the turning of the frame do to the relative motion is smooth: what is left of
//! the motion at the end of the step without the contact's own force gives their pull as a line in time. Under it the
//! contact's own law is a linear equation in each phase, solved by its power series, whose roots are the events.

use super::frame::{Cubic, Frame};
use super::laws::Laws;
use super::passage::{Outcome, Passage};
use super::polynomial::{LENGTH, Polynomial};
use super::push::{At, Forces, Push};
use super::state::Phase;

/// Pieces of one step; what is beyond goes on in the last phase. Grazing events could else alternate without end.
const MOST_PIECES: usize = 12;

/// Nodes and weights of Gauss's rule with four nodes on 0 to 1.
const NODES: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Overlap and lambda, each with its rate, at the start of a piece.
#[derive(Clone, Copy)]
struct Point {
    overlap: f64,
    closing: f64,
    surface: f64,
    sliding: f64,
}

/// Accelerations of overlap and lambda without the contact's own force: value and slope in time.
struct Pull {
    normal: [f64; 2],
    tangential: [f64; 2],
}

/// What is known to vanish at the start of a piece, since the piece began there.
#[derive(Clone, Copy, Default)]
struct Zeros {
    /// Of the normal force.
    force: usize,
    /// Of the distance to Amonton's limit, for positive and for negative stretch.
    yields: [usize; 2],
    /// Of the rate of slip.
    slip: usize,
}

/// Overlap, lambda and normal force along a piece, on the scaled time 0 to 1.
struct Piece {
    overlap: Polynomial,
    surface: Polynomial,
    force: Polynomial,
    length: f64,
}

/// What ends a piece.
#[derive(Clone, Copy, PartialEq)]
enum Event {
    Touch,
    Release,
    Press,
    Yield(f64),
    Hold,
}

impl<F: Frame> Passage<'_, F> {
    /// Integrals over a step in which the phase changes, with the phase at its end.
    pub fn in_pieces(&self, laws: &Laws) -> Outcome {
        let pull = self.pull();
        let mut point = Point {
            overlap: self.start.overlap,
            closing: self.start.closing,
            surface: self.start.surface,
            sliding: self.start.sliding,
        };
        let (mut phase, mut reference, mut zeros) = (self.phase, self.reference, Zeros::default());
        let mut push = Push::default();
        let mut elapsed = 0.0;
        for index in 1.. {
            let length = self.step - elapsed;
            let piece = self.piece(laws, &pull, &point, (phase, reference), elapsed, length);
            let event = if index < MOST_PIECES {
                piece.first_event(laws, phase, reference, zeros)
            } else {
                None
            };
            let end = event.map_or(1.0, |(x, _)| x);
            self.integrate(laws, &piece, (phase, reference), (elapsed, end), &mut push);
            point = piece.point(end);
            let Some((x, event)) = event else {
                break;
            };
            elapsed += x * length;
            (phase, reference, zeros) = next_phase(laws, event, phase, &mut point, reference);
        }
        self.finish(laws, phase, reference, point, push)
    }

    fn finish(&self, laws: &Laws, phase: Phase, reference: f64, point: Point, push: Push) -> Outcome {
        let phase = match phase {
            Phase::Unpressed if self.end.overlap <= 0.0 => Phase::Open,
            other => other,
        };
        let force = laws.normal_force(point.overlap, point.closing);
        let reference = match phase.slip_sense() {
            Some(sense) => point.surface - sense * laws.slip_compliance * force,
            None => reference,
        };
        let own = if phase.is_pressed() { self.mobility * force } else { 0.0 };
        let pull = self.pull();
        Outcome {
            phase,
            reference,
            closing_rate: pull.normal[0] + self.step * pull.normal[1] - own,
            push,
        }
    }

    /// Acceleration lambda gets from a unit of tangential force \[1/kg\]: that of the centres and of both spins.
    fn tangential_mobility(&self) -> f64 {
        (self.end.lever * self.end.lever + 2.0) * self.mobility
    }

    /// The cubic from the start to the end less what the contact's own force did has these second derivatives.
    fn pull(&self) -> Pull {
        let (start, end, step) = (self.start, self.end, self.step);
        let [from, to] = [Cubic::bend(0.0), Cubic::bend(1.0)];
        let line = |value: f64, slope: f64, end_value: f64, end_slope: f64| {
            let bend = |x: &Cubic| x.of(value, step * slope, end_value, step * end_slope) / (step * step);
            let (first, last) = (bend(&from), bend(&to));
            [first, (last - first) / step]
        };
        let (normal, tangential) = (self.own.normal, self.own.tangential);
        let mobility = self.tangential_mobility();
        Pull {
            normal: line(
                start.overlap,
                start.closing,
                end.overlap + self.mobility * normal[1],
                end.closing + self.mobility * normal[0],
            ),
            tangential: line(
                start.surface - self.reference,
                start.sliding,
                end.surface - self.reference - mobility * tangential[1],
                end.sliding - mobility * tangential[0],
            ),
        }
    }

    /// Power series of `delta'' = pull - N / m`, `lambda'' = pull + 3 tau / m` in this phase.
    fn piece(
        &self,
        laws: &Laws,
        pull: &Pull,
        point: &Point,
        (phase, reference): (Phase, f64),
        elapsed: f64,
        length: f64,
    ) -> Piece {
        let square = length * length;
        let line = |pull: [f64; 2]| [square * (pull[0] + pull[1] * elapsed), square * pull[1] * length];
        let (normal, tangential) = (line(pull.normal), line(pull.tangential));
        let (mut overlap, mut surface, mut force) = ([0.0; LENGTH], [0.0; LENGTH], [0.0; LENGTH]);
        (overlap[0], overlap[1]) = (point.overlap, length * point.closing);
        (surface[0], surface[1]) = (point.surface, length * point.sliding);
        let (inertia, spin) = (square * self.mobility, square * self.tangential_mobility());
        let (stiffness, damping) = (laws.normal.stiffness, laws.normal.damping / length);
        let pressed = phase.is_pressed();
        let share = -phase.slip_sense().unwrap_or(0.0) * laws.slip_share();
        for i in 0..LENGTH {
            if i + 1 < LENGTH {
                force[i] = stiffness * overlap[i] + damping * (i + 1) as f64 * overlap[i + 1];
            }
            if i + 2 < LENGTH {
                let (own, skin) = match phase {
                    _ if !pressed => (0.0, 0.0),
                    Phase::Stick => {
                        let stretch = surface[i] - if i == 0 { reference } else { 0.0 };
                        (force[i], laws.skin.force(stretch))
                    }
                    _ => (force[i], share * force[i]),
                };
                let (pull, drag) = if i < 2 { (normal[i], tangential[i]) } else { (0.0, 0.0) };
                let divisor = ((i + 1) * (i + 2)) as f64;
                overlap[i + 2] = (pull - inertia * own) / divisor;
                surface[i + 2] = (drag + spin * skin) / divisor;
            }
        }
        Piece {
            overlap: Polynomial(overlap),
            surface: Polynomial(surface),
            force: Polynomial(force),
            length,
        }
    }

    fn integrate(
        &self,
        laws: &Laws,
        piece: &Piece,
        (phase, reference): (Phase, f64),
        (elapsed, end): (f64, f64),
        push: &mut Push,
    ) {
        if phase == Phase::Open {
            return;
        }
        if phase == Phase::Unpressed {
            let energy = |x: f64| laws.normal.energy(piece.overlap.at(x).max(0.0));
            push.lost += energy(0.0) - energy(end);
            return;
        }
        let (closing, sliding, force_rate) = (
            piece.overlap.derivative(),
            piece.surface.derivative(),
            piece.force.derivative(),
        );
        for (node, weight) in NODES {
            let x = node * end;
            let span = weight * end * piece.length;
            let time = elapsed + x * piece.length;
            let (overlap, normal) = (piece.overlap.at(x), piece.force.at(x));
            let closing = closing.at(x) / piece.length;
            let tangential = match phase.slip_sense() {
                None => laws.skin.force(piece.surface.at(x) - reference),
                Some(sense) => {
                    let limit = laws.slip_share() * normal;
                    let slip = sense * sliding.at(x) - laws.slip_compliance * force_rate.at(x);
                    push.lost += span * limit * slip / piece.length;
                    -sense * limit
                }
            };
            let forces = Forces {
                normal,
                tangential,
                overlap,
            };
            let whole = time / self.step;
            let at = At {
                span,
                ahead: self.step - time,
                value: Cubic::value(whole),
                slope: Cubic::slope(whole),
            };
            push.add(self.frame, &forces, &at);
            push.lost += span * laws.normal.damping * closing * closing;
        }
    }
}

impl Piece {
    fn point(&self, x: f64) -> Point {
        Point {
            overlap: self.overlap.at(x),
            closing: self.overlap.derivative().at(x) / self.length,
            surface: self.surface.at(x),
            sliding: self.surface.derivative().at(x) / self.length,
        }
    }

    /// The first change of phase and the scaled time at which it happens.
    fn first_event(&self, laws: &Laws, phase: Phase, reference: f64, zeros: Zeros) -> Option<(f64, Event)> {
        let earlier = |a: Option<(f64, Event)>, b: Option<(f64, Event)>| match (a, b) {
            (Some(a), Some(b)) => Some(if b.0 < a.0 { b } else { a }),
            (a, b) => a.or(b),
        };
        let when = |x: Option<f64>, event: Event| x.map(|x| (x, event));
        let release = || {
            when(
                self.force.mixed(-1.0, &self.force, 0.0).first_rise(zeros.force),
                Event::Release,
            )
        };
        match phase {
            Phase::Open => when(self.overlap.first_rise(0), Event::Touch),
            Phase::Unpressed => when(self.force.first_rise(zeros.force), Event::Press),
            Phase::Stick => {
                let stretch = self.surface.raised(-reference);
                let yields = |sense: f64, zeros: usize| {
                    let beyond = stretch.mixed(sense, &self.force, -laws.slip_compliance);
                    when(beyond.first_rise(zeros), Event::Yield(sense))
                };
                let either = earlier(yields(1.0, zeros.yields[0]), yields(-1.0, zeros.yields[1]));
                earlier(release(), either)
            }
            Phase::SlipForward | Phase::SlipBackward => {
                let sense = phase.slip_sense()?;
                let hold = if laws.grips() {
                    let slip = self
                        .surface
                        .mixed(-sense, &self.force, laws.slip_compliance)
                        .derivative();
                    when(slip.first_rise(zeros.slip), Event::Hold)
                } else {
                    None
                };
                earlier(release(), hold)
            }
        }
    }
}

/// The phase after an event, lambda* in it, and what vanishes at its start.
fn next_phase(laws: &Laws, event: Event, phase: Phase, point: &mut Point, reference: f64) -> (Phase, f64, Zeros) {
    let slips = |sense: f64| {
        if sense > 0.0 {
            Phase::SlipForward
        } else {
            Phase::SlipBackward
        }
    };
    // A force that starts from zero holds the skin only if Amonton's limit rises faster than the stretch.
    let starts = |point: &Point, from_zero: bool| {
        let force = usize::from(from_zero);
        let outrun = point.sliding.abs() > laws.slip_compliance * laws.normal.stiffness * point.closing;
        if !laws.grips() || (from_zero && outrun) {
            (
                slips(point.sliding),
                point.surface,
                Zeros {
                    force,
                    ..Zeros::default()
                },
            )
        } else {
            let zeros = Zeros {
                force,
                yields: [force; 2],
                slip: 0,
            };
            (Phase::Stick, point.surface, zeros)
        }
    };
    match event {
        Event::Touch => {
            point.overlap = 0.0;
            starts(point, laws.normal.damping == 0.0)
        }
        Event::Press => starts(point, true),
        Event::Release => {
            let phase = if point.overlap > 0.0 {
                Phase::Unpressed
            } else {
                Phase::Open
            };
            let zeros = Zeros {
                force: 1,
                ..Zeros::default()
            };
            (phase, point.surface, zeros)
        }
        Event::Yield(sense) => (slips(sense), reference, Zeros::default()),
        Event::Hold => {
            let sense = phase.slip_sense().unwrap_or(1.0);
            let force = laws.normal_force(point.overlap, point.closing);
            let reference = point.surface - sense * laws.slip_compliance * force;
            let yields = if sense > 0.0 { [2, 0] } else { [0, 2] };
            (
                Phase::Stick,
                reference,
                Zeros {
                    force: 0,
                    yields,
                    slip: 0,
                },
            )
        }
    }
}
