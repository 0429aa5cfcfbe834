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

/// Brings a job into an engine's own format.
pub type Load = fn(&Job) -> Result<Box<dyn Task>, String>;

/// A library, or a way to use it.
#[derive(Clone, Copy)]
pub struct Engine {
    /// Its name in the tables.
    pub name: &'static str,
    /// Whether it is made for such a job.
    pub fits: fn(&Job) -> bool,
    /// The job in its own format, ready to be timed.
    pub load: Load,
}

const fn for_all(name: &'static str, load: Load) -> Engine {
    Engine { name, fits: |_| true, load }
}

/// The ways to give polycsg its operands.
pub const ROUTES: &[Engine] = &[
    for_all("rings", polycsg::from_rings),
    for_all("rings-boundary", polycsg::boundary),
    for_all("operands", polycsg::from_operands),
    for_all("regions", polycsg::from_regions),
    #[cfg(feature = "geo")]
    Engine { name: "geo-types", fits: Job::is_dissolve, load: polycsg::from_geo },
    Engine { name: "clips", fits: Job::has_common_clip, load: polycsg::clips },
];

/// The other libraries that were compiled in.
pub const PEERS: &[Engine] = &[
    #[cfg(feature = "i_overlay")]
    for_all("i_overlay-i32", i_overlay::load::<i32>),
    #[cfg(feature = "i_overlay")]
    for_all("i_overlay-i64", i_overlay::load::<i64>),
    #[cfg(feature = "geo")]
    for_all("geo", geo::load),
    #[cfg(feature = "clipper2")]
    for_all("clipper2", clipper2::load),
    #[cfg(feature = "clipper2-rust")]
    for_all("clipper2-rust", clipper2_rust::load),
    #[cfg(feature = "polyclip")]
    for_all("polyclip", polyclip::load),
    #[cfg(feature = "geos")]
    for_all("geos", geos::load),
    #[cfg(feature = "geos")]
    Engine { name: "geos-coverage", fits: Job::is_coverage, load: geos::coverage },
    #[cfg(feature = "linesweeper")]
    for_all("linesweeper", linesweeper::load),
    #[cfg(feature = "polyops")]
    for_all("polyops", polyops::load),
];

/// The engine of that name.
pub fn engine(name: &str) -> Option<Engine> {
    ROUTES.iter().chain(PEERS).copied().find(|engine| engine.name == name)
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
