//! Draws the stages of a form factor as SVG on standard output:
//! `cargo run -p formfactor --example factor_stages > crates/formfactor/docs/stages.svg` draws the figure of the docs.
use formfactor::{DVec3, DifferentialArea, Error, PlanarPolygon, glam::DVec2, visible_part};
use polycsg::{Csg, FillRule, Region};
use std::fmt::Write as _;

/// Side of a panel, the margin inside it, and the height of its caption.
const SIDE: f64 = 250.0;
const MARGIN: f64 = 18.0;
const CAPTION: f64 = 26.0;

const STYLE: &str = "<style>text{font:14px sans-serif;fill:#555}path{fill:none;stroke-width:1.6}.to{stroke:#0072b2}\
.by{stroke:#d55e00}.by2{stroke:#cc79a7}.off{stroke:#aaa;stroke-dasharray:3 3}.ray{stroke:#999;stroke-width:0.8}\
.to.full{fill:#0072b222}.by.full{fill:#d55e0044}.by2.full{fill:#cc79a744}.lit{fill:#f0e442aa;stroke:#222}\
.plus{stroke:#0072b2;stroke-width:2.4}.minus{stroke:#d55e00;stroke-width:2.4}.from{stroke:#222}</style>\
<defs><marker id=\"ff-arrow\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"6\" markerHeight=\"6\" orient=\"auto\">\
<path d=\"M0 1L7 4L0 7z\" style=\"fill:context-stroke;stroke:none\"/></marker></defs>";

/// What is drawn: a lamp above dA, a board and a frame that hide some of it, and a board that does not.
struct Scene {
    from: DifferentialArea,
    to: PlanarPolygon,
    hiding: [PlanarPolygon; 2],
    aside: PlanarPolygon,
}

impl Scene {
    fn new() -> Result<Self, Error> {
        let lamp = [[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]];
        let board = [[-0.45, -0.35, 0.8], [0.1, -0.4, 1.1], [-0.15, 0.25, 1.2]];
        let frame = |half: f64| {
            let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
            corners.map(|[x, y]| [x + 0.35, y + 0.3, 1.3])
        };
        let aside = [[1.2, -0.3, 0.9], [1.7, -0.3, 0.9], [1.7, 0.3, 1.2], [1.2, 0.3, 1.2]];
        Ok(Self {
            from: DifferentialArea::new(DVec3::ZERO, DVec3::Z)?,
            to: PlanarPolygon::new([lamp])?,
            hiding: [PlanarPolygon::new([board])?, PlanarPolygon::new([frame(0.4), frame(0.2)])?],
            aside: PlanarPolygon::new([aside])?,
        })
    }

    /// Where a point of space is in the first two panels.
    fn pixel(&self, p: DVec3) -> DVec2 {
        let flat = DVec2::new(p.x + 0.35 * p.y, p.z + 0.25 * p.y);
        DVec2::new(SIDE / 2.0 - 12.0 + 72.0 * flat.x, SIDE - 30.0 - 82.0 * flat.y)
    }

    fn outline(&self, polygon: &PlanarPolygon, class: &str) -> String {
        path(polygon.loops().map(|l| l.iter().map(|p| self.pixel(*p)).collect()), class)
    }

    fn rays(&self) -> String {
        let corners =
            self.to.loops().flatten().map(|corner| vec![self.pixel(DVec3::ZERO), self.pixel(*corner)]);
        path(corners, "ray")
    }

    fn differential_area(&self) -> String {
        let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let square = square.map(|[x, y]| self.pixel(0.12 * DVec3::new(x, y, 0.0))).to_vec();
        let normal = vec![self.pixel(DVec3::ZERO), self.pixel(0.4 * DVec3::Z)];
        let arrow = format!("<path class=\"from\" marker-end=\"url(#ff-arrow)\" d=\"{}\"/>", line(&normal));
        path([square], "from") + &arrow
    }

    /// What one occluder hides of the target.
    fn shadow(&self, occluder: &PlanarPolygon) -> Region {
        let visible = |occluders: &[PlanarPolygon]| visible_part(&self.from, &self.to, occluders);
        visible(&[]).region().difference(visible(std::slice::from_ref(occluder)).region())
    }
}

/// Where a point of the target's plane is in the other panels; seen from below, as dA does.
fn flat(p: DVec2) -> DVec2 {
    DVec2::new(SIDE / 2.0, SIDE / 2.0) + (SIDE / 2.0 - MARGIN) * DVec2::new(p.x, -p.y)
}

fn line(points: &[DVec2]) -> String {
    let points: Vec<String> = points.iter().map(|p| format!("{:.1} {:.1}", p.x, p.y)).collect();
    format!("M{}", points.join("L"))
}

fn path(rings: impl IntoIterator<Item = Vec<DVec2>>, class: &str) -> String {
    let rings: Vec<String> = rings.into_iter().map(|ring| line(&ring) + "z").collect();
    format!("<path class=\"{class}\" fill-rule=\"evenodd\" d=\"{}\"/>", rings.concat())
}

fn region(region: &Region, class: &str) -> String {
    path(region.rings().map(|ring| ring.iter().map(|p| flat(*p)).collect()), class)
}

fn space(scene: &Scene) -> String {
    let Scene { to, hiding: [board, frame], aside, .. } = scene;
    [(to, "to full"), (frame, "by2 full"), (board, "by full"), (aside, "off")]
        .map(|(polygon, class)| scene.outline(polygon, class))
        .concat()
        + &scene.differential_area()
}

fn pyramid(scene: &Scene) -> String {
    let Scene { to, hiding: [board, frame], aside, .. } = scene;
    scene.outline(to, "to")
        + &scene.rays()
        + &scene.outline(frame, "by2")
        + &scene.outline(board, "by")
        + &scene.outline(aside, "off")
        + &scene.differential_area()
}

fn shadows(scene: &Scene) -> String {
    let whole = visible_part(&scene.from, &scene.to, &[]);
    region(whole.region(), "to")
        + &region(&scene.shadow(&scene.hiding[0]), "by full")
        + &region(&scene.shadow(&scene.hiding[1]), "by2 full")
}

fn visible(scene: &Scene) -> String {
    region(visible_part(&scene.from, &scene.to, &scene.hiding).region(), "lit")
}

/// The directed edges of the boundary: those for which N . n is positive add, the others subtract.
fn terms(scene: &Scene) -> Result<String, polycsg::Error> {
    let visible = visible_part(&scene.from, &scene.to, &scene.hiding);
    let rings: Vec<Vec<DVec3>> = visible.rings().collect();
    let set = Csg::from_rings(visible.region().rings(), FillRule::EvenOdd)?;
    let boundary = set.evaluate();
    let mut svg = region(&boundary, "ray");
    for ring in &rings {
        for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let class = if b.cross(*a).dot(scene.from.normal()) > 0.0 { "plus" } else { "minus" };
            let ends = [a, b].map(|p| flat(DVec2::new(p.y, p.x)));
            write!(svg, "<path class=\"{class}\" marker-end=\"url(#ff-arrow)\" d=\"{}\"/>", line(&ends))
                .expect("a string takes everything");
        }
    }
    Ok(svg)
}

/// The whole picture.
pub(crate) fn svg() -> Result<String, Box<dyn std::error::Error>> {
    let scene = Scene::new()?;
    let panels = [
        ("1 dA, target, occluders", space(&scene)),
        ("2 cull: the target's pyramid", pyramid(&scene)),
        ("3 project: shadows", shadows(&scene)),
        ("4 visible: target − shadows", visible(&scene)),
        ("5 sum: edges add or subtract", terms(&scene)?),
    ];
    let (width, height) = (SIDE * 5.0, SIDE + CAPTION);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">{STYLE}<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for (i, (caption, drawing)) in (0u8..).zip(&panels) {
        let x = SIDE * f64::from(i);
        let middle = SIDE / 2.0;
        writeln!(
            svg,
            "<g transform=\"translate({x} {CAPTION})\">{drawing}<text x=\"{middle}\" y=\"-8\" text-anchor=\"middle\">{caption}</text></g>"
        )?;
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

#[cfg_attr(test, expect(dead_code, reason = "the figure's test includes this file for `svg` alone"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use std::io::Write as _;
    std::io::stdout().lock().write_all(svg()?.as_bytes())?;
    Ok(())
}
