//! What lights without surfaces bring to the leaves.
//!
//! The lit part of a leaf is a polygon, so that the mean light of a beam on it and how that climbs are integrals without an error, however
//! large the leaf is; only what they leave is an error of what the leaf sends. The sky is looked at from the points of the leaf, as other
//! tiles are.
use super::flow::Linear;
use super::tile::{INNER, OUTER, Outline, SQUARE};
use super::tiling::{Tile, Tiling};
use crate::error::Error;
use crate::solve::lights::{Lights, LitPolygon};
use crate::solve::workers::attempt;
use formfactor::DifferentialArea;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// How many curvatures a mean over five points may be off by.
const CUBATURE: f64 = 0.3;

/// Shorter edges of shadows, beside what they cross, are not cut along.
const SHORT: f64 = 1e-4;
/// What lies on the rim of a tile within this share of its size is a part of that.
const RIM: f64 = 1e-5;

/// What lights bring to a tile, band by band, in the units of the bands.
#[derive(Clone, Debug)]
struct TileLight {
    received: Vec<Linear>,
    /// The part of the mean that comes from beyond the scene.
    beyond: Vec<f64>,
    /// How far it is from linear.
    deviation: Vec<f64>,
    /// What the mean may be off by.
    error: Vec<f64>,
    /// The axis along which the sky bends most.
    axis: usize,
    /// The edges of shadows on it, in the frame of its patch.
    edges: Vec<[DVec2; 2]>,
}

/// What lights bring to the tiles.
#[derive(Debug)]
pub(super) struct Direct<'s> {
    pub(super) lights: Lights<'s>,
    /// For each tile, as it was found or as it is a part of what its parent has; and whether it was found.
    of_tile: Vec<(TileLight, bool)>,
    none: TileLight,
}

/// The light of a band on every tile: how far it is from linear, and what its mean may be off by.
#[derive(Debug)]
pub(super) struct DirectFlaws {
    pub(super) deviation: Vec<f64>,
    pub(super) error: Vec<f64>,
}

impl<'s> Direct<'s> {
    /// Nothing is found yet.
    pub(super) fn new(tiling: &Tiling<'s>) -> Direct<'s> {
        let bands = tiling.scene.bands;
        Direct {
            lights: Lights::new(tiling.scene, tiling.enclosure.polygons()),
            of_tile: Vec::new(),
            none: TileLight {
                received: vec![[0.0; 3]; bands],
                beyond: vec![0.0; bands],
                deviation: vec![0.0; bands],
                error: vec![0.0; bands],
                axis: 0,
                edges: Vec::new(),
            },
        }
    }

    /// The leaves of which the light is not known, though there may be some.
    pub(super) fn unknown(&mut self, tiling: &Tiling<'_>) -> Vec<usize> {
        self.inherit(tiling);
        if self.lights.is_empty() {
            return Vec::new();
        }
        tiling.leaves().filter(|&leaf| !self.of_tile[leaf].1).collect()
    }

    /// Finds the light of some leaves. `sums` is ΣF of the tiles of which it is known: a closed room has no sky.
    ///
    /// # Errors
    /// [`Error::Defect`] when what a light sees cannot be found.
    pub(super) fn find(
        &mut self,
        tiling: &Tiling<'_>,
        leaves: &[usize],
        sums: &[Option<f64>],
    ) -> Result<(), Error> {
        let find = |&leaf: &usize| {
            let name = &tiling.scene.patches[tiling.tiles[leaf].patch].name;
            attempt(name, || self.of_leaf(tiling, leaf, sums[leaf] == Some(1.0)))
        };
        let found: Vec<Result<TileLight, Error>> = leaves.par_iter().map(find).collect();
        for (&leaf, light) in leaves.iter().zip(found) {
            self.of_tile[leaf] = (light?, true);
        }
        Ok(())
    }

    /// Takes in tiles that were cut since: until their own light is found they have their parents'.
    pub(super) fn inherit(&mut self, tiling: &Tiling<'_>) {
        for tile in &tiling.tiles[self.of_tile.len()..] {
            let mut light =
                tile.parent.map_or_else(|| self.none.clone(), |parent| self.of_tile[parent].0.clone());
            if tile.parent.is_some() {
                light.received.iter_mut().for_each(|received| *received = tile.restrict(*received));
                light.edges.clear();
            }
            self.of_tile.push((light, false));
        }
    }

    fn of_leaf(&self, tiling: &Tiling<'_>, leaf: usize, is_closed: bool) -> TileLight {
        let tile = &tiling.tiles[leaf];
        let mut light = self.none.clone();
        let linear = |at| tile.outline.linear(tiling.flatten(tile.patch, at));
        for lit in self.lights.lit(&tiling.enclosure, (tile.surface, &tile.polygon), linear) {
            self.add_beam(&mut light, tiling, tile, &lit);
            light.edges.extend(shadow_edges(tiling, tile, &lit));
        }
        if self.lights.has_sky() && !is_closed {
            self.add_sky(&mut light, tiling, tile);
        }
        light
    }

    /// The projection on linear functions, and what that leaves: of orthogonal functions the squares add up.
    fn add_beam(&self, light: &mut TileLight, tiling: &Tiling<'_>, tile: &Tile, lit: &LitPolygon) {
        let area = tile.polygon.area();
        let mean = lit.moments.whole / area;
        let [first, second] = lit.moments.linear.map(|moment| moment / area / SQUARE);
        let left = lit.moments.square / area - mean * mean - SQUARE * (first * first + second * second);
        let deviation = left.max(0.0).sqrt();
        let (strength, is_beyond) = self.lights.beam(lit.beam);
        for (band, strength) in strength.iter().enumerate() {
            let strength = strength / tiling.units()[band];
            add(&mut light.received[band], strength, [mean, first, second]);
            light.beyond[band] += if is_beyond { strength * mean } else { 0.0 };
            light.deviation[band] += strength * deviation;
        }
    }

    fn add_sky(&self, light: &mut TileLight, tiling: &Tiling<'_>, tile: &Tile) {
        let [middle, ahead, back, left, right] = tile.points.each_ref().map(|point| self.lights.sky(point));
        let mean = INNER * middle + OUTER * (ahead + back + left + right);
        let slopes = [ahead - back, left - right].map(|climb| OUTER * climb / SQUARE);
        let [long, short] = [(ahead, back), (left, right)].map(|(a, b)| (f64::midpoint(a, b) - middle).abs());
        light.axis = usize::from(short > long);
        for (band, radiance) in self.lights.sky_radiance().iter().enumerate() {
            let strength = radiance / tiling.units()[band];
            add(&mut light.received[band], strength, [mean, slopes[0], slopes[1]]);
            light.beyond[band] += strength * mean;
            light.deviation[band] += strength * SQUARE.sqrt() * (long + short);
            light.error[band] += strength * CUBATURE * (long + short);
        }
    }

    /// The edge of a shadow of which most is inside a part of a leaf.
    pub(super) fn edge_in(&self, leaf: usize, outline: &Outline) -> Option<[DVec2; 2]> {
        let inside = self.of(leaf).edges.iter().map(|line| (outline.within(*line), line));
        let (length, line) = inside.reduce(|a, b| if b.0 > a.0 { b } else { a })?;
        (length > SHORT * outline.axes[0].length()).then_some(*line)
    }

    /// Whether shadows have edges on a leaf.
    pub(super) fn has_edges(&self, leaf: usize) -> bool {
        !self.of(leaf).edges.is_empty()
    }

    /// The edges of all shadows on the leaves of each patch.
    pub(super) fn edges(&self, tiling: &Tiling<'_>) -> Vec<Vec<[DVec2; 2]>> {
        let mut edges = vec![Vec::new(); tiling.scene.patches.len()];
        tiling.leaves().for_each(|leaf| edges[tiling.tiles[leaf].patch].extend(&self.of(leaf).edges));
        edges
    }

    /// The light of a tile in a band.
    pub(super) fn received(&self, tile: usize, band: usize) -> Linear {
        self.of(tile).received[band]
    }

    /// What a leaf sends in a band before anything is exchanged: of its own, and of what lights bring.
    pub(super) fn given(&self, tiling: &Tiling<'_>, leaf: usize, band: usize) -> Linear {
        let reflected = self.received(leaf, band).map(|h| tiling.tiles[leaf].reflectance[band] * h);
        [tiling.emittance(leaf, band) + reflected[0], reflected[1], reflected[2]]
    }

    /// The part of its mean that comes from beyond the scene.
    pub(super) fn beyond(&self, tile: usize, band: usize) -> f64 {
        self.of(tile).beyond[band]
    }

    /// The axis across which a tile is best cut.
    pub(super) fn axis(&self, tile: usize) -> usize {
        self.of(tile).axis
    }

    fn of(&self, tile: usize) -> &TileLight {
        self.of_tile.get(tile).map_or(&self.none, |(light, _)| light)
    }

    /// What is wrong with the light of a band.
    pub(super) fn flaws(&self, tiling: &Tiling<'_>, band: usize) -> DirectFlaws {
        let of = |value: fn(&TileLight) -> &Vec<f64>| {
            let at = |tile: usize| {
                if tiling.tiles[tile].halves.is_none() { value(self.of(tile))[band] } else { 0.0 }
            };
            (0..tiling.tiles.len()).map(at).collect()
        };
        DirectFlaws { deviation: of(|light| &light.deviation), error: of(|light| &light.error) }
    }

    /// The power of the lamps in a band, in its unit.
    pub(super) fn power(&self, tiling: &Tiling<'_>, band: usize) -> f64 {
        self.lights.power()[band] / tiling.units()[band]
    }

    /// The light of a point, band by band, in their units.
    pub(super) fn at(&self, tiling: &Tiling<'_>, point: &DifferentialArea) -> Vec<f64> {
        let [lamps, beyond] = self.lights.irradiance(&tiling.enclosure, point);
        let sums = lamps.iter().zip(&beyond).zip(tiling.units());
        sums.map(|((lamps, beyond), unit)| (lamps + beyond) / unit).collect()
    }
}

/// Those edges of what is lit that are no edges of the tile.
fn shadow_edges(tiling: &Tiling<'_>, tile: &Tile, lit: &LitPolygon) -> Vec<[DVec2; 2]> {
    let corners: Vec<DVec2> = tile.outline.corners.iter().map(|corner| corner.0).collect();
    let near = RIM * tile.outline.axes[0].length();
    let is_on_rim = |ends: &[DVec2; 2]| {
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        sides
            .map(|(a, b)| (a, (*b - *a).normalize_or_zero()))
            .any(|(a, way)| ends.iter().all(|end| way.perp_dot(*end - *a).abs() <= near))
    };
    let flat = |ring: &Vec<DVec3>| {
        let ring: Vec<DVec2> = ring.iter().map(|at| tiling.flatten(tile.patch, *at)).collect();
        let next = ring.iter().copied().cycle().skip(1);
        ring.iter().copied().zip(next).map(|(a, b)| [a, b]).collect::<Vec<_>>()
    };
    lit.rings.iter().flat_map(flat).filter(|ends| !is_on_rim(ends)).collect()
}

fn add(to: &mut Linear, strength: f64, light: Linear) {
    to.iter_mut().zip(light).for_each(|(to, light)| *to += strength * light);
}
