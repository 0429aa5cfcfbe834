//! Exact form factors (view factors, configuration factors) from a point to a polygon, with occlusion.
pub use glam;
pub use glam::DVec3;

mod complement;
mod cull;
mod differential_area;
mod doubt;
mod enclosure;
mod error;
mod exact;
mod hierarchy;
mod horizon;
mod lambert;
mod polygon;
mod predicates;
mod project;
mod region;
mod twofold;
mod view;
mod visible;

pub use complement::unoccluded_complement;
pub use differential_area::DifferentialArea;
pub use enclosure::Enclosure;
pub use error::Error;
pub use exact::{FormFactor, form_factor, unoccluded};
pub use hierarchy::by_hierarchy;
pub use polycsg::Scratch;
pub use polygon::PlanarPolygon;
pub use visible::{VisiblePart, visible_part};
