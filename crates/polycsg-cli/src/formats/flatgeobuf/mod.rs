//! FlatGeobuf.
mod properties;
pub(crate) mod reader;
mod shapes;
pub(crate) mod writer;
