//! Three letters built from disks and bars, filled with stripes, over a shadow: nested expressions and an affine map.
//!
//! `cargo run -p polycsg --example lettering > lettering.svg`

mod drawing;

use drawing::Sheet;
use polycsg::glam::DAffine2;
use polycsg::{Csg, DVec2, Error, FillRule, Region};
use std::f64::consts::TAU;

fn disk(center: DVec2, radius: f64) -> Csg<'static> {
    let corner = |i: u32| center + radius * DVec2::from_angle(f64::from(i) / 96.0 * TAU);
    let ring: Vec<DVec2> = (0..96).map(corner).collect();
    Csg::from_rings([ring], FillRule::NonZero).expect("finite coordinates")
}

fn bar(low: DVec2, high: DVec2) -> Csg<'static> {
    let ring = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    Csg::from_rings([ring], FillRule::NonZero).expect("finite coordinates")
}

fn hoop(center: DVec2, radius: f64) -> Csg<'static> {
    disk(center, radius) - disk(center, radius - 1.0)
}

/// Letters four units high on the base line through `at`.
fn letter_c(at: DVec2) -> Csg<'static> {
    hoop(at + 2.0, 2.0) - bar(at + DVec2::new(2.4, 1.2), at + DVec2::new(4.5, 2.8))
}

fn letter_s(at: DVec2) -> Csg<'static> {
    let (lower, upper) = (at + DVec2::new(1.5, 1.25), at + DVec2::new(1.5, 2.75));
    let open = |corner: DVec2| bar(corner - DVec2::new(1.3, 1.25), corner + DVec2::new(1.3, 1.25));
    (hoop(lower, 1.25) - open(lower + DVec2::new(-1.3, 1.25)))
        | (hoop(upper, 1.25) - open(upper + DVec2::new(1.3, -1.25)))
}

fn letter_g(at: DVec2) -> Csg<'static> {
    letter_c(at) | bar(at + DVec2::new(2.2, 1.2), at + DVec2::new(3.9, 2.1))
}

fn stripes(count: u32) -> Csg<'static> {
    Csg::union((0..count).map(|i| {
        let y = 0.9 + f64::from(i) * 0.5;
        bar(DVec2::new(0.0, y), DVec2::new(14.0, y + 0.28))
    }))
}

fn svg() -> Result<String, Error> {
    let word = Csg::union([
        letter_c(DVec2::new(0.8, 0.8)),
        letter_s(DVec2::new(5.2, 0.8)),
        letter_g(DVec2::new(8.6, 0.8)),
    ]);
    let word: Region = word.evaluate();
    let shifted = word.map_affine(DAffine2::from_translation(DVec2::new(0.22, -0.22)))?;
    let mut sheet = Sheet::new(DVec2::new(13.4, 5.6), 60.0);
    sheet.region(&shifted.difference(&word), "fill:#bbb");
    sheet.region(&(Csg::from(&word) & stripes(9)).evaluate(), "fill:#0072b2");
    sheet.region(&(Csg::from(&word) - stripes(9)).evaluate(), "fill:#56b4e9");
    sheet.region(&word, "fill:none;stroke:#222;stroke-width:2");
    Ok(sheet.svg())
}

#[expect(clippy::print_stdout, reason = "the drawing is this program's output")]
fn main() -> Result<(), Error> {
    print!("{}", svg()?);
    Ok(())
}
