//! The diffuse light of a 3D scene, by the radiosity method with exact form factors.
//!
//! A [`Scene`] is a list of one-sided planar [`Patch`]es, each with a reflectance and an emission per band (a band is a
//! colour channel or a wavelength). [`solve()`] cuts the patches into triangular elements (a [`Mesh`]) and exchanges light
//! between them until the error is within the tolerance. The [`Solution`] holds the radiosity of every element in W/m², a
//! [`Ledger`] of the energy and a bound on the algebraic error. A [`Record`] is a solution as it is written to files, pictures
//! and pages.
//!
//! Lengths are in the scene file's unit. Emission is radiance L in W/m²/sr; a patch emits the radiosity E = πL.
//!
//! ```no_run
//! use radiosity::{Quality, Record, io::Source, solve};
//! use std::ops::ControlFlow;
//!
//! let scene = Source::open("room.glb")?.scene()?;
//! let solution = solve(&scene, &Quality::Normal.options(), |progress| {
//!     eprintln!("{:.1e} unshot", progress.unshot);
//!     ControlFlow::Continue(())
//! })?;
//! println!("the discrete system is solved to within {:?} W/m²", solution.bound);
//! let record = Record::new("room.glb", &scene, &solution);
//! let page = radiosity::viewer::page(&record, record.exposure());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | what | where |
//! | --- | --- |
//! | reading scene files, writing results | [`io`]: COLLADA, glTF, View3D |
//! | what will trouble a solution, and its repair | [`inspect`], [`repair()`] |
//! | the scenes of the literature | [`scenes`] |
//! | a solution as it is written, and tables | [`Record`], [`patch_table`], [`element_table`] |
//! | radiosity along a line | [`profile`] |
//! | how far two solutions are from each other | [`compare`] |
//! | colours, pictures, a page | [`expose`], [`picture`], [`viewer`] |
//!
//! [`glam`] and [`formfactor`] are part of this interface: a breaking version of one is a breaking version of this crate.
pub use formfactor;
pub use glam;

mod bodies;
pub mod compare;
mod coplanar;
mod error;
mod escape;
pub mod expose;
mod extent;
mod image_file;
pub mod inspect;
pub mod io;
mod mesh;
pub mod picture;
mod plane;
mod predicates;
pub mod profile;
mod record;
mod recording;
mod repair;
mod scene;
pub mod scenes;
mod sides;
mod solve;
mod spectrum;
mod table;
mod union_find;
pub mod viewer;

pub use error::Error;
pub use mesh::element::{Element, Mesh};
pub use record::{PatchRecord, Record};
pub use recording::packed::Packed;
pub use recording::recorder::Recorder;
pub use recording::{PackedMesh, PackedTiles, Recording, Step, StepKind};
pub use repair::{Repaired, repair, repair_until};
pub use scene::Scene;
pub use scene::asset::Asset;
pub use scene::camera::Camera;
pub use scene::lamp::{Cone, Distribution, Lamp, Rim};
pub use scene::patch::{Origin, Patch};
pub use scene::photometry::Photometry;
pub use scene::sky::{Sky, SkyKind, Sun};
pub use scene::texture::{Image, Texture};
pub use scene::units::Units;
pub use sides::{needed_sides, one_sided};
pub use solve::ledger::Ledger;
pub use solve::norm::Norm;
pub use solve::options::{Method, Options};
pub use solve::progress::{LinkedTiles, Moment, Progress};
pub use solve::quality::Quality;
pub use solve::solution::{Solution, Transfers};
pub use solve::state::{State, StateError};
pub use solve::{solve, solve_from};
pub use table::{element_table, patch_table};
