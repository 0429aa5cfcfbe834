//! How far two solutions of one scene are from each other.
//!
//! ```text
//! overlap    the area that each element of one shares with each of the other: the meshes may differ
//! ```
//! A solution counts as one value per element. Reflected light is compared, radiosity less own emission, so that bright emitters
//! do not hide errors of the light that they cast.
mod overlap;

use crate::record::Record;
use glam::DVec3;
use overlap::Piece;
use serde::Serialize;
use std::{collections::BTreeMap, f64::consts::PI};
use thiserror::Error;

/// The difference of two solutions.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Comparison {
    /// The difference in each band.
    pub bands: Vec<Difference>,
    /// Where the two are furthest apart; `None` where they agree everywhere.
    pub worst: Option<Worst>,
    /// Whether both have the same elements. Otherwise each element was compared with all elements that it overlaps.
    pub same_mesh: bool,
}

/// The difference of two solutions, a and b, in one band, relative to b. Infinite where b is dark and a is not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Difference {
    /// ∫|a − b| dA / ∫|b| dA.
    pub l1: f64,
    /// √(∫(a − b)² dA / ∫b² dA).
    pub l2: f64,
    /// max |a − b| / max |b|.
    pub max: f64,
}

/// The place where two solutions are furthest apart, as a share of the second one's largest value in that band.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Worst {
    /// The patch's name.
    pub patch: String,
    /// The element, by its number in the first solution.
    pub element: usize,
    /// Its centroid, in the scene's coordinates.
    pub place: DVec3,
    /// The band.
    pub band: usize,
    /// Reflected light there in the first solution, W/m².
    pub a: f64,
    /// The same in the second one.
    pub b: f64,
}

/// Why two solutions cannot be compared.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unlike {
    /// One has another number of bands.
    #[error("one has {a} bands, the other {b}; compare solutions of one scene")]
    Bands {
        /// Of the first.
        a: usize,
        /// Of the second.
        b: usize,
    },
    /// A patch is in one of them only.
    #[error("patch {name} is in one of the two only; compare solutions of one scene")]
    Patch {
        /// Its name.
        name: String,
    },
    /// A patch of that name lies elsewhere, or has another shape.
    #[error(
        "patch {name} is not the same in both: its elements do not cover each other; compare solutions of one scene"
    )]
    Shape {
        /// Its name.
        name: String,
    },
}

/// What share of a patch rounding may leave uncovered when two meshes of it are laid over each other.
const UNCOVERED: f64 = 1e-6;

/// Compares the solution `a` with the reference `b`.
///
/// The meshes may differ: the norms are integrals over the areas that triangles of both share. Takes O(n) for n elements of
/// equal meshes, and about O(n √n) otherwise.
///
/// # Errors
/// [`Unlike`] when they are not solutions of one scene.
///
/// ```
/// use radiosity::{Options, Record, compare::compare, scenes, solve};
/// use std::ops::ControlFlow;
///
/// let scene = scenes::scene("furnace").expect("a built-in scene");
/// let solved = |elements| {
///     let options = Options::mesh(elements);
///     Ok::<_, radiosity::Error>(Record::new("furnace", &scene, &solve(&scene, &options, |_| ControlFlow::Continue(()))?))
/// };
/// let difference = compare(&solved(24)?, &solved(60)?)?;
/// assert!(difference.largest() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn compare(a: &Record, b: &Record) -> Result<Comparison, Unlike> {
    if a.bands != b.bands {
        return Err(Unlike::Bands { a: a.bands, b: b.bands });
    }
    let patches = matched(a, b)?;
    let same_mesh = a.vertices == b.vertices && a.elements == b.elements;
    let pieces = if same_mesh { overlap::same(a) } else { overlap::overlaps(a, b, &patches) };
    if let Some(name) = moved(a, b, &patches, &pieces) {
        return Err(Unlike::Shape { name });
    }
    let light = [reflected(a), reflected(b)];
    let bands: Vec<Difference> = (0..a.bands).map(|band| norms(&pieces, &light, [a.bands, band])).collect();
    Ok(Comparison { worst: worst(a, b, &pieces, &light), bands, same_mesh })
}

impl Comparison {
    /// The largest norm of all bands.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.bands.iter().flat_map(|band| [band.l1, band.l2, band.max]).fold(0.0, f64::max)
    }
}

/// For each patch of `a` its number in `b`.
fn matched(a: &Record, b: &Record) -> Result<Vec<usize>, Unlike> {
    let numbers = |record: &Record| -> BTreeMap<String, usize> {
        record.patches.iter().enumerate().map(|(number, patch)| (patch.name.clone(), number)).collect()
    };
    let (of_a, of_b) = (numbers(a), numbers(b));
    let alone = |name: &&String| !of_a.contains_key(*name) || !of_b.contains_key(*name);
    match of_a.keys().chain(of_b.keys()).find(alone) {
        Some(name) => Err(Unlike::Patch { name: name.clone() }),
        None => Ok(a.patches.iter().map(|patch| of_b[&patch.name]).collect()),
    }
}

/// The name of a patch whose elements in one do not cover those in the other.
fn moved(a: &Record, b: &Record, patches: &[usize], pieces: &[Piece]) -> Option<String> {
    let areas = |record: &Record| {
        let mesh = record.mesh();
        let mut areas = vec![0.0; record.patches.len()];
        mesh.elements
            .iter()
            .enumerate()
            .for_each(|(index, element)| areas[element.patch] += mesh.area(index));
        areas
    };
    let (of_a, of_b, mut shared) = (areas(a), areas(b), vec![0.0; a.patches.len()]);
    pieces.iter().for_each(|piece| shared[a.elements[piece.elements[0]][0]] += piece.area);
    let off = |patch: &usize| {
        let most = of_a[*patch].max(of_b[patches[*patch]]);
        (most - shared[*patch]).abs() > UNCOVERED * most
    };
    (0..patches.len()).find(off).map(|patch| a.patches[patch].name.clone())
}

/// Radiosity less own emission, elements × bands.
fn reflected(record: &Record) -> Vec<f64> {
    let elements = record.elements.iter().zip(record.radiosity.chunks(record.bands));
    let own = |patch: usize, band: usize| PI * record.patches[patch].emission[band];
    elements.flat_map(|(e, light)| light.iter().enumerate().map(|(k, b)| b - own(e[0], k))).collect()
}

/// The light on each piece in halves, whose difference cannot overflow, and in shares of the largest, whose squares cannot.
fn norms(pieces: &[Piece], light: &[Vec<f64>; 2], [bands, band]: [usize; 2]) -> Difference {
    let halves = |piece: &Piece| [0, 1].map(|side| light[side][piece.elements[side] * bands + band] / 2.0);
    let (mut off, mut size) = (Vec::new(), Vec::new());
    for [a, b] in pieces.iter().map(halves) {
        off.push((a - b).abs());
        size.push(b.abs());
    }
    let [off, size] = [off, size].map(|values| {
        let largest = values.iter().copied().fold(0.0, f64::max);
        let shares = pieces.iter().zip(values).filter(|(_, value)| *value > 0.0);
        let add = |[one, two]: [f64; 2], (piece, value): (&Piece, f64)| {
            let share = value / largest;
            [one + piece.area * share, two + piece.area * share * share]
        };
        (largest, shares.fold([0.0; 2], add))
    });
    if off.0 == 0.0 {
        return Difference { l1: 0.0, l2: 0.0, max: 0.0 };
    }
    let max = off.0 / size.0;
    let by = |k: usize| if size.0 > 0.0 { off.1[k] / size.1[k] } else { 1.0 };
    Difference { l1: max * by(0), l2: max * by(1).sqrt(), max }
}

fn worst(a: &Record, b: &Record, pieces: &[Piece], light: &[Vec<f64>; 2]) -> Option<Worst> {
    let bands = a.bands;
    let mut largest = vec![0.0f64; bands];
    for values in light[1].chunks(bands).take(b.elements.len()) {
        largest.iter_mut().zip(values).for_each(|(largest, value)| *largest = largest.max(value.abs()));
    }
    let mut found: Option<(f64, [usize; 2], [f64; 2])> = None;
    for (piece, band) in pieces.iter().flat_map(|piece| (0..bands).map(move |band| (piece, band))) {
        let [x, y] = [0, 1].map(|side| light[side][piece.elements[side] * bands + band]);
        let off = if x == y { 0.0 } else { (x - y).abs() / largest[band] };
        if off > found.as_ref().map_or(0.0, |(most, ..)| *most) {
            found = Some((off, [piece.elements[0], band], [x, y]));
        }
    }
    found.map(|(_, [element, band], [x, y])| {
        let patch = a.patches[a.elements[element][0]].name.clone();
        Worst { patch, element, place: a.mesh().centroid(element), band, a: x, b: y }
    })
}

#[cfg(test)]
mod tests;
