//! From one value per element to one value per vertex.
//!
//! Around a vertex lie the elements that share it, all of one patch and of one side of whatever stands there. Facets of
//! one curved surface, patches of one object and one smoothing group, share their light where they meet, and what that changes
//! fades out over each facet; nothing else does, so that light neither leaks nor bleeds over edges.
use super::solution::Solution;
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use crate::union_find::UnionFind;
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
        let changes = self.spread(values.iter().enumerate().map(change).collect(), is_shared);
        let changed = |(at, value): (usize, f64)| {
            if is_shared(at / self.bands) { mean(at) } else { (value + changes[at]).max(0.0) }
        };
        values.into_iter().enumerate().map(changed).collect()
    }

    /// Changes that are known at some vertices, at all of them: elsewhere each is the mean of its neighbours' on its patch. 0 on patches
    /// without any that is known.
    fn spread(&self, mut changes: Vec<f64>, is_known: impl Fn(usize) -> bool) -> Vec<f64> {
        let mut around = BTreeMap::<usize, Vec<usize>>::new();
        for element in &self.mesh.elements {
            let [a, b, c] = element.corners;
            for (vertex, others) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
                if !is_known(vertex) {
                    around.entry(vertex).or_default().extend(others);
                }
            }
        }
        for _ in 0..SPREAD {
            for (&vertex, others) in &around {
                for band in 0..self.bands {
                    let sum: f64 = others.iter().map(|other| changes[other * self.bands + band]).sum();
                    changes[vertex * self.bands + band] = sum / others.len() as f64;
                }
            }
        }
        changes
    }
}
