//! Solids that pass through each other: what lies within a solid is cut away from the surfaces that reach into it.
//!
//! ```text
//!   ┌──────────┐
//!   │     ┌╌╌╌╌┼─────┐     No light comes to what is dashed: it lies within the other solid.
//!   │     ╎    ╎     │
//!   └─────┼╌╌╌╌┘     │
//!         └──────────┘
//! ```
//!
//! A plane cuts a closed surface in closed loops; which points of the plane are inside is told by the exact winding number of these. Of a
//! patch that only touches a solid nothing is cut: the solid is to be on both sides of what is cut.
use super::cut::{named, pieces, strip};
use super::weld::{Welds, key};
use crate::bodies::{Bodies, is_other_side};
use crate::coplanar::perimeter;
use crate::extent::{BoxTree, Extent};
use crate::plane::Plane;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use glam::{DVec2, DVec3};
use polycsg::{Csg, FillRule, Region};
use std::collections::{BTreeMap, HashSet};

/// A closed surface of triangles that are turned out, so that a plane cuts each in one segment at most.
#[derive(Debug)]
struct ClosedSurface {
    body: usize,
    triangles: Vec<[DVec3; 3]>,
    boxes: BoxTree,
    extent: Extent,
}

/// What is cut out of a patch, and a patch of the solid that it lies within.
type BuriedPart = (Region, usize);

/// Cuts away what lies within solids; tells what did. Nothing when `stop` says to stop. A patch that lies within a solid wholly stays, unless
/// another that is connected to it reaches out: it is dark in any case. O(n log n) for n patches of which few are cut.
pub(super) fn cut(scene: &mut Scene, stop: &dyn Fn() -> bool) -> Option<Vec<Finding>> {
    let welds = Welds::of(scene);
    let bodies = Bodies::of_all_sides(scene, &welds);
    let [solids, hollows] = [false, true].map(|turned_in| solids(scene, &bodies, &welds, turned_in));
    let boxes = BoxTree::new(scene.patches.iter().map(Extent::of));
    let mut buried: BTreeMap<usize, Vec<BuriedPart>> = BTreeMap::new();
    for solid in &solids {
        if stop() {
            return None;
        }
        let within = |hollow: &&ClosedSurface| solid.extent.holds(&hollow.extent);
        let hollows: Vec<&ClosedSurface> = hollows.iter().filter(within).collect();
        for (patch, part) in parts_within(scene, &bodies, &boxes, solid, &hollows) {
            buried.entry(patch).or_default().push((part, bodies.bodies[solid.body].first));
        }
    }
    let findings = buried.iter().flat_map(|(patch, parts)| findings(scene, *patch, parts)).collect();
    if !buried.is_empty() {
        leave_out(scene, &buried);
    }
    Some(findings)
}

/// The closed bodies of which all faces have one side and are turned out, or of which all are turned in.
fn solids(scene: &Scene, bodies: &Bodies, welds: &Welds, turned_in: bool) -> Vec<ClosedSurface> {
    let two_sided: HashSet<usize> = (0..scene.patches.len())
        .filter(|&index| is_other_side(scene, index))
        .map(|index| bodies.of_patch[index])
        .collect();
    let mut triangles: BTreeMap<usize, Vec<[DVec3; 3]>> = BTreeMap::new();
    for (patch, &body) in scene.patches.iter().zip(&bodies.of_patch) {
        if bodies.bodies[body].turned_in == Some(turned_in) && !two_sided.contains(&body) {
            triangles.entry(body).or_default().extend(fan(patch, welds, turned_in));
        }
    }
    triangles.into_iter().map(|(body, triangles)| ClosedSurface::new(body, triangles)).collect()
}

/// Triangles that add up to a patch, from its first vertex to every edge: what is covered to and fro cancels.
fn fan(patch: &Patch, welds: &Welds, turned_in: bool) -> Vec<[DVec3; 3]> {
    let place = |point: &DVec3| welds.place(*point);
    let tip = patch.polygon.loops().flatten().next().map_or(DVec3::ZERO, place);
    let edges = patch.polygon.loops().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let edges = edges.map(|(a, b)| [place(a), place(b)]).filter(|[a, b]| *a != tip && *b != tip && a != b);
    edges.map(|[a, b]| if turned_in { [tip, b, a] } else { [tip, a, b] }).collect()
}

/// What lies within a solid and not in a hollow of it, of patches of other bodies that reach into it. Of solids that share edges and are
/// one body it is what lies within one of them.
fn parts_within(
    scene: &Scene,
    bodies: &Bodies,
    boxes: &BoxTree,
    solid: &ClosedSurface,
    hollows: &[&ClosedSurface],
) -> Vec<(usize, Region)> {
    let mut others: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for patch in boxes.meeting(&solid.extent) {
        let body = bodies.of_patch[patch];
        if body != solid.body || bodies.bodies[body].is_joined {
            others.entry(body).or_default().push(patch);
        }
    }
    let meets = |patch: &usize| !solid.boxes.meeting(&Extent::of(&scene.patches[*patch])).is_empty();
    let mut parts = Vec::new();
    for patches in others.into_values().filter(|patches| patches.iter().any(meets)) {
        let is_own = |patch: usize| bodies.of_patch[patch] == solid.body;
        let within =
            |patch: usize| Some((patch, solid.buried(&scene.patches[patch], is_own(patch), hollows)?));
        let found: Vec<(usize, Region)> = patches.into_iter().filter_map(within).collect();
        if found.iter().any(|(patch, part)| !is_all(&scene.patches[*patch], part)) {
            parts.extend(found);
        }
    }
    parts
}

/// Whether no more than rounding is left of a patch without a part of it.
fn is_all(patch: &Patch, part: &Region) -> bool {
    let left = patch.polygon.area() - area(&Plane::of(&patch.polygon), part);
    left <= strip(patch) * perimeter(&patch.polygon)
}

/// The area of a region of a plane.
fn area(plane: &Plane, region: &Region) -> f64 {
    region.area() / plane.normal.abs().max_element()
}

impl ClosedSurface {
    fn new(body: usize, triangles: Vec<[DVec3; 3]>) -> ClosedSurface {
        ClosedSurface {
            body,
            boxes: BoxTree::new(triangles.iter().map(Extent::holding)),
            extent: Extent::holding(triangles.iter().flatten()),
            triangles,
        }
    }

    /// What of a patch lies within it and not in one of its hollows; nothing where that is no more than rounding. A patch of its own is to lie
    /// within it once more than it does by itself.
    fn buried(&self, patch: &Patch, is_own: bool, hollows: &[&ClosedSurface]) -> Option<Region> {
        let plane = Plane::of(&patch.polygon);
        // Planes within it are one where overlaps are cut, too.
        let near = strip(patch).max(patch.slack());
        let [before, mut behind] = [true, false].map(|is_before| self.section(&plane, near, is_before));
        if before.is_empty() || behind.is_empty() {
            return None;
        }
        let outline = plane.region(&patch.polygon);
        if is_own {
            behind.extend(outline.rings().map(|ring| ring.iter().rev().copied().collect::<Vec<_>>()));
        }
        let [before, behind] = [before, behind].map(inside);
        let within = Csg::from(&outline) & Csg::from(&before) & Csg::from(&behind);
        let empty: Vec<Region> = hollows
            .iter()
            .flat_map(|hollow| [true, false].map(|is_before| inside(hollow.section(&plane, near, is_before))))
            .collect();
        let part = (within - Csg::union(&empty)).evaluate();
        (area(&plane, &part) > strip(patch) * perimeter(&patch.polygon)).then_some(part)
    }

    /// The outlines of what of it is in a plane, just before the plane or just behind it: what is as near to the plane as rounding is on the
    /// other side.
    fn section(&self, plane: &Plane, near: f64, is_before: bool) -> Vec<Vec<DVec2>> {
        let limit = if is_before { near } else { -near };
        let mut segments: BTreeMap<[u64; 2], Vec<DVec2>> = BTreeMap::new();
        for index in self.boxes.crossed_by(plane, near) {
            let [a, b, c] = self.triangles[index];
            let (mut start, mut end) = (None, None);
            for [from, to] in [[a, b], [b, c], [c, a]] {
                match [from, to].map(|point| plane.height(point) > limit) {
                    [true, false] => start = Some(crossing(plane, [from, to])),
                    [false, true] => end = Some(crossing(plane, [from, to])),
                    _ => {}
                }
            }
            if let (Some(start), Some(end)) = (start, end) {
                segments.entry(bits(start)).or_default().push(end);
            }
        }
        rings(segments).into_iter().map(|ring| straight(ring, near)).collect()
    }
}

/// What outlines go around.
fn inside(rings: Vec<Vec<DVec2>>) -> Region {
    Region::from_rings(rings, FillRule::Positive).unwrap_or_default()
}

/// Where an edge passes through the plane, or its end that is nearest to it, in the plane: the same for both directions of the edge.
fn crossing(plane: &Plane, ends: [DVec3; 2]) -> DVec2 {
    let [a, b] = if key(ends[0]) < key(ends[1]) { ends } else { [ends[1], ends[0]] };
    let [above, below] = [a, b].map(|point| plane.height(point));
    let share = (above / (above - below)).clamp(0.0, 1.0);
    plane.flatten(a + share * (b - a))
}

fn bits(point: DVec2) -> [u64; 2] {
    point.to_array().map(|coordinate| (coordinate + 0.0).to_bits())
}

/// The closed walks over segments, each of which is used once.
fn rings(mut segments: BTreeMap<[u64; 2], Vec<DVec2>>) -> Vec<Vec<DVec2>> {
    let mut rings = Vec::new();
    while let Some((start, mut ends)) = segments.pop_first() {
        let mut ring = Vec::new();
        let mut next = ends.pop();
        if !ends.is_empty() {
            segments.insert(start, ends);
        }
        while let Some(point) = next {
            ring.push(point);
            let Some(ends) = segments.get_mut(&bits(point)) else { break };
            next = ends.pop();
            if ends.is_empty() {
                segments.remove(&bits(point));
            }
        }
        rings.push(ring);
    }
    rings
}

/// A ring without the points within its sides, where edges of triangles pass through the plane. Of two that rounding keeps apart one stays: so
/// each is held against the points that are left beside it.
fn straight(mut ring: Vec<DVec2>, near: f64) -> Vec<DVec2> {
    let mut at = 0;
    while at < ring.len() && ring.len() > 2 {
        let count = ring.len();
        let [before, point, after] = [at, at + 1, at + 2].map(|index| ring[index % count]);
        let (side, arm) = (after - before, point - before);
        if side.perp_dot(arm).abs() <= near * side.length() && arm.dot(side - arm) > 0.0 {
            ring.remove((at + 1) % count);
        } else {
            at += 1;
        }
    }
    ring
}

/// Of what lies within solids of a patch.
fn findings(scene: &Scene, patch: usize, parts: &[BuriedPart]) -> Vec<Finding> {
    let patch = &scene.patches[patch];
    let plane = Plane::of(&patch.polygon);
    let finding = |(part, first): &BuriedPart| Finding {
        kind: Kind::Buried,
        patches: vec![patch.name.clone(), scene.patches[*first].name.clone()],
        what: format!(
            "{:.4e} of its {:.4e} lies within the solid of the second",
            area(&plane, part),
            patch.polygon.area()
        ),
        repair: "unite the solids; or let reading or inspect --repair do it".into(),
        places: Vec::new(),
    };
    parts.iter().map(finding).collect()
}

/// Cuts parts out of patches.
fn leave_out(scene: &mut Scene, buried: &BTreeMap<usize, Vec<BuriedPart>>) {
    let mut taken: HashSet<String> = scene.patches.iter().map(|patch| patch.name.clone()).collect();
    let mut patches = Vec::with_capacity(scene.patches.len());
    for (index, patch) in scene.patches.iter().enumerate() {
        let Some(parts) = buried.get(&index) else {
            patches.push(patch.clone());
            continue;
        };
        let outline = Plane::of(&patch.polygon).region(&patch.polygon);
        let regions: Vec<Region> = parts.iter().map(|(part, _)| part.clone()).collect();
        let rest = (Csg::from(&outline) - Csg::union(&regions)).evaluate();
        patches.extend(named(patch, pieces(patch, &rest, std::iter::empty()), &mut taken));
    }
    scene.patches = patches;
}
