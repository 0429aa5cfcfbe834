//! A map overlay: an island with a lake and an islet in it, cut by parcels and by soils; the areas of the parts.
//!
//! `cargo run -p polycsg --example overlay > overlay.svg`

mod drawing;

use drawing::Sheet;
use polycsg::{Csg, DVec2, Error, FillRule, Region, Scratch};
use std::f64::consts::TAU;

const SIZE: DVec2 = DVec2::new(12.0, 9.0);
const SOILS: [(&str, &str); 4] =
    [("sand", "#f0e442"), ("loam", "#e69f00"), ("clay", "#cc79a7"), ("peat", "#009e73")];

/// A closed shore line around `center`.
fn shore(center: DVec2, radius: f64, waves: f64, corners: u32) -> Vec<DVec2> {
    let point = |i: u32| {
        let angle = f64::from(i) / f64::from(corners) * TAU;
        let swell = 1.0 + 0.16 * (waves * angle).sin() + 0.07 * (3.0 * waves * angle + 1.0).cos();
        center + DVec2::from_angle(angle) * radius * swell * DVec2::new(1.3, 1.0)
    };
    (0..corners).map(point).collect()
}

/// Land, the lake in it and the islet in the lake: three shores, read even-odd.
fn land() -> Result<Region, Error> {
    let lake = DVec2::new(6.8, 4.6);
    let shores = [
        shore(SIZE / 2.0, 3.4, 5.0, 240),
        shore(lake, 1.2, 3.0, 90),
        shore(lake + DVec2::new(0.2, -0.1), 0.4, 2.0, 30),
    ];
    Region::from_rings(shores, FillRule::EvenOdd)
}

/// The band between two wavy lines; neighbours share a line, so that they meet without gap or overlap.
fn soil(index: u32) -> Result<Region, Error> {
    let line = |level: u32| {
        let base = f64::from(level) / 4.0 * SIZE.y;
        (0..=60).map(move |i| {
            let x = f64::from(i) / 60.0 * SIZE.x;
            let bend = if level == 0 || level == 4 { 0.0 } else { 0.5 * (x + f64::from(level)).sin() };
            DVec2::new(x, base + bend)
        })
    };
    let ring: Vec<DVec2> = line(index).chain(line(index + 1).rev()).collect();
    Region::from_rings([ring], FillRule::NonZero)
}

/// Slanted strips across the map.
fn parcel(index: u32) -> Result<Region, Error> {
    let x = f64::from(index) * 1.5 - 2.5;
    let ring = [[x, 0.0], [x + 1.5, 0.0], [x + 4.0, SIZE.y], [x + 2.5, SIZE.y]];
    Region::from_rings([ring], FillRule::NonZero)
}

fn svg() -> Result<String, Error> {
    let mut sheet = Sheet::new(SIZE, 70.0);
    let mut scratch = Scratch::default();
    let land = land()?;
    let mut sum = 0.0;
    for (index, (name, colour)) in (0..).zip(SOILS) {
        let soil = soil(index)?;
        let part = (Csg::from(&land) & Csg::from(&soil)).evaluate_with(&mut scratch);
        sheet.region(&part, &format!("fill:{colour};stroke:#555;stroke-width:.5"));
        sheet.text(DVec2::new(0.2, 0.9 - 0.2 * f64::from(index)), &format!("{name} {:.3}", part.area()));
        sum += part.area();
    }
    sheet.text(DVec2::new(2.0, 0.9), &format!("sum {sum:.12}, land {:.12}", land.area()));
    for index in 0..8 {
        let parcel = parcel(index)?;
        let part = (Csg::from(&land) & Csg::from(&parcel)).evaluate_with(&mut scratch);
        sheet.region(&part, "fill:none;stroke:#222;stroke-width:1.5");
    }
    Ok(sheet.svg())
}

#[expect(clippy::print_stdout, reason = "the drawing is this program's output")]
fn main() -> Result<(), Error> {
    print!("{}", svg()?);
    Ok(())
}
