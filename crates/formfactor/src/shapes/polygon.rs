//! Planar polygons: loops with holes, and the plane that they share.
use super::plane::{OF_PARTS, PLANARITY, deviation, kept_axes, newell, plane_of};
use super::{convex, loops};
use crate::error::Error;
use crate::numeric::rounding::in_range;
use crate::numeric::{offset::Offset, predicates::Plane};
use exactfloat::DoubleDouble;
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// A planar polygon with holes and islands: the points inside an odd number of its loops.
///
/// Loop 0 runs counter-clockwise seen from the front; the other loops may run either way. As a target a polygon is
/// one-sided, as an occluder two-sided.
///
/// A triangle is exact as given. A polygon of more vertices stands for its vertices moved along the normal onto its plane. It
/// is refused when a vertex lies further off than 64 roundings of its largest coordinate, and what the move changes is part
/// of every `error_bound`.
///
/// ```
/// use formfactor::PlanarPolygon;
/// // A square that faces up, with a square hole.
/// let outer = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 4.0, 1.0], [0.0, 4.0, 1.0]];
/// let hole = [[1.0, 1.0, 1.0], [3.0, 1.0, 1.0], [3.0, 3.0, 1.0], [1.0, 3.0, 1.0]];
/// let frame = PlanarPolygon::new([outer, hole])?;
/// assert_eq!(frame.area(), 12.0);
/// assert_eq!(frame.normal(), formfactor::DVec3::Z);
/// # Ok::<(), formfactor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PlanarPolygon {
    points: Vec<DVec3>,
    /// End of each loop within `points`.
    ends: Vec<usize>,
    plane: Plane,
    normal: DVec3,
    /// The two kept axes, in the order that keeps loop 0 counter-clockwise, and the dropped one.
    axes: [usize; 3],
    /// By how much the dropped coordinate falls per unit of each kept one.
    slopes: [DoubleDouble; 2],
    /// How far a vertex as given may lie from where it stands on the plane: zero for triangles that are no parts.
    deviation: f64,
    convex: bool,
    /// Convex pieces that meet in whole edges, no vertex straight between its neighbours; none where it is one itself, or crosses itself.
    pieces: Vec<Vec<DVec3>>,
    /// The points in the order of their kept coordinates.
    order: Vec<usize>,
}

impl PlanarPolygon {
    /// A polygon from its loops. The first vertex of a loop is not repeated at its end.
    ///
    /// # Errors
    /// See [`Error`]: no loops, too few vertices, coordinates out of range, no area, vertices off the plane.
    pub fn new<L, P>(loops: L) -> Result<Self, Error>
    where
        L: IntoIterator,
        L::Item: AsRef<[P]>,
        P: Copy + Into<DVec3>,
    {
        let (points, ends) = collect(loops)?;
        let outer = &points[..*ends.first().ok_or(Error::NoLoops)?];
        let normal = newell(outer)?;
        let plane = plane_of(outer, normal)?;
        Self::on_plane(points, ends, plane, normal, PLANARITY)
    }

    /// A part of this polygon, on the same plane and facing the same way, whichever way its loops run: its vertices, which rounding may have put off that plane, stand for
    /// those on it. What is decided by the side of the plane is the same for the part and the whole.
    ///
    /// ```
    /// use formfactor::PlanarPolygon;
    /// let wall = PlanarPolygon::new([[[0.0, 0.0, 0.0], [3.0, 0.0, 0.1], [3.0, 2.0, 0.4], [0.0, 2.0, 0.3]]])?;
    /// let third = wall.part([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.1 / 3.0], [1.0, 2.0, 1.0 / 3.0], [0.0, 2.0, 0.3]]])?;
    /// assert_eq!(third.normal(), wall.normal());
    /// assert!((3.0 * third.area() / wall.area() - 1.0).abs() < 1e-15);
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    ///
    /// # Errors
    /// See [`Error`]: no loops, too few vertices, coordinates out of range, no area, vertices off the plane.
    pub fn part<L, P>(&self, loops: L) -> Result<Self, Error>
    where
        L: IntoIterator,
        L::Item: AsRef<[P]>,
        P: Copy + Into<DVec3>,
    {
        let (mut points, ends) = collect(loops)?;
        let outer = &points[..*ends.first().ok_or(Error::NoLoops)?];
        if newell(outer)?.dot(self.normal) < 0.0 {
            let starts = std::iter::once(0).chain(ends.iter().copied());
            starts.zip(&ends).for_each(|(start, end)| points[start..*end].reverse());
        }
        Self::on_plane(points, ends, self.plane.clone(), self.normal, OF_PARTS)
    }

    /// Whether this is a polygon's [`Self::part`], or the polygon itself: the plane is the same, bit for bit.
    pub(crate) fn has_plane_of(&self, whole: &PlanarPolygon) -> bool {
        self.plane.corners == whole.plane.corners
    }

    fn on_plane(
        points: Vec<DVec3>,
        ends: Vec<usize>,
        plane: Plane,
        normal: DVec3,
        planarity: f64,
    ) -> Result<Self, Error> {
        let axes = kept_axes(plane.normal.round());
        let deviation = deviation(&points, &ends, &plane, normal, planarity)?;
        let [u, v, w] = axes;
        let slopes = [u, v].map(|axis| plane.normal.0[axis] / plane.normal.0[w]);
        let order = (0..points.len()).collect();
        let (convex, pieces) = (false, Vec::new());
        let mut polygon =
            Self { points, ends, plane, normal, axes, slopes, deviation, convex, pieces, order };
        polygon.convex = polygon.ends.len() == 1 && loops::is_convex(&polygon.flat_loops()[0]);
        // A spike of many decades may have an area that rounds to 0, or a Newell normal that lies in the dropped axis' plane.
        let area = polygon.area();
        if !area.is_finite() || area == 0.0 {
            return Err(Error::TooSmall);
        }
        let Self { points, order, .. } = &mut polygon;
        order.sort_by(|a, b| by_kept_axes(axes, points[*a], points[*b]));
        polygon.pieces = if polygon.convex { polygon.straightened() } else { polygon.cut() };
        Ok(polygon)
    }

    /// The loops, as given but for -0.0, which became 0.0.
    pub fn loops(&self) -> impl Iterator<Item = &[DVec3]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.points[start..*end])
    }

    /// The unit normal. It points to the front, from where loop 0 runs counter-clockwise.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The area of the points inside an odd number of loops, in the coordinates' units squared.
    #[must_use]
    pub fn area(&self) -> f64 {
        loops::area(&self.flat_loops()) * self.steepness()
    }

    /// The edges of every loop, those between equal points left out.
    pub(crate) fn edges(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        self.loops().flat_map(pairs).filter(|(a, b)| a != b)
    }

    /// Every vertex, loop after loop.
    pub(crate) fn points(&self) -> &[DVec3] {
        &self.points
    }

    pub(crate) fn plane(&self) -> &Plane {
        &self.plane
    }

    /// Whether the points that span this polygon's plane lie in that of another one, or are vertices of it.
    pub(crate) fn lies_in_plane_of(&self, other: &Self) -> bool {
        // Most are turned against each other, and need no look at points. Vertices may be off the plane that they stand for.
        if other.deviation == 0.0 && self.plane.is_across(&other.plane) {
            return false;
        }
        let on =
            |corner: DVec3| other.plane.side_of(corner) == Ordering::Equal || other.points.contains(&corner);
        self.plane.corners.iter().all(|&corner| on(corner))
    }

    pub(crate) fn deviation(&self) -> f64 {
        self.deviation
    }

    /// The same of a polygon that should lie in this one's plane.
    pub(crate) fn deviation_of(&self, part: &Self) -> Result<f64, Error> {
        let points = [&self.points[..], &part.points].concat();
        let ends = part.ends.iter().map(|end| end + self.points.len());
        let ends: Vec<usize> = std::iter::once(self.points.len()).chain(ends).collect();
        deviation(&points, &ends, &self.plane, self.normal, OF_PARTS)
    }

    /// Whether it is one convex loop; decided exactly, in the two kept coordinates.
    pub(crate) fn is_convex(&self) -> bool {
        self.convex
    }

    /// Itself where it is convex, without vertices that lie straight between their neighbours, else convex pieces that meet in whole edges; none
    /// where the loops cross each other. Counter-clockwise seen from the front. A convex polygon is in pieces, too, if its vertices stand for
    /// others nearby and some of them lie nearly straight between their neighbours.
    pub(crate) fn convex_pieces(&self) -> impl Iterator<Item = &[DVec3]> {
        let whole = (self.convex && self.pieces.is_empty()).then_some(self.points());
        whole.into_iter().chain(self.pieces.iter().map(Vec::as_slice))
    }

    /// The pieces of a convex polygon; none where it is one itself.
    fn straightened(&self) -> Vec<Vec<DVec3>> {
        let ring = &self.flat_loops()[0];
        if self.deviation > 0.0 {
            return if convex::is_clearly_convex(ring) { Vec::new() } else { self.cut() };
        }
        let kept: Vec<DVec3> = convex::bends(ring).map(|corner| self.points[corner]).collect();
        if kept.len() == ring.len() { Vec::new() } else { vec![kept] }
    }

    fn cut(&self) -> Vec<Vec<DVec3>> {
        let vertex = |flat: &DVec2| self.find(*flat).map(|index| self.points[index]);
        let raised = |piece: &Vec<DVec2>| piece.iter().map(vertex).collect();
        let pieces: Option<Vec<Vec<DVec3>>> =
            convex::convex_pieces(&self.flat_loops()).iter().map(raised).collect();
        pieces.unwrap_or_default()
    }

    /// The two kept coordinates of a point of the plane, the third dropped: bit for bit what was given.
    pub(crate) fn flat(&self, point: DVec3) -> DVec2 {
        DVec2::new(point[self.axes[0]], point[self.axes[1]])
    }

    /// The vertex with these kept coordinates.
    pub(crate) fn find(&self, flat: DVec2) -> Option<usize> {
        let [u, v, _] = self.axes;
        let mut sought = DVec3::ZERO;
        (sought[u], sought[v]) = (flat.x, flat.y);
        let found = self.order.binary_search_by(|i| by_kept_axes(self.axes, self.points[*i], sought));
        found.ok().map(|place| self.order[place])
    }

    pub(crate) fn axes(&self) -> [usize; 3] {
        self.axes
    }

    pub(crate) fn flat_loops(&self) -> Vec<Vec<DVec2>> {
        self.loops().map(|l| l.iter().map(|p| self.flat(*p)).collect()).collect()
    }

    /// The plane's point with the kept coordinates `flat`; a vertex is itself.
    pub(crate) fn raise(&self, flat: DVec2) -> DVec3 {
        self.find(flat).map_or_else(
            || self.lift(DVec3::ZERO, DVec3::ZERO, flat).offset.round(),
            |index| self.points[index],
        )
    }

    /// Area in space per area in the two kept coordinates.
    pub(crate) fn steepness(&self) -> f64 {
        1.0 / self.normal[self.axes[2]].abs()
    }

    /// Where the plane's point with the kept coordinates `flat` lies as seen from `position`, which has the kept coordinates of
    /// `eye`.
    pub(crate) fn lift(&self, position: DVec3, eye: DVec3, flat: DVec2) -> Lifted {
        let [u, v, w] = self.axes;
        let anchor = Offset::between(position, self.plane.corners[0]).0;
        let mut offset = [DoubleDouble::ZERO; 3];
        offset[u] = DoubleDouble::difference(flat.x, eye[u]);
        offset[v] = DoubleDouble::difference(flat.y, eye[v]);
        let run = [offset[u] - anchor[u], offset[v] - anchor[v]];
        offset[w] = anchor[w] - (self.slopes[0] * run[0] + self.slopes[1] * run[1]);
        let error = self.plane.normal_error() / self.plane.normal.0[w].hi.abs();
        Lifted { offset: Offset(offset), error: error * (run[0].hi.abs() + run[1].hi.abs()) }
    }
}

/// A point of a polygon's plane as seen from elsewhere, and a bound on the error of its dropped coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lifted {
    pub(crate) offset: Offset,
    pub(crate) error: f64,
}

fn collect<L, P>(loops: L) -> Result<(Vec<DVec3>, Vec<usize>), Error>
where
    L: IntoIterator,
    L::Item: AsRef<[P]>,
    P: Copy + Into<DVec3>,
{
    let (mut points, mut ends) = (Vec::new(), Vec::new());
    for (loop_index, vertices) in loops.into_iter().enumerate() {
        let vertices = vertices.as_ref();
        if vertices.len() < 3 {
            return Err(Error::TooFewVertices { loop_index, count: vertices.len() });
        }
        // Adding zero turns -0.0 into 0.0, so that equal points are equal bit for bit.
        points.extend(vertices.iter().map(|p| (*p).into() + DVec3::ZERO));
        let start = ends.last().copied().unwrap_or(0);
        if let Some(vertex) = points[start..].iter().position(|p| !in_range(*p)) {
            return Err(Error::BadVertex { loop_index, vertex });
        }
        ends.push(points.len());
    }
    Ok((points, ends))
}

/// Each point of a loop with the next.
fn pairs(points: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> {
    points.iter().copied().zip(points.iter().copied().cycle().skip(1))
}

fn by_kept_axes([u, v, _]: [usize; 3], a: DVec3, b: DVec3) -> Ordering {
    // No point has a -0.0: a total order by value.
    a[u].total_cmp(&b[u]).then(a[v].total_cmp(&b[v]))
}
