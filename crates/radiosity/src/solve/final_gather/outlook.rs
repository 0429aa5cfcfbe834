//! Where vertices are looked from, and the elements around them.
use crate::error::Error;
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use crate::solve::receivers::{AT_RIM, receivers};
use crate::solve::run::Run;
use formfactor::DifferentialArea;

/// From vertices that have this share of the area together, only lights are looked at,
const FEW: f64 = 0.03;
/// where each has less than this share of the mean.
const SMALL: f64 = 0.125;

/// On a rim all but lights are looked at from this share of the way into the elements: next to the rim, what touches it changes so fast that
/// it tells little of them.
const INSIDE: f64 = 0.03;

/// A vertex that is looked from.
#[derive(Debug)]
pub(super) struct Outlook {
    pub(super) point: DifferentialArea,
    /// Where all but lights are looked at from.
    pub(super) inside: DifferentialArea,
    /// The elements around it that sent light, with their shares of the area there.
    pub(super) around: Vec<(usize, f64)>,
    /// What they receive on average, per band.
    pub(super) mean: Vec<f64>,
    /// How far away their centroids are at most.
    pub(super) reach: f64,
    /// Whether more is looked at than lights.
    pub(super) is_wide: bool,
    /// For a vertex of cuts the ends of what was an edge: elements that had to be cut tell little of what it receives.
    pub(super) ends: Option<[usize; 2]>,
}

/// The outlooks from some vertices of a mesh, in ascending order. Its elements are parts of those of the run, `whole`.
pub(super) fn outlooks(
    scene: &Scene,
    run: &Run<'_>,
    (mesh, whole): (&Mesh, &[usize]),
    vertices: &[usize],
) -> Result<Vec<Outlook>, Error> {
    let mut around = vec![Vec::new(); vertices.len()];
    for (index, element) in mesh.elements.iter().enumerate() {
        for at in element.corners.iter().filter_map(|corner| vertices.binary_search(corner).ok()) {
            around[at].push((whole[index], mesh.area(index)));
        }
    }
    let places = receivers(scene, mesh);
    let outlook = |(mut around, &vertex): (Vec<(usize, f64)>, &usize)| {
        let patch = mesh.elements[places[vertex].element].patch;
        let from = |share: f64| Ok(run.factors.on_patch(places[vertex].inside(share)?, patch));
        let (point, inside) = (from(AT_RIM)?, from(INSIDE)?);
        let area: f64 = around.iter().map(|(_, area)| area).sum();
        around.iter_mut().for_each(|(_, share)| *share /= area.max(f64::MIN_POSITIVE));
        let centroids = around.iter().map(|(element, _)| run.factors.receivers[*element].position());
        let reach = centroids.map(|centroid| centroid.distance(point.position())).fold(0.0, f64::max);
        let mean = |band: usize| {
            let received = |at: usize| run.light.irradiance[at * run.light.bands + band];
            around.iter().map(|(element, share)| share * received(*element)).sum()
        };
        Ok(Outlook {
            point,
            inside,
            mean: (0..run.light.bands).map(mean).collect(),
            around,
            reach,
            is_wide: true,
            ends: None,
        })
    };
    around.into_iter().zip(vertices).map(outlook).collect()
}

/// The area of the elements around each vertex.
pub(super) fn areas_around(mesh: &Mesh) -> Vec<f64> {
    let mut areas = vec![0.0; mesh.vertices.len()];
    for (index, element) in mesh.elements.iter().enumerate() {
        element.corners.iter().for_each(|&corner| areas[corner] += mesh.area(index));
    }
    areas
}

/// From the smallest vertices, by the area around each, only lights are looked at: they have 3 % of it, and are most where bodies are round.
pub(super) fn narrow(areas: &[f64], outlooks: &mut [Outlook]) {
    let mut all: Vec<usize> = (0..areas.len()).collect();
    all.sort_by(|&a, &b| areas[a].total_cmp(&areas[b]));
    let whole: f64 = areas.iter().sum();
    let (small, mut sum) = (SMALL * whole / all.len().max(1) as f64, 0.0);
    for vertex in all {
        sum += areas[vertex];
        outlooks[vertex].is_wide = sum >= FEW * whole || areas[vertex] >= small;
    }
}
