//! Short numbers that tell scenes, meshes and files apart.
use crate::mesh::subdivide::Subdivision;
use crate::scene::Scene;
use fnv::FnvHasher;
use formfactor::PlanarPolygon;
use glam::DVec3;
use std::hash::Hasher;

/// The fingerprint of some bytes: FNV-1a, 64 bits, the same on every machine.
pub(super) fn of(bytes: &[u8]) -> u64 {
    let mut hasher = FnvHasher::default();
    hasher.write(bytes);
    hasher.finish()
}

/// The fingerprint of all patches' shapes.
pub(super) fn of_shapes(scene: &Scene) -> u64 {
    let mut hasher = FnvHasher::default();
    write_shapes(&mut hasher, scene);
    hasher.finish()
}

/// The fingerprint of a shape.
pub(super) fn of_polygon(polygon: &PlanarPolygon) -> u64 {
    let mut hasher = FnvHasher::default();
    polygon.loops().for_each(|points| write_points(&mut hasher, points));
    hasher.finish()
}

fn write_shapes(hasher: &mut FnvHasher, scene: &Scene) {
    for patch in &scene.patches {
        patch.polygon.loops().for_each(|points| write_points(hasher, points));
        write_number(hasher, usize::MAX);
    }
}

/// The fingerprint of all that form factors depend on: what hides, and what is cut how.
pub(super) fn of_mesh(scene: &Scene, subdivision: &Subdivision) -> u64 {
    let mut hasher = FnvHasher::default();
    write_shapes(&mut hasher, scene);
    let Subdivision { mesh, nodes, .. } = subdivision;
    write_points(&mut hasher, &mesh.vertices);
    for element in &mesh.elements {
        element.corners.iter().chain([&element.patch]).for_each(|number| write_number(&mut hasher, *number));
    }
    for node in nodes {
        [node.elements.start, node.elements.end].iter().for_each(|number| write_number(&mut hasher, *number));
    }
    hasher.finish()
}

/// The fingerprint of what is taken roughly: a share of the view, but of no patch that emits.
pub(super) fn of_emitters(scene: &Scene, share: f64) -> u64 {
    let mut hasher = FnvHasher::default();
    hasher.write(&share.to_le_bytes());
    scene.patches.iter().for_each(|patch| hasher.write(&[u8::from(patch.emits())]));
    hasher.finish()
}

/// Points, and how many there are.
fn write_points(hasher: &mut FnvHasher, points: &[DVec3]) {
    write_number(hasher, points.len());
    for coordinate in points.iter().flat_map(DVec3::to_array) {
        hasher.write(&coordinate.to_le_bytes());
    }
}

/// A number, as wide on every machine.
fn write_number(hasher: &mut FnvHasher, number: usize) {
    hasher.write(&(number as u64).to_le_bytes());
}
