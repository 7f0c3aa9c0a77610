//! The equations of the packing for the documentation page inside the component.

/// HTML fragment.
pub const HTML: &str = r"
<h2>Equations</h2>
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
<li>base driven by the inputs: between two communication points a distance <i>h</i> apart it moves on the cubic that
continues its displacement and velocity and ends at <code>base.displacement</code> + <i>h</i>
<code>base.velocity</code> with velocity <code>base.velocity</code></li>
<li>base driven as a sine: <i>y</i> = <i>A</i> sin(2 &pi; <i>f</i> <i>t</i> + <i>&phi;</i>);
&Gamma; = <i>A</i> (2 &pi; <i>f</i>)<sup>2</sup> / <i>g</i></li>
</ul>
<p>Velocity Verlet, with the damping at the velocity of the same instant; the time step is a hundredth of the shortest
contact period unless <code>time_step</code> sets it. The trajectory lives on its own grid of time and does not depend
on the communication points.</p>
<p>Source: G. G. Peraza Mues, Spontaneous rotation in vibrated disk packings, doctoral thesis, Cinvestav M&eacute;rida,
2018, chapters 2 and 4.</p>
";
