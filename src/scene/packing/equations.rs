//! The equations of the packing for the documentation page inside the component.

/// HTML fragment of the soft packing.
pub const HTML: &str = r"
<p>Each disk obeys Newton's equations under gravity and the forces of its contacts with disks, walls and base.
With <i>n</i> the unit normal towards the disk, &delta; the overlap, <i>u<sub>n</sub></i> and <i>u<sub>t</sub></i> the
relative velocities of the surfaces:</p>
<ul>
<li>normal force: <i>N</i> = max(<i>k<sub>n</sub></i> &delta; &minus; &gamma;<sub>n</sub> <i>u<sub>n</sub></i>, 0)</li>
<li>tangential displacement: &lambda; = <i>R<sub>a</sub></i> &theta;<sub>a</sub> + <i>R<sub>b</sub></i>
&theta;<sub>b</sub> &minus; (<i>R<sub>a</sub></i> + <i>R<sub>b</sub></i>) &beta;, with &beta; the direction of the line of
centres; at a wall &lambda; = <i>R</i> &theta; + <i>d</i> with <i>d</i> the place along the wall</li>
<li>tangential force: &tau; = &minus;&kappa; <i>k<sub>n</sub></i> (&lambda; &minus; &lambda;*); &lambda;* is &lambda; at
the instant of touch and slips so that |&tau;| &le; &mu; <i>N</i></li>
<li>base driven by the inputs: during a communication step it moves on the quintic that continues its displacement,
velocity and acceleration; the quintic ends where the polynomial leads that extrapolates the last values of
<code>base.displacement</code>, <code>base.velocity</code> and <code>base.acceleration_input</code>, of degree five at most</li>
<li>base driven as a sine: <i>y</i> = <i>A</i> sin(2 &pi; <i>f</i> <i>t</i> + <i>&phi;</i>);
&Gamma; = <i>A</i> (2 &pi; <i>f</i>)<sup>2</sup> / <i>g</i></li>
<li>drives that hold the bottom row (the disks that stand on the floor at the start; they do not turn and belong to the base):
<code>sine-fixed-bottom</code> moves it with the base, <code>random-bottom</code> displaces the centre of each of its disks by
<i>d</i> = &epsilon; <i>q</i> &radic;((1 &minus; exp(&minus;<i>s</i>)) / (2 <i>s</i>)), <i>s</i> = |<i>q</i>|<sup>2</sup>/2,
with <i>q</i> two damped oscillators of unit variance forced by white noise: anywhere in the circle of radius &epsilon; with
the same probability</li>
<li>side walls: they stand still and rub on disks that the floor carries, or with <code>wall.motion</code> =
<code>with_base</code> move up and down with the floor, as those of a box on a shaker do; <code>base.reaction_force</code>
then holds their friction</li>
<li>rotation: angles are sampled at <code>measure.start</code> and every <code>measure.interval</code> from then on.
<code>disk.mean_angular_velocity</code>: whole excursion over its time; <code>disk.rotation_correlation</code>:
&rho;<sup>2</sup> of angle and time; <code>disk.adjusted_deviation</code>: &sigma;<sub>a</sub> = &sigma; / (|&omega;| + &sigma;)
with &omega; the mean angular velocity and &sigma; the standard deviation of those in the n intervals;
<code>rotation.persistent_mean_square</code>: mean over the disks of &omega;<sup>2</sup> &minus; &sigma;<sup>2</sup> / (n &minus; 1)</li>
</ul>
<p>Velocity Verlet, with the damping at the velocity of the same instant; the time step is a hundredth of the shortest
contact period unless <code>time_step</code> sets it. The trajectory lives on its own grid of time and does not depend
on the communication points.</p>
<p>Source: G. G. Peraza Mues, Spontaneous rotation in vibrated disk packings, doctoral thesis, Cinvestav M&eacute;rida,
2018, chapters 2, 3.1 and 4.</p>
";

/// HTML fragment of the hard packing.
pub const HARD_HTML: &str = r"
<p>Disks fly on parabolas and meet in instantaneous impacts. An impact has the outcome of the soft contact's own: with
<i>c</i> = &gamma;<sub>n</sub> / (2 &radic;(<i>k<sub>n</sub></i> <i>m</i>)) and the effective mass <i>m</i></p>
<ul>
<li>normal restitution <i>e<sub>n</sub></i> = exp(&minus;2 <i>c</i> arccos <i>c</i> / &radic;(1 &minus; <i>c</i><sup>2</sup>)),
continued beyond <i>c</i> = 1</li>
<li>tangential restitution <i>e<sub>t</sub></i>(|<i>u<sub>t</sub></i>/<i>u<sub>n</sub></i>|; &kappa;, &mu;, <i>c</i>) from
the phases of stick and slip during the impact, stitched exactly and tabulated to 10<sup>&minus;6</sup></li>
<li>impacts within <code>collision.contact_time</code> of a disk&#39;s last one lose nothing along the normal (contact-time
model), which ends inelastic collapse</li>
<li>moving bottom: each disk meets the base where and when it is; random phase: the bottom stays and lends each impact the
velocity that a base of random phase has where it is first met, or with <code>base.profile</code> = <code>sawtooth</code>
<i>A</i> &omega;, up</li>
<li>side walls: they stand still and rub on disks that the floor carries, or with <code>wall.motion</code> =
<code>with_base</code> move up and down with the floor, as those of a box on a shaker do; <code>base.reaction_force</code>
then holds their friction</li>
<li>rotation: angles are sampled at <code>measure.start</code> and every <code>measure.interval</code> from then on.
<code>disk.mean_angular_velocity</code>: whole excursion over its time; <code>disk.rotation_correlation</code>:
&rho;<sup>2</sup> of angle and time; <code>disk.adjusted_deviation</code>: &sigma;<sub>a</sub> = &sigma; / (|&omega;| + &sigma;)
with &omega; the mean angular velocity and &sigma; the standard deviation of those in the n intervals;
<code>rotation.persistent_mean_square</code>: mean over the disks of &omega;<sup>2</sup> &minus; &sigma;<sup>2</sup> / (n &minus; 1)</li>
</ul>
<p>Source: G. G. Peraza Mues, Spontaneous rotation in vibrated disk packings, doctoral thesis, Cinvestav M&eacute;rida,
2018, chapters 2.3, 3.1 and 4.5.</p>
";
