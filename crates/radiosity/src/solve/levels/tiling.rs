//! The tree of tiles of a scene, which grows where light is not resolved.
use super::base::Base;
use super::boxes::Boxes;
use super::plates::Plates;
use super::tile::{Outline, SQUARE};
use crate::error::Error;
use crate::extent::Extent;
use crate::mesh::{contacts::Neighbourhood, convex::convex_parts, frame::power_of_two};
use crate::scene::Scene;
use crate::solve::lights::magnitude;
use crate::solve::occluders::Occluders;
use formfactor::{DifferentialArea, Enclosure, PlanarPolygon};
use glam::{DVec2, DVec3};
use std::{f64::consts::PI, sync::Arc};

/// Tiles that reach less than this share of that are not cut.
const LEAST: f64 = 1e-4;
/// Parts of patches are seen smaller by this share, so that no edge of one lies along a longer one of what stands on it: form factors are
/// quicker where no two edges are in line.
const WITHIN: f64 = 1e-10;

/// A tile in its tree.
#[derive(Clone, Debug)]
pub(super) struct Tile {
    pub(super) patch: usize,
    /// The polygon of the enclosure that it is a part of.
    pub(super) surface: usize,
    pub(super) outline: Outline,
    /// What form factors are taken to.
    pub(super) polygon: PlanarPolygon,
    /// In the scene's units.
    pub(super) area: f64,
    pub(super) points: [DifferentialArea; 5],
    pub(super) normal: DVec3,
    pub(super) halves: Option<[usize; 2]>,
    pub(super) parent: Option<usize>,
    /// The functions of the parent in those of this one: see [`Outline::restriction`].
    pub(super) restriction: [f64; 6],
    /// Whether something else stands on it, so that a part of it may be covered.
    pub(super) is_crossed: bool,
    /// Names the tile by how it was cut.
    pub(super) key: u64,
    pub(super) reflectance: Vec<f64>,
    /// The standard deviation of the reflectance over it.
    pub(super) mottle: Vec<f64>,
}

/// The tiles of a scene; children come after their parents.
#[derive(Debug)]
pub(super) struct Tiling<'s> {
    pub(super) scene: &'s Scene,
    pub(super) enclosure: Enclosure,
    /// The boxes around the polygons of the enclosure.
    pub(super) extents: Vec<Extent>,
    pub(super) boxes: Boxes,
    pub(super) tiles: Vec<Tile>,
    bases: Vec<Base>,
    surface_of: Vec<usize>,
    /// The mean area of the parts that each patch is made of, where it is.
    pub(super) grain: Vec<Option<f64>>,
    /// Radiosity is counted in these: band by band a power of two near the largest that is emitted, so that its squares are in range.
    units: Vec<f64>,
}

impl<'s> Tiling<'s> {
    /// The convex parts of all patches.
    pub(super) fn new(scene: &'s Scene) -> Result<Tiling<'s>, Error> {
        Tiling::past(scene, Occluders::join(scene), vec![None; scene.patches.len()])
    }

    /// The convex parts of all plates.
    pub(super) fn of(plates: &'s Plates<'_>) -> Result<Tiling<'s>, Error> {
        let grain = (0..plates.count()).map(|plate| plates.grain(plate)).collect();
        Tiling::past(&plates.scene, plates.occluders.clone(), grain)
    }

    fn past(scene: &'s Scene, occluders: Occluders, grain: Vec<Option<f64>>) -> Result<Tiling<'s>, Error> {
        let Occluders { polygons, of_patch } = occluders;
        let [low, high] = scene.extent();
        let size = (high - low).length();
        let neighbourhood = Neighbourhood::of(scene);
        let base = |(patch, polygon): (usize, &PlanarPolygon)| {
            Base::of(polygon, size, |near| neighbourhood.contacts(patch, near))
        };
        let around: Vec<Extent> = polygons.iter().map(Extent::around).collect();
        let mut tiling = Tiling {
            scene,
            boxes: Boxes::around(&around),
            extents: around,
            enclosure: Enclosure::new(polygons),
            tiles: Vec::new(),
            bases: scene.patches.iter().map(|patch| &patch.polygon).enumerate().map(base).collect(),
            surface_of: of_patch,
            grain,
            units: (0..scene.bands).map(|band| unit(scene, band)).collect(),
        };
        for patch in 0..scene.patches.len() {
            tiling.add_patch(patch)?;
        }
        Ok(tiling)
    }

    fn add_patch(&mut self, patch: usize) -> Result<(), Error> {
        let (polygon, frame) = (&self.scene.patches[patch].polygon, self.bases[patch].frame);
        let parts =
            convex_parts(polygon, &frame).map_err(|refusal| refusal.of(&self.scene.patches[patch].name))?;
        let outlines: Vec<Outline> = parts.into_iter().filter_map(Outline::new).collect();
        let apart: Vec<Outline> =
            outlines.into_iter().flat_map(|outline| self.apart(patch, outline)).collect();
        let shape = crate::solve::fingerprint::of_polygon(&self.scene.patches[patch].polygon);
        for (index, outline) in (0..).zip(apart) {
            let key = crate::solve::fingerprint::of(&[shape, index].map(u64::to_le_bytes).concat());
            let tile = self.tile(patch, outline, None, key)?;
            self.tiles.push(tile);
        }
        Ok(())
    }

    /// The parts of an outline in different rooms: cut along all contacts that cross it from rim to rim.
    fn apart(&self, patch: usize, outline: Outline) -> Vec<Outline> {
        let frame = self.bases[patch].frame;
        let (mut open, mut apart) = (vec![outline], Vec::new());
        while let Some(outline) = open.pop() {
            let crossing = self.contacts(patch).iter().filter(|line| outline.is_crossed_by(**line));
            let cut =
                |[start, end]: &[DVec2; 2]| outline.cut([*start, *end - *start], |flat| frame.lift(flat));
            match crossing.filter_map(cut).next() {
                Some(halves) => open.extend(halves),
                None => apart.push(outline),
            }
        }
        apart
    }

    fn tile(&self, patch: usize, outline: Outline, parent: Option<usize>, key: u64) -> Result<Tile, Error> {
        let (source, frame) = (&self.scene.patches[patch], self.bases[patch].frame);
        let refused = |error| Error::Shape { patch: source.name.clone(), source: error };
        let places: Vec<DVec3> = outline.places().collect();
        let middle = frame.lift(outline.centroid);
        let within =
            |place: &DVec3| if parent.is_some() { *place + (middle - *place) * WITHIN } else { *place };
        let within: Vec<DVec3> = places.iter().map(within).collect();
        let surface = &self.enclosure.polygons()[self.surface_of[patch]];
        // A patch may be farther off the plane of a wall that it is joined with than roundings are.
        let polygon = surface.part([&within]).or_else(|_| source.polygon.part([&within])).map_err(refused)?;
        let normal = source.polygon.normal();
        let points = self.points(patch, &outline)?;
        let [reflectance, mottle] = source.reflectance_within(&places);
        Ok(Tile {
            patch,
            surface: self.surface_of[patch],
            reflectance,
            mottle,
            polygon,
            area: self.area(patch, &outline),
            points,
            normal,
            is_crossed: self.is_crossed(patch, &outline),
            halves: None,
            parent,
            restriction: parent.map_or([0.0; 6], |parent| outline.restriction(&self.tiles[parent].outline)),
            outline,
            key,
        })
    }

    /// The points of an outline on a patch.
    pub(super) fn points(&self, patch: usize, outline: &Outline) -> Result<[DifferentialArea; 5], Error> {
        let [a, b, c, d, e] = outline.points().map(|at| self.point(patch, at));
        Ok([a?, b?, c?, d?, e?])
    }

    /// A point of a patch, given in its frame.
    pub(super) fn point(&self, patch: usize, at: DVec2) -> Result<DifferentialArea, Error> {
        let source = &self.scene.patches[patch];
        DifferentialArea::new(self.lift(patch, at), source.polygon.normal())
            .map(|point| point.owned_by(self.surface_of[patch]))
            .map_err(|error| Error::Shape { patch: source.name.clone(), source: error })
    }

    /// The area of an outline on a patch, in the scene's units.
    pub(super) fn area(&self, patch: usize, outline: &Outline) -> f64 {
        let unit = self.bases[patch].frame.unit();
        outline.area * unit * unit
    }

    /// Whether a patch is made of several.
    pub(super) fn is_joined(&self, patch: usize) -> bool {
        self.grain[patch].is_some()
    }

    /// The area of a patch.
    pub(super) fn patch_area(&self, patch: usize) -> f64 {
        self.scene.patches[patch].polygon.area()
    }

    /// A point of space in the frame of a patch.
    pub(super) fn flatten(&self, patch: usize, place: DVec3) -> DVec2 {
        self.bases[patch].frame.flatten(place)
    }

    /// A point of the frame of a patch in space.
    pub(super) fn lift(&self, patch: usize, flat: DVec2) -> DVec3 {
        self.bases[patch].frame.lift(flat)
    }

    /// The lines on which other patches touch a patch, in its frame.
    pub(super) fn contacts(&self, patch: usize) -> &[[DVec2; 2]] {
        &self.bases[patch].contacts.ends
    }

    /// The halves of a tile: see [`cut`](Tiling::cut). Nothing when it is too small.
    pub(super) fn halve(&mut self, tile: usize, axis: usize) -> Result<Option<[usize; 2]>, Error> {
        let parent = &self.tiles[tile];
        if parent.halves.is_some() || self.reach(parent) < LEAST * self.scale(parent.patch) {
            return Ok(parent.halves);
        }
        let (patch, key) = (parent.patch, parent.key);
        let Some(parts) = self.cut(patch, &parent.outline, axis) else { return Ok(None) };
        let way = parts[0].centroid - parts[1].centroid;
        let mut halves = [0; 2];
        for (index, part) in parts.into_iter().enumerate() {
            let name = [key, index as u64, way.x.to_bits(), way.y.to_bits()].map(u64::to_le_bytes).concat();
            let half = self.tile(patch, part, Some(tile), crate::solve::fingerprint::of(&name))?;
            halves[index] = self.tiles.len();
            self.tiles.push(half);
        }
        self.tiles[tile].halves = Some(halves);
        Ok(Some(halves))
    }

    /// The halves of an outline on a patch: cut along one of the contacts in it if there are any, else across one of its axes through the centroid.
    pub(super) fn cut(&self, patch: usize, outline: &Outline, axis: usize) -> Option<[Outline; 2]> {
        self.cut_along(patch, outline, None, axis)
    }

    /// The same: where there is no contact, along an edge of light on it, if that is given.
    pub(super) fn cut_along(
        &self,
        patch: usize,
        outline: &Outline,
        edge: Option<[DVec2; 2]>,
        axis: usize,
    ) -> Option<[Outline; 2]> {
        let frame = self.bases[patch].frame;
        let cut = |line| outline.cut(line, |flat| frame.lift(flat));
        let contact = self.bases[patch].contact_in(outline).into_iter().chain(edge);
        let along = contact.filter_map(|[start, end]| cut([start, end - start])).next();
        along.or_else(|| cut(outline.across(axis)))
    }

    /// Whether something else stands on an outline.
    pub(super) fn is_crossed(&self, patch: usize, outline: &Outline) -> bool {
        self.bases[patch].is_crossed(outline)
    }

    /// The surfaces that may stand between two tiles, by their boxes.
    pub(super) fn surfaces_between(&self, ends: [usize; 2]) -> Arc<[u32]> {
        let [one, other] = ends.map(|end| Extent::of_points(self.tiles[end].outline.places()));
        let hull = one.with(&other);
        self.boxes.find(|extent| !extent.is_near(&hull, 0.0)).into()
    }

    /// The names of two tiles.
    pub(super) fn names(&self, ends: [usize; 2]) -> [u64; 2] {
        ends.map(|end| self.tiles[end].key)
    }

    /// The corners of all tiles.
    pub(super) fn outlines(&self) -> Vec<Vec<DVec3>> {
        self.tiles.iter().map(|tile| tile.outline.places().collect()).collect()
    }

    /// How far a tile reaches from its centroid.
    fn reach(&self, tile: &Tile) -> f64 {
        tile.outline.axes[0].length() * self.bases[tile.patch].frame.unit()
    }

    /// What lengths on a patch are small beside.
    pub(super) fn scale(&self, patch: usize) -> f64 {
        self.bases[patch].scale
    }

    /// The emitted radiosity of a tile, in the unit of the band.
    pub(super) fn emittance(&self, tile: usize, band: usize) -> f64 {
        PI * self.scene.patches[self.tiles[tile].patch].emission[band] / self.units[band]
    }

    /// The unit of radiosity of each band, in the scene's.
    pub(super) fn units(&self) -> &[f64] {
        &self.units
    }

    /// The whole tile that each tile is a part of.
    pub(super) fn roots(&self) -> Vec<usize> {
        let mut roots: Vec<usize> = Vec::with_capacity(self.tiles.len());
        for (index, tile) in self.tiles.iter().enumerate() {
            roots.push(tile.parent.map_or(index, |parent| roots[parent]));
        }
        roots
    }

    /// The mean over the whole tiles of each patch.
    pub(super) fn means(&self, of_root: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sums = vec![[0.0; 2]; self.scene.patches.len()];
        for (index, tile) in self.tiles.iter().enumerate().filter(|(_, tile)| tile.parent.is_none()) {
            let [sum, area] = &mut sums[tile.patch];
            (*sum, *area) = (*sum + tile.area * of_root(index), *area + tile.area);
        }
        sums.into_iter().map(|[sum, area]| if area > 0.0 { sum / area } else { 0.0 }).collect()
    }

    /// The tiles that are not cut.
    pub(super) fn leaves(&self) -> impl Iterator<Item = usize> {
        (0..self.tiles.len()).filter(|&tile| self.tiles[tile].halves.is_none())
    }
}

/// A power of two near the largest radiosity that is emitted, or what lights bring.
fn unit(scene: &Scene, band: usize) -> f64 {
    let emitted = scene.patches.iter().map(|patch| PI * patch.emission[band]);
    power_of_two(emitted.fold(magnitude(scene, band), f64::max))
}

impl Tile {
    /// Coefficients on the parent, on this tile.
    pub(super) fn restrict(&self, [mean, first, second]: [f64; 3]) -> [f64; 3] {
        let [a, b, aa, ab, ba, bb] = self.restriction;
        [mean + a * first + b * second, aa * first + ab * second, ba * first + bb * second]
    }

    /// What coefficients on this tile add to those of the parent, times the parent's area: the projection.
    pub(super) fn extend(&self, [mean, first, second]: [f64; 3]) -> [f64; 3] {
        let [a, b, aa, ab, ba, bb] = self.restriction;
        let onto = |centre: f64, one: f64, two: f64| mean * centre / SQUARE + first * one + second * two;
        [self.area * mean, self.area * onto(a, aa, ba), self.area * onto(b, ab, bb)]
    }
}
