//! Columns of geometries: what they are encoded as, read into features, and written back.
pub(crate) mod encoding;
pub(crate) mod features;
pub(crate) mod read;
pub(crate) mod write;
