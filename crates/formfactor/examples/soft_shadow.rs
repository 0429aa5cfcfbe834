//! A soft shadow by exact form factors, as a grey picture: `cargo run --release -p formfactor --example soft_shadow > shadow.pgm`.
//!
//! A square lamp hangs over a floor, with a frame and a slanting board in between. Each pixel is the form factor from the
//! middle of its piece of floor to the lamp: no sampling, and so no noise and no bands.
use formfactor::{DVec3, DifferentialArea, Enclosure, Error, PlanarPolygon};
use std::io::{self, Write};

const WIDTH: u32 = 480;
const HEIGHT: u32 = 360;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let room = room()?;
    let floor = || (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let factors: Result<Vec<f64>, Error> = floor().map(|(x, y)| at(&room, x, y)).collect();
    let factors = factors?;
    let brightest = factors.iter().copied().fold(0.0, f64::max);
    let pixels: Vec<u8> = factors.iter().map(|factor| grey(factor / brightest)).collect();
    let mut out = io::stdout().lock();
    write!(out, "P5\n{WIDTH} {HEIGHT}\n255\n")?;
    out.write_all(&pixels)?;
    Ok(())
}

/// The lamp, which faces down, a square frame and a board.
fn room() -> Result<Enclosure, Error> {
    let lamp = PlanarPolygon::new([square(0.5, 3.0, -1.0)])?;
    let frame = PlanarPolygon::new([square(0.8, 1.2, 1.0), square(0.5, 1.2, 1.0)])?;
    let board = PlanarPolygon::new([[[0.9, -0.4, 0.2], [1.3, -0.4, 1.0], [1.3, 0.9, 1.0], [0.9, 0.9, 0.2]]])?;
    Ok(Enclosure::new(vec![lamp, frame, board]))
}

/// A square about the axis at some height, counter-clockwise from above for `turn` = 1.
fn square(half: f64, height: f64, turn: f64) -> [[f64; 3]; 4] {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [x * half, turn * y * half, height])
}

/// The form factor from the floor under a pixel to the lamp.
fn at(room: &Enclosure, x: u32, y: u32) -> Result<f64, Error> {
    let scale = 4.0 / f64::from(HEIGHT);
    let along = |i: u32, count: u32| (f64::from(i) + 0.5 - f64::from(count) / 2.0) * scale;
    let from = DifferentialArea::new(DVec3::new(along(x, WIDTH), -along(y, HEIGHT), 0.0), DVec3::Z)?;
    Ok(room.form_factor(&from, 0).value)
}

/// A share of the brightest as a grey of a display with gamma 2.2.
fn grey(share: f64) -> u8 {
    let level = 255.0 * share.clamp(0.0, 1.0).powf(1.0 / 2.2);
    (0..=u8::MAX).find(|grey| f64::from(*grey) + 0.5 >= level).unwrap_or(u8::MAX)
}
