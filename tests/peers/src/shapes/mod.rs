//! The inputs, made anew in every process that needs them.

mod clips;
mod curves;
mod lattices;
mod layers;
mod maps;
mod pairs;
mod scattered;
mod spikes;
mod topojson;

pub use maps::{fetch, folder, is_fetched};

use crate::job::{Job, Op, Polygon, Ring};
use crate::random::Random;

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
    Family { name: "smooth-intersection", make: |n| Ok(pairs::outlines(Op::Intersection, n, 0.0)) },
    Family { name: "smooth-union", make: |n| Ok(pairs::outlines(Op::Union, n, 0.0)) },
    Family { name: "ragged-intersection", make: |n| Ok(pairs::outlines(Op::Intersection, n, 0.05)) },
    Family { name: "tiles", make: |n| Ok(pairs::tiles(n)) },
    Family { name: "neighbours", make: |n| Ok(pairs::neighbours(n)) },
    Family { name: "clips-smooth", make: |n| Ok(clips::smooth(n)) },
    Family { name: "clips-spiky", make: |n| Ok(clips::spiky(n)) },
    Family { name: "parcels", make: |n| Ok(layers::parcels(n)) },
    Family { name: "skyline", make: |n| Ok(layers::skyline(n)) },
    Family { name: "baseline-random", make: |n| Ok(layers::baseline(n)) },
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

/// The outline r(t) = 1 + Σ a cos(kt + p) over k = 2 … 6, a in [0, 0.25 / k], at n equal angles, each r off by up to `noise`.
fn outline(random: &mut Random, n: usize, noise: f64) -> Ring {
    let waves = [2.0, 3.0, 4.0, 5.0, 6.0]
        .map(|k| (k, random.within(0.0, 0.25 / k), random.within(0.0, std::f64::consts::TAU)));
    polar(n, [0.0, 0.0], |_, t| {
        let smooth: f64 = waves.iter().map(|(k, a, p)| a * (k * t + p).cos()).sum();
        1.0 + smooth + random.within(-noise, noise)
    })
}

/// n points on a closed curve given in polar form: radius at an angle.
fn polar(n: usize, centre: [f64; 2], mut radius: impl FnMut(usize, f64) -> f64) -> Ring {
    let step = std::f64::consts::TAU / n as f64;
    let point = |i: usize| {
        let angle = step * i as f64;
        let r = radius(i, angle);
        [centre[0] + r * angle.cos(), centre[1] + r * angle.sin()]
    };
    (0..n).map(point).collect()
}
