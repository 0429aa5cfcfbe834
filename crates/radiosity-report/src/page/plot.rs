//! Log-log plots as SVG: lines with markers, ticks at decades, and a key that goes beside the plot or, where there is no room, below.
use super::axis::{Axis, power};
use super::escape::escape;
use super::marker::{Sign, marker};
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
    /// Whether its values were measured, or are proven bounds on them.
    pub(crate) sign: Sign,
    pub(crate) name: String,
    /// A second line in the key.
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

/// Of the whole picture and of the frame within it; small enough that labels can be read on a screen of 400 pixels.
const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 392.0;
const LEFT: f64 = 66.0;
const RIGHT: f64 = 424.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 342.0;
/// How many labels there is room for, across and up.
const LABELS: [usize; 2] = [7, 9];
/// What is smaller is drawn here: below the rounding of doubles nothing is told apart.
const LEAST: f64 = 1e-17;

impl Plot<'_> {
    /// The plot with its key; its colours are those of the page that it stands in. A sentence where there is nothing to draw.
    pub(crate) fn html(&self) -> String {
        let title = escape(&self.title);
        let count = self.points().count();
        if self.points().any(|point| point.y > 0.0) {
            let (svg, key) = (self.svg(), self.key());
            format!("<figure class=\"plot\"><figcaption>{title}</figcaption>\n{svg}{key}</figure>\n")
        } else if count == 0 {
            format!("<p class=\"empty\"><b>{title}</b>: nothing was measured.</p>\n")
        } else {
            format!("<p class=\"empty\"><b>{title}</b>: no plot, as all {count} values are 0.</p>\n")
        }
    }

    fn points(&self) -> impl Iterator<Item = &Point> {
        self.curves.iter().flat_map(|curve| &curve.points)
    }

    fn svg(&self) -> String {
        let floors = self.curves.iter().filter_map(|curve| curve.floor);
        let heights = self.points().map(|point| point.y.max(LEAST)).chain(floors).chain(self.arrows());
        let across = Axis::over(self.points().map(|point| point.x), [LEFT, RIGHT]);
        let up = Axis::over(heights, [BOTTOM, TOP]);
        let title = escape(&self.title);
        let mut svg = format!(
            "<svg class=\"plot\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{title}\">\n"
        );
        self.grid(&mut svg, [across, up]);
        self.curves.iter().for_each(|curve| curve.draw(&mut svg, [across, up]));
        svg + "</svg>\n"
    }

    /// Where the arrows of bounds end, so that they lie within the frame.
    fn arrows(&self) -> impl Iterator<Item = f64> {
        let bounds = self.curves.iter().filter(|curve| curve.sign.is_bound());
        bounds.flat_map(|curve| &curve.points).map(|point| point.y.max(LEAST) / 5.0)
    }

    /// Lines at the decades, their names, and what the axes show.
    fn grid(&self, svg: &mut String, [across, up]: [Axis; 2]) {
        for decade in across.ticks(LABELS[0]) {
            let x = across.place(10f64.powi(decade));
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{x:.1} {TOP}V{BOTTOM}\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                BOTTOM + 20.0,
                power(decade)
            );
        }
        for decade in up.ticks(LABELS[1]) {
            let y = up.place(10f64.powi(decade));
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{LEFT} {y:.1}H{RIGHT}\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                LEFT - 6.0,
                y + 4.0,
                power(decade)
            );
        }
        let (middle, centre) = (f64::midpoint(LEFT, RIGHT), f64::midpoint(TOP, BOTTOM));
        let _ = writeln!(
            svg,
            "<text x=\"{middle}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\
             <text transform=\"translate(16 {centre:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            BOTTOM + 42.0,
            escape(self.x),
            escape(self.y)
        );
    }

    /// What the markers mean; proven bounds and measured values under headings of their own where both are drawn.
    fn key(&self) -> String {
        let of = |proven: bool| {
            let here = self.curves.iter().filter(|curve| curve.sign.is_bound() == proven);
            here.map(Curve::entry).collect::<String>()
        };
        let (proven, measured) = (of(true), of(false));
        let entries = if proven.is_empty() {
            measured
        } else {
            format!(
                "<li class=\"kind\">Proven bound: the error is below</li>\n{proven}<li class=\"kind\">Measured error</li>\n{measured}"
            )
        };
        format!("<ul class=\"key\">\n{entries}</ul>\n")
    }
}

impl Curve {
    /// The line with its markers.
    fn draw(&self, svg: &mut String, [across, up]: [Axis; 2]) {
        let at = |point: &Point| (across.place(point.x), up.place(point.y.max(LEAST)));
        let _ = write!(svg, "<g class=\"{}\">", self.sign.class());
        if !self.points.is_empty() {
            let path: Vec<String> =
                self.points.iter().map(at).map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
            let _ = write!(svg, "<path class=\"line\" d=\"M{}\"/>", path.join("L"));
        }
        if let Some(floor) = self.floor {
            let y = up.place(floor);
            let _ = write!(svg, "<path class=\"floor\" d=\"M{LEFT} {y:.1}H{RIGHT}\"/>");
        }
        for point in &self.points {
            let (x, y) = at(point);
            if let Some([low, high]) = point.spread.map(|ends| ends.map(|end| across.place(end))) {
                let _ = write!(svg, "<path class=\"spread\" d=\"M{low:.1} {y:.1}H{high:.1}\"/>");
            }
            let _ = write!(svg, "{}", marker(self.sign, [x, y], &point.hint));
        }
        *svg += "</g>\n";
    }

    /// Its line of the key.
    fn entry(&self) -> String {
        let (class, name, note) = (self.sign.class(), escape(&self.name), escape(&self.note));
        let sign = match self.points.as_slice() {
            [] => "<path class=\"floor\" d=\"M0 10H20\"/>".to_owned(),
            _ => marker(self.sign, [10.0, 10.0], ""),
        };
        let note = if note.is_empty() { note } else { format!("<small>{note}</small>") };
        format!(
            "<li><svg class=\"sign {class}\" viewBox=\"0 0 20 20\">{sign}</svg><span>{name}{note}</span></li>\n"
        )
    }
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
            sign: Sign::Measured(style),
            name: format!("a < {style}"),
            note: "slope -2".into(),
            points: (0..4).map(point).collect(),
            floor: Some(1e-5),
        };
        Plot { title: "T & t".into(), x: "time (s)", y: "error", curves: (0..count).map(curve).collect() }
    }

    fn parsed(html: &str, look: impl Fn(&roxmltree::Document<'_>)) {
        look(&roxmltree::Document::parse(html).unwrap());
    }

    fn has_class(node: &roxmltree::Node<'_, '_>, class: &str) -> bool {
        node.attribute("class").is_some_and(|found| found.split(' ').any(|word| word == class))
    }

    #[test]
    fn a_plot_is_xml_with_a_marker_for_each_point_and_each_entry() {
        parsed(&plot(12).html(), |document| {
            let of = |class: &str| document.descendants().filter(|node| has_class(node, class)).count();
            assert_eq!((of("mark"), of("line"), of("floor"), of("spread")), (12 * 5, 12, 12, 48));
        });
    }

    #[test]
    fn labels_lie_within_the_picture() {
        parsed(&plot(14).html(), |document| {
            let texts = document.descendants().filter(|node| node.has_tag_name("text"));
            let places: Vec<[f64; 2]> = texts
                .map(|node| ["x", "y"].map(|name| node.attribute(name).map(|n| n.parse().unwrap())))
                .filter_map(|[x, y]| Some([x?, y?]))
                .collect();
            assert!(places.iter().all(|[x, y]| *x > 0.0 && *x < WIDTH && *y > 10.0 && *y < HEIGHT));
        });
    }

    #[test]
    fn a_bound_has_a_sign_and_a_heading_of_its_own() {
        let mut plot = plot(3);
        plot.curves[0].sign = Sign::Bound(0);
        parsed(&plot.html(), |document| {
            let of = |class: &str| document.descendants().filter(|node| has_class(node, class)).count();
            // Four points and the entry; two groups of them in the picture and in the key.
            assert_eq!((of("limit"), of("mark"), of("kind")), (5, 10, 2));
            let key: Vec<&str> = document.descendants().filter_map(|node| node.text()).collect();
            let at = |text: &str| key.iter().position(|found| found.starts_with(text)).unwrap();
            assert!(at("Proven bound") < at("a < 0") && at("a < 0") < at("Measured error"));
            assert!(at("Measured error") < at("a < 1"));
        });
        assert!(!self::plot(3).html().contains("Proven"), "nothing to tell apart");
    }

    #[test]
    fn nothing_to_draw_is_a_sentence() {
        let mut plot = plot(2);
        plot.curves.iter_mut().flat_map(|curve| &mut curve.points).for_each(|point| point.y = 0.0);
        let html = plot.html();
        assert!(html.contains("T &amp; t</b>: no plot, as all 8 values are 0.") && !html.contains("<svg"));
        plot.curves.iter_mut().for_each(|curve| curve.points.clear());
        assert!(plot.html().contains("nothing was measured") && !plot.html().contains("<svg"));
    }
}
