//! Neighbours that face opposite ways.
//!
//! Two patches that share an edge and belong to one surface run along it in opposite directions. Where they run the same
//! way, one of them is flipped: of a connected surface the side with the smaller area. Of patches with the same edges only
//! the first counts: a duplicate runs along all of them the same way, and is not flipped.
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use std::collections::{HashMap, HashSet};

type EdgeKey = [[u64; 3]; 2];

pub(super) fn findings(scene: &Scene) -> Vec<Finding> {
    let mut sides: HashMap<EdgeKey, Vec<(usize, bool)>> = HashMap::new();
    let mut known = HashSet::new();
    for (index, patch) in scene.patches.iter().enumerate() {
        let edges = edges(patch);
        if !known.insert(edges.clone()) {
            continue;
        }
        for [a, b] in edges {
            let forward = a < b;
            sides.entry(if forward { [a, b] } else { [b, a] }).or_default().push((index, forward));
        }
    }
    // An edge of two patches joins them; more patches are a junction of several surfaces.
    let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); scene.patches.len()];
    let mut edges: Vec<_> = sides.into_values().filter(|sides| sides.len() == 2).collect();
    edges.sort_unstable();
    for pair in edges {
        let [(a, along), (b, other)] = [pair[0], pair[1]];
        neighbours[a].push((b, along == other));
        neighbours[b].push((a, along == other));
    }
    let flipped = flipped(scene, &neighbours);
    flipped.into_iter().map(|patch| finding(&scene.patches[patch].name)).collect()
}

/// The directed edges of a patch, sorted.
fn edges(patch: &Patch) -> Vec<EdgeKey> {
    let loops = patch.polygon.loops();
    let pairs = loops.flat_map(|points| points.iter().zip(points.iter().cycle().skip(1)));
    let mut edges: Vec<EdgeKey> =
        pairs.map(|(a, b)| [a, b].map(|p| p.to_array().map(|number| (number + 0.0).to_bits()))).collect();
    edges.sort_unstable();
    edges
}

/// The patches that face the other way than most of the area of their surface.
fn flipped(scene: &Scene, neighbours: &[Vec<(usize, bool)>]) -> Vec<usize> {
    let mut turned: Vec<Option<bool>> = vec![None; neighbours.len()];
    let mut all = Vec::new();
    for start in 0..neighbours.len() {
        if turned[start].is_some() {
            continue;
        }
        let surface = surface(start, neighbours, &mut turned);
        let area = |side: bool| {
            let part = surface.iter().filter(|patch| turned[**patch] == Some(side));
            part.map(|patch| scene.patches[*patch].polygon.area()).sum::<f64>()
        };
        let minority = area(true) <= area(false);
        all.extend(surface.iter().filter(|patch| turned[**patch] == Some(minority)));
    }
    all.sort_unstable();
    all
}

/// All patches connected with the first, each marked by whether it is turned against it.
fn surface(start: usize, neighbours: &[Vec<(usize, bool)>], turned: &mut [Option<bool>]) -> Vec<usize> {
    turned[start] = Some(false);
    let mut surface = vec![start];
    let mut at = 0;
    while let Some(&patch) = surface.get(at) {
        let here = turned[patch].unwrap_or_default();
        for &(next, same_way) in &neighbours[patch] {
            if turned[next].is_none() {
                turned[next] = Some(here != same_way);
                surface.push(next);
            }
        }
        at += 1;
    }
    surface
}

fn finding(name: &str) -> Finding {
    Finding {
        kind: Kind::Flipped,
        patches: vec![name.into()],
        what: "it faces the other way than the patches around it".into(),
        repair: "reverse the order of its vertices; its front gives and takes the light".into(),
        places: Vec::new(),
    }
}
