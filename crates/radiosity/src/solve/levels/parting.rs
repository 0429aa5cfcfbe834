//! The mesh of plates, cut along the borders of the patches that they are made of.
//!
//! ```text
//! +-------+-------+         +---+---+---+---+
//! |     / | \     |         |   | / | \ |   |    each triangle of the plate is cut by the patches that it is on; their vertices receive what
//! |   /   |   \   |   ->    +---/---+---\---+    is linear on the triangle
//! | /     |     \ |         | / |   |   | \ |
//! +-------+-------+         +---+---+---+---+
//! ```
use super::members::PlateMembers;
use super::tile::{Outline, clipped};
use super::tiling::Tiling;
use crate::extent::{BoxTree, Extent};
use crate::mesh::convex::PlacedCorner;
use crate::mesh::{cover::Cover, cover::CoverTile, element::Element, element::Mesh, guests::Guests};
use glam::{DVec2, DVec3};
use std::ops::Range;

/// What is less than this share of a triangle is what rounding left.
const SLIVER: f64 = 1e-9;

/// A mesh of patches.
#[derive(Debug)]
pub(super) struct Parted {
    /// The tile that each triangle is a part of, as in the mesh of plates.
    pub(super) cover: Cover,
    /// For each vertex a triangle of the mesh of plates that it is on.
    on: Vec<usize>,
}

/// A part of a triangle of a plate.
type TrianglePart = (usize, Vec<PlacedCorner>);

/// Cuts the mesh of plates; `lines` are those of each plate across which light jumps. O(n log n).
pub(super) fn part(
    tiling: &Tiling<'_>,
    members: &PlateMembers<'_>,
    lines: &[Vec<[DVec2; 2]>],
    plates: &Cover,
) -> Parted {
    let triangles = Triangles::of(plates, members.plates.count());
    let pieces: Vec<Vec<TrianglePart>> =
        (0..members.of_patches.len()).map(|patch| triangles.pieces(tiling, members, patch)).collect();
    let all =
        Guests::new(pieces.iter().flatten().flat_map(|(_, corners)| corners.iter().map(|corner| corner.1)));
    let mut parted = Parted { cover: Cover::default(), on: Vec::new() };
    for (patch, (pieces, &plate)) in pieces.iter().zip(&members.of_patches).enumerate() {
        if members.plates.is_joined(plate) {
            let loops = members.plates.given.patches[patch].polygon.loops();
            let sides = loops.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
            let on_sides = sides.flat_map(|(start, end)| all.on([*start, *end]));
            let guests: Vec<PlacedCorner> =
                on_sides.map(|place| (tiling.flatten(plate, place), place)).collect();
            parted.add(patch, pieces, &lines[plate], &guests);
        } else {
            parted.copy(patch, plates, triangles.of_plates[plate].clone());
        }
    }
    for owner in &mut parted.cover.owners {
        *owner = plates.owners[*owner];
    }
    parted
}

/// The triangles of all plates.
struct Triangles<'c> {
    mesh: &'c Mesh,
    of_plates: Vec<Range<usize>>,
    boxes: BoxTree,
}

impl<'c> Triangles<'c> {
    fn of(cover: &'c Cover, plates: usize) -> Triangles<'c> {
        let mesh = &cover.mesh;
        let start = |plate: usize| mesh.elements.partition_point(|element| element.patch < plate);
        let of_plates = (0..plates).map(|plate| start(plate)..start(plate + 1)).collect();
        let extent = |element: usize| Extent::holding(&mesh.triangle(element));
        Triangles { mesh, of_plates, boxes: BoxTree::new((0..mesh.elements.len()).map(extent)) }
    }

    /// The parts of the triangles of a plate on one of its patches.
    fn pieces(&self, tiling: &Tiling<'_>, members: &PlateMembers<'_>, patch: usize) -> Vec<TrianglePart> {
        let plate = members.of_patches[patch];
        let of_part = |part: &Vec<PlacedCorner>| {
            let extent = Extent::of_points(part.iter().map(|corner| corner.1));
            let mut near = self.boxes.meeting(&extent.grown(SLIVER * extent.diagonal()));
            near.retain(|element| self.of_plates[plate].contains(element));
            near.sort_unstable();
            let piece = |element: usize| {
                let triangle = self.mesh.triangle(element).map(|place| (tiling.flatten(plate, place), place));
                let [a, b, c] = triangle.map(|corner| corner.0);
                let outline = Outline::new(clipped(triangle.to_vec(), part))?;
                (2.0 * outline.area > SLIVER * (b - a).perp_dot(c - a)).then_some((element, outline.corners))
            };
            near.into_iter().filter_map(piece).collect::<Vec<_>>()
        };
        members.parts[patch].iter().flat_map(of_part).collect()
    }
}

/// A part of a triangle, around the mean of its corners.
fn tile((number, corners): &TrianglePart) -> CoverTile<'_> {
    let share = 1.0 / corners.len() as f64;
    let sum = |(flat, place): PlacedCorner, corner: &PlacedCorner| (flat + corner.0, place + corner.1);
    let (flat, place) = corners.iter().fold((DVec2::ZERO, DVec3::ZERO), sum);
    CoverTile { number: *number, corners, middle: (flat * share, place * share) }
}

impl Parted {
    /// Adds a part of a plate.
    fn add(&mut self, patch: usize, pieces: &[TrianglePart], lines: &[[DVec2; 2]], guests: &[PlacedCorner]) {
        let tiles: Vec<_> = pieces.iter().map(tile).collect();
        let before = self.cover.mesh.elements.len();
        self.cover.add(patch, &tiles, lines, guests);
        let Cover { mesh, owners } = &self.cover;
        self.on.resize(mesh.vertices.len(), 0);
        for (element, owner) in mesh.elements.iter().zip(owners).skip(before) {
            element.corners.iter().for_each(|&corner| self.on[corner] = *owner);
        }
    }

    /// Adds a plate as it is.
    fn copy(&mut self, patch: usize, plates: &Cover, elements: Range<usize>) {
        let corners = || elements.clone().flat_map(|element| plates.mesh.elements[element].corners);
        let Some(first) = corners().min() else { return };
        let last = corners().max().unwrap_or(first);
        let base = self.cover.mesh.vertices.len();
        self.cover.mesh.vertices.extend(&plates.mesh.vertices[first..=last]);
        self.on.resize(self.cover.mesh.vertices.len(), elements.start);
        for element in elements {
            let corners = plates.mesh.elements[element].corners.map(|corner| corner - first + base);
            corners.iter().for_each(|&corner| self.on[corner] = element);
            self.cover.mesh.elements.push(Element { patch, corners });
            self.cover.owners.push(element);
        }
    }

    /// What the vertices receive, vertices × `bands`, where those of the plates receive so much.
    pub(super) fn vertices(&self, plates: &Mesh, light: &[f64], bands: usize) -> Vec<f64> {
        let at = |(&place, &element): (&DVec3, &usize)| {
            let weights = weights(plates.triangle(element), place);
            let corners = plates.elements[element].corners;
            let value = move |band: usize| {
                corners
                    .iter()
                    .zip(weights)
                    .map(|(corner, weight)| weight * light[corner * bands + band])
                    .sum::<f64>()
            };
            (0..bands).map(value).collect::<Vec<f64>>()
        };
        self.cover.mesh.vertices.iter().zip(&self.on).flat_map(at).collect()
    }
}

/// The shares of a triangle's corners in a place on it: all of a corner that is there, however thin the triangle is.
fn weights(corners: [DVec3; 3], place: DVec3) -> [f64; 3] {
    if let Some(corner) = corners.iter().position(|corner| *corner == place) {
        return [0, 1, 2].map(|k| if k == corner { 1.0 } else { 0.0 });
    }
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let part = |one: DVec3, other: DVec3| (one - place).cross(other - place).dot(normal).max(0.0);
    let parts = [part(b, c), part(c, a), part(a, b)];
    let sum: f64 = parts.iter().sum();
    if sum > 0.0 { parts.map(|part| part / sum) } else { [1.0 / 3.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thin_triangles_have_shares_too() {
        let [a, b] = [DVec3::ZERO, DVec3::X];
        for c in [DVec3::Y, DVec3::X * 0.25, DVec3::Y * 1e-200] {
            assert_eq!(weights([a, b, c], c), [0.0, 0.0, 1.0]);
            let inside = weights([a, b, c], (a + b + c) / 3.0);
            assert!(inside.iter().all(|share| (share - 1.0 / 3.0).abs() < 1e-12), "{c}: {inside:?}");
        }
    }
}
