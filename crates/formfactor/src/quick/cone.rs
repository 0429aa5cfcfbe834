//! Convex polygons as dA sees them: cones, bounded by the planes through dA and each edge.
//!
//! ```text
//!    c ______ b       The polygon a b c runs counter-clockwise seen from dA. The plane through dA and the edge from a to b
//!      \     |        has the normal `inward` = (b - a) x (a - dA), toward the polygon: a point p is inside the cone where
//!        \   |        inward . (p - dA) > 0 for all edges.
//!          \ |
//!            a        A sign is trusted where the dot product is larger than a bound on its error: some roundings of the
//!                     sum of its terms' magnitudes. Else the place is `Open`.
//!        dA
//! ```
use super::interval::greater;
use super::lanes::Corners;
use crate::numeric::rounding::ROUNDING;
use glam::DVec3;

/// What a corner is: two that are rounded to one place need not be one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CornerId {
    /// The vertices as given between which a plane cut the edge; twice the same where none did.
    between: [DVec3; 2],
}

impl CornerId {
    pub(super) fn cut(between: [DVec3; 2]) -> Self {
        Self { between }
    }

    /// The vertex as given; none where the polygon was cut.
    pub(super) fn given(self) -> Option<DVec3> {
        let [a, b] = self.between;
        (a == b).then_some(a)
    }

    /// The vertices as given on either side.
    pub(super) fn between(self) -> [DVec3; 2] {
        self.between
    }

    /// Two vertices as given on the line of the edge from here to another corner, in its order; none where a plane made the edge.
    fn line(self, end: Self) -> Option<[DVec3; 2]> {
        match [self.given(), end.given()] {
            [Some(a), Some(b)] => Some([a, b]),
            [Some(a), None] => Some([a, end.beyond(a)?]),
            [None, Some(b)] => Some([self.beyond(b)?, b]),
            [None, None] => None,
        }
    }

    /// Of the edge that was cut here, the end beyond the cut.
    fn beyond(self, end: DVec3) -> Option<DVec3> {
        match self.between {
            [a, b] if a == end => Some(b),
            [a, b] if b == end => Some(a),
            _ => None,
        }
    }
}

/// A vertex of a convex polygon, and how far it may lie from where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Relative to dA, rounded once.
    pub(super) at: DVec3,
    pub(super) id: CornerId,
    pub(super) deviation: f64,
    /// The part of it that is the rounding of a cut.
    pub(super) rounding: f64,
}

impl Corner {
    pub(super) fn given(given: DVec3, origin: DVec3, deviation: f64) -> Self {
        Self { at: given - origin, id: CornerId::cut([given; 2]), deviation, rounding: 0.0 }
    }

    /// The edge to another corner; none where they coincide. Its direction is rounded once between vertices as given, which may be far closer
    /// together than dA is. An edge on a line that is known exactly counts how far off that a cut of it may be.
    fn edge(&self, end: &Self) -> Option<Edge> {
        let (along, off) = match [self.id.given(), end.id.given()] {
            [Some(a), Some(b)] => (b - a, 0.0),
            _ if self.id.line(end.id).is_some() => (end.at - self.at, self.rounding + end.rounding),
            _ => (end.at - self.at, 0.0),
        };
        (along != DVec3::ZERO).then(|| Edge::new(self.at, end.at, along, off))
    }
}

/// An edge as dA sees it, the polygon to its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// Its ends relative to dA, rounded.
    pub(super) start: DVec3,
    pub(super) end: DVec3,
    /// From start to end, rounded once.
    pub(super) along: DVec3,
    /// The normal of its plane through dA, toward the polygon: `along x start`.
    pub(super) inward: DVec3,
    /// A bound on the error of `inward . p`, per component of p, and the sum over the components.
    pub(super) errors: DVec3,
    pub(super) error: f64,
}

/// A component of `inward` has the terms |along_j start_k| + |along_k start_j|. Rounding of both factors, the product and
/// the difference takes less than 4.1 roundings of them, the dot product with a rounded vector less than 4.1 more.
pub(super) const ERROR: f64 = 9.0 * ROUNDING;

/// More than underflow can take from a product of three, for coordinates up to 2^200.
pub(super) const UNDERFLOW: f64 = 1e-240;

/// On which side of a plane a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Inside,
    Outside,
    Open,
}

impl Edge {
    /// One end of it may be off its line by `off`.
    fn new(start: DVec3, end: DVec3, along: DVec3, off: f64) -> Self {
        let (a, b) = (along.abs(), start.abs());
        let terms = DVec3::new(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x);
        let errors = ERROR * terms + off * (size(a) + size(b));
        Self { start, end, along, inward: along.cross(start), errors, error: errors.element_sum() }
    }

    /// A coarser bound on the error of `inward`, which costs less.
    pub(super) fn coarse_error(&self) -> f64 {
        coarse_error(self.along, self.start)
    }

    /// How far inside a point is, given relative to dA, and a bound on the error.
    pub(super) fn depth(&self, point: DVec3) -> (f64, f64) {
        (self.inward.dot(point), self.errors.dot(point.abs()) + UNDERFLOW)
    }

    /// A lower bound on the angle that it subtends: its sine, with sizes that are larger than the lengths.
    pub(super) fn least_angle(&self) -> f64 {
        self.inward.length() / (size(self.start) * size(self.end))
    }

    /// On which side of its plane a point lies.
    pub(super) fn place(&self, point: DVec3) -> Place {
        let (depth, error) = self.depth(point);
        if depth > error {
            Place::Inside
        } else if depth < -error {
            Place::Outside
        } else {
            Place::Open
        }
    }
}

/// A bound on the error of `along x start`, summed over its components.
pub(super) fn coarse_error(along: DVec3, start: DVec3) -> f64 {
    ERROR * size(along) * size(start)
}

/// The size of a vector: the sum of its components' magnitudes, which is cheaper than the length and not less.
pub(super) fn size(v: DVec3) -> f64 {
    v.abs().element_sum()
}

/// Adds the edges of a convex polygon whose corners are counter-clockwise as dA sees them. Each starts where the one before it
/// ends, and comes with what its start is. Of corners that coincide the first is taken.
pub(super) fn faces(
    corners: impl DoubleEndedIterator<Item = Corner> + Clone,
    edges: &mut Vec<Edge>,
    ids: &mut Vec<CornerId>,
) {
    let Some(mut before) = corners.clone().next_back() else { return };
    for corner in corners {
        if let Some(edge) = before.edge(&corner) {
            edges.push(edge);
            ids.push(before.id);
            before = corner;
        }
    }
}

/// The cone of a convex polygon.
#[derive(Clone, Copy, Debug)]
pub(super) struct OneCone<'c> {
    /// Each starts where the one before it ends.
    pub(super) edges: &'c [Edge],
    pub(super) ids: &'c [CornerId],
    pub(super) spread: &'c Spread,
}

impl<'c> OneCone<'c> {
    pub(super) fn new(edges: &'c [Edge], ids: &'c [CornerId], spread: &'c Spread) -> Self {
        Self { edges, ids, spread }
    }

    /// Two vertices as given on the line of an edge, in its order; none where a plane made the edge.
    pub(super) fn line(&self, edge: usize) -> Option<[DVec3; 2]> {
        let [start, end] = self.ends(edge);
        start.line(end)
    }

    /// What the ends of an edge are.
    pub(super) fn ends(&self, edge: usize) -> [CornerId; 2] {
        let next = if edge + 1 == self.ids.len() { 0 } else { edge + 1 };
        [self.ids[edge], self.ids[next]]
    }
}

/// Where the corners of a cone are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spread {
    pub(super) corners: Corners,
    /// The largest size of a corner.
    pub(super) reach: f64,
    /// How far off the place of a cut corner may be.
    rounding: f64,
    /// Which of all edges are its own: from `first` on.
    first: usize,
}

impl Spread {
    /// Of the cone of those edges that come last, from `first` on.
    pub(super) fn of(edges: &[Edge], first: usize, corners: impl Iterator<Item = Corner>) -> Self {
        let edges = &edges[first..];
        let reach = edges.iter().fold(0.0, |reach, edge| greater(reach, size(edge.start)));
        let rounding = corners.fold(0.0, |rounding, corner| greater(rounding, corner.rounding));
        Self { corners: Corners::of(edges.iter().map(|edge| edge.start)), reach, rounding, first }
    }

    /// A bound on the error of how far inside a plane a corner is: coarse, but it costs little.
    pub(super) fn error(&self, plane: &Edge) -> f64 {
        plane.error * self.reach + self.displaced(plane)
    }

    /// What the roundings of cuts add to that error.
    pub(super) fn displaced(&self, plane: &Edge) -> f64 {
        UNDERFLOW + if self.rounding > 0.0 { size(plane.inward) * self.rounding } else { 0.0 }
    }
}

/// The cones of occluders: the edges of all, and where the corners of each are.
#[derive(Debug, Default)]
pub(super) struct Cones {
    edges: Vec<Edge>,
    ids: Vec<CornerId>,
    spreads: Vec<Spread>,
}

impl Cones {
    pub(super) fn clear(&mut self) {
        self.edges.clear();
        self.ids.clear();
        self.spreads.clear();
    }

    /// Adds the cone of a convex polygon whose corners are counter-clockwise as dA sees them, and returns its edges.
    pub(super) fn push(&mut self, corners: impl DoubleEndedIterator<Item = Corner> + Clone) -> &[Edge] {
        let first = self.edges.len();
        faces(corners.clone(), &mut self.edges, &mut self.ids);
        self.spreads.push(Spread::of(&self.edges, first, corners));
        &self.edges[first..]
    }

    pub(super) fn len(&self) -> usize {
        self.spreads.len()
    }

    /// The edges of all cones.
    pub(super) fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The number of the first edge of a cone among all.
    #[inline]
    pub(super) fn first(&self, cone: usize) -> usize {
        self.spreads[cone].first
    }

    #[inline]
    pub(super) fn cone(&self, cone: usize) -> OneCone<'_> {
        let spread = &self.spreads[cone];
        let own = spread.first..spread.first + spread.corners.count;
        OneCone { edges: &self.edges[own.clone()], ids: &self.ids[own], spread }
    }
}
