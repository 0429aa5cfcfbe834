//! Polygon Booleans (2D constructive solid geometry) on plain `f64` coordinates: union, intersection, difference,
//! symmetric difference, and any expression of them.
//!
//! # Definitions
//!
//! - A **ring** is a closed chain of points. A [`FillRule`] says which points raw rings enclose.
//! - A **region** ([`Region`]) is a set of points, stored by its boundary: polygons with holes, islands in the holes, and so
//!   on. It is regularised: the closure of its interior, so it has no stray edges or points.
//! - An **edge** is an input segment; **sub-edges** are its pieces between neighbouring contacts.
//! - The **membership** ([`Membership`]) of a directed sub-edge in a set says which of its two sides lie inside: IN, OUT,
//!   ON+ (interior to the left) or ON− (interior to the right). A Boolean acts on each side by itself.
//! - The **boundary** ([`Boundary`]) of a set consists of the sub-edges that are ON, directed with the interior to the left.
//!
//! # Promises
//!
//! - *Every topological decision is exact*, for every finite `f64`: subnormal, huge, nearly collinear or thousandfold
//!   coincident. There is no tolerance and no grid.
//! - *A result is always valid*: rings are simple and meet one another in common vertices only, outer rings run
//!   counter-clockwise and holes clockwise, and holes and islands are nested correctly. So every operation takes every result.
//! - *Input vertices that survive come back bit for bit* (`-0.0` as `0.0`). A crossing is rounded once, to nearest. Where
//!   that would make edges meet, they are repaired, by moves of the size of that rounding. This may close a needle that is
//!   narrower than the move, and a tip of it then vanishes with the area around it: an input vertex is kept or gone, never moved.
//! - *Results do not depend on* the order of operands and rings, on where a ring starts, or on directions that the rule does not
//!   read: of any ring under the even-odd rule, of all rings of an operand together under the non-zero rule.
//! - NaN and infinity are the only errors, apart from a limit that the caller may set.
//!
//! ```
//! use polycsg::{FillRule, Region};
//! let square = |low: f64, high: f64| {
//!     Region::from_rings([[[low, low], [high, low], [high, high], [low, high]]], FillRule::NonZero)
//! };
//! let (a, b) = (square(0.0, 4.0)?, square(1.0, 3.0)?);
//! let frame = a.difference(&b);
//! assert_eq!(frame.area(), 12.0);
//! let polygon = frame.polygons().next().expect("a frame");
//! assert_eq!((polygon.outer().len(), polygon.holes().count()), (4, 1));
//! # Ok::<(), polycsg::Error>(())
//! ```
//!
//! # Which call
//!
//! | task | call |
//! | --- | --- |
//! | raw rings, made valid | [`Region::from_rings`] |
//! | why polygons are not valid as they are | [`flaw`] |
//! | two regions | [`Region::union`], [`intersection`](Region::intersection), [`difference`](Region::difference), [`symmetric_difference`](Region::symmetric_difference) |
//! | many operands, nested expressions, raw rings as operands | [`Csg`], then [`evaluate`](Csg::evaluate) |
//! | many small jobs | [`Csg::evaluate_with`] with one [`Scratch`]; on threads, `Csg::evaluate_all` |
//! | untrusted input, which may have more crossings than fit in memory | [`Csg::try_evaluate_with`] |
//! | only the area, or whether anything is left; which operand an edge comes from | [`Csg::boundary`] |
//! | many regions clipped by one, many questions about one | [`PreparedRegion`] |
//! | whether a region contains or meets another one | [`Region::contains`], [`Region::intersects`] |
//! | where a point lies, how a segment lies | [`Region::locate`], [`classify`] |
//! | without the vertices in the middle of straight edges | [`Region::without_collinear_vertices`] |
//! | moved, turned, scaled, mirrored | [`Region::map_affine`] |
//! | triangles | `Region::triangulate` |
//! | files and other crates | the features `serde` and `geo-types` |
//!
//! The crate has no curves, no offsets, and no tolerances that clean dirty input.
//!
//! # How it works
//!
#![doc = include_str!("../docs/stages.svg")]
//!
//! All operands enter one arrangement. Their edges are cut where they meet, exactly. A walk over the sub-edges keeps the
//! winding numbers of all operands; where the expression differs on the two sides of a sub-edge, that sub-edge is boundary.
//! Only then is anything rounded. Expected time O((n + k) log n) for n edges with k contacts. The example `stages` draws this
//! figure, and any case of yours.
//!
//! The method's terms (ON+/ON−, candidate edges, Table 3.1) are those of Barreto, "Cálculo do Fator-de-Forma exato entre
//! Áreas Diferencial e Finita Usando CSG", UFC, 2008, chapter 3, with its tables completed.
//!
//! # Features
//!
//! - `geo-types`: conversions from and to `geo_types::{Polygon, MultiPolygon}`, which expressions also take as they are.
//! - `rayon`: threads inside one job of 50 000 edges or more, over many jobs by
//!   [`Csg::evaluate_all`](Csg#method.evaluate_all), and over many clips by [`PreparedRegion::clip_all`]. The results have the same bits as on one thread.
//! - `serde`: a [`Region`] as nested sequences of coordinates, checked when it is read.
//! - `triangulate`: [`Region::triangulate`](Region#method.triangulate), constrained Delaunay triangles.
//!
//! None is on by default.
//!
//! Points are [`glam::DVec2`], and [`glam`] is re-exported here. It is part of the interface, so a new incompatible version of
//! glam means a breaking release of this crate.

pub use glam;
pub use glam::DVec2;

mod affine;
mod arrangement;
mod assemble;
mod base;
mod batch;
mod boundary;
mod classify;
mod contacts;
mod edges;
mod error;
mod evaluate;
mod expression;
mod flaw;
#[cfg(fuzzing)]
#[doc(hidden)]
pub mod fuzzing;
#[cfg(feature = "geo-types")]
mod geo;
mod limits;
mod pipeline;
mod predicates;
mod region;
mod relate;
#[cfg(feature = "serde")]
mod serde;
mod spatial;
#[cfg(feature = "triangulate")]
mod triangulate;
mod validate;

pub use boundary::{Boundary, BoundaryEdge};
pub use classify::{Interval, classify};
pub use error::Error;
pub use expression::csg::{Csg, FillRule};
pub use flaw::{Flaw, flaw};
pub use limits::Limits;
pub use pipeline::scratch::Scratch;
pub use region::membership::Membership;
pub use region::prepared::PreparedRegion;
pub use region::{Invalid, Location, Polygon, Region};
