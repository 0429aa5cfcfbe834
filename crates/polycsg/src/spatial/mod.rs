//! Indexes over edges in the plane: which of them may meet, and which lies right below a point.

pub(crate) mod chains;
pub(crate) mod chord_tree;
pub(crate) mod ray_shooting;
pub(crate) mod slabs;
pub(crate) mod strips;
