//! The light followed through the rooms of a scene.
use super::{light::Light, rooms::Rooms, run::Run};
use crate::error::Error;
use crate::scene::{Scene, patch::Patch};
use crate::union_find::UnionFind;

/// Follows the light from the emitters, and from where lights shine. What no light reaches is left out, and no factor to it is found; what only
/// receives is lit but sends the light no further. Nothing when the watcher wants to stop.
pub(super) fn follow(scene: &Scene, run: &mut Run<'_>) -> Result<Option<Rooms>, Error> {
    let patches = scene.patches.len();
    let elements = &run.factors.subdivision.mesh.elements;
    let patch_of: Vec<usize> = elements.iter().map(|element| element.patch).collect();
    let sends = senders(scene, &run.light, &patch_of);
    let mut lit: Vec<bool> = scene.patches.iter().map(Patch::emits).collect();
    let direct = run.light.direct.chunks_exact(run.light.bands).zip(&patch_of);
    direct.filter(|(light, _)| light.iter().any(|h| *h > 0.0)).for_each(|(_, &patch)| lit[patch] = true);
    let mut open: Vec<usize> = (0..patches).filter(|&patch| lit[patch]).collect();
    let mut sums = vec![0.0; patch_of.len()];
    let mut groups = UnionFind::new(patches);
    while let Some(sender) = open.pop() {
        if run.report().is_break() {
            return Ok(None);
        }
        let Some(column) = run.column(sender)? else { return Ok(None) };
        for (element, factor) in column.iter() {
            let receiver = patch_of[element];
            sums[element] += factor;
            // A black patch without emission ends the light that reaches it: it connects nobody.
            if !sends[sender] {
                continue;
            }
            groups.join(sender, receiver);
            if !lit[receiver] {
                lit[receiver] = true;
                open.push(receiver);
            }
        }
    }
    let mut rooms = Rooms { rooms: Vec::new(), sums, patches };
    rooms.collect(&lit, &mut groups, &patch_of, &run.light);
    Ok(Some(rooms))
}

/// Which patches emit or reflect some light.
fn senders(scene: &Scene, light: &Light, patch_of: &[usize]) -> Vec<bool> {
    let mut sends: Vec<bool> = scene.patches.iter().map(Patch::emits).collect();
    for (element, &patch) in patch_of.iter().enumerate() {
        sends[patch] |= light.largest_reflectance(element) > 0.0;
    }
    sends
}
