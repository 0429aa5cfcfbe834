//! Diffuse light by path tracing, and rooms to try it on: nothing of `radiosity` or `formfactor` is used.
//!
//! [`room`] makes rooms of seven kinds from seeds, [`town`], [`tiled_room`] and [`cut`] scenes of many surfaces, [`mean_irradiance`] traces what a surface of one receives. Sizes are in metres,
//! z is up. A surface sends and receives on its front, where its first loop runs counter-clockwise, and blocks from both sides.
mod boxes;
mod large_scenes;
mod rooms;
mod shapes;
mod surface;
mod tracer;

pub use large_scenes::{cut, tiled_room, town};
pub use rooms::{KINDS, room};
pub use surface::Surface;
pub use tracer::{Estimate, mean_irradiance};

/// Red, green, blue.
pub type Bands = [f64; 3];
