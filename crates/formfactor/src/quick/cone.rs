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
use crate::numeric::rounding::ROUNDING;
use glam::{DVec2, DVec3, Vec3Swizzles};
use std::ops::Range;

/// A vertex of a convex polygon, and how far it may lie from where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Relative to dA, rounded once.
    pub(super) at: DVec3,
    /// The vertex as given; `None` where the polygon was cut.
    pub(super) given: Option<DVec3>,
    pub(super) deviation: f64,
}

impl Corner {
    /// The way to another corner: rounded once between vertices as given, which may be far closer together than dA is.
    fn along(&self, other: &Self) -> DVec3 {
        match (self.given, other.given) {
            (Some(from), Some(to)) => to - from,
            _ => other.at - self.at,
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
    /// The larger size of the two ends.
    reach: f64,
    /// (|start| + |along|) |along|, in sums of components: no direction turns faster than by this over |inward|.
    pub(super) spread: f64,
    /// Scales dot products of directions to it to at most 1: the inverse square of the larger size.
    pub(super) scale: f64,
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
        let reach = size(start).max(size(end));
        let spread = (size(start) + size(along)) * size(along);
        Self {
            start,
            end,
            along,
            inward: along.cross(start),
            errors,
            error: errors.element_sum(),
            reach,
            spread,
            scale: 1.0 / (reach * reach),
        }
    }

    /// A coarser bound on the error of `inward`, which costs less.
    pub(super) fn coarse_error(&self) -> f64 {
        coarse_error(self.along, self.start)
    }

    /// The side on which both ends of an edge lie for certain, by a coarser bound.
    pub(super) fn side_of(&self, edge: &Edge) -> Option<Place> {
        let (start, end) = (self.inward.dot(edge.start), self.inward.dot(edge.end));
        let error = self.error * edge.reach + UNDERFLOW;
        if start > error && end > error {
            Some(Place::Inside)
        } else if start < -error && end < -error {
            Some(Place::Outside)
        } else {
            None
        }
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

/// How slopes of directions are measured: two of three coordinates, divided by the depth along one vector.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    forward: DVec3,
    /// The size of `forward`.
    size: f64,
    dropped: usize,
}

/// A rectangle of slopes, around the directions to something.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes {
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl Slopes {
    const ALL: Self = Self { low: DVec2::NEG_INFINITY, high: DVec2::INFINITY };

    pub(super) fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
    }
}

impl Frame {
    /// Slopes by the depth along `forward`, the axis `dropped` left out.
    pub(super) fn new(forward: DVec3, dropped: usize) -> Self {
        Self { forward, size: size(forward), dropped }
    }

    /// A small rectangle around the slopes of a direction; everything where it does not lead forward enough.
    ///
    /// From a thousandth of its largest value on, the depth is known within 2^-40 of itself, and the slopes are below a
    /// thousand by the size of `forward`: 1e-9 of that is far more than their error.
    fn slopes(&self, toward: DVec3) -> Slopes {
        let depth = self.forward.dot(toward);
        if depth < 1e-3 * self.size * toward.abs().max_element() {
            return Slopes::ALL;
        }
        let kept = match self.dropped {
            0 => toward.yz(),
            1 => toward.xz(),
            _ => toward.xy(),
        };
        let (slopes, margin) = (kept / depth, DVec2::splat(1e-6 / self.size));
        Slopes { low: slopes - margin, high: slopes + margin }
    }

    /// Adds a rectangle around the slopes of each edge.
    pub(super) fn measure(&self, edges: &[Edge], extents: &mut Vec<Slopes>) {
        let Some(last) = edges.last() else { return };
        let mut around = self.slopes(last.end);
        for edge in edges {
            let next = self.slopes(edge.end);
            extents.push(around.join(next));
            around = next;
        }
    }
}

/// Adds the edges of a convex polygon whose corners are counter-clockwise as dA sees them.
pub(super) fn faces(corners: &[Corner], edges: &mut Vec<Edge>) {
    let Some(mut before) = corners.last() else { return };
    for corner in corners {
        let along = before.along(corner);
        if along != DVec3::ZERO {
            edges.push(Edge::new(before.at, corner.at, along));
        }
        before = corner;
    }
}

/// The cones of occluders: the edges of all, and where those of each end.
#[derive(Debug, Default)]
pub(super) struct Cones {
    edges: Vec<Edge>,
    ends: Vec<usize>,
    edge_extents: Vec<Slopes>,
    extents: Vec<Slopes>,
}

impl Cones {
    pub(super) fn clear(&mut self) {
        self.edges.clear();
        self.ends.clear();
        self.edge_extents.clear();
        self.extents.clear();
    }

    /// Adds the cone of a convex polygon whose corners are counter-clockwise as dA sees them, and returns its edges.
    pub(super) fn push(&mut self, corners: &[Corner]) -> &[Edge] {
        let first = self.edges.len();
        faces(corners, &mut self.edges);
        self.ends.push(self.edges.len());
        &self.edges[first..]
    }

    /// Finds the rectangle of slopes around every edge and every cone.
    pub(super) fn measure(&mut self, frame: &Frame) {
        let mut start = 0;
        for end in &self.ends {
            frame.measure(&self.edges[start..*end], &mut self.edge_extents);
            let extent = self.edge_extents[start..].iter().copied().reduce(Slopes::join);
            self.extents.push(extent.unwrap_or(Slopes::ALL));
            start = *end;
        }
    }

    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    fn range(&self, cone: usize) -> Range<usize> {
        let start = if cone == 0 { 0 } else { self.ends[cone - 1] };
        start..self.ends[cone]
    }

    pub(super) fn edges(&self, cone: usize) -> &[Edge] {
        &self.edges[self.range(cone)]
    }

    pub(super) fn edge_extents(&self, cone: usize) -> &[Slopes] {
        &self.edge_extents[self.range(cone)]
    }

    pub(super) fn extent(&self, cone: usize) -> &Slopes {
        &self.extents[cone]
    }
}
