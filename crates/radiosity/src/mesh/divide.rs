//! Points over a patch: its boundary and the contact lines at a spacing, and a lattice inside.
use super::lattice::{Lattice, parts};
use super::{Refusal, frame::Frame};
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
    /// The lattice that the interior points are from.
    pub(super) lattice: Lattice,
}

/// A point in the frame and in space.
type Spot = (DVec2, DVec3);

/// What is divided, and how.
struct Ground<'g> {
    frame: &'g Frame,
    region: Region,
    /// The patch's own vertices by their place in the frame: they keep their place in space bit for bit.
    corners: BTreeMap<[u64; 2], DVec3>,
    /// Contact lines in the frame.
    contacts: Vec<[DVec2; 2]>,
    /// Side of a cell, in the frame's unit.
    spacing: f64,
}

/// Finds the points of a patch for cells of side `spacing`, with points along the contact lines.
pub(super) fn divide(
    polygon: &PlanarPolygon,
    contacts: &[[DVec3; 2]],
    frame: &Frame,
    spacing: f64,
) -> Result<Points, Refusal> {
    let ground = Ground::new(polygon, contacts, frame, spacing)?;
    let mut points = Points { lattice: Lattice::over(&ground.region, ground.spacing), ..Points::default() };
    points.divide_boundary(&ground);
    let mut lines = points.lines(points.boundary.iter().map(|piece| piece.ends));
    for &contact in &ground.contacts {
        points.divide_contact(contact, &ground, &mut lines);
    }
    points.fill_inside(&ground, &lines);
    Ok(points)
}

impl Points {
    /// Appends every ring of the region, each edge in equal pieces between the contacts that end on it.
    fn divide_boundary(&mut self, ground: &Ground<'_>) {
        let mut known = BTreeMap::new();
        for (edge, [start, end]) in ground.edges().enumerate() {
            let chain: Vec<_> = ground
                .stops(start, end)
                .windows(2)
                .flat_map(|ends| pieces([ends[0], ends[1]], ground.spacing))
                .map(|(flat, place)| *known.entry(key(flat)).or_insert_with(|| self.push(flat, place)))
                .collect();
            let pairs = chain.windows(2).filter(|ends| ends[0] != ends[1]);
            self.boundary.extend(pairs.map(|ends| SubEdge { ends: [ends[0], ends[1]], edge }));
        }
    }

    /// Appends the part of a contact line that lies inside the region and keeps a quarter of a step from the
    /// boundary and from the contact lines before it, but for the points that it shares with them.
    fn divide_contact(&mut self, ends: [DVec2; 2], ground: &Ground<'_>, lines: &mut Vec<[DVec2; 2]>) {
        let clearance = self.lattice.step.min_element() / 4.0;
        let chain: Vec<Option<usize>> = pieces(ends.map(|end| (end, ground.frame.lift(end))), ground.spacing)
            .map(|(flat, place)| match self.known(flat, ground.near()) {
                None if ground.inside_and_clear(flat, lines, clearance) => Some(self.push(flat, place)),
                known => known,
            })
            .collect();
        let whole = chain.windows(2).filter_map(|pair| Some([pair[0]?, pair[1]?]));
        let middle = |[a, b]: [usize; 2]| self.flat[a].midpoint(self.flat[b]);
        let kept: Vec<_> =
            whole.filter(|&pair| ground.inside_and_clear(middle(pair), lines, clearance / 4.0)).collect();
        lines.extend(self.lines(kept.iter().copied()));
        self.contacts.extend(kept);
    }

    /// Appends the lattice points inside the region that keep half a step from the lines.
    fn fill_inside(&mut self, ground: &Ground<'_>, lines: &[[DVec2; 2]]) {
        let lattice = self.lattice;
        let clearance = lattice.step.min_element() / 2.0;
        for j in 1..lattice.cells[1] {
            for i in 1..lattice.cells[0] {
                let point = lattice.point(i, j);
                if ground.inside_and_clear(point, lines, clearance) {
                    self.push(point, ground.frame.lift(point));
                }
            }
        }
    }

    /// The first point within a distance.
    fn known(&self, flat: DVec2, distance: f64) -> Option<usize> {
        self.flat.iter().position(|known| known.distance(flat) < distance)
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
        contacts: &[[DVec3; 2]],
        frame: &'g Frame,
        spacing: f64,
    ) -> Result<Ground<'g>, Refusal> {
        let flatten = |points: &[DVec3]| points.iter().map(|&p| frame.flatten(p)).collect::<Vec<_>>();
        let region = Region::from_rings(polygon.loops().map(flatten), FillRule::EvenOdd)
            .map_err(|error| Refusal(error.to_string()))?;
        if region.is_empty() {
            return Err(Refusal("its area is zero".to_owned()));
        }
        let corners = polygon.loops().flatten().map(|&place| (key(frame.flatten(place)), place)).collect();
        let contacts = contacts.iter().map(|ends| ends.map(|end| frame.flatten(end))).collect();
        Ok(Ground { frame, region, corners, contacts, spacing: spacing / frame.unit() })
    }

    /// The edges of all rings, in order.
    fn edges(&self) -> impl Iterator<Item = [DVec2; 2]> {
        let rings = self.region.rings();
        rings.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&start, &end)| [start, end]))
    }

    /// The ends of an edge and the places between them where contact lines end.
    fn stops(&self, start: DVec2, end: DVec2) -> Vec<Spot> {
        let along = |point: DVec2| (point - start).dot(end - start) / (end - start).length_squared();
        let on_edge = |point: &DVec2| point.distance(start.lerp(end, along(*point))) < self.near();
        let margin = self.near() / start.distance(end);
        let mut breaks: Vec<f64> =
            self.contacts.iter().flatten().copied().filter(on_edge).map(along).collect();
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

    /// How near counts as the same place for contact lines.
    fn near(&self) -> f64 {
        self.spacing * 1e-3
    }

    /// Whether a point lies inside the region and keeps a distance from all lines. Those of the boundary are among
    /// them, so the crossing parity needs no care near the boundary.
    fn inside_and_clear(&self, point: DVec2, lines: &[[DVec2; 2]], distance: f64) -> bool {
        let crossed = |[a, b]: &[DVec2; 2]| {
            (a.y > point.y) != (b.y > point.y) && (b - a).perp_dot(point - a) * (b.y - a.y) > 0.0
        };
        let near = |&[a, b]: &[DVec2; 2]| {
            let along = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            point.distance_squared(a.lerp(b, along)) < distance * distance
        };
        self.edges().filter(crossed).count() % 2 == 1 && !lines.iter().any(near)
    }
}

/// A point as a key of a map; −0.0 reads as 0.0.
fn key(flat: DVec2) -> [u64; 2] {
    [(flat.x + 0.0).to_bits(), (flat.y + 0.0).to_bits()]
}

/// The points of an edge cut in equal parts near `spacing`, both ends included. In space they depend on the edge
/// alone, not on its direction, so that patches that share an edge share its points.
fn pieces([(start, from), (end, to)]: [Spot; 2], spacing: f64) -> impl Iterator<Item = Spot> {
    let parts = parts(start.distance(end), spacing);
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
