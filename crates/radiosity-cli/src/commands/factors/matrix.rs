//! The matrix from area to area: surfaces of several patches, and the changes asked for.
use super::names::place;
use super::row::{Row, Rows};
use crate::failure::Failure;
use crate::messages::say;
use crate::parse::positive;
use clap::Args;
use radiosity::Scene;
use radiosity::formfactor::{ExchangeRow, FactorMatrix};
use radiosity::io::vs3::Request;

/// What may be done to the whole matrix; nothing is done unasked.
#[derive(Args, Debug)]
pub(super) struct Changes {
    /// Make rows add to 1 and obey reciprocity, by least squares smoothing; refuses open scenes
    #[arg(long)]
    close: bool,
    /// Add a receiver of this name for what escapes, so that the rows of open scenes add to 1
    #[arg(long, value_name = "NAME", conflicts_with = "close")]
    space: Option<String>,
    /// Leave out pairs whose factors are below this, and keep the rows' sums
    #[arg(long, value_name = "FACTOR", value_parser = positive)]
    drop_below: Option<f64>,
    /// Take these patches for one surface, named as the first; may be given several times
    #[arg(long, value_name = "PATCH,PATCH")]
    group: Vec<String>,
}

impl Changes {
    pub(super) fn are_asked(&self) -> bool {
        self.close || self.space.is_some() || self.drop_below.is_some() || !self.group.is_empty()
    }
}

/// Rows, and what they lead to.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// Of each receiver: surfaces, patches that only block, space.
    pub(super) names: Vec<String>,
    /// Of each surface.
    pub(super) areas: Vec<f64>,
    pub(super) emittances: Vec<f64>,
    pub(super) rows: Rows,
    /// Whether the rows were closed, and whether they hold reflections.
    pub(super) is_closed: bool,
    pub(super) is_gray: bool,
}

impl Found {
    /// Rows to patches.
    pub(super) fn of(scene: &Scene, rows: Vec<Row>) -> Found {
        let patches = || scene.patches.iter();
        Found {
            names: patches().map(|patch| patch.name.clone()).collect(),
            areas: patches().map(|patch| patch.polygon.area()).collect(),
            emittances: patches().map(|patch| 1.0 - patch.reflectance[0]).collect(),
            rows: Rows::Listed(rows),
            ..Found::default()
        }
    }
}

/// The matrix of the scene's surfaces, with the changes that the file and the command ask for; says on stderr what was done.
pub(super) fn finish(
    scene: &Scene,
    pairs: Vec<ExchangeRow>,
    request: Option<Request>,
    changes: &Changes,
) -> Result<Found, Failure> {
    let asked = request.unwrap_or_default();
    let surfaces = Surfaces::of(scene, &asked.combined, &changes.group)?;
    let areas: Vec<f64> = scene.patches.iter().map(|patch| patch.polygon.area()).collect();
    let mut matrix = FactorMatrix::new(&areas, pairs);
    if surfaces.group.iter().enumerate().any(|(patch, group)| patch != *group) {
        matrix = matrix.grouped(&surfaces.group);
    }
    report_defects(&matrix, &surfaces);
    if let Some(threshold) = changes.drop_below {
        let before = matrix.values().len();
        matrix = matrix.without_below(threshold);
        say!("{} of {before} factors left out; their rows' others grew", before - matrix.values().len());
    }
    let is_closed = changes.close || asked.closes;
    if is_closed {
        let by = if changes.close { "--close" } else { "encl=1 in the file" };
        let (closed, done) = matrix.closed().map_err(|error| Failure::scene(format!("{by}: {error}")))?;
        let (defect, change) = (done.defect, done.change);
        say!(
            "{by}: closed by least squares; a row lacked up to {defect:.1e}, factors changed by up to {change:.1e}"
        );
        matrix = closed;
    }
    let mut names = surfaces.names(scene);
    if let Some(space) = &changes.space {
        matrix = matrix.with_space();
        names.push(space.clone());
    }
    let emittances: Vec<f64> =
        surfaces.first.iter().map(|patch| 1.0 - scene.patches[*patch].reflectance[0]).collect();
    if asked.emittances {
        matrix = matrix
            .with_emittances(&emittances)
            .map_err(|error| Failure::scene(format!("emit=1: {error}")))?;
        say!("emit=1 in the file: total exchange factors of gray surfaces, with all reflections");
    }
    let areas = matrix.areas()[..surfaces.count].to_vec();
    let emittances = emittances[..surfaces.count].to_vec();
    let rows = Rows::Matrix(matrix, surfaces.count);
    Ok(Found { names, areas, emittances, rows, is_closed, is_gray: asked.emittances })
}

/// What patches make surfaces: those first, then what only blocks.
struct Surfaces {
    /// Per patch.
    group: Vec<usize>,
    /// The first patch of each group.
    first: Vec<usize>,
    /// How many of them are surfaces.
    count: usize,
}

impl Surfaces {
    /// `combined` by the number of the file's surface, as of [`Request`]; `named` by commas.
    fn of(scene: &Scene, combined: &[Option<usize>], named: &[String]) -> Result<Surfaces, Failure> {
        let patches = &scene.patches;
        // Per patch the first one of its surface.
        let mut first: Vec<usize> = (0..patches.len()).collect();
        let mut of_surface = vec![None; combined.len()];
        for (index, patch) in patches.iter().enumerate() {
            if let Some(surface) = combined.get(patch.origin.polygon).copied().flatten() {
                first[index] = *of_surface[surface].get_or_insert(index);
            }
        }
        for names in named {
            let all = || patches.iter().map(|patch| patch.name.as_str());
            let members = names.split(',').map(|name| place(all(), name.trim()).map_err(Failure::usage));
            let members = members.collect::<Result<Vec<usize>, _>>()?;
            let roots: Vec<usize> = members.iter().map(|member| first[*member]).collect();
            first.iter_mut().filter(|root| roots.contains(root)).for_each(|root| *root = roots[0]);
        }
        let is_first = |patch: &usize| first[*patch] == *patch;
        let all = || (0..patches.len()).filter(is_first);
        let blocks = |patch: &usize| patches[*patch].only_blocks;
        let order: Vec<usize> = all().filter(|p| !blocks(p)).chain(all().filter(blocks)).collect();
        let count = order.iter().filter(|patch| !blocks(patch)).count();
        let mut place = vec![0; patches.len()];
        order.iter().enumerate().for_each(|(group, patch)| place[*patch] = group);
        Ok(Surfaces { group: first.iter().map(|root| place[*root]).collect(), first: order, count })
    }

    fn names(&self, scene: &Scene) -> Vec<String> {
        self.first.iter().map(|patch| scene.patches[*patch].name.clone()).collect()
    }
}

/// One line for people: what rows lack of 1. In a closed room that is an error.
fn report_defects(matrix: &FactorMatrix, surfaces: &Surfaces) {
    let defects = &matrix.defects()[..surfaces.count];
    let errors = (0..surfaces.count).map(|row| matrix.row(row).map(|f| f.error).sum::<f64>());
    let [least, most] =
        [defects.iter().copied().fold(f64::INFINITY, f64::min), defects.iter().copied().fold(0.0, f64::max)];
    let error = errors.fold(0.0, f64::max);
    say!(
        "{} surfaces, {} factors; rows lack {least:.1e} to {most:.1e} of 1, their estimated errors add to at most {error:.1e}",
        surfaces.count,
        matrix.values().len()
    );
}
