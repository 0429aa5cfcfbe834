//! Refuses patches that lie on each other: form factors to both would count the same view twice.
use crate::error::Error;
use crate::extent::Extent;
use crate::scene::{Scene, patch::Patch};
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};
use polycsg::{FillRule, Region};

/// How near two planes are one, in shares of the coordinates' size: what rounding of a rotated scene leaves.
const NEAR: f64 = 1e-12;
/// Which share of the smaller patch may lie on the other one: what rounding of a shared edge leaves.
const SHARE: f64 = 1e-9;

/// Checks that no two patches of one plane that face the same way overlap. O(n log n) for n patches, and O(k) for the k
/// pairs whose extents meet.
pub(super) fn check(scene: &Scene) -> Result<(), Error> {
    let placed = scene.patches.iter().map(|patch| BoxedPatch { patch, extent: Extent::of(patch) });
    let mut placed: Vec<BoxedPatch<'_>> = placed.collect();
    placed.sort_by(|a, b| a.extent.low.x.total_cmp(&b.extent.low.x));
    for (index, one) in placed.iter().enumerate() {
        let beside = |other: &&BoxedPatch<'_>| other.extent.low.x <= one.extent.high.x;
        for other in placed[index + 1..].iter().take_while(beside) {
            if let Some(share) = one.overlap(other) {
                return Err(named(scene, one.patch, other.patch, share));
            }
        }
    }
    Ok(())
}

/// The error, the patches in the order of the scene.
fn named(scene: &Scene, one: &Patch, other: &Patch, share: f64) -> Error {
    let place = |patch: &Patch| scene.patches.iter().position(|other| std::ptr::eq(other, patch));
    let [first, second] = if place(one) < place(other) { [one, other] } else { [other, one] };
    Error::Overlap { first: first.name.clone(), second: second.name.clone(), share }
}

/// A patch in its box.
#[derive(Debug)]
struct BoxedPatch<'s> {
    patch: &'s Patch,
    extent: Extent,
}

impl BoxedPatch<'_> {
    /// Which share of the smaller of two patches lies on the other one; nothing when they do not overlap.
    fn overlap(&self, other: &BoxedPatch<'_>) -> Option<f64> {
        let (one, two) = (&self.patch.polygon, &other.patch.polygon);
        if !self.extent.is_near(&other.extent, 0.0)
            || one.normal().dot(two.normal()) < 1.0 - NEAR
            || !self.in_one_plane(other)
        {
            return None;
        }
        let normal = one.normal().abs();
        let [one, two] = [one, two].map(|polygon| flatten(polygon, normal));
        let common = one.intersection(&two).area();
        Some(common / one.area().min(two.area())).filter(|share| *share > SHARE)
    }

    /// Whether all vertices of the other patch lie in this one's plane, but for rounding.
    fn in_one_plane(&self, other: &BoxedPatch<'_>) -> bool {
        let size = self.extent.reach().max(other.extent.reach());
        let Some(&origin) = self.patch.polygon.loops().flatten().next() else { return false };
        let height = |place: &DVec3| (*place - origin).dot(self.patch.polygon.normal()).abs();
        other.patch.polygon.loops().flatten().all(|place| height(place) <= NEAR * size)
    }
}

/// A polygon in the two coordinates that its plane is least steep over.
fn flatten(polygon: &PlanarPolygon, normal: DVec3) -> Region {
    let dropped = normal.max_position();
    let [u, v] = [(dropped + 1) % 3, (dropped + 2) % 3];
    let rings =
        polygon.loops().map(|points| points.iter().map(|p| DVec2::new(p[u], p[v])).collect::<Vec<_>>());
    Region::from_rings(rings, FillRule::EvenOdd).unwrap_or_default()
}
