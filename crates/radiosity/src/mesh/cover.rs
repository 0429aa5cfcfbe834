//! Convex tiles of patches in triangles that share their vertices, but across contact lines.
use super::convex::PlacedCorner;
use super::divide::Points;
use super::element::{Element, Mesh};
use super::split::split;
use glam::{DVec2, DVec3};

/// Vertices nearer than this share of a patch's size are one.
const NEAR: f64 = 1e-9;

/// Triangles, and which tile each is a part of.
#[derive(Debug, Default)]
pub(crate) struct Cover {
    pub(crate) mesh: Mesh,
    pub(crate) owners: Vec<usize>,
}

/// A convex tile, in the frame of its patch, each point with its place in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoverTile<'t> {
    pub(crate) number: usize,
    /// Counter-clockwise.
    pub(crate) corners: &'t [PlacedCorner],
    /// A point inside.
    pub(crate) middle: PlacedCorner,
}

impl Cover {
    /// Adds the tiles of a patch; `contacts` are the lines on which other patches touch it, `guests` what else must
    /// be a vertex: places on the patch's edges.
    ///
    /// ```text
    /// +-------+---+
    /// |       |   |    corners of a neighbour in the middle of a side are vertices of the tile; a tile becomes a fan around
    /// |       +---+    its middle
    /// |       |   |
    /// +-------+---+
    /// ```
    pub(crate) fn add(
        &mut self,
        patch: usize,
        tiles: &[CoverTile<'_>],
        contacts: &[[DVec2; 2]],
        guests: &[PlacedCorner],
    ) {
        let own = tiles.iter().flat_map(|tile| tile.corners.iter());
        let mut knots = Knots::of(own.chain(guests).copied());
        let on_lines = knots.on_lines(contacts);
        let mut triangles = Vec::new();
        for tile in tiles {
            let ring = knots.ring(tile.corners);
            for triangle in knots.fan(&ring, tile.middle) {
                triangles.push(triangle);
                self.owners.push(tile.number);
            }
        }
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let contacts = sides.filter(|side| is_on_line(*side, &on_lines)).collect();
        let points = Points { flat: knots.flat, contacts, ..Points::default() };
        let parted = split(&triangles, &points);
        let base = self.mesh.vertices.len();
        self.mesh.vertices.extend(parted.points.iter().map(|&point| knots.places[point]));
        let element = |corners: &[usize; 3]| Element { patch, corners: corners.map(|corner| base + corner) };
        self.mesh.elements.extend(parted.triangles.iter().map(element));
    }
}

/// The corners of all tiles of a patch, each once, sorted by their first coordinate.
struct Knots {
    flat: Vec<DVec2>,
    places: Vec<DVec3>,
    /// The numbers of those that were sorted, in that order.
    sorted: Vec<usize>,
    near: f64,
}

impl Knots {
    fn of(corners: impl Iterator<Item = PlacedCorner>) -> Knots {
        let mut corners: Vec<PlacedCorner> = corners.collect();
        corners.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.0.y.total_cmp(&b.0.y)));
        let size = corners.iter().map(|corner| corner.0.abs().max_element()).fold(0.0, f64::max);
        let mut knots = Knots { flat: Vec::new(), places: Vec::new(), sorted: Vec::new(), near: NEAR * size };
        for (flat, place) in corners {
            if let Some(known) = knots.find(flat) {
                // All patches that meet in a place choose the same of what rounding made of it.
                if place.to_array() < knots.places[known].to_array() {
                    knots.places[known] = place;
                }
                continue;
            }
            knots.sorted.push(knots.flat.len());
            knots.flat.push(flat);
            knots.places.push(place);
        }
        knots
    }

    /// The knots whose first coordinate is in a range.
    fn between(&self, low: f64, high: f64) -> impl Iterator<Item = usize> {
        let x = |knot: usize| self.flat[knot].x;
        let from = self.sorted.partition_point(|&knot| x(knot) < low - self.near);
        self.sorted[from..].iter().copied().take_while(move |&knot| x(knot) <= high + self.near)
    }

    fn find(&self, flat: DVec2) -> Option<usize> {
        self.between(flat.x, flat.x).find(|&knot| self.flat[knot].distance(flat) <= 2.0 * self.near)
    }

    /// The knots around a tile, with those in the middle of its sides.
    fn ring(&self, corners: &[PlacedCorner]) -> Vec<usize> {
        let mut ring: Vec<usize> = corners.iter().filter_map(|corner| self.find(corner.0)).collect();
        ring.dedup();
        let next = ring.iter().copied().cycle().skip(1);
        ring.iter()
            .zip(next)
            .flat_map(|(&start, end)| std::iter::once(start).chain(self.inside([start, end])))
            .collect()
    }

    /// The knots in the middle of a side, in order.
    fn inside(&self, [start, end]: [usize; 2]) -> Vec<usize> {
        let (a, b) = (self.flat[start], self.flat[end]);
        let (way, length) = ((b - a).normalize_or_zero(), a.distance(b));
        let along = |knot: usize| way.dot(self.flat[knot] - a);
        let is_inside = |&knot: &usize| {
            let reach = along(knot);
            reach > 2.0 * self.near
                && reach < length - 2.0 * self.near
                && way.perp_dot(self.flat[knot] - a).abs() <= 2.0 * self.near
        };
        let mut inside: Vec<usize> = self.between(a.x.min(b.x), a.x.max(b.x)).filter(is_inside).collect();
        inside.sort_by(|a, b| along(*a).total_cmp(&along(*b)));
        inside
    }

    /// Triangles of a ring: around its middle where it has more than three knots, so that no diagonal shows.
    fn fan(&mut self, ring: &[usize], (flat, place): PlacedCorner) -> Vec<[usize; 3]> {
        let count = ring.len();
        if let [a, b, c] = *ring {
            return vec![[a, b, c]];
        }
        let middle = self.flat.len();
        self.flat.push(flat);
        self.places.push(place);
        (0..count).map(|k| [middle, ring[k], ring[(k + 1) % count]]).collect()
    }

    /// For each knot the lines that it is on.
    fn on_lines(&self, lines: &[[DVec2; 2]]) -> Vec<Vec<usize>> {
        let mut of_knots = vec![Vec::new(); self.flat.len()];
        let far = 10.0 * self.near;
        for (index, [start, end]) in lines.iter().enumerate() {
            let (way, length) = ((*end - *start).normalize_or_zero(), start.distance(*end));
            let is_on = |knot: &usize| {
                let from_start = self.flat[*knot] - *start;
                let reach = way.dot(from_start);
                way.perp_dot(from_start).abs() <= far && reach >= -far && reach <= length + far
            };
            let within = self.between(start.x.min(end.x) - far, start.x.max(end.x) + far);
            within.filter(is_on).for_each(|knot| of_knots[knot].push(index));
        }
        of_knots
    }
}

/// Whether both ends of a side are on one line; the middle of a tile is on none.
fn is_on_line([start, end]: [usize; 2], on_lines: &[Vec<usize>]) -> bool {
    let [start, end] = [start, end].map(|knot| on_lines.get(knot).map_or(&[][..], Vec::as_slice));
    start.iter().any(|line| end.contains(line))
}
