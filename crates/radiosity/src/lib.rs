//! Scenes in, light out: progressive radiosity whose form factors are exact.
//!
//! A [`Scene`] is a list of one-sided planar [`Patch`]es, each with a reflectance and an emission per band.
//! [`solve()`] cuts the patches into triangular elements ([`Mesh`]) and shoots light until almost none is left
//! unshot; the [`Solution`] holds the radiosity of every element, an energy ledger and a bound on the
//! algebraic error.
//!
//! ```no_run
//! use radiosity::{Options, Record, io::Source, solve};
//! use std::ops::ControlFlow;
//!
//! let scene = Source::open("room.glb")?.scene()?;
//! let solution = solve(&scene, &Options::default(), |progress| {
//!     eprintln!("{:.1e} unshot", progress.unshot);
//!     ControlFlow::Continue(())
//! })?;
//! println!("error of every radiosity at most {:?} W/m²", solution.bound);
//! let record = Record::new("room.glb", &scene, &solution);
//! let page = radiosity::viewer::page(&record, record.exposure());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | what | where |
//! | --- | --- |
//! | scene files in, results out | [`io`]: COLLADA, glTF, View3D |
//! | what is wrong with a scene, and its repair | [`inspect`], [`repair()`] |
//! | the scenes of the literature | [`scenes`] |
//! | a solution as it is written, tables of it | [`Record`], [`patch_table`], [`element_table`] |
//! | how far two solutions are from each other | [`compare`] |
//! | colours, pictures, a page | [`expose`], [`picture`], [`viewer`] |
pub use formfactor;
pub use glam;

pub mod compare;
mod error;
pub mod expose;
mod extent;
mod image_file;
pub mod inspect;
pub mod io;
mod mesh;
pub mod picture;
mod plane;
mod predicates;
mod record;
mod repair;
mod scene;
pub mod scenes;
mod solve;
mod spectrum;
mod table;
mod union_find;
pub mod viewer;

pub use error::Error;
pub use mesh::element::{Element, Mesh};
pub use record::{PatchRecord, Record};
pub use repair::repair;
pub use scene::Scene;
pub use scene::asset::Asset;
pub use scene::camera::Camera;
pub use scene::patch::{Origin, Patch};
pub use scene::texture::{Image, Texture};
pub use solve::ledger::Ledger;
pub use solve::norm::Norm;
pub use solve::options::{Method, Options};
pub use solve::progress::Progress;
pub use solve::quality::Quality;
pub use solve::solution::Solution;
pub use solve::state::{State, StateError};
pub use solve::{solve, solve_from};
pub use table::{element_table, patch_table};
