//! Into the world: transformed, checked, split where needed, named.
use super::finish::{Finish, Spectra, Surface};
use super::polygon::{Corner, Facet, Polygon, bits, points};
use super::{
    flaws::Flaws,
    planar::planar,
    split::{newell, split},
};
use crate::io::error::Fault;
use crate::plane::slack;
use crate::scene::{
    finding::Finding,
    patch::{Origin, Patch},
    texture::Texture,
};
use crate::union_find::UnionFind;
use formfactor::PlanarPolygon;
use glam::{DMat4, DVec3};
use std::collections::{BTreeMap, HashMap, HashSet};

/// More polygons than any solver takes; what instances multiply must end somewhere.
const MAX_PATCHES: usize = 1_000_000;

/// Why a surface was refused.
#[derive(Debug)]
pub(crate) enum Refusal {
    /// More polygons than [`MAX_PATCHES`].
    TooMany,
    /// A polygon that the form factors refuse, by its index in the primitive.
    Shape { polygon: usize, source: formfactor::Error },
}

impl From<Refusal> for Fault {
    fn from(refusal: Refusal) -> Fault {
        match refusal {
            Refusal::TooMany => Fault::TooMany { what: "polygons", limit: MAX_PATCHES },
            Refusal::Shape { polygon, source } => Fault::Shape { polygon, source },
        }
    }
}

/// The patches so far.
#[derive(Debug, Default)]
pub(crate) struct Surfaces {
    drafts: Vec<Draft>,
    /// How many polygons each node's name has.
    counts: BTreeMap<String, usize>,
    /// How many smoothing groups there are.
    groups: usize,
    /// Whether the file holds coordinates in single precision.
    is_single: bool,
}

/// A patch before it has its name: `base`, the number of its polygon among those of that base, and its piece.
#[derive(Debug)]
struct Draft {
    base: String,
    number: usize,
    piece: Option<usize>,
    patch: Patch,
}

impl Surfaces {
    /// Of a file that holds coordinates in single precision.
    pub(crate) fn in_single_precision() -> Surfaces {
        Surfaces { is_single: true, ..Surfaces::default() }
    }

    /// Adds a surface's patches; returns the facets, by their numbers, that were split or left out.
    pub(crate) fn add(
        &mut self,
        surface: &Surface<'_>,
        warnings: &mut Vec<Finding>,
    ) -> Result<Vec<usize>, Refusal> {
        let world = &surface.world;
        if !(world.determinant().is_normal() && world.inverse().is_finite()) {
            let place = format!("{}, {}", surface.place, surface.name);
            let what = "a transform flattens its node to nothing; it is left out";
            Finding::note(warnings, place, what, "give the node a scale that is not 0");
            return Ok(Vec::new());
        }
        let groups = self.smoothing(surface.facets);
        let (mut flaws, mut flawed) = (Flaws::default(), Vec::new());
        for (facet, group) in surface.facets.iter().zip(groups) {
            let is_whole = self.add_facet(surface, facet, group, &mut flaws)?;
            flawed.extend((!is_whole).then_some(facet.number));
        }
        warnings.extend(flaws.findings(surface.place));
        Ok(flawed)
    }

    /// Adds the patches of a facet; returns whether it is one patch, of one or two sides.
    fn add_facet(
        &mut self,
        surface: &Surface<'_>,
        facet: &Facet,
        smoothing: Option<usize>,
        flaws: &mut Flaws,
    ) -> Result<bool, Refusal> {
        if self.drafts.len() >= MAX_PATCHES {
            return Err(Refusal::TooMany);
        }
        let count = self.counts.entry(surface.name.into()).or_default();
        *count += 1;
        let number = *count;
        let (polygon, name) = (facet.number, format!("{}.{number}", surface.name));
        let loops = transformed(&facet.loops, &surface.world);
        let rounding = self.rounding(facet, surface);
        let pieces =
            planar(&loops, rounding, &name, flaws).map_err(|source| Refusal::Shape { polygon, source })?;
        let is_whole = matches!(pieces.as_slice(), [(None, _)]);
        let texture = texture(&loops, facet, surface);
        let origin = Origin { polygon, ..surface.origin };
        let draft = |(piece, polygon, is_back)| {
            let patch = finished(polygon, &surface.finish, texture.clone());
            Draft {
                base: surface.name.into(),
                number,
                piece,
                patch: Patch { origin, smoothing, is_back, rounding, ..patch },
            }
        };
        for (piece, polygon) in pieces {
            let back = if surface.two_sided { turned(&polygon) } else { None };
            self.drafts.push(draft((piece, polygon, false)));
            self.drafts.extend(back.map(|polygon| draft((piece, polygon, true))));
        }
        Ok(is_whole)
    }

    /// How far the file's numbers, and doubles on their way into the world, may leave a facet's vertices from their places.
    fn rounding(&self, facet: &Facet, surface: &Surface<'_>) -> f64 {
        let DMat4 { x_axis, y_axis, z_axis, w_axis } = surface.world;
        let [x, y, z, shift] = [x_axis, y_axis, z_axis, w_axis].map(|axis| axis.truncate().abs());
        let sizes = facet.loops.iter().flatten().map(|corner| corner.point.abs());
        let moved = sizes.map(|size| x * size.x + y * size.y + z * size.z);
        let largest = moved.reduce(DVec3::max).unwrap_or(DVec3::ZERO);
        let spacing = if self.is_single { f64::from(f32::EPSILON) } else { f64::EPSILON };
        spacing / 2.0 * largest.length() + slack(&[largest + shift])
    }

    /// For each facet the number of its smoothing group: facets that share a vertex and the normal there.
    fn smoothing(&mut self, facets: &[Facet]) -> Vec<Option<usize>> {
        let mut groups = UnionFind::new(facets.len());
        let mut first = HashMap::new();
        for (index, facet) in facets.iter().enumerate() {
            for corner in facet.loops.iter().flatten().filter(|corner| corner.normal != DVec3::ZERO) {
                let known = *first.entry((bits(corner.point), bits(corner.normal))).or_insert(index);
                groups.join(known, index);
            }
        }
        let leaders: Vec<usize> = (0..facets.len()).map(|index| groups.first(index)).collect();
        let mut sizes = vec![0; facets.len()];
        leaders.iter().for_each(|&leader| sizes[leader] += 1);
        let base = self.groups;
        self.groups += facets.len();
        leaders.into_iter().map(|leader| (sizes[leader] > 1).then_some(base + leader)).collect()
    }

    /// Names the patches: the base alone where it has one polygon, `base.k` (from 1, in the order of the file, polygons
    /// left out counted) where it has several, `base.k.m` for the pieces of a split one. Nodes of the same name are
    /// numbered together; a name that is taken gets a `'`.
    pub(crate) fn named(self) -> Vec<Patch> {
        let mut taken = HashSet::new();
        let counts = self.counts;
        let patch = |draft: Draft| {
            let mut name = match draft.piece {
                Some(piece) => format!("{}.{}.{piece}", draft.base, draft.number),
                None if counts[&draft.base] > 1 => format!("{}.{}", draft.base, draft.number),
                None => draft.base,
            };
            if draft.patch.is_back {
                name.push_str(".back");
            }
            while !taken.insert(name.clone()) {
                name.push('\'');
            }
            Patch { name, ..draft.patch }
        };
        self.drafts.into_iter().map(patch).collect()
    }
}

/// The same points seen from the other side.
pub(super) fn turned(polygon: &PlanarPolygon) -> Option<PlanarPolygon> {
    let loops = polygon.loops().map(|points| points.iter().rev().copied().collect::<Vec<_>>());
    PlanarPolygon::new(loops).ok()
}

/// A patch without a name; its reflectance is the texture's mean where it has one.
fn finished(polygon: PlanarPolygon, finish: &Finish, texture: Option<Texture>) -> Patch {
    let material = finish.material.clone();
    if let Some(Spectra { reflectance, emission }) = finish.spectra.clone() {
        return Patch { material, ..Patch::new("", polygon, reflectance, emission) };
    }
    let reflectance = texture.as_ref().map_or(finish.reflectance, |texture| texture.overall());
    let patch = Patch::new("", polygon, reflectance.into(), finish.emission.into());
    Patch { texture, material, ..patch }
}

/// The picture laid over the polygon, if it has one.
fn texture(loops: &Polygon, facet: &Facet, surface: &Surface<'_>) -> Option<Texture> {
    let image = surface.finish.image.clone()?;
    let parts = match facet.parts.as_slice() {
        [] => split(loops),
        parts => parts.iter().map(|part| part.map(|corner| moved(corner, &surface.world))).collect(),
    };
    let map = parts.into_iter().map(|part| part.map(|corner| (corner.point, corner.place))).collect();
    Some(Texture { image, factor: surface.finish.reflectance, map })
}

/// Into the world, without repeated vertices and holes of fewer than three; a mirrored solid keeps its outside outside, and holes run
/// against their outline, so that the inside is to the left of every edge.
fn transformed(loops: &Polygon, world: &DMat4) -> Polygon {
    let mirrored = world.determinant() < 0.0;
    let turn = |ring: &Vec<Corner>| {
        let mut corners: Vec<Corner> = ring.iter().map(|corner| moved(*corner, world)).collect();
        corners.dedup_by_key(|corner| corner.point);
        if corners.len() > 1 && corners.first().map(|c| c.point) == corners.last().map(|c| c.point) {
            corners.pop();
        }
        if mirrored {
            corners.reverse();
        }
        corners
    };
    let loops = loops.iter().map(turn).enumerate();
    let mut loops: Polygon = loops
        .filter(|(index, corners)| *index == 0 || corners.len() > 2)
        .map(|(_, corners)| corners)
        .collect();
    if let Some((outline, holes)) = loops.split_first_mut().filter(|(outline, _)| !outline.is_empty()) {
        let front = newell(&points(outline));
        holes
            .iter_mut()
            .filter(|hole| newell(&points(hole)).dot(front) > 0.0)
            .for_each(|hole| hole.reverse());
    }
    loops
}

fn moved(corner: Corner, world: &DMat4) -> Corner {
    Corner { point: world.transform_point3(corner.point), ..corner }
}
