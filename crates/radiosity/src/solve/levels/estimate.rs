//! What the irradiance of every patch may be off by.
use super::budget::{BandLight, errors};
use super::equilibrium::{Equilibrium, largest};
use super::flow::Linear;
use super::gradients::Gradients;
use super::link::Link;
use super::tiling::Tiling;

/// Products that an estimate takes at most: it need not be exact.
const MOST: usize = 60;

/// The errors of the links of every leaf, added up as if all had one sign, with what comes of them by reflection; patches × bands.
///
/// An error δ of the irradiance is light of its own: x = ρ(δ + T x) is what the patches send of it, and δ + T x what they receive.
pub(super) fn estimate(
    tiling: &Tiling<'_>,
    links: &[Link],
    equilibrium: &Equilibrium<'_>,
    lights: &[BandLight],
    bands: usize,
) -> Vec<f64> {
    let wrong = errors(tiling, links, lights, bands);
    let patches = tiling.scene.patches.len();
    let (mut sums, mut areas) = (vec![0.0; patches * bands], vec![0.0; patches]);
    (0..equilibrium.leaves().len()).for_each(|leaf| areas[equilibrium.patch(leaf)] += equilibrium.area(leaf));
    for band in 0..bands {
        let of = |leaf: usize| wrong[equilibrium.leaves()[leaf] * bands + band];
        let reflectance = equilibrium.reflectance(band);
        let first: Vec<Linear> =
            reflectance.iter().enumerate().map(|(leaf, rho)| [rho * of(leaf), 0.0, 0.0]).collect();
        let mut sent = first.clone();
        let enough = 1e-3 * largest(&first) * equilibrium.gap(&reflectance);
        Gradients::new(equilibrium, &first, &reflectance).better(&mut sent, enough, MOST);
        for (leaf, light) in equilibrium.receive(&sent).into_iter().enumerate() {
            sums[equilibrium.patch(leaf) * bands + band] +=
                equilibrium.area(leaf) * (of(leaf) + light[0].max(0.0));
        }
    }
    let share = |(at, sum): (usize, &f64)| tiling.units()[at % bands] * sum / areas[at / bands];
    sums.iter().enumerate().map(share).collect()
}
