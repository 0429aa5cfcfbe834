//! Points over a patch: its boundary and the contact lines at a spacing, and a lattice inside.
use super::lattice::{Lattice, parts};
use super::{flat_index::FlatIndex, frame::Frame, lines::InnerLines, refusal::MeshRefusal};
use crate::predicates::ray_crosses;
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};
use polycsg::{FillRule, Region};
use std::collections::BTreeMap;

/// A piece of the patch's boundary between neighbouring points.
#[derive(Clone, Copy, Debug)]
pub(super) struct SubEdge {
    /// Start and end, the inside to the left.
    pub(super) ends: [usize; 2],
    /// The edge of the patch that it is a piece of.
    pub(super) edge: usize,
}

/// Points to be triangulated.
#[derive(Debug, Default)]
pub(super) struct Points {
    /// In the patch's frame; no two are equal.
    pub(super) flat: Vec<DVec2>,
    /// The same in space.
    pub(super) places: Vec<DVec3>,
    /// The boundary.
    pub(super) boundary: Vec<SubEdge>,
    /// Pieces of the contact lines inside; none crosses the boundary.
    pub(super) contacts: Vec<[usize; 2]>,
    /// The same of the lines where shadows begin and end.
    pub(super) shadows: Vec<[usize; 2]>,
    /// The lattice that the interior points are from.
    pub(super) lattice: Lattice,
}

/// A point in the frame and in space.
type PlacedPoint = (DVec2, DVec3);

/// What is divided, and how.
struct Ground<'g> {
    frame: &'g Frame,
    /// The region's edges, in order.
    edges: Vec<[DVec2; 2]>,
    /// The same, to be found.
    outline: FlatIndex,
    /// The patch's own vertices by their place in the frame: they keep their place in space bit for bit.
    corners: BTreeMap<[u64; 2], DVec3>,
    /// Contact lines in the frame.
    contacts: Vec<[DVec2; 2]>,
    /// Their ends.
    contact_ends: FlatIndex,
    /// Side of a cell, in the frame's unit.
    spacing: f64,
    lattice: Lattice,
    /// How often each cell of the lattice is halved; empty when none is.
    levels: &'g [u8],
}

/// What a patch is divided by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Division<'d> {
    /// Lines on which other patches touch it.
    pub(super) contacts: &'d [[DVec3; 2]],
    /// Lines where shadows begin and end.
    pub(super) shadows: &'d [[DVec3; 2]],
    /// Side of a cell.
    pub(super) spacing: f64,
    /// How often each cell of the lattice is halved; empty when none is.
    pub(super) levels: &'d [u8],
}

/// Finds the points of a patch, with points along its contact lines and the edges of its shadows.
pub(super) fn divide(
    polygon: &PlanarPolygon,
    division: &Division<'_>,
    frame: &Frame,
) -> Result<Points, MeshRefusal> {
    let ground = Ground::new(polygon, division, frame)?;
    let mut points = Points { lattice: ground.lattice, ..Points::default() };
    points.divide_boundary(&ground);
    let boundary = points.lines(points.boundary.iter().map(|piece| piece.ends));
    let mut lines = InnerLines::new(boundary, &points.flat);
    // Light jumps at both sides of what is thin, too: a contact line keeps no farther from others than points must to be told apart.
    for &contact in &ground.contacts {
        let pieces = points.divide_line(contact, &ground, (&mut lines, |_| 4.0 * ground.near()));
        points.contacts.extend(pieces);
    }
    for shadow in division.shadows.iter().filter_map(|ends| ground.clip(ends.map(|end| frame.flatten(end)))) {
        let pieces = points.divide_line(shadow, &ground, (&mut lines, |point| ground.step(point) / 4.0));
        points.shadows.extend(pieces);
    }
    points.fill_inside(&ground, &lines);
    Ok(points)
}

impl Points {
    /// Appends every ring of the region, each edge in equal pieces between the contacts that end on it.
    fn divide_boundary(&mut self, ground: &Ground<'_>) {
        let mut known = BTreeMap::new();
        for (edge, &[start, end]) in ground.edges.iter().enumerate() {
            let chain: Vec<_> = ground
                .stops(start, end)
                .windows(2)
                .flat_map(|ends| ground.pieces([ends[0], ends[1]]))
                .map(|(flat, place)| *known.entry(key(flat)).or_insert_with(|| self.push(flat, place)))
                .collect();
            let pairs = chain.windows(2).filter(|ends| ends[0] != ends[1]);
            self.boundary.extend(pairs.map(|ends| SubEdge { ends: [ends[0], ends[1]], edge }));
        }
    }

    /// Appends the points of the part of a line that lies inside the region and keeps apart from the boundary and from the lines before
    /// it, by a distance that is told for each point, but for the points that it shares with them; gives its pieces.
    fn divide_line(
        &mut self,
        ends: [DVec2; 2],
        ground: &Ground<'_>,
        (lines, apart): (&mut InnerLines, impl Fn(DVec2) -> f64),
    ) -> Vec<[usize; 2]> {
        let mut chain: Vec<Option<usize>> = Vec::new();
        for (flat, place) in ground.pieces(ends.map(|end| (end, ground.frame.lift(end)))) {
            chain.push(match lines.known(flat, ground.near()) {
                None if ground.inside_and_clear(flat, lines, apart(flat)) => {
                    let index = self.push(flat, place);
                    lines.push_point(self.flat[index]);
                    Some(index)
                }
                known => known,
            });
        }
        let whole = chain.windows(2).filter_map(|pair| Some([pair[0]?, pair[1]?]));
        let middle = |[a, b]: [usize; 2]| self.flat[a].midpoint(self.flat[b]);
        let clear = |pair: &[usize; 2]| {
            let middle = middle(*pair);
            ground.inside_and_clear(middle, lines, apart(middle) / 4.0)
        };
        let kept: Vec<_> = whole.filter(|pair| pair[0] != pair[1] && clear(pair)).collect();
        self.lines(kept.iter().copied()).into_iter().for_each(|piece| lines.push_piece(piece));
        kept
    }

    /// Appends the lattice points inside the region, and those of its halved cells, that keep half a step from the
    /// lines.
    fn fill_inside(&mut self, ground: &Ground<'_>, lines: &InnerLines) {
        for point in self.lattice.points(ground.levels) {
            if ground.inside_and_clear(point, lines, ground.step(point) / 2.0) {
                self.push(point, ground.frame.lift(point));
            }
        }
    }

    /// The segments between given pairs of points.
    fn lines(&self, pairs: impl Iterator<Item = [usize; 2]>) -> Vec<[DVec2; 2]> {
        pairs.map(|ends| ends.map(|end| self.flat[end])).collect()
    }

    /// Appends one point.
    fn push(&mut self, flat: DVec2, place: DVec3) -> usize {
        self.flat.push(self.lattice.align(flat));
        self.places.push(place);
        self.flat.len() - 1
    }
}

impl<'g> Ground<'g> {
    /// The patch as a valid region of its frame.
    fn new(
        polygon: &PlanarPolygon,
        division: &Division<'g>,
        frame: &'g Frame,
    ) -> Result<Ground<'g>, MeshRefusal> {
        let flatten = |points: &[DVec3]| points.iter().map(|&p| frame.flatten(p)).collect::<Vec<_>>();
        let region = Region::from_rings(polygon.loops().map(flatten), FillRule::EvenOdd)
            .map_err(|error| MeshRefusal(error.to_string()))?;
        if region.is_empty() {
            return Err(MeshRefusal("its area is zero".to_owned()));
        }
        let corners = polygon.loops().flatten().map(|&place| (key(frame.flatten(place)), place)).collect();
        let contacts: Vec<[DVec2; 2]> =
            division.contacts.iter().map(|ends| ends.map(|end| frame.flatten(end))).collect();
        let contact_ends = FlatIndex::new(contacts.iter().flatten().map(|&end| [end, end]).collect());
        let edges = edges(&region);
        let outline = FlatIndex::new(edges.clone());
        let spacing = division.spacing / frame.unit();
        let lattice = Lattice::over(&region, spacing);
        let levels = division.levels;
        Ok(Ground { frame, edges, outline, corners, contacts, contact_ends, spacing, lattice, levels })
    }

    /// The ends of an edge and the places between them where contact lines end.
    fn stops(&self, start: DVec2, end: DVec2) -> Vec<PlacedPoint> {
        let along = |point: DVec2| (point - start).dot(end - start) / (end - start).length_squared();
        let on_edge = |point: &DVec2| point.distance(start.lerp(end, along(*point))) < self.near();
        let margin = self.near() / start.distance(end);
        let around = [start.min(end) - 2.0 * self.near(), start.max(end) + 2.0 * self.near()];
        let ends = self.contact_ends.meeting(around).map(|index| self.contacts[index / 2][index % 2]);
        let mut breaks: Vec<f64> = ends.filter(on_edge).map(along).collect();
        breaks.retain(|at| (margin..1.0 - margin).contains(at));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|next, at| *next - *at < margin);
        let (from, to) = (self.place(start), self.place(end));
        let stop = |at: f64| (start.lerp(end, at), from.lerp(to, at));
        [(start, from)].into_iter().chain(breaks.into_iter().map(stop)).chain([(end, to)]).collect()
    }

    /// A vertex of the region in space.
    fn place(&self, flat: DVec2) -> DVec3 {
        self.corners.get(&key(flat)).copied().unwrap_or_else(|| self.frame.lift(flat))
    }

    /// How often the cell of a point is halved.
    fn level(&self, point: DVec2) -> u8 {
        self.levels.get(self.lattice.index(point)).copied().unwrap_or(0)
    }

    /// The lattice's step around a point.
    fn step(&self, point: DVec2) -> f64 {
        self.lattice.step.min_element() / f64::from(1u32 << self.level(point))
    }

    /// The points of a line cut in equal parts near the spacing, both ends included, each part cut again as often as
    /// the cell to its left is.
    fn pieces(&self, [start, end]: [PlacedPoint; 2]) -> Vec<PlacedPoint> {
        let left = (end.0 - start.0).perp().normalize_or_zero() * self.near();
        let whole: Vec<PlacedPoint> =
            pieces([start, end], parts(start.0.distance(end.0), self.spacing)).collect();
        let halved = whole.windows(2).flat_map(|ends| {
            let level = self.level(ends[0].0.midpoint(ends[1].0) + left);
            pieces([ends[0], ends[1]], 1 << level).take(1 << level)
        });
        halved.chain(whole.last().copied()).collect()
    }

    /// The part of a line within the lattice.
    fn clip(&self, [start, end]: [DVec2; 2]) -> Option<[DVec2; 2]> {
        let [low, high] = self.lattice.bounds();
        let way = end - start;
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for axis in 0..2 {
            let mut cuts = [(low[axis] - start[axis]) / way[axis], (high[axis] - start[axis]) / way[axis]];
            if way[axis] == 0.0 {
                let inside = (low[axis]..=high[axis]).contains(&start[axis]);
                cuts = if inside { [0.0, 1.0] } else { [1.0, 0.0] };
            } else if way[axis] < 0.0 {
                cuts.reverse();
            }
            (from, to) = (from.max(cuts[0]), to.min(cuts[1]));
        }
        (from < to).then(|| [start.lerp(end, from), start.lerp(end, to)])
    }

    /// How near counts as the same place for contact lines.
    fn near(&self) -> f64 {
        self.spacing * 1e-3
    }

    /// Whether a point lies inside the region and keeps a distance from all lines. Those of the boundary are among
    /// them, so the crossing parity needs no care near the boundary.
    fn inside_and_clear(&self, point: DVec2, lines: &InnerLines, distance: f64) -> bool {
        let crossed = |edge: &[DVec2; 2]| ray_crosses(point, *edge);
        self.outline.right_of(point).filter(crossed).count() % 2 == 1 && !lines.are_near(point, distance)
    }
}

/// The edges of all rings, in order.
fn edges(region: &Region) -> Vec<[DVec2; 2]> {
    let rings = region.rings();
    rings
        .flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&start, &end)| [start, end]))
        .collect()
}

/// A point as a key of a map; −0.0 reads as 0.0.
fn key(flat: DVec2) -> [u64; 2] {
    [(flat.x + 0.0).to_bits(), (flat.y + 0.0).to_bits()]
}

/// The points of an edge cut in equal parts, both ends included. In space they depend on the edge alone, not on its
/// direction, so that patches that share an edge share its points.
fn pieces([(start, from), (end, to)]: [PlacedPoint; 2], parts: usize) -> impl Iterator<Item = PlacedPoint> {
    let forward = from.to_array() <= to.to_array();
    (0..=parts).map(move |k| match k {
        0 => (start, from),
        k if k == parts => (end, to),
        k => {
            let along = k as f64 / parts as f64;
            let back = (parts - k) as f64 / parts as f64;
            let place = if forward { from.lerp(to, along) } else { to.lerp(from, back) };
            (start.lerp(end, along), place)
        }
    })
}
