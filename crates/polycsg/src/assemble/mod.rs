//! From the boundary to the region: rings, and which ring lies in which.

pub(crate) mod link;
pub(crate) mod nest;
pub(crate) mod positive;
#[cfg(test)]
mod tests;
