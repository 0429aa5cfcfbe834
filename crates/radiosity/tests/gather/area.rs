//! How much of the area of a scene is shown as bright as an exact gather over its own solution.
use super::sources::Sources;
use radiosity::formfactor::Error;
use radiosity::glam::DVec3;
use radiosity::{Mesh, Record, Scene, Solution};
use rayon::prelude::*;

/// What is darker than this share of the mean is not lit.
const DARK: f64 = 0.01;

/// A lit point that was looked at.
#[derive(Clone, Debug)]
pub(crate) struct Sample {
    pub(crate) patch: usize,
    pub(crate) point: DVec3,
    /// The sum over the bands of what is shown and of what the gather says.
    pub(crate) shown: f64,
    pub(crate) exact: f64,
}

impl Sample {
    /// The error as a share of what the point receives.
    pub(crate) fn off(&self) -> f64 {
        (self.shown - self.exact).abs() / self.exact
    }
}

/// How many of some points are shown within a share of what they receive, as a share.
pub(crate) fn within(samples: &[Sample], share: f64) -> f64 {
    samples.iter().filter(|sample| sample.off() <= share).count() as f64 / samples.len().max(1) as f64
}

/// Looks at about so many points that are spread evenly over the area; leaves out what is not lit.
pub(crate) fn lit_samples(scene: &Scene, solution: &Solution, count: usize) -> Result<Vec<Sample>, Error> {
    let (record, sources) = (Record::new("area", scene, solution), Sources::new(scene, solution)?);
    let look = |(index, element): (usize, usize)| {
        let weights = weights(index);
        let [patch, corners @ ..] = record.elements[element];
        let point = corners.iter().zip(weights).map(|(at, weight)| weight * record.vertices[*at]).sum();
        let shown = |band: usize| {
            let at = |(at, weight): (&usize, f64)| weight * record.vertex_irradiance[at * scene.bands + band];
            corners.iter().zip(weights).map(at).sum::<f64>()
        };
        let exact = sources.gather(patch, point)?.iter().sum();
        Ok(Sample { patch, point, shown: (0..scene.bands).map(shown).sum(), exact })
    };
    let places = places(&record.mesh(), count).into_par_iter().enumerate();
    let mut samples: Vec<Sample> = places.map(look).collect::<Result<_, Error>>()?;
    let mean = samples.iter().map(|sample| sample.exact).sum::<f64>() / samples.len().max(1) as f64;
    samples.retain(|sample| sample.exact > DARK * mean);
    Ok(samples)
}

/// For each point the element of what is shown that it is on: each has as many as its area asks for.
fn places(shown: &Mesh, count: usize) -> Vec<usize> {
    let areas: Vec<f64> = (0..shown.elements.len()).map(|at| shown.area(at)).collect();
    let step = areas.iter().sum::<f64>() / count as f64;
    let (mut places, mut sum) = (Vec::new(), 0.0);
    for (element, area) in areas.iter().enumerate() {
        sum += area;
        while (places.len() as f64 + 0.5) * step < sum {
            places.push(element);
        }
    }
    places
}

/// Barycentric coordinates that are spread evenly over triangles: multiples of the inverse plastic number and of its square.
fn weights(index: usize) -> [f64; 3] {
    let [a, b] =
        [0.754_877_666_246_692_7, 0.569_840_290_998_053_2].map(|step| (0.5 + step * index as f64).fract());
    let [a, b] = if a + b > 1.0 { [1.0 - a, 1.0 - b] } else { [a, b] };
    [1.0 - a - b, a, b]
}
