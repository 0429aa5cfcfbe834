//! GeoParquet 1.0 and 1.1: geometries as WKB or as GeoArrow's lists are read, as WKB written.
mod damage;
mod geometries;
mod metadata;
pub(crate) mod reader;
pub(crate) mod writer;
