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
    fn vertex(given: DVec3) -> Self {
        Self { between: [given; 2] }
    }

    pub(super) fn cut(between: [DVec3; 2]) -> Self {
        Self { between }
    }

    /// One of several that are rounded to one place: unlike all others, itself too.
    const UNKNOWN: Self = Self { between: [DVec3::NAN; 2] };

    pub(super) fn is_known(self) -> bool {
        !self.between[0].is_nan()
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
        Self { at: given - origin, id: CornerId::vertex(given), deviation, rounding: 0.0 }
    }

    /// The way to another corner: rounded once between vertices as given, which may be far closer together than dA is.
    fn along(&self, end: &Self) -> DVec3 {
        if self.rounding + end.rounding > 0.0 {
            end.at - self.at
        } else {
            end.id.between[0] - self.id.between[0]
        }
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
    pub(super) fn new(start: DVec3, end: DVec3, along: DVec3) -> Self {
        let (a, b) = (along.abs(), start.abs());
        let terms = DVec3::new(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x);
        let errors = ERROR * terms;
        Self { start, end, along, inward: along.cross(start), errors, error: errors.element_sum() }
    }

    /// Counts how far off its line the cuts at its ends may be: that through two vertices as given, or where a plane makes the edge exactly.
    /// Otherwise such an edge is where it is rounded to.
    fn count_cuts(&mut self, [start, end]: [&Corner; 2], is_cut_exactly: bool) {
        let has_line = is_cut_exactly || start.id.line(end.id).is_some();
        if start.rounding + end.rounding > 0.0 && has_line {
            self.errors += (start.rounding + end.rounding) * (size(self.along) + size(self.start));
            self.error = self.errors.element_sum();
        }
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
/// ends, and comes with what its start is. Of corners that coincide the first is taken,
/// and what it is counts as unknown.
pub(super) fn faces(
    corners: &[Corner],
    is_cut_exactly: bool,
    edges: &mut Vec<Edge>,
    ids: &mut Vec<CornerId>,
) {
    let Some(mut before) = corners.last() else { return };
    let (first, mut id) = (ids.len(), before.id);
    for corner in corners {
        let along = before.along(corner);
        if along != DVec3::ZERO {
            let mut edge = Edge::new(before.at, corner.at, along);
            edge.count_cuts([before, corner], is_cut_exactly);
            edges.push(edge);
            ids.push(id);
            (before, id) = (corner, corner.id);
        } else if id != corner.id {
            id = CornerId::UNKNOWN;
        }
    }
    // The last ones are where the first edge starts.
    if let Some(first) = ids.get_mut(first).filter(|_| !id.is_known()) {
        *first = id;
    }
}

/// The same of vertices as given.
pub(super) fn given_faces(
    vertices: impl DoubleEndedIterator<Item = DVec3> + Clone,
    origin: DVec3,
    edges: &mut Vec<Edge>,
    ids: &mut Vec<CornerId>,
) {
    let before = vertices.clone().next_back().into_iter().chain(vertices.clone());
    for (before, vertex) in before.zip(vertices).filter(|(before, vertex)| before != vertex) {
        edges.push(Edge::new(before - origin, vertex - origin, vertex - before));
        ids.push(CornerId::vertex(before));
    }
}

/// How far off the places of cut corners may be.
pub(super) fn rounding(corners: &[Corner]) -> f64 {
    corners.iter().fold(0.0, |largest, corner| greater(largest, corner.rounding))
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
    /// The largest size of a corner, and what roundings of cuts add to it.
    reach: f64,
    /// How far off the place of a cut corner may be, by [`ERROR`]: a plane's error is at least that many sizes of its normal.
    cuts: f64,
    /// Which of all edges are its own: from `first` on.
    first: usize,
    pub(super) kind: Kind,
}

/// What corners are that are no vertices as given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// Of a target: hardly above the horizon.
    #[default]
    Target,
    /// Of an occluder with vertices in a plane: exactly where it passes through the target's plane.
    Flat,
    /// Of one with vertices about a plane: about there.
    Bent,
}

impl Kind {
    pub(super) fn of_occluder(is_flat: bool) -> Self {
        if is_flat { Self::Flat } else { Self::Bent }
    }
}

impl Spread {
    /// Of the cone of those edges that come last, from `first` on, whose cut corners may be so far off.
    pub(super) fn of(edges: &[Edge], first: usize, rounding: f64, kind: Kind) -> Self {
        let edges = &edges[first..];
        let reach = edges.iter().fold(0.0, |reach, edge| greater(reach, size(edge.start)));
        let cuts = rounding / ERROR;
        Self {
            corners: Corners::of(edges.iter().map(|edge| edge.start)),
            reach: reach + cuts,
            cuts,
            first,
            kind,
        }
    }

    /// A bound on the error of how far inside a plane a corner is: coarse, but it costs little.
    pub(super) fn error(&self, plane: &Edge) -> f64 {
        plane.error * self.reach + UNDERFLOW
    }

    /// What the roundings of cuts add to that error.
    pub(super) fn displaced(&self, plane: &Edge) -> f64 {
        plane.error * self.cuts
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
    pub(super) fn push(&mut self, corners: &[Corner], kind: Kind) -> &[Edge] {
        let first = self.edges.len();
        faces(corners, kind == Kind::Flat, &mut self.edges, &mut self.ids);
        self.spreads.push(Spread::of(&self.edges, first, rounding(corners), kind));
        &self.edges[first..]
    }

    /// The same of vertices as given.
    pub(super) fn push_given(
        &mut self,
        vertices: impl DoubleEndedIterator<Item = DVec3> + Clone,
        origin: DVec3,
    ) -> &[Edge] {
        let first = self.edges.len();
        given_faces(vertices, origin, &mut self.edges, &mut self.ids);
        self.spreads.push(Spread::of(&self.edges, first, 0.0, Kind::Flat));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Wherever the list of corners starts, two that are rounded to one place are neither.
    #[test]
    fn corners_at_one_place_are_unknown() {
        let given = |x: f64, y: f64| Corner::given(DVec3::new(x, y, 1.0), DVec3::ZERO, 0.0);
        let twin = |other: f64| {
            let corner = given(0.0, 0.0);
            let id = CornerId::cut([DVec3::new(0.0, 0.0, 1.0), DVec3::new(other, other, 2.0)]);
            Corner { id, rounding: 1e-16, ..corner }
        };
        let mut corners = vec![twin(1.0), twin(2.0), given(0.0, 1.0), given(1.0, 0.0)];
        for _ in 0..corners.len() {
            corners.rotate_left(1);
            let (mut edges, mut ids) = (Vec::new(), vec![CornerId::UNKNOWN]);
            faces(&corners, true, &mut edges, &mut ids);
            let unknown = edges.iter().zip(&ids[1..]).filter(|(_, id)| !id.is_known());
            let starts: Vec<DVec3> = unknown.map(|(edge, _)| edge.start).collect();
            assert_eq!(starts, [DVec3::Z], "{corners:?}");
            assert_eq!(ids.len(), 4);
        }
    }
}
