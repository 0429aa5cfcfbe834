//! Planar polygons: loops with holes, and the plane that they share.
use super::{convex, loops};
use crate::error::Error;
use crate::numeric::rounding::{ROUNDING, SMALLEST, in_range};
use crate::numeric::{offset::Offset, predicates::Plane};
use exactfloat::DoubleDouble;
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// How many roundings of its largest coordinate a polygon's vertex may lie off the polygon's plane.
const PLANARITY: f64 = 64.0;

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
    /// How far a vertex as given may lie from where it stands on the plane: zero for triangles.
    deviation: f64,
    convex: bool,
    /// Convex pieces that meet in whole edges; none where it is one itself, or crosses itself.
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
        let axes = kept_axes(plane.normal.round());
        let deviation = deviation(&points, &ends, &plane, normal)?;
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
        let is_piece =
            polygon.convex && (deviation == 0.0 || convex::is_clearly_convex(&polygon.flat_loops()[0]));
        polygon.pieces = if is_piece { Vec::new() } else { polygon.cut() };
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
        deviation(&points, &ends, &self.plane, self.normal)
    }

    /// Whether it is one convex loop; decided exactly, in the two kept coordinates.
    pub(crate) fn is_convex(&self) -> bool {
        self.convex
    }

    /// Itself where it is convex, else convex pieces that meet in whole edges, counter-clockwise seen from the front; none where the
    /// loops cross each other. A convex polygon is in pieces, too, if its vertices stand for others nearby and some of them lie nearly straight
    /// between their neighbours.
    pub(crate) fn convex_pieces(&self) -> impl Iterator<Item = &[DVec3]> {
        let whole = (self.convex && self.pieces.is_empty()).then_some(self.points());
        whole.into_iter().chain(self.pieces.iter().map(Vec::as_slice))
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

/// The unit normal of a loop by Newell's sum, in double-double arithmetic.
fn newell(outer: &[DVec3]) -> Result<DVec3, Error> {
    let spokes = outer[1..].windows(2);
    let sum = spokes.fold(Offset([DoubleDouble::ZERO; 3]), |sum, pair| {
        let (part, _) = Offset::between(outer[0], pair[0]).cross(Offset::between(outer[0], pair[1]));
        Offset([0, 1, 2].map(|i| sum.0[i] + part.0[i]))
    });
    let sum = sum.round();
    let largest = sum.abs().max_element();
    if largest < SMALLEST * SMALLEST {
        // Products of extents below 2^-200 may underflow: only integers tell whether there is an area.
        let is_near = outer.iter().all(|p| (*p - outer[0]).abs().max_element() < SMALLEST);
        let spans = |pair: &[DVec3]| Plane::through([outer[0], pair[0], pair[1]]).is_some();
        let has_area = largest > 0.0 || is_near && outer[1..].windows(2).any(spans);
        return Err(if has_area { Error::TooSmall } else { Error::ZeroArea });
    }
    Ok((sum / largest).normalize())
}

/// The plane through three vertices that lie far apart, its normal on the side of `normal`.
fn plane_of(outer: &[DVec3], normal: DVec3) -> Result<Plane, Error> {
    let a = outer[0];
    let b = farthest(outer, |p| (p - a).length_squared());
    let c = farthest(outer, |p| (b - a).cross(p - a).length_squared());
    let corners = if outer.len() == 3 { [a, outer[1], outer[2]] } else { [a, b, c] };
    let plane = Plane::through(corners).ok_or(Error::ZeroArea)?;
    if plane.normal.round().dot(normal) > 0.0 {
        return Ok(plane);
    }
    Plane::through([corners[0], corners[2], corners[1]]).ok_or(Error::ZeroArea)
}

fn farthest(points: &[DVec3], distance: impl Fn(DVec3) -> f64) -> DVec3 {
    points.iter().copied().fold(points[0], |best, p| if distance(p) > distance(best) { p } else { best })
}

/// Each point of a loop with the next.
fn pairs(points: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> {
    points.iter().copied().zip(points.iter().copied().cycle().skip(1))
}

fn by_kept_axes([u, v, _]: [usize; 3], a: DVec3, b: DVec3) -> Ordering {
    // No point has a -0.0: a total order by value.
    a[u].total_cmp(&b[u]).then(a[v].total_cmp(&b[v]))
}

/// Drops the axis along which the normal is longest.
fn kept_axes(normal: DVec3) -> [usize; 3] {
    let size = normal.abs();
    let dropped = if size.z >= size.x && size.z >= size.y {
        2
    } else if size.y >= size.x {
        1
    } else {
        0
    };
    let (u, v) = ((dropped + 1) % 3, (dropped + 2) % 3);
    if normal[dropped] > 0.0 { [u, v, dropped] } else { [v, u, dropped] }
}

/// A bound on the way from a vertex moved along the Newell normal to the same vertex moved along the dropped axis onto
/// the plane of the three corners; zero when all vertices lie on that plane exactly.
fn deviation(points: &[DVec3], ends: &[usize], plane: &Plane, normal: DVec3) -> Result<f64, Error> {
    if points.len() == 3 || points.iter().all(|p| plane.side(*p).sign == Ordering::Equal) {
        return Ok(0.0);
    }
    let allowed = PLANARITY * ROUNDING * points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let length = plane.normal.round().length();
    let mut worst = 0.0_f64;
    for (index, point) in points.iter().enumerate() {
        let off = [plane.side(*point).value.hi.abs() / length, (*point - points[0]).dot(normal).abs()];
        let distance = off[0].max(off[1]);
        if distance > allowed {
            let loop_index = ends.partition_point(|end| *end <= index);
            let start = if loop_index == 0 { 0 } else { ends[loop_index - 1] };
            return Err(Error::NotPlanar { loop_index, vertex: index - start, distance, allowed });
        }
        worst = worst.max(off[0] + off[1]);
    }
    // The dropped axis meets the plane at no more than acos(1/sqrt 3): moving along it is at most sqrt 3 times as far.
    Ok(3.0 * worst)
}
