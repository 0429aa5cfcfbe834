//! A patch's plane in two of the three coordinates.
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};
use polycsg::{FillRule, Region};

/// How many roundings of its largest coordinate a point may lie off a plane or a line and still count as on it, as for
/// the vertices of a [`PlanarPolygon`].
const ROUNDINGS: f64 = 64.0;

/// The two coordinates in which a plane is seen best, in the order in which its front is counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    origin: DVec3,
    pub(crate) normal: DVec3,
    axes: [usize; 3],
}

impl Plane {
    pub(crate) fn of(polygon: &PlanarPolygon) -> Plane {
        let normal = polygon.normal();
        let dropped = normal.abs().max_position();
        let (u, v) = ((dropped + 1) % 3, (dropped + 2) % 3);
        let axes = if normal[dropped] > 0.0 { [u, v, dropped] } else { [v, u, dropped] };
        let origin = polygon.loops().next().map_or(DVec3::ZERO, |points| points[0]);
        Plane { origin, normal, axes }
    }

    pub(crate) fn flatten(&self, point: DVec3) -> DVec2 {
        DVec2::new(point[self.axes[0]], point[self.axes[1]])
    }

    /// The point of the plane with these two coordinates.
    pub(crate) fn raise(&self, flat: DVec2) -> DVec3 {
        let ([u, v, w], normal) = (self.axes, self.normal);
        let mut point = DVec3::ZERO;
        (point[u], point[v]) = (flat.x, flat.y);
        let run = normal[u] * (flat.x - self.origin[u]) + normal[v] * (flat.y - self.origin[v]);
        point[w] = self.origin[w] - run / normal[w];
        point
    }

    /// Signed distance from the plane, positive in front.
    pub(crate) fn height(&self, point: DVec3) -> f64 {
        (point - self.origin).dot(self.normal)
    }

    /// A polygon as seen along the dropped coordinate.
    pub(crate) fn region(&self, polygon: &PlanarPolygon) -> Region {
        let flat = |points: &[DVec3]| points.iter().map(|&point| self.flatten(point)).collect::<Vec<_>>();
        Region::from_rings(polygon.loops().map(flat), FillRule::EvenOdd)
            .expect("a polygon's coordinates are finite")
    }

    /// The polygons of a region, in the plane. Corners at one of the `known` points keep its place bit for bit; of two points above each
    /// other the last counts. Where that makes a polygon that is not planar, all its corners are raised to the plane.
    pub(crate) fn lift(&self, region: &Region, known: impl IntoIterator<Item = DVec3>) -> Vec<PlanarPolygon> {
        let known: std::collections::HashMap<[u64; 2], DVec3> =
            known.into_iter().map(|point| (bits(self.flatten(point)), point)).collect();
        let place = |flat: &DVec2| known.get(&bits(*flat)).copied().unwrap_or_else(|| self.raise(*flat));
        let lifted = |rings: &[&[DVec2]], place: &dyn Fn(&DVec2) -> DVec3| {
            PlanarPolygon::new(rings.iter().map(|ring| ring.iter().map(place).collect::<Vec<_>>())).ok()
        };
        let polygons = region.polygons().map(|p| std::iter::once(p.outer()).chain(p.holes()).collect());
        polygons
            .filter_map(|rings: Vec<&[DVec2]>| {
                lifted(&rings, &place).or_else(|| lifted(&rings, &|flat| self.raise(*flat)))
            })
            .collect()
    }
}

/// A place of a plane as a key; −0.0 reads as 0.0.
pub(crate) fn bits(flat: DVec2) -> [u64; 2] {
    [(flat.x + 0.0).to_bits(), (flat.y + 0.0).to_bits()]
}

/// How far off still counts as on, for points of this size.
pub(crate) fn slack(points: &[DVec3]) -> f64 {
    let largest = points.iter().map(|point| point.abs().max_element()).fold(0.0, f64::max);
    ROUNDINGS * f64::EPSILON * largest
}
