//! What is wrong with the surfaces of a scene, put right, so that solving does not refuse it.
//!
//! ```text
//! cut          faces of one plane cut out of each other
//! junctions    vertices within edges of other patches become vertices of these
//! necks        what is thin between a corner and an edge is gone
//! findings     what is wrong with patches, in words
//! reflectance  no surface reflects all light
//! sections     closed surfaces, and the loops in which planes cut them
//! slivers      what is thinner than rounding is left out
//! solids       what lies within solids is cut away, where they pass through each other
//! weld         vertices that nearly meet become one
//! ```
//!
//! Surfaces that pass through each other and are not closed stay as they are: form factors are exact past them. Faces of one plane that face
//! opposite ways stay too: neither sees the other.
mod cut;
pub(crate) mod findings;
mod junctions;
mod necks;
mod reflectance;
mod sections;
mod slivers;
mod solids;
pub(crate) mod weld;

pub(crate) use reflectance::BRIGHTEST;

use crate::scene::{Scene, finding::Finding};

/// So many rounds after the first one: the second finds nothing but where planes are one in pairs.
const ROUNDS: usize = 4;

/// A scene after its repair, and what was wrong.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Repaired {
    /// The scene, which [`solve()`](crate::solve()) takes.
    pub scene: Scene,
    /// What was repaired, here and while the file was read: each of a kind that has a [`remedy`](crate::inspect::Kind::remedy).
    pub repairs: Vec<Finding>,
}

/// Repairs the surfaces of a scene.
///
/// - Reflectances of 1 or more become 0.99, negative ones 0.
/// - Vertices that lie beside each other by less than single precision rounds away become one, where polygons stay planar.
///   What lies beside each other by rounding of the file's numbers, or of doubles, is not told.
/// - Slivers and spikes of polygons, which are thinner than rounding, are left out.
/// - Edges get the vertices of other patches that lie within them, T-junctions, where polygons stay planar.
/// - Of surfaces that reach into a solid, a closed body whose faces are turned out, what lies within is cut away: no light comes there.
/// - Patches that face the same way in one plane are cut out of each other, so that no point is covered twice. An emitter stays whole
///   and is cut out of a patch that does not emit. Otherwise the smaller patch stays whole, and of equal ones the first. Duplicates and
///   patches that are covered completely are removed. The pieces of a patch get `.1`, `.2`, … behind its name. Cuts are exact.
///
/// All other patches stay as they are, bit for bit. What is repaired already stays as it is. O(n log n) for n patches that are spread out.
#[must_use]
pub fn repair(scene: &Scene) -> Repaired {
    repair_until(scene, &|| false).expect("nothing stops it")
}

/// Repairs the surfaces of a scene as [`repair`] does, or nothing when `stop` says to stop: it is asked several times, less than a second apart
/// for scenes of 100 000 patches.
#[must_use]
pub fn repair_until(scene: &Scene, stop: &dyn Fn() -> bool) -> Option<Repaired> {
    let mut scene = scene.clone();
    let read = scene.warnings.iter().filter(|warning| warning.kind.remedy().is_some()).cloned();
    let mut repairs: Vec<Finding> = read.collect();
    repairs.extend(reflectance::limit(&mut scene));
    let known = repairs.len();
    let is_moved = join(&mut scene, &mut repairs, stop)?;
    repairs.extend(solids::cut(&mut scene, stop)?);
    repairs.extend(cut::cut(&mut scene));
    if stop() {
        return None;
    }
    if is_moved || repairs.len() > known {
        settle(&mut scene, stop)?;
    }
    Some(Repaired { scene, repairs })
}

/// Makes vertices one that nearly meet, and leaves out slivers; returns whether any vertex was moved, nothing when stopped.
fn join(scene: &mut Scene, findings: &mut Vec<Finding>, stop: &dyn Fn() -> bool) -> Option<bool> {
    let is_moved = weld::weld(scene, findings);
    findings.extend(slivers::leave_out(scene, stop)?);
    findings.extend(junctions::join(scene, stop)?);
    (!stop()).then_some(is_moved)
}

/// Repairs what cuts leave: corners of two pieces at one place that were rounded apart, thin pieces, and overlaps where planes are one in
/// pairs and not all together. What overlaps after some rounds is left out.
fn settle(scene: &mut Scene, stop: &dyn Fn() -> bool) -> Option<()> {
    for _ in 0..ROUNDS {
        let mut found = Vec::new();
        let is_moved = join(scene, &mut found, stop)?;
        found.extend(cut::cut(scene));
        if !is_moved && found.is_empty() {
            return Some(());
        }
    }
    cut::leave_out_covered(scene);
    Some(())
}
