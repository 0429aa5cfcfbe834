//! Steps of a run, kept as they come.
use super::packed::{Packed, index_text, number_text};
use super::{PackedMesh, PackedTiles, Recording, Step, StepKind};
use crate::mesh::conform::Conforming;
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use crate::solve::ledger::Ledger;
use crate::solve::progress::{LinkedTiles, Moment, Progress};
use crate::solve::solution::Solution;
use crate::spectrum::Colours;

/// The first steps are all kept: they change the most.
const FIRST: usize = 40;
/// More steps are thinned.
const STEPS: usize = 300;
/// As are more bytes of text.
const BYTES: usize = 20 << 20;
/// Of a step no more links are kept.
const LINKS: usize = 30_000;

/// Follows a run and keeps its steps. After the first, of many each second is kept, or each fourth and so on, so that they are a few hundred and
/// a page of them is below some tens of megabytes.
#[derive(Debug)]
pub struct Recorder {
    colours: Colours,
    first: usize,
    every: usize,
    seen: usize,
    /// The step as of the last time.
    last: Option<(StepKind, usize)>,
    /// Each with the mesh that it is of.
    steps: Vec<(Step, usize)>,
    meshes: Vec<Mesh>,
    tiles: Vec<Vec<glam::DVec3>>,
}

impl Recorder {
    /// Of a run that solves for the light of `scene`.
    #[must_use]
    pub fn new(scene: &Scene) -> Recorder {
        Recorder {
            colours: Colours::of(scene.bands, &scene.wavelengths),
            first: FIRST,
            every: 1,
            seen: 0,
            last: None,
            steps: Vec::new(),
            meshes: Vec::new(),
            tiles: Vec::new(),
        }
    }

    /// Keeps the step that a run is at, if it is a new one and its turn. Ask for [`Options::record`](crate::Options::record), so that there is
    /// one for each reflection and round.
    pub fn note(&mut self, progress: &Progress<'_>) {
        let (kind, count, shooter) = match progress.moment {
            Moment::Preparation => return,
            Moment::Shot(count, elements) => (StepKind::Shots, count, Some([elements.start, elements.end])),
            Moment::Bounce(count) => (StepKind::Bounces, count, None),
            Moment::Round(count) => (StepKind::Rounds, count, None),
        };
        let is_new = self.last != Some((kind, count));
        if is_new {
            self.last = Some((kind, count));
            self.seen += 1;
        }
        if is_new && self.seen.saturating_sub(self.first) % self.every == 0 {
            self.take(kind, count, progress);
        }
        // What was to shoot may have been split instead: a half of it is to shoot now.
        let newest = self.steps.last_mut().filter(|(step, _)| (step.kind, step.count) == (kind, count));
        newest.into_iter().for_each(|(step, _)| step.shooter = shooter);
    }

    fn take(&mut self, kind: StepKind, count: usize, progress: &Progress<'_>) {
        let solution = progress.solution();
        let mut step = self.step(kind, count, &solution, progress.ledger);
        step.seconds = progress.seconds;
        let open = progress.unshot_radiosity();
        step.open = (!open.is_empty()).then(|| Packed::new(&self.colours.rows(&open)));
        self.link(&mut step, progress.linked_tiles());
        self.keep(step, solution.mesh);
    }

    /// All that was kept, and the solution.
    #[must_use]
    pub fn end(mut self, solution: &Solution) -> Recording {
        let solution = &*solution.shown();
        let shown = Conforming::of(&solution.mesh);
        let mut last = self.step(StepKind::Solution, 0, solution, &solution.ledger);
        last.light = Packed::new(&shown.on_elements(&self.reflected(solution), 1));
        last.seconds = solution.seconds;
        if let Some((step, _)) = self.steps.last().filter(|(step, _)| step.kind == StepKind::Rounds) {
            (last.links, last.link_count) = (step.links.clone(), step.link_count);
        }
        let meshes = self.pack_meshes(&shown.mesh);
        let corners = self.tiles.iter().flatten().flat_map(|corner| corner.to_array());
        Recording {
            first: self.first,
            every: self.every,
            seen: self.seen,
            emitted: solution.ledger.emitted.clone(),
            meshes,
            tiles: PackedTiles {
                sizes: index_text(self.tiles.iter().map(Vec::len)),
                corners: number_text(corners),
            },
            steps: self.steps.into_iter().map(|(step, _)| step).chain([last]).collect(),
        }
    }

    /// The meshes of the steps that stayed, without the last; each step gets the number of its own.
    fn pack_meshes(&mut self, last: &Mesh) -> Vec<PackedMesh> {
        let mut packed = Vec::new();
        let mut numbers = vec![None; self.meshes.len()];
        for (step, mesh) in &mut self.steps {
            let own = &self.meshes[*mesh];
            if !is_same(own, last) {
                step.mesh = Some(*numbers[*mesh].get_or_insert_with(|| {
                    packed.push(pack(own));
                    packed.len() - 1
                }));
            }
        }
        packed
    }

    /// The colours that the elements reflect.
    fn reflected(&self, solution: &Solution) -> Vec<[f64; 3]> {
        let reflected: Vec<f64> =
            solution.irradiance.iter().zip(&solution.reflectance).map(|(h, rho)| h * rho).collect();
        self.colours.rows(&reflected)
    }

    fn step(&self, kind: StepKind, count: usize, solution: &Solution, ledger: &Ledger) -> Step {
        Step {
            kind,
            count,
            seconds: 0.0,
            mesh: None,
            shooter: None,
            absorbed: ledger.absorbed.clone(),
            escaped: ledger.escaped.clone(),
            unshot: ledger.unshot.clone(),
            light: Packed::new(&self.reflected(solution)),
            open: None,
            links: String::new(),
            link_count: 0,
        }
    }

    fn link(&mut self, step: &mut Step, LinkedTiles { tiles, links }: LinkedTiles) {
        let picked = (0..links.len()).step_by(links.len().div_ceil(LINKS).max(1));
        step.links = index_text(picked.flat_map(|link| links[link]));
        step.link_count = links.len();
        self.tiles = tiles;
    }

    /// Adds a step, and leaves out each second one when there are too many.
    fn keep(&mut self, step: Step, mesh: Mesh) {
        if self.meshes.last().is_none_or(|last| !is_same(last, &mesh)) {
            self.meshes.push(mesh);
        }
        self.steps.push((step, self.meshes.len() - 1));
        while self.steps.len() > 2 && (self.steps.len() > STEPS || self.bytes() > BYTES) {
            if self.steps.len() <= self.first + 1 {
                self.first = 1;
            }
            // Of those that stay, the numbers are multiples of the new interval.
            let mut number = 0;
            self.steps.retain(|_| {
                number += 1;
                number <= self.first || (number - self.first) % 2 == 0
            });
            self.every *= 2;
        }
    }

    /// About how much text there is.
    fn bytes(&self) -> usize {
        let of = |(index, (step, mesh)): (usize, &(Step, usize))| {
            let is_first = index == 0 || self.steps[index - 1].1 != *mesh;
            let mesh = if is_first { 48 * self.meshes[*mesh].elements.len() } else { 0 };
            mesh + step.light.bytes() + step.open.as_ref().map_or(0, Packed::bytes) + step.links.len()
        };
        self.steps.iter().enumerate().map(of).sum()
    }
}

fn is_same(one: &Mesh, other: &Mesh) -> bool {
    one.elements == other.elements && one.vertices == other.vertices
}

fn pack(mesh: &Mesh) -> PackedMesh {
    let rows = mesh.elements.iter().flat_map(|element| {
        let [a, b, c] = element.corners;
        [element.patch, a, b, c]
    });
    PackedMesh {
        vertices: number_text(mesh.vertices.iter().flat_map(|place| place.to_array())),
        elements: index_text(rows),
    }
}
