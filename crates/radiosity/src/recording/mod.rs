//! A run, step by step: what a page needs to walk through it.
//!
//! ```text
//! recorder    keeps steps as they come, evenly thinned
//! packed      lists of numbers as text
//! ```
pub(crate) mod packed;
pub(crate) mod recorder;

use packed::{Packed, indices, numbers};
use serde::{Deserialize, Serialize};

/// A run, step by step. Colours are red, green and blue as [`rgb`](crate::expose::rgb) makes them.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Recording {
    /// So many steps from the start were kept.
    pub first: usize,
    /// Of those after them each so-manieth, and the last.
    pub every: usize,
    /// How many steps the run had.
    pub seen: usize,
    /// Emitted power per band.
    pub emitted: Vec<f64>,
    /// The meshes before the last.
    pub meshes: Vec<PackedMesh>,
    /// The tiles that links are between, in the order in which they were made.
    pub tiles: PackedTiles,
    /// The steps; the last is the solution.
    pub steps: Vec<Step>,
}

/// What a step comes from.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum StepKind {
    /// Shots of pieces.
    Shots,
    /// Reflections of all light at once.
    Bounces,
    /// Rounds of refining links.
    Rounds,
    /// The end of the run.
    Solution,
}

/// A step of a run.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// What it comes from.
    pub kind: StepKind,
    /// How many shots, bounces or rounds there were.
    pub count: usize,
    /// Seconds since the start.
    pub seconds: f64,
    /// Its mesh; the solution's where there is none.
    pub mesh: Option<usize>,
    /// The first of the elements that shoot next, and the one after the last.
    pub shooter: Option<[usize; 2]>,
    /// Absorbed power per band; see [`Ledger`](crate::Ledger).
    pub absorbed: Vec<f64>,
    /// Escaped power per band.
    pub escaped: Vec<f64>,
    /// Unshot power per band.
    pub unshot: Vec<f64>,
    /// What the elements reflect, ρH.
    pub light: Packed,
    /// What they have yet to shoot, where that is known.
    pub open: Option<Packed>,
    /// Pairs of tiles that are linked, as text; of many links some, evenly picked.
    pub links: String,
    /// How many there are.
    pub link_count: usize,
}

/// A mesh as text.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PackedMesh {
    /// The vertices' coordinates.
    pub vertices: String,
    /// Patch and corners of every element.
    pub elements: String,
}

/// Polygons as text.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PackedTiles {
    /// How many corners each has.
    pub sizes: String,
    /// The coordinates of all corners.
    pub corners: String,
}

impl Step {
    /// The light that the elements reflect, as it was packed.
    #[must_use]
    pub fn reflected(&self) -> Vec<[f64; 3]> {
        self.light.rows().unwrap_or_default()
    }

    /// The pairs of tiles that are linked, or some of them.
    #[must_use]
    pub fn linked(&self) -> Vec<[usize; 2]> {
        let ends = indices(&self.links).unwrap_or_default();
        ends.chunks_exact(2).map(|ends| [ends[0] as usize, ends[1] as usize]).collect()
    }
}

impl Recording {
    /// Whether all lists fit together, for a mesh of so many elements.
    pub(crate) fn is_sound(&self, bands: usize, patches: usize, elements: usize) -> bool {
        let meshes: Option<Vec<usize>> = self.meshes.iter().map(|mesh| mesh.elements(patches)).collect();
        let tiles = self.tiles.count();
        let sound = |step: &Step, meshes: &[usize], tiles: usize| {
            let size = step.mesh.map_or(Some(elements), |mesh| meshes.get(mesh).copied());
            size.is_some_and(|size| step.is_sound(bands, size, tiles))
        };
        match (meshes, tiles) {
            (Some(meshes), Some(tiles)) => {
                self.emitted.len() == bands
                    && !self.steps.is_empty()
                    && self.steps.iter().all(|step| sound(step, &meshes, tiles))
            }
            _ => false,
        }
    }
}

impl Step {
    fn is_sound(&self, bands: usize, elements: usize, tiles: usize) -> bool {
        let fits = |packed: &Packed| packed.rows().is_some_and(|rows| rows.len() == elements);
        let ends = indices(&self.links);
        [&self.absorbed, &self.escaped, &self.unshot].iter().all(|list| list.len() == bands)
            && self.shooter.is_none_or(|[first, end]| first <= end && end <= elements)
            && fits(&self.light)
            && self.open.as_ref().is_none_or(fits)
            && ends.is_some_and(|ends| ends.len() % 2 == 0 && ends.iter().all(|end| (*end as usize) < tiles))
    }
}

impl PackedMesh {
    /// How many elements there are; nothing when they name what is not there.
    fn elements(&self, patches: usize) -> Option<usize> {
        let (vertices, elements) = (numbers(&self.vertices)?, indices(&self.elements)?);
        let places = vertices.len() / 3;
        let within = |row: &[u32]| {
            (row[0] as usize) < patches && row[1..].iter().all(|corner| (*corner as usize) < places)
        };
        let sound = vertices.len() % 3 == 0
            && vertices.iter().all(|ordinate| ordinate.is_finite())
            && elements.len() % 4 == 0
            && elements.chunks_exact(4).all(within);
        sound.then_some(elements.len() / 4)
    }
}

impl PackedTiles {
    /// How many tiles there are; nothing when corners are missing.
    fn count(&self) -> Option<usize> {
        let (sizes, corners) = (indices(&self.sizes)?, numbers(&self.corners)?);
        let wanted: u64 = sizes.iter().map(|size| 3 * u64::from(*size)).sum();
        (wanted == corners.len() as u64).then_some(sizes.len())
    }
}
