//! From one value per element to one value per vertex.
//!
//! Around a vertex lie the elements that share it, all of one patch and of one side of whatever stands there. Facets of
//! one curved surface, patches of one object and one smoothing group, share their light where they meet, and what that changes
//! fades out over each facet; nothing else does, so that light neither leaks nor bleeds over edges.
use super::solution::Solution;
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use crate::union_find::UnionFind;
use glam::DVec3;
use std::collections::BTreeMap;

impl Solution {
    /// Irradiance at the vertices, vertices × bands, W/m²: the area-weighted mean of the elements around each vertex.
    /// Light that was gathered at the vertices is theirs, and only the rest is such a mean. O(elements).
    #[must_use]
    pub fn vertex_irradiance(&self) -> Vec<f64> {
        let means = Means::of(&self.mesh, self.bands);
        let Some(gathered) = &self.gathered else {
            return means.shared(&self.welds, means.around(&self.irradiance));
        };
        let rest: Vec<f64> =
            self.irradiance.iter().zip(&gathered.elements).map(|(all, gathered)| all - gathered).collect();
        let sums = means
            .around(&rest)
            .into_iter()
            .zip(&gathered.vertices)
            .map(|(rest, gathered)| (rest + gathered).max(0.0));
        means.shared(&self.welds, sums.collect())
    }

    /// Radiosity at the vertices, vertices × bands, W/m²: what the elements around each vertex send on average, at the
    /// irradiance of the vertex. O(elements).
    #[must_use]
    pub fn vertex_radiosity(&self) -> Vec<f64> {
        let means = Means::of(&self.mesh, self.bands);
        let given = means.around(&self.irradiance);
        let reflectance = means.around(&self.reflectance);
        let change = self.vertex_irradiance().into_iter().zip(given).map(|(here, around)| here - around);
        let radiosity = means.around(&self.radiosity).into_iter().zip(reflectance).zip(change);
        radiosity.map(|((b, rho), change)| (b + rho * change).max(0.0)).collect()
    }
}

/// For each vertex the first vertex that it shares its light with: at the same place, on patches of one object and one
/// smoothing group. A vertex that a patch has more than once, at the foot of what stands on it, shares with none.
pub(crate) fn welds(scene: &Scene, mesh: &Mesh) -> Vec<usize> {
    let mut patch_of = vec![None; mesh.vertices.len()];
    for element in &mesh.elements {
        element.corners.iter().for_each(|&corner| patch_of[corner] = Some(element.patch));
    }
    let mut places: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (vertex, place) in mesh.vertices.iter().enumerate() {
        let Some(patch) = patch_of[vertex].map(|patch| &scene.patches[patch]) else { continue };
        let Some(smoothing) = patch.smoothing else { continue };
        let place = place.to_array().map(|coordinate| (coordinate + 0.0).to_bits());
        places.entry((patch.origin.instance, smoothing, place)).or_default().push(vertex);
    }
    let mut welds: Vec<usize> = (0..mesh.vertices.len()).collect();
    let normal = |vertex: usize| patch_of[vertex].map(|patch| scene.patches[patch].polygon.normal());
    let is_smooth = |one: usize, other: usize| {
        normal(one).zip(normal(other)).is_some_and(|(one, other)| one.dot(other) >= SMOOTH)
    };
    for vertices in places.values() {
        let mut patches: Vec<_> = vertices.iter().map(|&vertex| patch_of[vertex]).collect();
        patches.sort_unstable();
        patches.dedup();
        if patches.len() == vertices.len() {
            let mut facets = UnionFind::new(vertices.len());
            for (one, other) in (0..vertices.len()).flat_map(|one| (0..one).map(move |other| (one, other))) {
                if is_smooth(vertices[one], vertices[other]) {
                    facets.join(one, other);
                }
            }
            for (facet, &vertex) in vertices.iter().enumerate() {
                welds[vertex] = vertices[facets.first(facet)];
            }
        }
    }
    welds
}

/// How often what facets share is spread to the vertices inside of them.
const SPREAD: usize = 64;
/// What sharing changes fades to 1/e within so many times the width of the narrowest facet.
const FADE: f64 = 4.0;
/// Facets share their light where their normals have at least this dot product: beyond 60 degrees an edge is an edge.
const SMOOTH: f64 = 0.5;

/// Area-weighted means around vertices.
pub(super) struct Means<'m> {
    mesh: &'m Mesh,
    bands: usize,
    areas: Vec<f64>,
    /// The area around each vertex.
    weights: Vec<f64>,
}

impl<'m> Means<'m> {
    pub(super) fn of(mesh: &'m Mesh, bands: usize) -> Means<'m> {
        let areas: Vec<f64> = (0..mesh.elements.len()).map(|element| mesh.area(element)).collect();
        let mut weights = vec![0.0; mesh.vertices.len()];
        for (element, area) in mesh.elements.iter().zip(&areas) {
            element.corners.iter().for_each(|&corner| weights[corner] += area);
        }
        Means { mesh, bands, areas, weights }
    }

    /// The means of element values, vertices × bands.
    pub(super) fn around(&self, values: &[f64]) -> Vec<f64> {
        let mut means = vec![0.0; self.weights.len() * self.bands];
        for (element, value) in values.chunks_exact(self.bands).enumerate() {
            for corner in self.mesh.elements[element].corners {
                let share = self.areas[element] / self.weights[corner].max(f64::MIN_POSITIVE);
                let mean = means[corner * self.bands..].iter_mut();
                mean.zip(value).for_each(|(mean, v)| *mean += share * v);
            }
        }
        means
    }

    /// The means over vertices that share their light.
    fn shared(&self, welds: &[usize], values: Vec<f64>) -> Vec<f64> {
        let mut sums = vec![0.0; values.len()];
        let mut weights = vec![0.0; welds.len()];
        for (vertex, &first) in welds.iter().enumerate() {
            weights[first] += self.weights[vertex];
            for band in 0..self.bands {
                sums[first * self.bands + band] += self.weights[vertex] * values[vertex * self.bands + band];
            }
        }
        let is_shared = |vertex: usize| weights[welds[vertex]] != self.weights[vertex];
        if !(0..welds.len()).any(is_shared) {
            return values;
        }
        let mean = |at: usize| {
            sums[welds[at / self.bands] * self.bands + at % self.bands] / weights[welds[at / self.bands]]
        };
        let change =
            |(at, value): (usize, &f64)| if is_shared(at / self.bands) { mean(at) - value } else { 0.0 };
        let changes = self.faded(welds, values.iter().enumerate().map(change).collect(), is_shared);
        let changed = |(at, value): (usize, f64)| {
            if is_shared(at / self.bands) { mean(at) } else { (value + changes[at]).max(0.0) }
        };
        values.into_iter().enumerate().map(changed).collect()
    }

    /// Changes that are known where facets meet, at all vertices: elsewhere they fade out within a few times the width of the smallest facet
    /// that meets another there. A large flat facet stays as bright as it is but next to the small ones that round its rim.
    fn faded(&self, welds: &[usize], changes: Vec<f64>, is_known: impl Fn(usize) -> bool) -> Vec<f64> {
        let mut inside = BTreeMap::<usize, Vec<usize>>::new();
        for element in &self.mesh.elements {
            let [a, b, c] = element.corners;
            for (vertex, others) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
                if !is_known(vertex) {
                    inside.entry(vertex).or_default().extend(others);
                }
            }
        }
        let narrowest = self.narrowest(welds);
        let widths =
            (0..welds.len()).map(|vertex| if is_known(vertex) { narrowest[welds[vertex]] } else { 0.0 });
        let widths = spread(&inside, 1, widths.collect(), |_, _| 1.0);
        spread(&inside, self.bands, changes, |vertex, other| {
            let step = self.mesh.vertices[vertex].distance(self.mesh.vertices[other]);
            (-step / (FADE * widths[vertex]).max(f64::MIN_POSITIVE)).exp()
        })
    }

    /// The width of the narrowest facet around each vertex and those that it shares its light with, by the first of these.
    fn narrowest(&self, welds: &[usize]) -> Vec<f64> {
        let mut narrowest = vec![f64::INFINITY; welds.len()];
        let mut first = 0;
        for facet in self.mesh.elements.chunk_by(|one, other| one.patch == other.patch) {
            let area: f64 = self.areas[first..first + facet.len()].iter().sum();
            first += facet.len();
            let corners = || facet.iter().flat_map(|element| element.corners);
            let places = || corners().map(|corner| self.mesh.vertices[corner]);
            let low = places().fold(DVec3::INFINITY, DVec3::min);
            let high = places().fold(DVec3::NEG_INFINITY, DVec3::max);
            let width = area / low.distance(high).max(f64::MIN_POSITIVE);
            corners().for_each(|corner| narrowest[welds[corner]] = narrowest[welds[corner]].min(width));
        }
        narrowest
    }
}

/// Vertices × `columns` values that are known at some vertices, at those `inside` as well: each is the mean of what its neighbours keep.
fn spread(
    inside: &BTreeMap<usize, Vec<usize>>,
    columns: usize,
    mut values: Vec<f64>,
    keeps: impl Fn(usize, usize) -> f64,
) -> Vec<f64> {
    let shares = |(&vertex, others): (&usize, &Vec<usize>)| {
        let share = |&other: &usize| (other, keeps(vertex, other) / others.len() as f64);
        (vertex, others.iter().map(share).collect())
    };
    let shares: Vec<(usize, Vec<(usize, f64)>)> = inside.iter().map(shares).collect();
    for _ in 0..SPREAD {
        for (vertex, others) in &shares {
            for column in 0..columns {
                let mean = others.iter().map(|(other, share)| share * values[other * columns + column]);
                values[vertex * columns + column] = mean.sum();
            }
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::element::Element;

    /// A square facet of 8 × 8 cells, and another of 1 × 8 along one side of it, that wide; and which vertices share their light.
    fn facets(width: f64) -> (Mesh, Vec<usize>) {
        let mut mesh = Mesh::default();
        for (patch, columns, step) in [(0, 8, 1.0 / 8.0), (1, 1, width)] {
            let first = mesh.vertices.len();
            for (i, j) in (0..=columns).flat_map(|i| (0..9).map(move |j| (i, j))) {
                let x = f64::from(patch) + f64::from(i) * step;
                mesh.vertices.push(DVec3::new(x, f64::from(j) / 8.0, 0.0));
            }
            for at in (0..columns as usize * 9).filter(|at| at % 9 < 8).map(|at| first + at) {
                let halves = [[at, at + 9, at + 10], [at, at + 10, at + 1]];
                mesh.elements.extend(halves.map(|corners| Element { patch: patch as usize, corners }));
            }
        }
        let last = mesh.vertices.len() - 18;
        let first = |vertex: usize| if (last..last + 9).contains(&vertex) { vertex - 9 } else { vertex };
        let welds = (0..mesh.vertices.len()).map(first).collect();
        (mesh, welds)
    }

    /// What the vertices along the middle of the square show, from the far side to the shared one, where the square has 1 and its neighbour 3.
    fn across(width: f64, unit: f64) -> Vec<f64> {
        let (mut mesh, welds) = facets(width);
        mesh.vertices.iter_mut().for_each(|place| *place *= unit);
        let light = mesh.vertices.iter().enumerate().map(|(at, _)| if at < 81 { 1.0 } else { 3.0 });
        let shown = Means::of(&mesh, 1).shared(&welds, light.collect());
        (0..9).map(|column| shown[column * 9 + 4]).collect()
    }

    /// A facet that shares its light with one as wide fades all the way; beside a hundred times narrower one only its rim changes.
    #[test]
    fn what_sharing_changes_fades_with_the_narrower_facet() {
        let [alike, narrow] = [1.0, 0.01].map(|width| across(width, 1.0));
        assert!(alike.is_sorted() && narrow.is_sorted(), "{alike:?}, {narrow:?}");
        assert!(alike[8] > 1.5 && alike[6] > 1.3, "{alike:?}");
        assert!(narrow[8] > 1.1 && narrow[6] < 1.01 && narrow[0] < 1.0 + 1e-6, "{narrow:?}");
    }

    #[test]
    fn no_unit_of_length_changes_what_is_shared() {
        let here = across(0.1, 1.0);
        for unit in [2f64.powi(-60), 2f64.powi(60)] {
            assert_eq!(across(0.1, unit), here);
        }
    }

    #[test]
    fn even_light_stays_even() {
        let (mesh, welds) = facets(0.1);
        let light = vec![2.0; 2 * mesh.vertices.len()];
        let shown = Means::of(&mesh, 2).shared(&welds, light.clone());
        assert!(shown.iter().zip(&light).all(|(shown, light)| (shown - light).abs() < 1e-12));
    }
}
