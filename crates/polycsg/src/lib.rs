//! Exact polygon Booleans on plain `f64` coordinates.

pub use glam;
pub use glam::DVec2;

mod area;
mod arrangement;
mod below;
mod boundary;
mod classify;
mod contacts;
mod csg;
mod edges;
mod error;
#[cfg(feature = "geo-types")]
mod geo;
mod labels;
mod link;
mod membership;
mod nest;
mod outline;
mod pipeline;
mod predicates;
mod region;
mod repair;
mod rings;
mod scratch;
mod select;
mod strips;
mod truth;
mod union_find;
mod validate;

pub use boundary::{Boundary, BoundaryEdge};
pub use classify::{Interval, classify};
pub use csg::{Csg, FillRule};
pub use error::Error;
pub use membership::Membership;
pub use region::{Invalid, Location, Polygon, Region};
pub use scratch::Scratch;
