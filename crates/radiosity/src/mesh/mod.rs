//! Elements: the pieces of patches that carry a value each.
//!
//! ```text
//! subdivide    a scene cut into elements by a plan: the stages below, patch by patch
//! plan         how fine to cut what
//! convex       a patch in convex parts
//! cover        convex tiles in triangles that share their vertices
//! conform      elements cut where vertices of others hang in the middle of their sides
//! guests       corners of other patches' tiles on the edges of a patch
//! shadows      lines where the light of strong emitters starts or ceases to be hidden
//! spacing      how long the sides of cells are
//! outline      the polygon around any node of the tree: what a shooter looks like
//! tree         the triangles in the order of a binary tree of zones and lattice cells
//! split        vertices that are not shared across contacts, and the zones between contacts
//! triangulate  constrained Delaunay triangles of the points, those outside dropped
//! divide       a patch's edges and contacts at a spacing, and the points of a lattice of that spacing inside
//! lines        what points inside a patch are kept apart from
//! flat_index   segments and points of a plane, to be found by where they are
//! lattice      equal cells over a patch
//! contacts     lines on which other patches touch a patch: light jumps there
//! frame        a patch in two dimensions, its longest edge along x
//! refusal      why a polygon could not be cut
//! element      the mesh
//! ```
pub(crate) mod conform;
pub(crate) mod contacts;
pub(crate) mod convex;
pub(crate) mod cover;
mod divide;
pub(crate) mod element;
mod flat_index;
pub(crate) mod frame;
pub(crate) mod guests;
pub(crate) mod lattice;
mod lines;
pub(crate) mod outline;
pub(crate) mod plan;
pub(crate) mod refusal;
pub(crate) mod shadows;
mod spacing;
mod split;
pub(crate) mod subdivide;
pub(crate) mod tree;
mod triangulate;

#[cfg(test)]
mod tests;
