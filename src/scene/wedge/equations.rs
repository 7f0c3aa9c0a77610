//! The equations of the wedge for the documentation page inside the component.

/// HTML fragment.
pub const HTML: &str = r"
<p>A disk of radius <i>R</i> falls in a wedge of aperture &theta;<sub>W</sub> whose bisector is tilted counter-clockwise
by &theta;<sub>T</sub>. With &theta;<sub>0</sub> = (&pi; &minus; &theta;<sub>W</sub>)/2 the left wall has the angle
&theta;<sub>L</sub> = &minus;(&theta;<sub>0</sub> &minus; &theta;<sub>T</sub>), the right one &theta;<sub>R</sub> =
&theta;<sub>0</sub> + &theta;<sub>T</sub>; at |&theta;<sub>T</sub>| = &theta;<sub>0</sub> one of them is horizontal. A
wall at angle &theta; has <i>n</i> = (&minus;sin &theta;, cos &theta;) and <i>t</i> = (cos &theta;, sin &theta;).</p>
<ul>
<li>relative velocities at an impact, with the base moving up at <i>v<sub>b</sub></i>: <i>u<sub>n</sub></i> =
<i>v<sub>n</sub></i> &minus; <i>v<sub>b</sub></i> cos &theta;, <i>u<sub>t</sub></i> = <i>v<sub>t</sub></i> +
<i>R</i> &omega; &minus; <i>v<sub>b</sub></i> sin &theta;</li>
<li>after it: <i>u<sub>n</sub></i>' = &minus;<i>e<sub>n</sub></i> <i>u<sub>n</sub></i>, <i>u<sub>t</sub></i>' =
<i>e<sub>t</sub></i> <i>u<sub>t</sub></i>, <i>v<sub>t</sub></i>' = <i>v<sub>t</sub></i> &minus; (1 &minus;
<i>e<sub>t</sub></i>) <i>u<sub>t</sub></i> / 3, &omega;' = &omega; &minus; 2 (1 &minus; <i>e<sub>t</sub></i>)
<i>u<sub>t</sub></i> / (3 <i>R</i>)</li>
<li><i>e<sub>t</sub></i> follows from |<i>u<sub>t</sub></i>/<i>u<sub>n</sub></i>|, &kappa;, &mu; and
<i>e<sub>n</sub></i>: the tangential spring that sticks and slips during the impact, solved phase by phase</li>
<li>map: the walls are at rest; <i>v<sub>b</sub></i> is that of a sinusoidal base where a disk thrown at a random phase
first meets it, drawn again while the disk would not leave the wall; with <code>base.profile</code> = <code>sawtooth</code>
it is <i>A</i> &omega;<sub>b</sub>, up, at every impact</li>
<li>event-driven: the walls move with the base; the first meeting with either of them is found to rounding; no impact
leaves slower than <code>collision.minimum_normal_velocity</code></li>
<li>molecular dynamics: <i>N</i> = max(<i>k<sub>n</sub></i> &delta; &minus; &gamma;<sub>n</sub> <i>u<sub>n</sub></i>, 0),
&tau; = &minus;&kappa; <i>k<sub>n</sub></i> (&lambda; &minus; &lambda;*) with |&tau;| &le; &mu; <i>N</i>; velocity
Verlet</li>
<li>base driven as a sine: <i>y</i> = <i>A</i> sin(2 &pi; <i>f</i> <i>t</i> + <i>&phi;</i>), &omega;<sub>b</sub> = 2
&pi; <i>f</i></li>
<li>base driven by the inputs: during a communication step it moves on the quintic that continues its displacement,
velocity and acceleration; the quintic ends where the polynomial leads that extrapolates the last values of
<code>base.displacement</code>, <code>base.velocity</code> and <code>base.acceleration_input</code>, of degree five at most</li>
<li>scaled angular velocity: <i>R</i> &lang;&omega;&rang; / (<i>A</i> &omega;<sub>b</sub>), the exact mean over time
since <code>measure.start</code>; its standard error is the scatter of 32 to 64 batches of equal duration</li>
</ul>
<p>Source: G. G. Peraza Mues, Spontaneous rotation in vibrated disk packings, doctoral thesis, Cinvestav M&eacute;rida,
2018, sections 2.3.3, 4.5 and 6.3.</p>
";
