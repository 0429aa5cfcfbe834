//! Exact form factors from a point to a polygon, with occlusion, each with an error bound.
//!
//! The **form factor** (also *view factor* or *configuration factor*) F(dA -> A) is the fraction of the power leaving an
//! infinitesimal diffuse area dA that reaches a polygon A directly:
//!
//! F = integral over A of cos(theta) cos(theta') / (pi r^2) V dA,
//!
//! where r is the distance, the thetas are the angles with the two normals, and V is 1 where nothing stands in between
//! and 0 elsewhere.
//!
//! ```
//! use formfactor::{DVec3, DifferentialArea, PlanarPolygon, form_factor};
//!
//! // A floor element that looks up, a 2 x 2 lamp two units above it, and a board in between.
//! let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
//! let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
//! let board = PlanarPolygon::new([[[-0.25, -0.25, 1.0], [0.25, -0.25, 1.0], [0.25, 0.25, 1.0], [-0.25, 0.25, 1.0]]])?;
//!
//! let f = form_factor(&floor, &lamp, &[board]);
//! assert!((f.value - 0.165_978_835_648_252_18).abs() <= f.error_bound);
//! assert!(f.error_bound < 1e-14);
//! # Ok::<(), formfactor::Error>(())
//! ```
//!
//! # Definitions
//!
//! * A **differential area** is a point with a normal. It sees the half-space in front of its *horizon*, the plane through
//!   it across the normal.
//! * A **polygon** is the set of points inside an odd number of its loops. Its *front* is where its loop 0 is
//!   counter-clockwise. As a **target** it is one-sided: a dA on or behind its plane sees 0 of it. F is discontinuous there.
//! * An **occluder** is a polygon of which either side blocks. It *blocks* the ray from dA to a point of the target exactly when it
//!   meets the ray strictly between them (0 < t < 1). One that is coplanar with the target, or whose plane contains dA,
//!   blocks nothing.
//! * An [`Enclosure`] is a set of polygons each of which is a target and occludes the others.
//!
//! # How it works
//!
#![doc = include_str!("../docs/stages.svg")]
//!
//! | stage | what it does |
//! | --- | --- |
//! | `horizon` | cuts off what of the target lies below dA's horizon |
//! | `cull` | drops occluders that cannot matter, and stops when one hides everything: exact decisions |
//! | `project` | clips the others to the space between dA and the target and casts them on the target's plane |
//! | `visible` | subtracts the union of the shadows from the target with `polycsg`: exact topology |
//! | `lambert` | sums 1/(2 pi) beta N . n over the directed edges of what remains, beta the angle an edge subtends and n the unit normal of its plane through dA |
//!
//! The plane's coordinates are two of the three in space, so that a target's vertices keep theirs bit for bit and a shadow
//! that is representable is cast exactly. No tolerance decides anything.
//!
//! **What is not needed is not done.** Before all that a route in plain doubles (`quick`) takes a convex target and convex
//! occluders as cones from dA and clips edges against cones; every sign comes with a bound on its error, and where one is
//! open the stages above decide. The far side of closed convex bodies is dropped, and all of the target's own. An
//! [`Enclosure`] finds occluders in a tree of boxes; [`Stats`] tells what was left out.
//!
//! **Cancelling.** The contour's terms cancel for small, far and sliver targets, down to nothing: an unoccluded target whose
//! sum is known to less than 1e-13 of itself is integrated instead (`cubature`), all terms positive, with a bound on the rule.
//!
//! **From area to area**, [`Enclosure::area_form_factor`] is the mean of point form factors: a double contour integral where
//! nothing stands in between, and else a cubature on cells cut along the lines where the view changes its shape, with an
//! estimate of its error.
//!
//! # Conventions and limits
//!
//! * *Sign.* With R_k the vertices relative to dA, counter-clockwise seen from the target's front, which faces dA,
//!   2 pi F = sum of beta_k N . (R_{k+1} x R_k) / |R_{k+1} x R_k|. Seen along the target's normal the order turns round, and
//!   with it the sign: sources that write R_k x R_{k+1} mean loops that are clockwise from the front.
//! * *Horizon.* The sum is right for what lies above the horizon only: below it cos(theta) is negative and would be
//!   subtracted. An edge along the horizon contributes its angle, as N . n = 1.
//! * *An edge seen end-on* spans no angle and adds nothing. An edge through dA has no plane: the bound is then 1.
//! * *dA on the target's plane* sees 0; just before a point inside the target it sees 1, or 1/2 before an edge: F jumps
//!   there. Values at the vertices of a mesh are limits from one side, or interpolated.
//!
//! # The error bound
//!
//! `error_bound` holds always: |value - exact| <= `error_bound`, where exact is for the doubles as given. It adds up
//!
//! 1. the *arithmetic* of each term of the sum: some roundings of beta;
//! 2. the *blur* of each vertex of the visible boundary: rounding a crossing to doubles turns the direction to it, by at
//!    most that angle, and the turned edges sweep a part of the hemisphere;
//! 3. the blur of each vertex of each shadow, *measured* as the angle between the directions to the vertex and to the
//!    double it was projected to: the union of the shadows errs by no more than all that their edges sweep;
//! 4. for polygons of more than three vertices that are not exactly coplanar, what moving the vertices onto the plane can
//!    change.
//!
//! Where exact arithmetic decides that nothing is seen, the value is exactly 0: a target that turns its back or lies
//! below the horizon, one that a single convex occluder covers, covers whose projections are doubles.
//!
//! # What it is compared with
//!
//! [`approx`] has the methods that sample, from disks to hemicubes and rays, behind one trait.
//!
//! With the feature `rayon` rows and matrices between areas are found by all threads, with the same result for any number.
//!
//! Sources: Barreto, *Cálculo do Fator-de-Forma exato entre Áreas Diferencial e Finita Usando CSG* (2008), for the method;
//! Lambert (1760) for the contour formula; Stark and Riesenfeld (2000) for tracing visible edges; Sparrow (1963) for the double
//! contour integral.
pub use glam;
pub use glam::DVec3;

pub mod approx;

mod area;
mod buffers;
mod complement;
mod error;
mod exact;
mod form_factor;
mod hierarchy;
mod numeric;
mod pipeline;
mod quick;
mod scene;
mod shapes;
mod stats;
mod visible_part;

pub use area::{AreaFormFactor, Row};
pub use complement::unoccluded_complement;
pub use error::Error;
pub use form_factor::FormFactor;
pub use hierarchy::by_hierarchy;
pub use pipeline::{form_factor, unoccluded};
pub use scene::enclosure::Enclosure;
pub use shapes::differential_area::DifferentialArea;
pub use shapes::polygon::PlanarPolygon;
pub use stats::Stats;
pub use visible_part::{VisiblePart, visible_part};
