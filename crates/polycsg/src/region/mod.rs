//! Regions: polygons with holes, islands in the holes, and so on.

pub(crate) mod area;
mod collinear;
pub(crate) mod membership;
pub(crate) mod prepared;
pub(crate) mod rings;

use crate::predicates::{Segment, Side, is_inside, lexicographic, rightward, side};
use area::enclosed_area;
use glam::DVec2;
use rings::{Rings, ring_edges};
use std::cmp::Ordering;

/// A set of points of the plane: polygons with holes, islands in the holes, to any depth.
///
/// Always valid: rings are simple and meet one another in common vertices only; outer rings run counter-clockwise,
/// holes clockwise, so that the interior is on the left of every edge; the interior of each polygon is connected.
/// (With y upwards. Where y points downwards, as on screens, swap clockwise and counter-clockwise; nothing else changes.)
///
/// Always canonical: each ring starts at its leftmost (then lowest) vertex, polygons are sorted by depth and then by
/// that vertex, the holes of each by theirs. Equal sets with equal vertices are equal values.
///
/// Input vertices on the boundary are kept, even in the middle of a straight edge, but for tips of needles that are narrower than a
/// rounding. Coordinates may be in any unit, and areas
/// are in its square. The default is the empty set.
///
/// ```
/// use polycsg::{FillRule, Location, Region, DVec2};
/// let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
/// // Even-odd: a square with a hole, and an island in the hole.
/// let region = Region::from_rings([square(0.0, 9.0), square(2.0, 7.0), square(3.0, 5.0)], FillRule::EvenOdd)?;
/// let polygons: Vec<_> = region.polygons().collect();
/// assert_eq!(polygons.len(), 2);
/// assert_eq!((polygons[0].holes().count(), polygons[0].depth()), (1, 0));
/// assert_eq!((polygons[1].holes().count(), polygons[1].depth()), (0, 1));
/// assert_eq!(region.area(), 81.0 - 25.0 + 4.0);
/// assert_eq!(region.locate(DVec2::new(6.0, 6.0)), Location::Outside);
/// # Ok::<(), polycsg::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Region {
    rings: Rings,
    /// All polygons but the first, which starts with ring 0 and has depth 0.
    later: Vec<PolygonSpan>,
}

/// A polygon's rings: from `first` to where the next polygon starts.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PolygonSpan {
    first: usize,
    depth: usize,
}

/// One polygon of a [`Region`]: an outer ring and its holes, borrowed.
///
/// Its holes may touch the outer ring and one another in single vertices; an island in a hole is a polygon of its own.
#[derive(Clone, Copy, Debug)]
pub struct Polygon<'r> {
    rings: &'r Rings,
    first: usize,
    end: usize,
    depth: usize,
}

impl<'r> Polygon<'r> {
    /// The outer ring, counter-clockwise, three points or more, the first not repeated.
    #[must_use]
    pub fn outer(&self) -> &'r [DVec2] {
        self.rings.ring(self.first)
    }

    /// The holes, each clockwise, the first point not repeated.
    pub fn holes(&self) -> impl Iterator<Item = &'r [DVec2]> + use<'r> {
        let rings = self.rings;
        (self.first + 1..self.end).map(move |ring| rings.ring(ring))
    }

    /// How many polygons surround it: 0 for an outermost one, 1 for an island in a hole of that, and so on.
    #[must_use]
    pub fn depth(&self) -> usize {
        self.depth
    }
}

/// Where a point lies; see [`Region::locate`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Location {
    /// In the interior.
    Inside,
    /// In the exterior.
    Outside,
    /// On the boundary, exactly.
    Boundary,
}

impl Region {
    /// The polygons, outermost first: by depth, then from left to right.
    pub fn polygons(&self) -> impl Iterator<Item = Polygon<'_>> {
        let first = (!self.is_empty()).then_some(PolygonSpan { first: 0, depth: 0 });
        let ends = self.later.iter().map(|next| next.first).chain([self.rings.len()]);
        first
            .into_iter()
            .chain(self.later.iter().copied())
            .zip(ends)
            .map(|(PolygonSpan { first, depth }, end)| Polygon { rings: &self.rings, first, end, depth })
    }

    /// All rings, each polygon's outer ring followed by its holes; the interior is on the left of each.
    pub fn rings(&self) -> impl Iterator<Item = &[DVec2]> + Clone {
        self.rings.iter()
    }

    /// Whether the set is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rings.len() == 0
    }

    /// The area; infinite when it exceeds the largest `f64`, 0 when it is below the smallest. O(n).
    ///
    /// The sum carries 106 bits. The relative error stays below 2^-52 unless some ring's number of vertices, times the area of
    /// the box around it, exceeds 10^12 times the area.
    pub fn area(&self) -> f64 {
        enclosed_area(self.rings().map(ring_edges))
    }

    /// Whether a point lies inside, outside or on the boundary, exactly. A point that is not finite lies outside. O(n).
    ///
    /// ```
    /// use polycsg::{DVec2, FillRule, Location, Region};
    /// let triangle = Region::from_rings([[[0.0, 0.0], [3.0, 1.0], [0.0, 2.0]]], FillRule::NonZero)?;
    /// assert_eq!(triangle.locate(DVec2::new(1.5, 0.5)), Location::Boundary);
    /// assert_eq!(triangle.locate(DVec2::new(1.5, 0.5_f64.next_up())), Location::Inside);
    /// assert_eq!(triangle.locate(DVec2::new(1.5, 0.5_f64.next_down())), Location::Outside);
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    #[must_use]
    pub fn locate(&self, point: DVec2) -> Location {
        if !point.is_finite() {
            return Location::Outside;
        }
        let mut above = false;
        for ring in self.rings() {
            for edge in ring_edges(ring) {
                match look_down(edge, point) {
                    Look::On => return Location::Boundary,
                    Look::Hits => above = !above,
                    Look::Misses => {}
                }
            }
        }
        if above { Location::Inside } else { Location::Outside }
    }

    pub(crate) fn rings_of(&self) -> &Rings {
        &self.rings
    }

    /// Rings as somebody states them to be a region's; nothing is checked.
    #[cfg(feature = "serde")]
    pub(crate) fn as_given(rings: Rings) -> Region {
        Region { rings, later: Vec::new() }
    }

    /// Whether two regions have the same rings, and this one so many of them in each of its polygons.
    #[cfg(feature = "serde")]
    pub(crate) fn has_rings_of(&self, other: &Region, counts: impl Iterator<Item = usize>) -> bool {
        self.rings == other.rings && self.polygons().map(|polygon| polygon.end - polygon.first).eq(counts)
    }
}

/// What is wrong with a region. No operation of this crate returns an invalid region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Invalid {
    /// Two edges meet elsewhere than in a common vertex. Edges are counted through [`Region::rings`].
    Contact {
        /// One edge.
        edge: usize,
        /// The other.
        other: usize,
    },
    /// The direction, nesting or order of the rings is not the promised one.
    Structure,
}

impl std::fmt::Display for Invalid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Invalid::Contact { edge, other } => {
                write!(f, "edges {edge} and {other} meet otherwise than in a common vertex")
            }
            Invalid::Structure => write!(f, "the direction, nesting or order of the rings is not canonical"),
        }
    }
}

impl std::error::Error for Invalid {}

enum Look {
    On,
    Hits,
    Misses,
}

/// What a ray down from `p`, just right of it, does with an edge.
#[inline]
fn look_down(edge: Segment, p: DVec2) -> Look {
    let [a, b] = rightward(edge);
    if p == a || p == b {
        return Look::On;
    }
    let spans = a.x <= p.x && p.x <= b.x;
    if !spans || p.y < a.y.min(b.y) {
        return Look::Misses;
    }
    match side(a, b, p) {
        Side::On if is_inside([a, b], p) => Look::On,
        Side::Left if p.x < b.x => Look::Hits,
        _ => Look::Misses,
    }
}

/// Builds a region from rings that are valid and in order.
#[derive(Debug)]
pub(crate) struct RegionBuilder {
    region: Region,
}

impl RegionBuilder {
    pub(crate) fn with_capacity(points: usize, rings: usize) -> RegionBuilder {
        RegionBuilder { region: Region { rings: Rings::with_capacity(points, rings), later: Vec::new() } }
    }

    /// Starts a polygon; its rings follow, the outer one first.
    pub(crate) fn polygon(&mut self, depth: u32) {
        let first = self.region.rings.len();
        if first > 0 {
            self.region.later.push(PolygonSpan { first, depth: depth as usize });
        }
    }

    /// Adds a ring, in two parts.
    pub(crate) fn ring(&mut self, parts: [&[DVec2]; 2]) {
        parts.iter().for_each(|part| self.region.rings.extend(part));
        self.region.rings.close();
    }

    pub(crate) fn build(self) -> Region {
        debug_assert!(
            self.region
                .rings()
                .all(|ring| { ring.iter().skip(1).all(|&p| lexicographic(ring[0], p) == Ordering::Less) })
        );
        self.region
    }
}
