//! A window behind blinds: each edge of what stays visible in the colour of the shape that it comes from.
//!
//! `cargo run -p polycsg --example provenance > provenance.svg`

mod drawing;

use drawing::Sheet;
use polycsg::{Csg, DVec2, Error, FillRule, Region, Scratch};

const COLOURS: [&str; 6] = ["#222", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"];

fn slat(center: DVec2, angle: f64) -> Result<Region, Error> {
    let corner =
        |along: f64, across: f64| center + DVec2::from_angle(angle).rotate(DVec2::new(along, across));
    Region::from_rings(
        [[corner(-2.6, -0.4), corner(2.6, -0.4), corner(2.6, 0.4), corner(-2.6, 0.4)]],
        FillRule::NonZero,
    )
}

fn svg() -> Result<String, Error> {
    let window = Region::from_rings([[[1.0, 1.0], [7.0, 1.0], [7.0, 7.0], [1.0, 7.0]]], FillRule::NonZero)?;
    let places = [(2.5, 3.0, 0.9), (4.5, 5.0, -0.3), (5.5, 3.5, 1.2), (3.0, 5.5, 0.2), (5.0, 2.0, -0.1)];
    let slats: Result<Vec<Region>, Error> =
        places.iter().map(|&(x, y, angle)| slat(DVec2::new(x, y), angle)).collect();
    let slats = slats?;
    let visible = Csg::from(&window) - Csg::union(&slats);

    let mut sheet = Sheet::new(DVec2::splat(8.0), 70.0);
    slats.iter().for_each(|slat| sheet.region(slat, "fill:#eee;stroke:#ccc"));
    sheet.region(&visible.evaluate(), "fill:#fff8dc");
    // Operands count in their order of appearance: 0 is the window, 1 to 5 are the slats.
    let mut scratch = Scratch::default();
    for edge in visible.boundary(&mut scratch).edges() {
        sheet.line([edge.start, edge.end], &format!("stroke:{};stroke-width:3.5", COLOURS[edge.operand]));
    }
    Ok(sheet.svg())
}

#[expect(clippy::print_stdout, reason = "the drawing is this program's output")]
fn main() -> Result<(), Error> {
    print!("{}", svg()?);
    Ok(())
}
