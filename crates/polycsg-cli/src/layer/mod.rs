//! Layers: features in batches, with their columns as Arrow has them.
pub(crate) mod areas;
pub(crate) mod batch;
pub(crate) mod columns;
pub(crate) mod crs;
