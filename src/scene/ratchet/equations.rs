//! The equations of the ratchet for the documentation page inside the component.

/// HTML fragment.
pub const HTML: &str = r"
<p>Disks fly on parabolas in a cell that repeats horizontally and meet in instantaneous impacts: each other, the teeth of
a base that moves vertically, and a ceiling. Positive is to the right, where the left side of a tooth is met first; with
asymmetry below 0.5 that is the steeper one.</p>
<ul>
<li>tooth: width <i>w</i>, height <i>h</i> of the sharp apex, asymmetry <i>a</i> = <i>l</i>/<i>w</i> with <i>l</i> the
horizontal extent of the left side; the tip is rounded by an arc tangent to both sides</li>
<li>normal velocity after an impact: |<i>u<sub>n</sub></i>&#39;| = max(&epsilon; |<i>u<sub>n</sub></i>|,
<i>v<sub>min</sub></i>), &epsilon; = <code>collision.restitution</code>, <i>v<sub>min</sub></i> =
<code>collision.minimum_normal_velocity</code></li>
<li>tangential impulse: what stops the surfaces, at most &mu; times the normal impulse</li>
<li>velocities are relative to the base at the instant of contact</li>
<li><code>transport_velocity</code>: displacement of the disks, periods undone, over the time since
<code>measure.start</code>, or since the last communication point where the input <code>measure.mark</code> had changed;
an exact time average. Its standard error is that of up to 64 batches of the same duration, its spread the standard
deviation over the disks of their own averages; <code>base.mean_power</code> is averaged over the same time</li>
<li><code>layers</code>: <i>n</i> = <i>N</i>/<i>k</i>, <i>k</i> = width of the cell over 2 <code>disk.radius_min</code></li>
<li>base driven by the inputs: during a communication step it moves on the quintic that continues its displacement,
velocity and acceleration; the quintic ends where the polynomial leads that extrapolates the last values of
<code>base.displacement</code>, <code>base.velocity</code> and <code>base.acceleration_input</code>, of degree five at most</li>
<li>base driven as a sine: <i>y</i> = <i>A</i> sin(2 &pi; <i>f</i> <i>t</i> + <i>&phi;</i>);
&Gamma; = <i>A</i> (2 &pi; <i>f</i>)<sup>2</sup> / <i>g</i></li>
</ul>
<p>The first hit on a tooth is found for certain: a parabola below the gap is known at every instant, and the search
steps to its root.</p>
<p>Source: Z. Farkas, P. Tegzes, A. Vukics, T. Vicsek, Transitions in the horizontal transport of vertically vibrated
granular layers, Phys. Rev. E 60, 7022 (1999), sections III, IV and appendices A, B.</p>
";
