//! Draws every stage of a Boolean as SVG on standard output.
//!
//! `cargo run -p polycsg --example stages > crates/polycsg/docs/stages.svg` draws the figure of the docs;
//! with `-- FILE union|intersection|difference|xor` it draws a case of yours. FILE holds one ring a line: `a` or `b`
//! for the operand, then x y x y …; rings are read by the even-odd rule.

use polycsg::{Csg, DVec2, FillRule, Membership, Region, Scratch, classify};
use std::fmt::Write;

type Rings = Vec<Vec<DVec2>>;

/// Side of a panel, and the margin inside it.
const SIDE: f64 = 300.0;
const MARGIN: f64 = 16.0;
const CAPTION: f64 = 26.0;

const STYLE: &str = "<style>text{font:14px sans-serif;fill:#555}.a{stroke:#0072b2}.b{stroke:#d55e00}\
.in{stroke:#888}.out{stroke:#bbb;stroke-dasharray:2 3}.on{stroke:#009e73;stroke-width:3}\
.outer{stroke:#0072b2}.hole{stroke:#d55e00}.edge{fill:none;stroke-width:1.6}</style>\
<defs><marker id=\"arrow\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto\">\
<path d=\"M0 1L7 4L0 7z\" fill=\"context-stroke\"/></marker></defs>";

/// The operands of a picture and the operation between them.
pub(crate) struct Case {
    /// The rings of the first and of the second operand.
    pub(crate) operands: [Rings; 2],
    /// union, intersection, difference or xor.
    pub(crate) operation: String,
}

impl Case {
    /// A frame with an island, minus a ring around a point and a bow-tie. All crossings are doubles.
    pub(crate) fn of_the_docs() -> Case {
        let ring = |points: &[[f64; 2]]| points.iter().map(|&p| DVec2::from(p)).collect::<Vec<_>>();
        let square = |low: f64, high: f64| ring(&[[low, low], [high, low], [high, high], [low, high]]);
        let diamond = |x: f64, y: f64, r: f64| ring(&[[x + r, y], [x, y + r], [x - r, y], [x, y - r]]);
        let frame = vec![square(0.0, 12.0), square(2.0, 10.0), square(4.0, 8.0)];
        let bow_tie = ring(&[[8.5, 0.5], [12.5, 4.5], [12.5, 0.5], [8.5, 4.5]]);
        let cut = vec![diamond(3.0, 9.0, 2.5), diamond(3.0, 9.0, 1.5), bow_tie];
        Case { operands: [frame, cut], operation: "difference".into() }
    }

    fn operand(&self, index: usize) -> Csg<'_> {
        Csg::from_rings(&self.operands[index], FillRule::EvenOdd).expect("finite coordinates")
    }

    fn csg(&self) -> Csg<'_> {
        let (a, b) = (self.operand(0), self.operand(1));
        match self.operation.as_str() {
            "union" => a | b,
            "intersection" => a & b,
            "xor" => a ^ b,
            _ => a - b,
        }
    }

    fn edges(&self) -> impl Iterator<Item = (usize, [DVec2; 2])> + '_ {
        self.operands.iter().enumerate().flat_map(|(operand, rings)| {
            rings.iter().flat_map(move |ring| {
                (0..ring.len()).map(move |i| (operand, [ring[i], ring[(i + 1) % ring.len()]]))
            })
        })
    }
}

/// Maps the plane to the panels' pixels.
struct View {
    low: DVec2,
    scale: f64,
}

impl View {
    fn of(case: &Case) -> View {
        let points = || case.operands.iter().flatten().flatten();
        let low = points().fold(DVec2::MAX, |a, &b| a.min(b));
        let high = points().fold(DVec2::MIN, |a, &b| a.max(b));
        View { low, scale: (SIDE - 2.0 * MARGIN) / (high - low).max_element() }
    }

    fn pixel(&self, p: DVec2) -> (f64, f64) {
        let q = (p - self.low) * self.scale;
        (MARGIN + q.x, SIDE - MARGIN - q.y)
    }

    fn line(&self, class: &str, [a, b]: [DVec2; 2], arrow: bool) -> String {
        let ((x1, y1), (x2, y2)) = (self.pixel(a), self.pixel(b));
        let marker = if arrow { " marker-end=\"url(#arrow)\"" } else { "" };
        format!("<path class=\"edge {class}\" d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\"{marker}/>")
    }

    fn dot(&self, p: DVec2) -> String {
        let (x, y) = self.pixel(p);
        format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"#222\"/>")
    }

    fn outline(&self, ring: &[DVec2]) -> String {
        let points: Vec<String> =
            ring.iter().map(|&p| self.pixel(p)).map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
        format!("M{}z", points.join("L"))
    }
}

/// The whole picture.
pub(crate) fn svg(case: &Case) -> String {
    let view = View::of(case);
    let region = case.csg().evaluate();
    let panels = [
        ("1 edges: operands a and b", edges(case, &view)),
        ("2 contacts: where edges meet", contacts(case, &view)),
        ("3 memberships: in, out, on", memberships(case, &view, &region)),
        ("4 boundary: interior to the left", boundary(case, &view)),
        ("5 rings: outer and holes", rings(&view, &region)),
        ("6 region: by depth", filled(&view, &region)),
    ];
    let (width, height) = (3.0 * SIDE, 2.0 * (SIDE + CAPTION));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">{STYLE}<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for (i, (caption, drawing)) in panels.iter().enumerate() {
        let (x, y) = ((i % 3) as f64 * SIDE, (i / 3) as f64 * (SIDE + CAPTION));
        let baseline = SIDE + 12.0;
        writeln!(svg, "<g transform=\"translate({x} {y})\">{drawing}<text x=\"{MARGIN}\" y=\"{baseline}\">{caption}</text></g>")
            .expect("a string takes all");
    }
    svg + "</svg>\n"
}

fn edges(case: &Case, view: &View) -> String {
    case.edges().map(|(operand, edge)| view.line(["a", "b"][operand], edge, true)).collect()
}

/// Interval ends of every edge against both operands.
fn contacts(case: &Case, view: &View) -> String {
    let regions = [0, 1].map(|i| case.operand(i).evaluate());
    let intervals = case.edges().flat_map(|(_, edge)| {
        regions.iter().flat_map(move |region| classify(edge, region).expect("finite coordinates"))
    });
    let dots: String = intervals.map(|interval| view.dot(interval.start)).collect();
    case.edges().map(|(_, edge)| view.line("in", edge, false)).collect::<String>() + &dots
}

fn memberships(case: &Case, view: &View, region: &Region) -> String {
    let class = |membership| match membership {
        Membership::In => "in",
        Membership::Out => "out",
        Membership::OnPlus | Membership::OnMinus => "on",
    };
    let intervals = case.edges().flat_map(|(_, edge)| classify(edge, region).expect("finite coordinates"));
    intervals.map(|i| view.line(class(i.membership), [i.start, i.end], false)).collect()
}

fn boundary(case: &Case, view: &View) -> String {
    let mut scratch = Scratch::default();
    let csg = case.csg();
    let edges = csg.boundary(&mut scratch).edges();
    edges.map(|edge| view.line(["a", "b"][edge.operand], [edge.start, edge.end], true)).collect()
}

fn rings(view: &View, region: &Region) -> String {
    let draw = |ring: &[DVec2], class: &str| {
        format!("<path class=\"edge {class}\" d=\"{}\"/>{}", view.outline(ring), view.dot(ring[0]))
    };
    region
        .polygons()
        .map(|p| draw(p.outer(), "outer") + &p.holes().map(|hole| draw(hole, "hole")).collect::<String>())
        .collect()
}

fn filled(view: &View, region: &Region) -> String {
    let colours = ["#56b4e9", "#e69f00", "#009e73"];
    let fill = |polygon: polycsg::Polygon<'_>| {
        let rings = std::iter::once(polygon.outer()).chain(polygon.holes());
        let d: String = rings.map(|ring| view.outline(ring)).collect();
        format!("<path fill=\"{}\" stroke=\"#333\" d=\"{d}\"/>", colours[polygon.depth() % colours.len()])
    };
    region.polygons().map(fill).collect()
}

fn read(path: &str, operation: &str) -> Result<Case, String> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{path}: {e}"))?;
    let mut operands: [Rings; 2] = Default::default();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let mut words = line.split_whitespace();
        let operand = match words.next() {
            Some("a") => 0,
            Some("b") => 1,
            _ => return Err(format!("{path}:{}: a ring starts with a or b", number + 1)),
        };
        let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
        let numbers = numbers.map_err(|e| format!("{path}:{}: {e}", number + 1))?;
        operands[operand].push(numbers.chunks_exact(2).map(|p| DVec2::new(p[0], p[1])).collect());
    }
    Ok(Case { operands, operation: operation.into() })
}

#[cfg_attr(test, expect(dead_code, reason = "the figure's test includes this file for `svg` alone"))]
#[expect(clippy::print_stdout, reason = "the drawing is this program's output")]
fn main() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let case = match arguments.as_slice() {
        [] => Case::of_the_docs(),
        [path, operation] => read(path, operation)?,
        _ => return Err("give no arguments, or FILE and union, intersection, difference or xor".into()),
    };
    print!("{}", svg(&case));
    Ok(())
}
