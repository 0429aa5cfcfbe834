//! The inputs, made anew in every process that needs them.

mod curves;
mod lattices;
mod maps;
mod scattered;
mod spikes;
mod topojson;

pub use maps::{fetch, folder, is_fetched};

use crate::job::{Job, Polygon, Ring};

/// A kind of input, in any size.
#[derive(Clone, Copy)]
pub struct Family {
    /// Its name in the tables.
    pub name: &'static str,
    /// The input of a given size; an error when a map is not there.
    pub make: fn(usize) -> Result<Job, String>,
}

/// All kinds of input.
pub const FAMILIES: &[Family] = &[
    Family { name: "square-triangle", make: |_| Ok(scattered::square_and_triangle()) },
    Family { name: "square-rectangles", make: |n| Ok(scattered::square_and_rectangles(n)) },
    Family { name: "octagons", make: |n| Ok(scattered::octagons(n)) },
    Family { name: "stars", make: |n| Ok(spikes::stars(n)) },
    Family { name: "combs", make: |n| Ok(spikes::comb(n)) },
    Family { name: "blobs", make: |n| Ok(curves::blobs(n)) },
    Family { name: "annuli", make: |n| Ok(curves::annuli(n)) },
    Family { name: "holes", make: |n| Ok(curves::holes(n)) },
    Family { name: "grid", make: |n| Ok(lattices::grid(n)) },
    Family { name: "checkers-shifted", make: |n| Ok(lattices::shifted_checkers(n)) },
    Family { name: "checkers-complement", make: |n| Ok(lattices::complementary_checkers(n)) },
    Family { name: "land", make: maps::land },
    Family { name: "countries", make: maps::countries },
    Family { name: "counties", make: maps::counties },
];

/// The family of that name.
pub fn family(name: &str) -> Option<Family> {
    FAMILIES.iter().copied().find(|family| family.name == name)
}

fn shifted(polygons: &[Polygon], by: [f64; 2]) -> Vec<Polygon> {
    let ring = |ring: &Ring| ring.iter().map(|p| [p[0] + by[0], p[1] + by[1]]).collect();
    polygons.iter().map(|polygon| polygon.iter().map(ring).collect()).collect()
}

/// n points on a closed curve given in polar form: radius at an angle.
fn polar(n: usize, centre: [f64; 2], radius: impl Fn(usize, f64) -> f64) -> Ring {
    let step = std::f64::consts::TAU / n as f64;
    let point = |i: usize| {
        let angle = step * i as f64;
        let r = radius(i, angle);
        [centre[0] + r * angle.cos(), centre[1] + r * angle.sin()]
    };
    (0..n).map(point).collect()
}
