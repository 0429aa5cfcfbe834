//! Approximate methods to compare the exact one with, each as its source defines it, behind one trait: [`Method`].
//!
//! | method | idea | error falls as | weak point |
//! | --- | --- | --- | --- |
//! | [`Disk`] | the target as one disk of its area | never | visibility is ignored; near targets are wrong |
//! | [`Wallace`] | parts as disks, a ray to each | 1/n in n parts | shadow edges: a part is seen or not |
//! | [`Pietrek`] | near parts by the contour sum | 1/n | the same |
//! | [`VisibilityIndex`] | parts split where rays disagree | 1/n or better in n rays per part | what slips between the rays, at any depth |
//! | [`Hemicube`] | an item buffer on five faces | 1/resolution | what is smaller than a cell |
//! | [`Baum`] | near targets by the contour sum on parts that the hemicube shows | 1/divisions, 1/resolution | the same |
//! | [`SinglePlane`] | one plane, cut finer where edges are | square root of the smallest cell or better | what passes below the plane's rim |
//! | [`MonteCarlo`] | cosine-weighted rays | n^-1/2 random, n^-3/4 stratified | none |
//! | [`Paraboloid`] | one image of the hemisphere | 1/resolution | what is smaller than a cell |
//!
//! All methods follow the exact one's definitions: targets are one-sided, occluders two-sided, the polygon that owns dA never
//! blocks. None of them has an error bound.
//!
//! ```
//! use formfactor::approx::{Exact, Hemicube, Method, MonteCarlo, Sampling};
//! use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
//!
//! let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
//! let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
//! let room = Enclosure::new(vec![lamp]);
//! let methods: [&dyn Method; 3] =
//!     [&Exact, &Hemicube::new(128), &MonteCarlo { rays: 4096, sampling: Sampling::Stratified, seed: 1 }];
//! for method in methods {
//!     let row = method.row(&room, &floor, &[0]);
//!     assert!((row[0] - 0.239_456_470_460_8).abs() < 0.01, "{}", method.name());
//! }
//! # Ok::<(), formfactor::Error>(())
//! ```
mod baum;
mod contour;
mod delta;
mod disk;
mod exact;
mod frame;
mod gather;
mod hemicube;
mod method;
mod monte_carlo;
mod paraboloid;
mod parts;
mod pietrek;
mod random;
mod ray;
mod screen;
mod single_plane;
mod visibility_index;
mod wallace;

pub use baum::Baum;
pub use disk::Disk;
pub use exact::Exact;
pub use frame::Rotation;
pub use hemicube::Hemicube;
pub use method::Method;
pub use monte_carlo::{MonteCarlo, Sampling};
pub use paraboloid::Paraboloid;
pub use parts::Division;
pub use pietrek::Pietrek;
pub use single_plane::SinglePlane;
pub use visibility_index::VisibilityIndex;
pub use wallace::Wallace;
