//! What every stage uses: ids, boxes and a hash of points, counted work, threads, classes of ids.

pub(crate) mod corners;
pub(crate) mod hash;
pub(crate) mod id;
pub(crate) mod meter;
pub(crate) mod parts;
pub(crate) mod sort;
pub(crate) mod threads;
pub(crate) mod union_find;
