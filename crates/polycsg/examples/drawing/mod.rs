//! What the drawing examples share: a sheet of SVG with y upwards.

use polycsg::{DVec2, Region};
use std::fmt::Write;

/// A picture of the box from (0, 0) to `size`, in units of `scale` pixels.
pub(crate) struct Sheet {
    size: DVec2,
    scale: f64,
    body: String,
}

impl Sheet {
    pub(crate) fn new(size: DVec2, scale: f64) -> Sheet {
        Sheet { size, scale, body: String::new() }
    }

    fn pixel(&self, p: DVec2) -> String {
        format!("{:.2} {:.2}", p.x * self.scale, (self.size.y - p.y) * self.scale)
    }

    fn ring(&self, ring: &[DVec2]) -> String {
        let points: Vec<String> = ring.iter().map(|&p| self.pixel(p)).collect();
        format!("M{}z", points.join("L"))
    }

    /// One path for each polygon, its holes in it: right whichever way a viewer fills.
    pub(crate) fn region(&mut self, region: &Region, style: &str) {
        for polygon in region.polygons() {
            let rings = std::iter::once(polygon.outer()).chain(polygon.holes());
            let path: String = rings.map(|ring| self.ring(ring)).collect();
            self.add(format_args!("<path style=\"{style}\" d=\"{path}\"/>"));
        }
    }

    #[allow(dead_code, reason = "not every example draws single lines")]
    pub(crate) fn line(&mut self, [a, b]: [DVec2; 2], style: &str) {
        let (a, b) = (self.pixel(a), self.pixel(b));
        self.add(format_args!("<path style=\"fill:none;{style}\" d=\"M{a}L{b}\"/>"));
    }

    #[allow(dead_code, reason = "not every example writes")]
    pub(crate) fn text(&mut self, at: DVec2, text: &str) {
        let (x, y) = (at.x * self.scale, (self.size.y - at.y) * self.scale);
        self.add(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-family=\"sans-serif\" font-size=\"13\">{text}</text>"
        ));
    }

    fn add(&mut self, element: std::fmt::Arguments<'_>) {
        writeln!(self.body, "{element}").expect("a string takes all");
    }

    pub(crate) fn svg(&self) -> String {
        let pixels = self.size * self.scale;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{x}\" height=\"{y}\" viewBox=\"0 0 {x} {y}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n",
            x = pixels.x,
            y = pixels.y,
            body = self.body
        )
    }
}
