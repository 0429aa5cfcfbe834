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
//! Which points of a patch are inside is told by the exact winding number of the closed loops in which its plane cuts a solid. Of a patch that
//! only touches a solid nothing is cut: the solid is to be on both sides of what is cut.
use super::cut::{named, pieces, strip};
use super::sections::ClosedSurface;
use super::weld::Welds;
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
            |patch: usize| Some((patch, buried(solid, &scene.patches[patch], is_own(patch), hollows)?));
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

/// What of a patch lies within a solid and not in one of its hollows; nothing where that is no more than rounding. A patch of its own is to lie
/// within it once more than it does by itself.
fn buried(solid: &ClosedSurface, patch: &Patch, is_own: bool, hollows: &[&ClosedSurface]) -> Option<Region> {
    let plane = Plane::of(&patch.polygon);
    // Planes within it are one where overlaps are cut, too.
    let near = strip(patch).max(patch.slack());
    if is_own && !solid.reaches_before(patch, &plane, near) {
        return None;
    }
    let [before, mut behind] = [near, -near].map(|height| solid.section(&plane, height));
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
        .flat_map(|hollow| [near, -near].map(|height| inside(hollow.section(&plane, height))))
        .collect();
    let part = (within - Csg::union(&empty)).evaluate();
    (area(&plane, &part) > strip(patch) * perimeter(&patch.polygon)).then_some(part)
}

/// What outlines go around.
fn inside(rings: Vec<Vec<DVec2>>) -> Region {
    Region::from_rings(rings, FillRule::Positive).unwrap_or_default()
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
