//! Exact polygon overlay and dissolve for DataFusion and Ballista: scalar functions and aggregates of
//! [polycsg](https://docs.rs/polycsg), by SedonaDB's names and with PostGIS's rules for NULL and empty geometries.
//!
//! ```
//! use datafusion::prelude::SessionContext;
//! use polycsg_datafusion::Functions;
//! # tokio::runtime::Runtime::new()?.block_on(async {
//! let mut context = SessionContext::new();
//! Functions::default().register(&mut context)?;
//! let square = "X'010300000001000000050000000000000000000000000000000000000000000000000000400000000000000000\
//!     000000000000004000000000000000400000000000000000000000000000004000000000000000000000000000000000'";
//! let found = context.sql(&format!("SELECT st_area(st_union(g, g)) AS area FROM (SELECT {square} AS g)")).await?;
//! let text = datafusion::arrow::util::pretty::pretty_format_batches(&found.collect().await?)?.to_string();
//! assert!(text.contains("4.0"), "{text}");
//! # Ok::<(), datafusion::error::DataFusionError>(()) })?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Geometries
//!
//! A column is well-known binary (`Binary`, `LargeBinary` or `BinaryView`, with or without GeoArrow's metadata; ISO's and PostGIS's
//! dialects are read, ISO's is written) or GeoArrow's polygons, multipolygons or points. Results are multipolygons in the encoding of
//! the first column, with its metadata, so that the system of coordinates stays. Polygons are areas of the plane: z and m are not
//! read, and spherical edges are refused. The rings of a polygon may run in any direction. A polygon or multipolygon that is not
//! valid is the set of points that its rings enclose an odd number of times.
//!
//! # Results
//!
//! All decisions are exact and every vertex is rounded once. Results are *regularised*, the closure of their interior: areas that
//! only touch have an empty intersection. Equal areas that follow one another in a batch, as a constant or one side of a nested-loop
//! join gives them, are read once, and prepared once where they are many.
//!
//! # Joins
//!
//! DataFusion has no spatial join: it asks `ST_Intersects` for every pair, in a nested loop. With the feature `join` the rule
//! `BoxJoin` replaces the nested loop by a join by boxes. The feature takes the engine's crates of physical plans, which the
//! functions do without.
//!
//! # Errors
//!
//! What the types tell is refused when a query is planned. What the values tell is an [`Error`] with the row or the group.
//! Nothing panics, whatever the bytes are.
//!
//! ## `st_intersection`
#![doc = include_str!("../docs/st_intersection.md")]
//! ## `st_union`
#![doc = include_str!("../docs/st_union.md")]
//! ## `st_difference`
#![doc = include_str!("../docs/st_difference.md")]
//! ## `st_symdifference`
#![doc = include_str!("../docs/st_symdifference.md")]
//! ## `st_makevalid`
#![doc = include_str!("../docs/st_makevalid.md")]
//! ## `st_isvalid`
#![doc = include_str!("../docs/st_isvalid.md")]
//! ## `st_isvalidreason`
#![doc = include_str!("../docs/st_isvalidreason.md")]
//! ## `st_area`
#![doc = include_str!("../docs/st_area.md")]
//! ## `st_contains`
#![doc = include_str!("../docs/st_contains.md")]
//! ## `st_intersects`
#![doc = include_str!("../docs/st_intersects.md")]
//! ## `st_union_agg`
#![doc = include_str!("../docs/st_union_agg.md")]
//! ## `st_intersection_agg`
#![doc = include_str!("../docs/st_intersection_agg.md")]

mod aggregate;
mod column;
mod error;
mod functions;
#[cfg(feature = "join")]
mod join;
mod page;
mod scalar;
mod validity;

pub use error::Error;
pub use functions::Functions;
#[cfg(feature = "join")]
pub use join::rule::BoxJoin;
