//! Whether polygons are valid as they are, in the sense of the simple features' standard, decided exactly. The boundary of all rings
//! under the even-odd rule tells: of valid polygons, each edge is part of it, cut at most where a vertex of another ring touches it,
//! and the rings of the region are those that were given.

use crate::error::Error;
use crate::expression::csg::{Csg, FillRule};
use crate::pipeline::scratch::Scratch;
use crate::predicates::{Side, lexicographic, side};
use crate::region::Region;
use glam::DVec2;
use std::fmt;

/// Why polygons are not valid in the sense of the simple features' standard; see [`flaw`]. Rings are counted through all polygons,
/// and from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Flaw {
    /// A ring has fewer than 3 vertices.
    Short {
        /// The ring.
        ring: usize,
    },
    /// A coordinate is NaN or infinite.
    NonFinite {
        /// The ring.
        ring: usize,
        /// The vertex.
        vertex: usize,
    },
    /// An edge crosses another one, or lies on another one.
    Crossing {
        /// The ring.
        ring: usize,
        /// The vertex where the edge starts.
        vertex: usize,
    },
    /// A ring visits a point twice.
    TouchesItself {
        /// The ring.
        ring: usize,
        /// The point.
        point: DVec2,
    },
    /// All vertices of a ring are equal.
    Point {
        /// The ring.
        ring: usize,
    },
    /// Rings that touch cut the interior of a polygon in parts.
    Cuts {
        /// One of the rings.
        ring: usize,
        /// Another one.
        other: usize,
    },
    /// A hole lies outside of its polygon.
    HoleOutside {
        /// The hole.
        ring: usize,
    },
    /// A polygon lies inside another one.
    Inside {
        /// Its outer ring.
        ring: usize,
    },
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Flaw::Short { ring } => write!(f, "ring {ring}: it has fewer than 3 vertices"),
            Flaw::NonFinite { ring, vertex } => Error::NonFinite { ring, vertex }.fmt(f),
            Flaw::Crossing { ring, vertex } => {
                write!(f, "ring {ring}, vertex {vertex}: the edge from there crosses or covers another edge")
            }
            Flaw::TouchesItself { ring, point } => {
                write!(f, "ring {ring}: it touches itself in ({}, {})", point.x, point.y)
            }
            Flaw::Point { ring } => write!(f, "ring {ring}: all of its vertices are equal"),
            Flaw::Cuts { ring, other } => {
                write!(f, "rings {ring} and {other}: they cut the interior in parts")
            }
            Flaw::HoleOutside { ring } => write!(f, "ring {ring}: a hole lies outside of its polygon"),
            Flaw::Inside { ring } => write!(f, "ring {ring}: a polygon lies inside another"),
        }
    }
}

impl std::error::Error for Flaw {}

/// The first thing that makes polygons invalid in the sense of the simple features' standard (OGC 06-103r4, as GEOS and PostGIS judge):
/// what [`Region::from_rings`] would change. None where they are valid. Decided exactly, wherever the coordinates lie.
///
/// Each polygon is its rings, the outer one first, in any direction; the first vertex may stand once more at the end. A polygon without
/// rings, or of one ring without vertices, is empty and valid. Polygons may touch in points, not along edges. Expected
/// O((n + k) log n) for n edges with k contacts.
///
/// ```
/// use polycsg::{Flaw, Scratch, flaw};
/// let mut scratch = Scratch::default();
/// let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
/// let bow_tie = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
/// assert_eq!(flaw([[&square]], &mut scratch), None);
/// assert_eq!(flaw([[&bow_tie]], &mut scratch), Some(Flaw::Crossing { ring: 0, vertex: 0 }));
/// let hole = vec![[5.0, 1.0], [6.0, 1.0], [6.0, 2.0]];
/// let found = flaw([[&square, &hole]], &mut scratch).expect("a hole that lies elsewhere");
/// assert_eq!(found.to_string(), "ring 1: a hole lies outside of its polygon");
/// ```
pub fn flaw<P, R, T>(polygons: P, scratch: &mut Scratch) -> Option<Flaw>
where
    P: IntoIterator,
    P::Item: IntoIterator<Item = R>,
    R: AsRef<[T]>,
    T: Copy + Into<DVec2>,
{
    GivenRings::read(polygons).check(scratch).err()
}

/// The rings of all polygons, without the vertices that close them.
#[derive(Default)]
struct GivenRings {
    rings: Vec<Vec<DVec2>>,
    /// The polygon of each.
    polygon: Vec<usize>,
}

/// A piece of a ring's edge.
#[derive(Clone, Copy)]
struct RingPiece {
    start: DVec2,
    end: DVec2,
}

impl GivenRings {
    fn read<P, R, T>(polygons: P) -> GivenRings
    where
        P: IntoIterator,
        P::Item: IntoIterator<Item = R>,
        R: AsRef<[T]>,
        T: Copy + Into<DVec2>,
    {
        let mut given = GivenRings::default();
        for (number, polygon) in polygons.into_iter().enumerate() {
            for ring in polygon {
                // -0.0 reads as 0.0.
                let mut ring: Vec<DVec2> = ring.as_ref().iter().map(|&p| p.into() + DVec2::ZERO).collect();
                if ring.len() > 1 && ring.first() == ring.last() {
                    ring.pop();
                }
                given.rings.push(ring);
                given.polygon.push(number);
            }
        }
        given
    }

    fn check(&self, scratch: &mut Scratch) -> Result<(), Flaw> {
        let short = |&ring: &usize| self.rings[ring].len() < 3 && !self.is_empty_polygon(ring);
        if let Some(ring) = (0..self.rings.len()).find(short) {
            return Err(Flaw::Short { ring });
        }
        let csg = match Csg::from_rings(&self.rings, FillRule::EvenOdd) {
            Ok(csg) => csg,
            Err(Error::NonFinite { ring, vertex }) => return Err(Flaw::NonFinite { ring, vertex }),
            Err(_) => unreachable!("reading rings has no other error"),
        };
        let pieces = self.pieces(&csg, scratch)?;
        touching_itself(&pieces)?;
        let is_point = |&ring: &usize| pieces[ring].is_empty() && !self.is_empty_polygon(ring);
        if let Some(ring) = (0..pieces.len()).find(is_point) {
            return Err(Flaw::Point { ring });
        }
        self.check_places(&pieces, &csg.evaluate_with(scratch))
    }

    /// An empty polygon may have a ring without vertices.
    fn is_empty_polygon(&self, ring: usize) -> bool {
        let of_polygon = self.polygon.iter().filter(|&&polygon| polygon == self.polygon[ring]);
        self.rings[ring].is_empty() && of_polygon.count() == 1
    }

    /// The pieces of each ring, in order; an error where an edge is not all there.
    fn pieces(&self, csg: &Csg<'_>, scratch: &mut Scratch) -> Result<Vec<Vec<RingPiece>>, Flaw> {
        let mut of_edge = vec![vec![]; self.rings.iter().map(Vec::len).sum()];
        for edge in csg.boundary(scratch).edges() {
            of_edge[edge.edge].push([edge.start, edge.end]);
        }
        let mut vertices: Vec<DVec2> = self.rings.iter().flatten().copied().collect();
        vertices.sort_unstable_by(|&a, &b| lexicographic(a, b));
        let touches = |[start, end]: [DVec2; 2], p: DVec2| {
            vertices.binary_search_by(|&vertex| lexicographic(vertex, p)).is_ok()
                && side(start, end, p) == Side::On
        };
        let mut of_edge = of_edge.into_iter();
        let whole = self.rings.iter().enumerate().map(|(ring, points)| {
            let ends = points.iter().cycle().skip(1);
            let mut found = vec![];
            for (vertex, ((&start, &end), pieces)) in
                points.iter().zip(ends).zip(of_edge.by_ref()).enumerate()
            {
                let chain = chained([start, end], pieces, touches);
                found.extend(chain.ok_or(Flaw::Crossing { ring, vertex })?);
            }
            Ok(found)
        });
        whole.collect()
    }

    /// Whether rings that only touch one another stand in their places.
    fn check_places(&self, pieces: &[Vec<RingPiece>], region: &Region) -> Result<(), Flaw> {
        let owners = Owners::of(pieces);
        let is_shell = |ring: usize| ring == 0 || self.polygon[ring - 1] != self.polygon[ring];
        for polygon in region.polygons() {
            let mut shell = None;
            for found in std::iter::once(polygon.outer()).chain(polygon.holes()) {
                let ring = owners.of_whole(found)?;
                match shell {
                    None if is_shell(ring) => shell = Some(ring),
                    None => return Err(Flaw::HoleOutside { ring }),
                    Some(_) if is_shell(ring) => return Err(Flaw::Inside { ring }),
                    Some(shell) if self.polygon[shell] != self.polygon[ring] => {
                        return Err(Flaw::HoleOutside { ring });
                    }
                    Some(_) => {}
                }
            }
        }
        Ok(())
    }
}

/// The ring of each piece, found by its ends.
struct Owners(Vec<([DVec2; 2], usize)>);

impl Owners {
    fn of(pieces: &[Vec<RingPiece>]) -> Owners {
        let of_ring = |(ring, pieces): (usize, &Vec<RingPiece>)| {
            pieces.iter().map(|piece| (ordered([piece.start, piece.end]), ring)).collect::<Vec<_>>()
        };
        let mut owners: Vec<_> = pieces.iter().enumerate().flat_map(of_ring).collect();
        owners.sort_unstable_by(|(a, _), (b, _)| by_ends(a, b));
        Owners(owners)
    }

    /// The ring that all edges of a ring belong to.
    fn of_whole(&self, ring: &[DVec2]) -> Result<usize, Flaw> {
        let ends = ring.iter().cycle().skip(1);
        let mut owners = ring.iter().zip(ends).map(|(&a, &b)| {
            let wanted = ordered([a, b]);
            let place = self.0.binary_search_by(|(ends, _)| by_ends(ends, &wanted));
            self.0[place.expect("the edges of the region are the pieces")].1
        });
        let first = owners.next().expect("a ring of a region has edges");
        match owners.find(|&owner| owner != first) {
            Some(other) => Err(Flaw::Cuts { ring: first, other }),
            None => Ok(first),
        }
    }
}

fn ordered([a, b]: [DVec2; 2]) -> [DVec2; 2] {
    if lexicographic(a, b).is_le() { [a, b] } else { [b, a] }
}

fn by_ends(a: &[DVec2; 2], b: &[DVec2; 2]) -> std::cmp::Ordering {
    lexicographic(a[0], b[0]).then(lexicographic(a[1], b[1]))
}

/// The pieces of an edge, in its direction; none unless they make up all of it, and are cut where a vertex touches it.
fn chained(
    edge: [DVec2; 2],
    mut pieces: Vec<[DVec2; 2]>,
    touches: impl Fn([DVec2; 2], DVec2) -> bool,
) -> Option<Vec<RingPiece>> {
    let (mut at, mut found) = (edge[0], vec![]);
    while at != edge[1] {
        let next = pieces.iter().position(|ends| ends.contains(&at))?;
        let [a, b] = pieces.swap_remove(next);
        let to = if a == at { b } else { a };
        if to != edge[1] && !touches(edge, to) {
            return None;
        }
        found.push(RingPiece { start: at, end: to });
        at = to;
    }
    Some(found)
}

/// Whether no ring visits a point twice.
fn touching_itself(pieces: &[Vec<RingPiece>]) -> Result<(), Flaw> {
    for (ring, pieces) in pieces.iter().enumerate() {
        let mut starts: Vec<DVec2> = pieces.iter().map(|piece| piece.start).collect();
        starts.sort_unstable_by(|&a, &b| lexicographic(a, b));
        if let Some(twice) = starts.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(Flaw::TouchesItself { ring, point: twice[0] });
        }
    }
    Ok(())
}
