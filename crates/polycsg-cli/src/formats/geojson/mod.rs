//! GeoJSON, read feature by feature in two passes: the first one finds the columns.
mod collection;
mod feature;
pub(crate) mod reader;
mod schema;
pub(crate) mod writer;
