//! The equations of the disk on two supports for the documentation page inside the component.

/// HTML fragment.
pub const HTML: &str = r"
<p>A disk of radius <i>R</i> and mass <i>m</i> lies on a left support 1 and a right support 2. The contacts make the angles
&alpha;<sub>1</sub> = &theta;<sub>0</sub> &minus; &theta;<sub>T</sub> and &alpha;<sub>2</sub> = &theta;<sub>0</sub> +
&theta;<sub>T</sub> with gravity.</p>
<ul>
<li><i>n<sub>i</sub></i> = max(<i>k<sub>n</sub></i> &delta;<sub>i</sub> + &gamma;<sub>n</sub> &delta;<sub>i</sub>', 0)
while the disks overlap by &delta;<sub>i</sub></li>
<li>&tau;<sub>i</sub> = &minus;<i>k<sub>t</sub></i> (&lambda;<sub>i</sub> &minus; &lambda;<sub>i</sub>*), |&tau;<sub>i</sub>|
&le; &mu; <i>n<sub>i</sub></i>; &lambda;<sub>i</sub> = <i>R</i>&theta; + <i>R</i>&theta;<sub>i</sub> &minus;
2<i>R</i>&beta;<sub>i</sub>, at a wall <i>R</i>&theta; + <i>d<sub>i</sub></i></li>
<li>stick ends where |&tau;| reaches &mu; <i>n</i>; slip ends where the rate of &lambda;* vanishes; a contact opens where its
force vanishes and closes where the disks touch. Each such instant is found to rounding</li>
<li><i>m</i> <i>x</i>'' = <i>n</i><sub>1</sub> sin &alpha;<sub>1</sub> &minus; <i>n</i><sub>2</sub> sin &alpha;<sub>2</sub> +
&tau;<sub>1</sub> cos &alpha;<sub>1</sub> + &tau;<sub>2</sub> cos &alpha;<sub>2</sub>, <i>m</i> <i>y</i>'' =
<i>n</i><sub>1</sub> cos &alpha;<sub>1</sub> + <i>n</i><sub>2</sub> cos &alpha;<sub>2</sub> &minus; &tau;<sub>1</sub> sin
&alpha;<sub>1</sub> + &tau;<sub>2</sub> sin &alpha;<sub>2</sub> &minus; <i>m g</i>, with the angles of the moment;
(<i>m R</i>&sup2;/2) &theta;'' = <i>R</i> (&tau;<sub>1</sub> + &tau;<sub>2</sub>) + <i>T</i></li>
<li>&Theta; = (&tau;<sub>2</sub> &minus; &tau;<sub>1</sub>) / (2 <i>k<sub>t</sub> R</i>), &delta;&theta; =
&minus;(&tau;<sub>2</sub> + &tau;<sub>1</sub>) / (2 <i>k<sub>t</sub> R</i>)</li>
<li>torque: <code>torque</code> + <code>torque.rate</code> (<i>t</i> &minus; <i>t<sub>c</sub></i>) since the communication
point <i>t<sub>c</sub></i>, or <i>A<sub>e</sub></i> sin(&omega;<sub>e</sub> <i>t</i>)</li>
<li>random supports: <i>x</i>, <i>y</i> and angle of each obey <i>q</i>'' + 2 <i>c</i> &omega;<sub>b</sub> <i>q</i>' +
&omega;<sub>b</sub>&sup2; <i>q</i> = white noise, with &lang;<i>q</i>&sup2;&rang; = <i>A<sub>b</sub></i>&sup2;
(<i>A<sub>b</sub></i>&sup2;/<i>R</i>&sup2; for the angle), in exact steps of <code>chosen_time_step</code></li>
</ul>
<p>Source: G. G. Peraza Mues, Spontaneous rotation in vibrated disk packings, doctoral thesis, Cinvestav M&eacute;rida,
2018, chapters 4 and 5.</p>
";
