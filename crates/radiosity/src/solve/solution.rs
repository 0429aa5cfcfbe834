//! The light of a scene.
use super::ledger::Ledger;
use crate::error::Error;
use crate::mesh::element::Mesh;
use serde::Serialize;
use std::borrow::Cow;

/// The light of a scene.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The elements.
    pub mesh: Mesh,
    /// Number of bands.
    pub bands: usize,
    /// Radiosity of every element, elements × bands, W/m².
    pub radiosity: Vec<f64>,
    /// Irradiance of every element, elements × bands, W/m².
    pub irradiance: Vec<f64>,
    /// Where the emitted power went.
    pub ledger: Ledger,
    /// Per band, a bound on the algebraic error of every element's radiosity in W/m²: ‖r‖∞ / (1 − max ρ ΣF). It bounds how far the light
    /// is from that of the discrete system. How far that is from the light of the scene is no part of it: see
    /// [`Solution::estimate`] and [`Solution::error_estimate`]. Infinite where a patch reflects all light.
    pub bound: Vec<f64>,
    /// How far the mean irradiance of each patch may be from that of the scene, patches × bands, W/m²: an estimate. Only
    /// [`Method::Hierarchical`](crate::Method::Hierarchical) finds one.
    pub estimate: Option<Vec<f64>>,
    /// Which patches the camera sees, of a run [for a camera](crate::Options::for_camera): the light of the others is no more right than what
    /// it sees needs.
    pub in_view: Option<Vec<bool>>,
    /// How light was taken between parts of patches, by levels.
    pub transfers: Option<Transfers>,
    /// The largest |ΣF − 1| over the elements: 0 but for rounding in a closed scene. `None` for a run that was stopped, where
    /// form factors were taken [roughly](crate::Options::rough), and where computing it would take longer than the solution.
    pub closure: Option<f64>,
    /// The largest relative change of a form factor by closure scaling; `None` where nothing was scaled.
    pub scaling: Option<f64>,
    /// How many shots were made.
    pub shots: usize,
    /// How many matrix-vector products were made.
    pub products: usize,
    /// Whether the tolerance was reached, and what is shown was gathered where that is asked for; by levels also whether the estimate is within [`Options::error`](crate::Options::error).
    pub converged: bool,
    /// The [`Error::Defect`] that ended the run early, if one did; the light is as far as the run had come.
    pub fault: Option<Error>,
    /// Seconds that the run took.
    pub seconds: f64,
    /// Reflectance of every element, elements × bands.
    pub(crate) reflectance: Vec<f64>,
    /// What the vertices receive, where it was gathered.
    pub(crate) gathered: Option<Gathered>,
    /// A finer mesh for what is shown, where light was gathered on one.
    pub(crate) fine: Option<FineLight>,
    /// For each vertex the first one that it shares its light with.
    pub(crate) welds: Vec<usize>,
}

impl Solution {
    /// The irradiance per band that every element would still receive if the unshot light spread evenly. It brightens the
    /// picture of a run that was stopped.
    ///
    /// ΣAΔB / ΣA / (1 − ρ̄), ρ̄ the mean reflectance: all its reflections to come (Cohen, Chen, Wallace and Greenberg 1988).
    #[must_use]
    pub fn ambient(&self) -> Vec<f64> {
        let areas: Vec<f64> = (0..self.mesh.elements.len()).map(|element| self.mesh.area(element)).collect();
        let in_band = |band: usize| {
            let kept = self.reflectance.iter().skip(band).step_by(self.bands).map(|rho| 1.0 - rho);
            let absorbed: f64 = kept.zip(&areas).map(|(kept, area)| kept * area).sum();
            let unshot = self.ledger.unshot[band].max(0.0);
            if unshot == 0.0 || absorbed == 0.0 { 0.0 } else { unshot / absorbed }
        };
        (0..self.bands).map(in_band).collect()
    }

    /// The solution as it is shown: on a finer mesh where light was gathered on one. Parts of elements send and receive what the whole does.
    pub(crate) fn shown(&self) -> Cow<'_, Solution> {
        let Some(fine) = &self.fine else { return Cow::Borrowed(self) };
        let part = |values: &[f64]| -> Vec<f64> {
            let of = |element: &usize| &values[element * self.bands..][..self.bands];
            fine.whole.iter().flat_map(of).copied().collect()
        };
        let gathered = self.gathered.as_ref().map(|gathered| part(&gathered.elements));
        let gathered = Gathered { elements: gathered.unwrap_or_default(), vertices: fine.vertices.clone() };
        Cow::Owned(Solution {
            mesh: fine.mesh.clone(),
            radiosity: part(&self.radiosity),
            irradiance: part(&self.irradiance),
            reflectance: part(&self.reflectance),
            welds: fine.welds.clone(),
            gathered: Some(gathered),
            fine: None,
            ..self.clone()
        })
    }

    /// The solution with [`Solution::ambient`] added to every element, for display only.
    #[must_use]
    pub fn with_ambient(&self) -> Solution {
        let ambient = self.ambient();
        let mut lit = self.clone();
        for (at, h) in lit.irradiance.iter_mut().enumerate() {
            *h += ambient[at % self.bands];
            lit.radiosity[at] += self.reflectance[at] * ambient[at % self.bands];
        }
        lit
    }

    /// The estimates of a patch, per band; empty where there are none.
    #[must_use]
    pub fn patch_estimate(&self, patch: usize) -> &[f64] {
        self.estimate.as_ref().map_or(&[], |estimate| &estimate[patch * self.bands..][..self.bands])
    }

    /// Area-weighted means of `values` (elements × bands) over each of the scene's patches: patches × bands.
    #[must_use]
    pub fn patch_means(&self, values: &[f64], patches: usize) -> Vec<Vec<f64>> {
        let mut sums = vec![vec![0.0; self.bands]; patches];
        let mut areas = vec![0.0; patches];
        for (index, element) in self.mesh.elements.iter().enumerate() {
            let area = self.mesh.area(index);
            areas[element.patch] += area;
            for (sum, value) in sums[element.patch].iter_mut().zip(&values[index * self.bands..]) {
                *sum += area * value;
            }
        }
        sums.iter().zip(&areas).map(|(sums, area)| sums.iter().map(|sum| sum / area).collect()).collect()
    }
}

/// How light was taken between the parts of patches, of a solution by levels: each as roughly as its share of the error allows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Transfers {
    /// Pairs of the convex parts of patches between which nothing goes: they face away from each other, or something hides all.
    pub none: usize,
    /// Pairs of the convex parts of patches that are linked by their clusters: the product of what these see of each.
    pub clusters: usize,
    /// Links with nothing in between: the contour formula alone, from five points of each end.
    pub open: usize,
    /// Links past what stands in between: exact from five points of each end.
    pub occluded: usize,
    /// Pairs of the convex parts of patches of which the whole exchange was integrated, past what stands in between.
    pub totals: usize,
}

/// Light that was gathered at vertices.
#[derive(Clone, Debug)]
pub(crate) struct Gathered {
    /// How much of the irradiance of the elements it is, elements × bands.
    pub(crate) elements: Vec<f64>,
    /// Irradiance of the vertices, vertices × bands.
    pub(crate) vertices: Vec<f64>,
}

/// Light that was gathered on a finer mesh.
#[derive(Clone, Debug)]
pub(crate) struct FineLight {
    /// Its first vertices are those of the solution.
    pub(crate) mesh: Mesh,
    /// For each element the one of the solution that it is a part of, in ascending order.
    pub(crate) whole: Vec<usize>,
    /// Irradiance of the vertices, vertices × bands.
    pub(crate) vertices: Vec<f64>,
    /// As [`Solution::welds`].
    pub(crate) welds: Vec<usize>,
}
