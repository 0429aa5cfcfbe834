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
//! # Where to start
//!
//! | you have | you want | call |
//! | --- | --- | --- |
//! | one target, some occluders | the form factor from a point | [`form_factor`](fn@form_factor), [`unoccluded`] |
//! | one target, some occluders | the part of the target that the point sees | [`visible_part`](fn@visible_part) |
//! | two polygons alone | the form factor from polygon to polygon | [`unoccluded_area`] |
//! | many polygons that are targets and occluders | form factors from a point to one, or to all | [`Enclosure::form_factor`], [`Enclosure::row`] |
//! | many polygons | form factors from many points to one of them, or to a part | [`Enclosure::form_factors`], [`Enclosure::form_factors_within`] |
//! | many polygons | whether points see a place | [`Enclosure::sees`], [`Enclosure::each_sees`] |
//! | many polygons | form factors from polygon to polygon | [`Enclosure::area_form_factor`], [`Enclosure::area_matrix`] |
//! | many polygons | form factors from or to parts of polygons | the same, with a [`Part`] |
//! | many polygons | a form factor from polygon to polygon with a bound that holds | [`Enclosure::bounded_area_form_factor`] |
//! | many polygons | matrices row by row, to be resumed or shared among machines; closed, grouped, sparse | [`Enclosure::exchange_row`], [`FactorMatrix`] |
//! | a polygon that hides almost all of the hemisphere | 1 - F with all digits | [`unoccluded_complement`] |
//! | an enclosure | approximate form factors to compare with | [`approx`] |
//!
//! # Definitions
//!
//! * A **differential area** dA is a point with a normal. It sees the half-space in front of its *horizon*, the plane through
//!   the point perpendicular to the normal.
//! * A **polygon** is the set of points inside an odd number of its loops. Its *front* is the side from which its loop 0 runs
//!   counter-clockwise.
//! * A **target** is a polygon as it is seen. It is one-sided: a dA on or behind its plane sees 0 of it. F jumps there.
//! * An **occluder** is a polygon that stands in the way. It is two-sided. It *blocks* the ray from dA to a point of the
//!   target exactly when it meets the ray strictly between them (0 < t < 1). One that is coplanar with the target, or whose
//!   plane contains dA, blocks nothing.
//! * An [`Enclosure`] is a set of polygons. Each of them is a target, and an occluder of the others.
//!
//! # How it works
//!
#![doc = include_str!("../docs/stages.svg")]
//!
//! | stage | what it does |
//! | --- | --- |
//! | `horizon` | cuts off the part of the target below dA's horizon |
//! | `cull` | drops occluders that cannot block, and stops when one hides everything: exact decisions |
//! | `project` | clips the other occluders to the space between dA and the target, and projects them on the target's plane |
//! | `visible` | subtracts the union of these shadows from the target with `polycsg`: exact topology |
//! | `lambert` | sums 1/(2 pi) beta N . n over the directed edges of what remains; beta is the angle that an edge subtends, n the unit normal of its plane through dA |
//!
//! Points of the target's plane keep two of their three coordinates, relative to dA. So directions are rounded by no more than
//! a few roundings, however near or far away, and a shadow whose vertices are doubles is exact. Edges that pass dA are halved
//! where they are nearest, so that no plane through dA turns by more than that. No tolerance decides anything.
//!
//! **The quick route.** Most form factors never get that far. A route in plain doubles (`quick`) clips each edge against the cones
//! that dA spans with the other polygons, or with convex pieces of those that are not convex. Every sign comes with a bound on
//! its error; where one is open, exact turns decide, or the stages above. Of bodies only the near side is looked at. An
//! [`Enclosure`] finds the occluders in a tree of boxes. [`Stats`] counts what was left out.
//!
//! **Cancellation.** The terms of the contour sum cancel for small, far and sliver targets. Where an unoccluded target's sum
//! is known to less than 13 digits, the target is integrated instead (`cubature`): all terms are positive, and the rule's
//! error is bounded.
//!
//! **From area to area.** [`Enclosure::area_form_factor`] is the mean of point form factors. What stands in between is found as
//! convex bodies and plates, coplanar polygons as one. Where nothing does, few nodes of the kernel are enough for what is far
//! apart, a double contour integral for the rest. Elsewhere one of the two is cut along the lines on which edges and vertices seem to
//! meet, so that each cell is integrated over by Gauss's rules of point form factors in plain doubles. The result comes with an
//! estimate of its error: [`AreaFormFactor::error_estimate`] says from what. A [`Tolerance`] says what each
//! entry and each row may err by, and [`Limits`] what they may cost.
//!
//! **From area to area, for certain.** [`Enclosure::bounded_area_form_factor`] is an interval that holds. Nothing in it is estimated: on
//! cells from which all shapes are alike the point form factor is a polynomial with a bound on what it leaves out and on all
//! roundings, and other cells count with all that they might see. An evaluation takes some 50 times as long as one of the
//! estimate's, and at 1e-4 as many are needed.
//!
//! # Conventions and limits
//!
//! * *Sign.* With R_k the vertices relative to dA, counter-clockwise seen from the target's front, which faces dA,
//!   2 pi F = sum of beta_k N . (R_{k+1} x R_k) / |R_{k+1} x R_k|. Sources that write R_k x R_{k+1} mean loops that run
//!   clockwise seen from the front.
//! * *Horizon.* The sum is right only for what lies above the horizon: below it cos(theta) is negative and would be
//!   subtracted. An edge along the horizon contributes its angle, as N . n = 1.
//! * *An edge seen end-on* subtends no angle and adds nothing. An edge through dA has no plane: the bound is then 1.
//! * *dA on the target's plane* sees 0; just before a point inside the target it sees 1, or 1/2 before an edge: F jumps
//!   there. Values at the vertices of a mesh are limits from one side, or interpolated.
//! * *Range.* Coordinates up to 2^200 in magnitude, and extents down to 2^-200. Units are yours: F has none.
//! * *Near and far.* Down to a gap of 1e-14 of a wall's size, and in coordinates of 5e6, values are within 1e-13 of themselves
//!   or 1e-15, bounds below 1e-11. A polygon of more than three vertices that are not exactly coplanar stays uncertain by its
//!   deviation: give tilted ones in map coordinates as triangles, or relative to a point nearby.
//!
//! # The error bound
//!
//! |value - exact| <= `error_bound` always holds, where *exact* is for the doubles as given. The bound adds up
//!
//! 1. the arithmetic of each term of the sum: some roundings of beta;
//! 2. for each vertex of the visible boundary, the angle by which rounding a crossing to doubles may turn the direction to it:
//!    the turned edges sweep a part of the hemisphere;
//! 3. the same for each vertex of each shadow, where that angle is measured: it lies between the directions to the vertex
//!    and to the double that it was projected to. The union of the shadows errs by no more than all that their edges sweep;
//! 4. for polygons of more than three vertices that are not exactly coplanar, what moving the vertices onto the plane can
//!    change. How far they move is the polygon's *deviation*.
//!
//! Where exact arithmetic decides that nothing is seen, the value is exactly 0: for a target that turns its back or lies
//! below the horizon, for one that a single convex occluder covers, and for covers whose projections are doubles.
//!
//! # Features and versions
//!
//! The feature `rayon` finds rows and matrices between areas on all threads, with the same result for any number of them.
//!
//! Points and vectors are those of [`glam`], which is re-exported: use `formfactor::glam` or `formfactor::DVec3` and the
//! versions agree. A new breaking version of glam is a new breaking version of this crate.
//!
//! Sources: Barreto, *Cálculo do Fator-de-Forma exato entre Áreas Diferencial e Finita Usando CSG* (2008), for the method;
//! Lambert (1760) for the contour formula; Makino and Berz (2003) for Taylor models; Stark and Riesenfeld (2000) for tracing visible edges; Sparrow (1963) for the double
//! contour integral.
pub use glam;
pub use glam::DVec3;

pub mod approx;

mod area;
mod buffers;
mod centroid;
mod complement;
mod edge_moment;
mod error;
mod exact;
mod far_centroid;
mod form_factor;
mod hierarchy;
mod matrix;
mod numeric;
mod occluders;
mod pipeline;
mod quick;
mod scene;
mod shapes;
mod stats;
mod visible_part;

pub use area::{AreaFormFactor, BoundedFormFactor, Limits, Part, Row, Tolerance, unoccluded_area};
pub use complement::unoccluded_complement;
pub use error::Error;
pub use form_factor::FormFactor;
pub use hierarchy::by_hierarchy;
pub use matrix::{Closure, Exchange, ExchangeRow, Factor, FactorMatrix};
pub use pipeline::{form_factor, unoccluded};
pub use scene::blockers::Blockers;
pub use scene::enclosure::Enclosure;
pub use shapes::differential_area::DifferentialArea;
pub use shapes::polygon::PlanarPolygon;
pub use stats::Stats;
pub use visible_part::{VisiblePart, visible_part};
