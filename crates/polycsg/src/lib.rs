//! Exact polygon Booleans on plain `f64` coordinates.
pub use glam;
pub use glam::DVec2;
mod boundary;
mod classify;
mod csg;
mod error;
mod membership;
mod region;
mod scratch;
pub use boundary::{Boundary, BoundaryEdge};
pub use classify::{Interval, classify};
pub use csg::{Csg, FillRule};
pub use error::Error;
pub use membership::Membership;
pub use region::{Location, Polygon, Region};
pub use scratch::Scratch;
