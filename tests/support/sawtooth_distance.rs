//! Distance of a point from a sawtooth, without anything of the library.

/// Distance of a point from segment a b.
fn to_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (d, q) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let along = ((q[0] * d[0] + q[1] * d[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
    (q[0] - along * d[0]).hypot(q[1] - along * d[1])
}

/// Teeth of F Fig. 5 as two segments and an arc, found by bisection, and nothing of the library.
pub struct Profile {
    width: f64,
    height: f64,
    /// Horizontal place of the apex.
    apex: f64,
    tip: f64,
    centre: [f64; 2],
}

impl Profile {
    pub fn new(width: f64, height: f64, asymmetry: f64, tip: f64) -> Self {
        let apex = asymmetry * width;
        // Depth inside both infinite sides grows down the bisector: find the point `tip` deep.
        let unit = |d: [f64; 2]| [d[0] / d[0].hypot(d[1]), d[1] / d[0].hypot(d[1])];
        let (left, right) = (unit([-apex, -height]), unit([width - apex, -height]));
        let down = unit([left[0] + right[0], left[1] + right[1]]);
        let depth = |s: f64| (s * (down[0] * left[1] - down[1] * left[0])).abs();
        let (mut low, mut high) = (0.0, 2.0 * height);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if depth(middle) < tip {
                low = middle
            } else {
                high = middle
            }
        }
        let centre = [apex + low * down[0], height + low * down[1]];
        Self {
            width,
            height,
            apex,
            tip,
            centre,
        }
    }

    /// Distance of a point above from the whole profile.
    pub fn distance(&self, x: f64, y: f64) -> f64 {
        let x = x.rem_euclid(self.width);
        let mut least = f64::INFINITY;
        for tooth in -2..=2 {
            let shift = f64::from(tooth) * self.width;
            let p = [x - shift, y];
            let c = self.centre;
            let foot = |a: [f64; 2], b: [f64; 2]| {
                let d = [b[0] - a[0], b[1] - a[1]];
                let along = ((c[0] - a[0]) * d[0] + (c[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
                [a[0] + along * d[0], a[1] + along * d[1]]
            };
            let apex = [self.apex, self.height];
            let (left, right) = ([0.0, 0.0], [self.width, 0.0]);
            least = least.min(to_segment(p, left, foot(left, apex)));
            least = least.min(to_segment(p, right, foot(right, apex)));
            least = least.min((p[0] - c[0]).hypot(p[1] - c[1]) - self.tip);
        }
        least
    }
}
