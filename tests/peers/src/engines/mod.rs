//! The libraries, each fed in its own format.
//!
//! What a call starts from is prepared beforehand: polygons in the types that the library takes, integers where it works on
//! integers, copies where it consumes its input. Timed are reading those, the Boolean, and building and dropping the
//! library's own result.

#[cfg(feature = "clipper2")]
mod clipper2;
#[cfg(feature = "clipper2-rust")]
mod clipper2_rust;
#[cfg(feature = "geo")]
mod geo;
#[cfg(feature = "geos")]
mod geos;
#[cfg(feature = "i_overlay")]
mod i_overlay;
#[cfg(feature = "linesweeper")]
mod linesweeper;
#[cfg(feature = "polyclip")]
mod polyclip;
mod polycsg;
#[cfg(feature = "polyops")]
mod polyops;
mod task;

pub use task::{Outcome, Task};

use crate::job::Job;

/// A library, or a way to use it.
#[derive(Clone, Copy)]
pub struct Engine {
    /// Its name in the tables.
    pub name: &'static str,
    /// The job in its own format, ready to be timed.
    pub load: fn(&Job) -> Result<Box<dyn Task>, String>,
}

/// polycsg from raw rings; the column that the ratios are about.
pub const POLYCSG: Engine = Engine { name: "polycsg", load: polycsg::from_rings };

/// polycsg from raw rings, stopping at the boundary.
pub const POLYCSG_BOUNDARY: Engine = Engine { name: "polycsg-boundary", load: polycsg::boundary };

/// polycsg from regions that were evaluated before.
pub const POLYCSG_REGIONS: Engine = Engine { name: "polycsg-regions", load: polycsg::from_regions };

/// polycsg from regions, stopping at the boundary.
pub const POLYCSG_REGIONS_BOUNDARY: Engine =
    Engine { name: "polycsg-regions-boundary", load: polycsg::boundary_of_regions };

/// The other libraries that were compiled in.
pub const PEERS: &[Engine] = &[
    #[cfg(feature = "i_overlay")]
    Engine { name: "i_overlay-i32", load: i_overlay::load::<i32> },
    #[cfg(feature = "i_overlay")]
    Engine { name: "i_overlay-i64", load: i_overlay::load::<i64> },
    #[cfg(feature = "geo")]
    Engine { name: "geo", load: geo::load },
    #[cfg(feature = "clipper2")]
    Engine { name: "clipper2", load: clipper2::load },
    #[cfg(feature = "clipper2-rust")]
    Engine { name: "clipper2-rust", load: clipper2_rust::load },
    #[cfg(feature = "polyclip")]
    Engine { name: "polyclip", load: polyclip::load },
    #[cfg(feature = "geos")]
    Engine { name: "geos", load: geos::load },
    #[cfg(feature = "linesweeper")]
    Engine { name: "linesweeper", load: linesweeper::load },
    #[cfg(feature = "polyops")]
    Engine { name: "polyops", load: polyops::load },
];

/// The engine of that name.
pub fn engine(name: &str) -> Option<Engine> {
    let ours = [POLYCSG, POLYCSG_BOUNDARY, POLYCSG_REGIONS, POLYCSG_REGIONS_BOUNDARY];
    ours.into_iter().chain(PEERS.iter().copied()).find(|engine| engine.name == name)
}

/// What coordinates are multiplied by for libraries on integers: a power of two that brings the largest near 2^38,
/// inside of what polyclip allows (2^40) and where Clipper2's products in doubles still tell neighbours apart.
#[cfg(any(feature = "clipper2", feature = "clipper2-rust", feature = "polyclip"))]
fn integer_scale(job: &Job) -> f64 {
    (38.0 - job.extent().max(f64::MIN_POSITIVE).log2().ceil()).exp2()
}

#[cfg(any(feature = "clipper2-rust", feature = "polyclip"))]
#[expect(clippy::cast_possible_truncation, reason = "scaled to less than 2^39")]
fn integer(c: f64, scale: f64) -> i64 {
    (c * scale).round() as i64
}
