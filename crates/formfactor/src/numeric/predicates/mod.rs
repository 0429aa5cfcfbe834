//! The only place that decides signs. Results are of type `Ordering`; there is no tolerance.
//!
//! ```text
//! height     the height of a point over a plane through three others, or over a horizon: of degree 3
//! crossing   the height of the place where a line crosses another plane: of degree 6
//! ```
mod crossing;
mod height;

pub(crate) use crossing::side_of_crossing;
pub(crate) use height::{Plane, over_horizon, place, turn, turn_in_plane};
