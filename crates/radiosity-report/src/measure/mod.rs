//! What is measured, and how.
//!
//! ```text
//! solutions, truth, path_tracer, mitsuba  whole solutions against the truth, and path tracing beside them
//! published, left_out, stiff, booleans    tables of the sources, economies, solvers, polygon Booleans
//! error_image                             pictures of a scene and of the errors in it
//! stress, cases                           points along axes of stress, and points known to 34 digits
//! test_scene                              a scene cut in elements: points, emitters, and the exact light between them
//! matrices, rooms                         whole matrices from area to area
//! query                                   what every method is asked, and the exact answers
//! ```
pub(crate) mod booleans;
pub(crate) mod cases;
pub(crate) mod error_image;
pub(crate) mod left_out;
pub(crate) mod matrices;
pub(crate) mod mitsuba;
pub(crate) mod path_tracer;
pub(crate) mod published;
pub(crate) mod query;
pub(crate) mod rooms;
pub(crate) mod solutions;
pub(crate) mod stiff;
pub(crate) mod stress;
pub(crate) mod test_scene;
pub(crate) mod truth;
