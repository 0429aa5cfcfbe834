//! Exact form factors.
pub use glam;
pub use glam::DVec3;
