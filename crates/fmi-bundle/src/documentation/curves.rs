//! Curves over time as SVG: panels one above the other, each with the name and unit of what it shows, over one axis of time.
//!
//! Polylines and round ticks are all that the page needs: see `docs/decisions.md` for what a plotting crate would bring.

use std::fmt::Write;

use quick_xml::escape::escape;

/// A curve with what it is.
pub struct Curve {
    /// Name of the variable.
    pub name: String,
    /// Name of its unit; `1` or nothing for pure numbers.
    pub unit: &'static str,
    /// Whether it goes into the model.
    pub input: bool,
    /// A value for each time.
    pub values: Vec<f64>,
}

const WIDTH: f64 = 720.0;
/// Left and right of the panels.
const MARGINS: [f64; 2] = [78.0, 12.0];
/// Height of a panel, and what is above each for its name.
const PANEL: f64 = 92.0;
const TITLE: f64 = 26.0;
/// Below the last panel: ticks and the name of the axis.
const FOOT: f64 = 40.0;

/// The picture. `times` \[s\] ascend.
pub fn draw(times: &[f64], curves: &[Curve], label: &str) -> String {
    let height = curves.len() as f64 * (PANEL + TITLE) + FOOT;
    let mut svg = format!(
        "<svg class=\"curves\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{}\">\n",
        escape(label)
    );
    let time = Axis::of(times, 8, MARGINS[0], WIDTH - MARGINS[1]);
    for (index, curve) in curves.iter().enumerate() {
        let top = index as f64 * (PANEL + TITLE) + TITLE;
        panel(&mut svg, &time, times, curve, top);
    }
    let bottom = height - FOOT;
    for (at, text) in time.ticks() {
        let _ = writeln!(
            svg,
            "<text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
            bottom + 16.0
        );
    }
    let middle = 0.5 * (MARGINS[0] + WIDTH - MARGINS[1]);
    let _ = writeln!(
        svg,
        "<text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">time [s]</text>\n</svg>",
        height - 6.0
    );
    svg
}

fn panel(svg: &mut String, time: &Axis, times: &[f64], curve: &Curve, top: f64) {
    let axis = Axis::of(&curve.values, 4, top + PANEL, top);
    let (left, right) = (time.from, time.to);
    let unit = match curve.unit {
        "" | "1" => String::new(),
        unit => format!(" [{}]", escape(unit)),
    };
    let _ = writeln!(
        svg,
        "<text class=\"name\" x=\"{left}\" y=\"{:.1}\">{}{unit}</text>",
        top - 6.0,
        escape(curve.name.as_str())
    );
    for (at, text) in axis.ticks() {
        let _ = writeln!(
            svg,
            "<path class=\"grid\" d=\"M{left} {at:.1}H{right}\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
            left - 6.0,
            at + 4.0
        );
    }
    for (at, _) in time.ticks() {
        let _ = writeln!(svg, "<path class=\"grid\" d=\"M{at:.1} {top}V{:.1}\"/>", top + PANEL);
    }
    let _ = writeln!(
        svg,
        "<rect class=\"frame\" x=\"{left}\" y=\"{top}\" width=\"{:.1}\" height=\"{PANEL}\"/>",
        right - left
    );
    let points = times.iter().zip(&curve.values);
    let points = points.map(|(t, value)| format!("{:.1},{:.1}", time.place(*t), axis.place(*value)));
    let class = if curve.input { "of-input" } else { "of-output" };
    let _ = writeln!(
        svg,
        "<polyline class=\"{class}\" points=\"{}\"/>",
        points.collect::<Vec<_>>().join(" ")
    );
}

/// A linear axis whose ends are its first and last tick, or the data where ticks would waste room.
struct Axis {
    low: f64,
    high: f64,
    step: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// An axis that shows all `values`, from `from` to `to` in the picture, with about `ticks` ticks.
    fn of(values: &[f64], ticks: u32, from: f64, to: f64) -> Self {
        let finite = || values.iter().copied().filter(|value| value.is_finite());
        let (mut low, mut high) = (
            finite().fold(f64::INFINITY, f64::min),
            finite().fold(f64::NEG_INFINITY, f64::max),
        );
        if low > high {
            (low, high) = (0.0, 0.0);
        }
        // A constant stands in the middle; rounding about a constant is shown as one.
        let size = low.abs().max(high.abs());
        if high - low <= 1e-12 * size || high == low {
            let room = if size == 0.0 { 1.0 } else { 0.5 * size };
            (low, high) = (low - room, high + room);
        }
        let room = 0.04 * (high - low);
        if ticks < 8 {
            (low, high) = (low - room, high + room);
        }
        Self {
            low,
            high,
            step: round_step((high - low) / f64::from(ticks)),
            from,
            to,
        }
    }

    fn place(&self, value: f64) -> f64 {
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Places and texts of the ticks.
    fn ticks(&self) -> impl Iterator<Item = (f64, String)> {
        let first = (self.low / self.step - 1e-9).ceil() as i64;
        let last = (self.high / self.step + 1e-9).floor() as i64;
        (first..=last).map(|count| {
            let value = count as f64 * self.step;
            (self.place(value), tick_text(value, self.step))
        })
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is not below `least`.
fn round_step(least: f64) -> f64 {
    // The power is read off the decimal text: the same on every system.
    let text = format!("{least:e}");
    let exponent = text
        .split('e')
        .nth(1)
        .and_then(|text| text.parse::<i32>().ok())
        .unwrap_or(0);
    let power = |mantissa: u8, exponent: i32| format!("{mantissa}e{exponent}").parse().unwrap_or(least);
    let steps = [(1, exponent), (2, exponent), (5, exponent), (1, exponent + 1)];
    let steps = steps.map(|(mantissa, exponent)| power(mantissa, exponent));
    steps.into_iter().find(|step| *step >= least).unwrap_or(least)
}

/// `value` with as many digits as tell neighbours apart.
fn tick_text(value: f64, step: f64) -> String {
    let exponent = |number: f64| -> i32 {
        let text = format!("{number:e}");
        text.split('e').nth(1).and_then(|text| text.parse().ok()).unwrap_or(0)
    };
    let digits = exponent(step);
    if value == 0.0 {
        return "0".into();
    }
    if (-4..=4).contains(&digits) {
        return format!("{value:.*}", usize::try_from(-digits).unwrap_or(0));
    }
    let decimals = usize::try_from(exponent(value) - digits).unwrap_or(0);
    format!("{value:.decimals$e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_ticks_are_round() {
        for (least, step) in [
            (0.9, 1.0),
            (1.0, 1.0),
            (1.1, 2.0),
            (3.0, 5.0),
            (6.0, 10.0),
            (2.1e-7, 5e-7),
            (0.04, 0.05),
        ] {
            assert_eq!(round_step(least), step, "{least}");
        }
    }

    #[test]
    fn texts_of_ticks_tell_neighbours_apart() {
        assert_eq!(tick_text(0.15, 0.05), "0.15");
        assert_eq!(tick_text(-40.0, 20.0), "-40");
        assert_eq!(tick_text(1.2e-5, 2e-6), "1.2e-5");
        assert_eq!(tick_text(0.0, 2e-6), "0");
    }

    #[test]
    fn the_ends_of_the_data_are_inside_of_the_panel() {
        let axis = Axis::of(&[-3.0, 7.0], 4, 100.0, 0.0);
        assert!(axis.place(-3.0) < 100.0 && axis.place(7.0) > 0.0 && axis.place(-3.0) > axis.place(7.0));
        let places: Vec<f64> = axis.ticks().map(|(place, _)| place).collect();
        assert!(places.len() >= 2 && places.iter().all(|place| (0.0..=100.0).contains(place)));
    }

    #[test]
    fn a_constant_is_a_line_in_the_middle() {
        for constant in [0.0, 5.0, -1e-9] {
            let axis = Axis::of(&[constant; 3], 4, 100.0, 0.0);
            assert!((axis.place(constant) - 50.0).abs() < 1e-9, "{constant}");
        }
    }

    #[test]
    fn every_point_of_a_curve_is_drawn() {
        let curve = Curve {
            name: "a<b".into(),
            unit: "m",
            input: false,
            values: vec![0.0, 1.0, 0.5],
        };
        let svg = draw(&[0.0, 0.1, 0.2], &[curve], "a run");
        let points = svg.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        assert_eq!(points.split(' ').count(), 3);
        assert!(svg.contains("a&lt;b [m]") && svg.contains("time [s]"), "{svg}");
    }
}
