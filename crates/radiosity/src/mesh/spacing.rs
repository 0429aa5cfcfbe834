//! How long the sides of cells are: the same everywhere, so that elements are shared out by area, unless one patch is most
//! of the scene but little of what is lit, as the ground around a house is.
use crate::scene::{Scene, patch::Patch};
use formfactor::Enclosure;

/// The light of so many of the strongest emitters tells what is lit.
const EMITTERS: usize = 16;

/// The side of a cell of each patch, for about so many triangles.
///
/// A patch of more than half of all area gets no larger a share of the elements than half, and half of what it receives of the
/// light straight from the emitters; the others share the rest by area.
pub(super) fn spacings(scene: &Scene, elements: usize) -> Vec<f64> {
    let areas: Vec<f64> = scene.patches.iter().map(|patch| patch.polygon.area()).collect();
    let total: f64 = areas.iter().sum();
    let count = elements.max(1) as f64;
    let side = |area: f64, count: f64| (2.0 * area / count).sqrt();
    let mut spacings = vec![side(total, count); areas.len()];
    let Some(largest) = (0..areas.len()).find(|&patch| areas[patch] > total / 2.0) else { return spacings };
    let others: f64 = areas.iter().enumerate().filter(|(patch, _)| *patch != largest).map(|(_, a)| a).sum();
    let share = f64::midpoint(1.0, lit_share(scene, largest));
    if others > 0.0 && areas[largest] / total > share {
        spacings.fill(side(others, (1.0 - share) * count));
        spacings[largest] = side(areas[largest], share * count);
    }
    spacings
}

/// Which share of the light that patches receive straight from the middles of the strongest emitters a patch receives; all
/// where none receives any.
fn lit_share(scene: &Scene, patch: usize) -> f64 {
    let enclosure = Enclosure::new(scene.patches.iter().map(|patch| patch.polygon.clone()).collect());
    let (mut own, mut all) = (0.0, 0.0);
    for emitter in strongest(scene, EMITTERS) {
        let Some(from) = scene.patches[emitter].middle() else { continue };
        for (to, factor) in enclosure.row(&from.owned_by(emitter)).into_iter().enumerate() {
            let received = power(&scene.patches[emitter]) * factor.value;
            own += if to == patch { received } else { 0.0 };
            all += received;
        }
    }
    if all > 0.0 { own / all } else { 1.0 }
}

/// The patches that emit most power, all bands together.
fn strongest(scene: &Scene, count: usize) -> Vec<usize> {
    let mut emitters: Vec<usize> =
        (0..scene.patches.len()).filter(|&patch| scene.patches[patch].emits()).collect();
    emitters.sort_by(|&a, &b| power(&scene.patches[b]).total_cmp(&power(&scene.patches[a])));
    emitters.truncate(count);
    emitters
}

/// What a patch emits, all bands together.
pub(super) fn power(patch: &Patch) -> f64 {
    patch.polygon.area() * patch.emission.iter().sum::<f64>()
}
