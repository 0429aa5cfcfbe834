//! Log-log plots as SVG: lines with markers, ticks at decades, a legend beside the plot.
use super::axis::{Axis, power};
use super::escape::escape;
use std::fmt::Write;

/// A plot.
#[derive(Clone, Debug)]
pub(crate) struct Plot<'p> {
    pub(crate) title: String,
    /// What the axes show, with the unit.
    pub(crate) x: &'p str,
    pub(crate) y: &'p str,
    pub(crate) curves: Vec<Curve>,
}

/// A line of a plot.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    /// Which colour and marker; a method has the same ones in all plots.
    pub(crate) style: usize,
    pub(crate) name: String,
    /// A second line in the legend.
    pub(crate) note: String,
    pub(crate) points: Vec<Point>,
    /// A level below which it does not get.
    pub(crate) floor: Option<f64>,
}

/// A marker.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// From where to where x spreads.
    pub(crate) spread: Option<[f64; 2]>,
    /// What is shown when the pointer rests on it.
    pub(crate) hint: String,
}

/// Of the whole picture and of the frame within it.
const WIDTH: f64 = 780.0;
const LEFT: f64 = 74.0;
const RIGHT: f64 = 520.0;
const TOP: f64 = 34.0;
const ENTRY: f64 = 31.0;
/// What is smaller is drawn here: below the rounding of doubles nothing is told apart.
const LEAST: f64 = 1e-17;

impl Plot<'_> {
    /// The plot as an SVG element; its colours are those of the page that it stands in.
    pub(crate) fn svg(&self) -> String {
        let bottom = TOP + (ENTRY * self.curves.len() as f64).max(440.0);
        let height = bottom + 52.0;
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let across = Axis::over(points().map(|point| point.x), [LEFT, RIGHT]);
        let up = Axis::over(points().map(|point| point.y.max(LEAST)), [bottom, TOP]);
        let mut svg = format!(
            "<svg class=\"plot\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{0}\">\
             <text class=\"title\" x=\"{LEFT}\" y=\"20\">{0}</text>\n",
            escape(&self.title)
        );
        self.grid(&mut svg, [across, up], bottom);
        for (row, curve) in self.curves.iter().enumerate() {
            curve.draw(&mut svg, [across, up], TOP + ENTRY * (row as f64 + 0.4));
        }
        svg += "</svg>\n";
        svg
    }

    /// Lines at the decades, their names, and what the axes show.
    fn grid(&self, svg: &mut String, [across, up]: [Axis; 2], bottom: f64) {
        for decade in across.ticks() {
            let x = across.place(10f64.powi(decade));
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{x:.1} {TOP}V{bottom}\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                bottom + 22.0,
                power(decade)
            );
        }
        for decade in up.ticks() {
            let y = up.place(10f64.powi(decade));
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{LEFT} {y:.1}H{RIGHT}\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                LEFT - 7.0,
                y + 4.0,
                power(decade)
            );
        }
        let (middle, centre) = (f64::midpoint(LEFT, RIGHT), f64::midpoint(TOP, bottom));
        let _ = writeln!(
            svg,
            "<text x=\"{middle}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\
             <text transform=\"translate(17 {centre:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            bottom + 43.0,
            escape(self.x),
            escape(self.y)
        );
    }
}

impl Curve {
    /// The line with its markers, and its entry in the legend.
    fn draw(&self, svg: &mut String, [across, up]: [Axis; 2], entry: f64) {
        let style = self.style;
        let at = |point: &Point| (across.place(point.x), up.place(point.y.max(LEAST)));
        let path: Vec<String> = self.points.iter().map(at).map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
        let _ = write!(svg, "<g class=\"s{style}\"><path class=\"line\" d=\"M{}\"/>", path.join("L"));
        if let Some(floor) = self.floor {
            let y = up.place(floor);
            let _ = write!(svg, "<path class=\"floor\" d=\"M{LEFT} {y:.1}H{RIGHT}\"/>");
        }
        for point in &self.points {
            let (x, y) = at(point);
            if let Some([low, high]) = point.spread.map(|ends| ends.map(|end| across.place(end))) {
                let _ = write!(svg, "<path class=\"spread\" d=\"M{low:.1} {y:.1}H{high:.1}\"/>");
            }
            let _ = write!(svg, "{}", marker(style, x, y, &point.hint));
        }
        let (x, line) = (RIGHT + 24.0, entry + 13.0);
        let _ = writeln!(
            svg,
            "{}<text x=\"{:.1}\" y=\"{:.1}\">{}</text><text class=\"note\" x=\"{:.1}\" y=\"{line:.1}\">{}</text></g>",
            marker(style, x, entry - 4.0, ""),
            x + 13.0,
            entry,
            escape(&self.name),
            x + 13.0,
            escape(&self.note)
        );
    }
}

/// One of twelve shapes, filled or open.
fn marker(style: usize, x: f64, y: f64, hint: &str) -> String {
    const SHAPES: [(&str, bool); 12] = [
        ("m-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0z", true),
        ("m-4.5-4.5h9v9h-9z", true),
        ("m0-6l5.5 9.5h-11z", true),
        ("m0 6l5.5-9.5h-11z", true),
        ("m0-6l5 6l-5 6l-5-6z", true),
        ("m-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0z", false),
        ("m-4.5-4.5h9v9h-9z", false),
        ("m0-6l5.5 9.5h-11z", false),
        ("m0 6l5.5-9.5h-11z", false),
        ("m0-6l5 6l-5 6l-5-6z", false),
        ("m-5-5l10 10m0-10l-10 10", false),
        ("m-6 0h12m-6-6v12", false),
    ];
    let (shape, filled) = SHAPES[style % SHAPES.len()];
    let class = if filled { "mark full" } else { "mark" };
    let hint = if hint.is_empty() { String::new() } else { format!("<title>{}</title>", escape(hint)) };
    format!("<path class=\"{class}\" d=\"M{x:.1} {y:.1}{shape}\">{hint}</path>")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(count: usize) -> Plot<'static> {
        let point = |k: i32| Point {
            x: 10f64.powi(k),
            y: 10f64.powi(-2 * k),
            spread: Some([1.0, 10.0]),
            hint: String::new(),
        };
        let curve = |style: usize| Curve {
            style,
            name: format!("a < {style}"),
            note: "slope -2".into(),
            points: (0..4).map(point).collect(),
            floor: Some(1e-5),
        };
        Plot { title: "T & t".into(), x: "time (s)", y: "error", curves: (0..count).map(curve).collect() }
    }

    #[test]
    fn a_plot_is_xml_with_a_marker_for_each_point_and_each_entry() {
        let svg = plot(12).svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let of = |class: &str| {
            let has = |node: &roxmltree::Node<'_, '_>| {
                node.attribute("class").is_some_and(|c| c.split(' ').any(|word| word == class))
            };
            document.descendants().filter(has).count()
        };
        assert_eq!((of("mark"), of("line"), of("floor"), of("spread")), (12 * 5, 12, 12, 48));
    }

    #[test]
    fn nothing_lies_outside_of_the_picture_and_entries_do_not_overlap() {
        let svg = plot(14).svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let view: Vec<f64> = document
            .root_element()
            .attribute("viewBox")
            .unwrap()
            .split(' ')
            .map(|n| n.parse().unwrap())
            .collect();
        let texts = document.descendants().filter(|node| node.has_tag_name("text"));
        let places: Vec<[f64; 2]> = texts
            .map(|node| ["x", "y"].map(|name| node.attribute(name).map(|n| n.parse().unwrap())))
            .filter_map(|[x, y]| Some([x?, y?]))
            .collect();
        assert!(places.iter().all(|[x, y]| *x > 0.0 && *x < view[2] - 100.0 && *y > 10.0 && *y < view[3]));
        let mut legend: Vec<f64> = places.iter().filter(|[x, _]| *x > RIGHT).map(|[_, y]| *y).collect();
        legend.sort_by(f64::total_cmp);
        assert!(legend.len() == 28 && legend.windows(2).all(|pair| pair[1] - pair[0] >= 12.0));
    }
}
